"""Every law takes Python's numbers outside its range as it takes arrays: NaN where it has no answer, never complex."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from mixedlub.friction import catalogue
from tests.contracts.rigs import states
from tests.contracts.test_scaling import OTHER_ARGUMENTS, laws

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
