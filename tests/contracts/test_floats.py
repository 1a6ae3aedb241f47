"""Numbers of Python and of processors.

Every law takes Python's numbers outside its range as it takes arrays: NaN where it has no answer, never complex. No
example of a docstring shows a number to its last bit, which other processors round otherwise.
"""

from __future__ import annotations

import ast
import doctest
import inspect
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mixedlub.friction import catalogue
from tests.contracts.rigs import states
from tests.contracts.test_scaling import OTHER_ARGUMENTS, laws

ROOT = Path(__file__).parents[2]
Documented = ast.Module | ast.ClassDef | ast.FunctionDef
SUMS = (
    *("loss.mean_friction", "loss.friction_of_path", "loss.sliding_integral"),
    *("loss.mesh_loss", "loss.over_path", "loss.rolling_loss"),
)
"""Laws that sum over the last axis of arrays, and so take no numbers."""
FRICTION = [(f"friction.{law.name}", law.law) for law in catalogue().values()]
LAWS = [(name, law) for name, law in (*laws(), *FRICTION) if name not in SUMS]


def sound(word: str) -> Any:
    """A value of an argument within the range of the laws: a number of Python, or a pair where they need one."""
    known = OTHER_ARGUMENTS[word][0] if word in OTHER_ARGUMENTS else states()["gear_pair"].get(word, 0.5)
    return known if isinstance(known, tuple) else float(np.ravel(known)[-1])


def answer(law: Callable[..., Any], values: dict[str, Any]) -> Any:
    """What a law gives; NaN where its splines over the gap refuse it, as for a negative modulus."""
    try:
        return law(**values)
    except ValueError:
        return np.nan


@pytest.mark.parametrize(("name", "law"), LAWS, ids=[name for name, _ in LAWS])
def test_negative_numbers_give_what_arrays_give(name: str, law: Callable[..., Any]) -> None:
    values = {word: sound(word) for word in inspect.signature(law).parameters}
    pairs = {word: value for word, value in values.items() if isinstance(value, tuple)}
    numbers = {word: value for word, value in values.items() if word not in pairs}
    turned = [{word: -value} for word, value in numbers.items()] + [{word: -value for word, value in numbers.items()}]
    with np.errstate(all="ignore"):
        for changed in turned:
            given = numbers | changed
            found = answer(law, given | pairs)
            wanted = answer(law, {word: np.asarray(value) for word, value in given.items()} | pairs)
            assert np.isrealobj(found), changed
            assert np.ravel(found) == pytest.approx(np.ravel(wanted), rel=1e-12, abs=0.0, nan_ok=True), changed


NUMBER = re.compile(r"(?<![\w.'])[-+]?(?:\d+\.\d*|\.\d+|\d+(?=e))(?:e[-+]?\d+)?(?![\w'])")
ROUNDED = re.compile(r"round|:[,.\d]*[gfe%]|%\.|number\(|print\(|_plain\(|convert\(|in_reach\(")
"""Examples that round, or whose law does."""
LOOKED_UP = re.compile(r"metres|length\(|cutoff_for|_mm2_s|typical|series_coefficients|change|case_of|p\.length")
"""Answers read from a table, a file or a unit's name as they stand there."""


def documented(node: Documented) -> Iterator[Documented]:
    """A module, a class or a function, and those in it."""
    yield node
    for inner in node.body:
        if isinstance(inner, ast.ClassDef | ast.FunctionDef):
            yield from documented(inner)


def examples() -> Iterator[tuple[str, doctest.Example]]:
    """Every example of the packages whose answer is seen, with its place."""
    for package in ("profiles", "roughness", "mixedlub"):
        for path in sorted((ROOT / package).rglob("*.py")):
            for node in documented(ast.parse(path.read_text(encoding="utf-8"))):
                for example in doctest.DocTestParser().get_examples(ast.get_docstring(node, clean=False) or ""):
                    if example.want and not example.exc_msg:
                        yield f"{path.relative_to(ROOT)}: {example.source.strip()}", example


def held_to_the_last_bit(example: doctest.Example) -> list[str]:
    """Numbers of an answer that another processor may round otherwise.

    Left out are words in quotes, numbers that the example itself holds, and short sums of powers of two.
    """
    seen = re.sub(r"'[^']*'|\"[^\"]*\"", "", example.want)
    held = [word for word in NUMBER.findall(seen) if len(re.sub(r"e.*|\D", "", word).strip("0")) > 10]
    if ROUNDED.search(example.source) or LOOKED_UP.search(example.source):
        return held
    given = {float(word) for word in NUMBER.findall(example.source)}
    return [w for w in NUMBER.findall(seen) if float(w) not in given and not (float(w) * 1024.0).is_integer()]


def test_no_example_shows_a_number_to_the_last_bit() -> None:
    assert [place for place, example in examples() if held_to_the_last_bit(example)] == []


@pytest.mark.parametrize(
    ("source", "want", "held"),
    [
        ("float(mean(NODES**4))", "0.0125", True),
        ("round(float(mean(NODES**4)), 9)", "0.0125", False),
        ("round(area, 16)", "0.12345678901234", True),
        ("of(0.137)", "0.137", False),
        ("half(1.0)", "(0.5, '0.1')", False),
    ],
)
def test_an_example_to_the_last_bit_is_seen(source: str, want: str, held: bool) -> None:
    assert bool(held_to_the_last_bit(doctest.Example(source, want))) is held
