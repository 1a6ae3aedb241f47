"""Every law and effect answers the same in other units of mass, length and time, or says why it cannot."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import mixedlub.laws
from mixedlub.base_model import chains as base_models
from mixedlub.chain.effect import Effect
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.schema.units import dimension
from roughness import mccool
from tests.contracts.rigs import EFFECTS, RIGS, moved, states

ODD = np.log([1.7, 0.31, 2.3])
"""Logarithms of odd factors on the kilogram, the metre and the second."""

OTHER_ARGUMENTS = {
    "temperature": (340.0, "K"),
    "rise": (20.0, "K"),
    "pressure": (2e8, "Pa"),
    "known_temperature": ((313.15, 373.15), "K"),
    "known_viscosity": ((34e-6, 7.2e-6), "m^2/s"),
    "kinematic_viscosity": (34e-6, "m^2/s"),
    "ordinate": (0.18, "-"),
    "immersion_ratio": (0.5, "-"),
    "youngs_modulus": ((206e9, 70e9), "Pa"),
    "poisson_ratio": ((0.3, 0.25), "-"),
    "value": (np.array([3.0, 2.0]), "Pa"),
    "weight": (np.array([0.3, 0.4]), "-"),
    "mean_weight": (np.array([0.3]), "-"),
    "given": (0.4, "-"),
    "exponent": (0.6, "-"),
    "scale": (9.904, "-"),
    "hardness": (6e9, "Pa"),
    "wavelength": (0.3, "-"),
    "reduction": (1.4, "-"),
    "orientation": (3.0, "-"),
    "lengths": (np.array([20e-6, 60e-6]), "m"),
    "shares": (np.array([[0.3, 0.7], [0.5, 0.5], [0.6, 0.4]]), "-"),
    "rates": (np.array([1e4, 4e4]), "1/m"),
    "cutoffs": (np.array([5e-6]), "m"),
    "moes_load": (100.0, "-"),
    "moes_material": (11.0, "-"),
    "per_stress": (2e-8, "1/Pa"),
    "at_40": (46e-6, "m^2/s"),
    "at_100": (8.7e-6, "m^2/s"),
    "slow": (20.0, "W"),
    "fast": (30.0, "W"),
    "share": (0.7, "-"),
    "contact_temperature": (430.0, "K"),
    "bulk_temperature": (360.0, "K"),
    "mean_flash_temperature": (30.0, "K"),
    "integral_temperature": (400.0, "K"),
    "scuffing_temperature": (500.0, "K"),
    "flash_weight": (1.5, "-"),
    "slip": (np.array([[2e-3, 3e-5]]), "m"),
    "early": (np.array([[2e-3, 4e-5]]), "m"),
    "slip_length": (2e-5, "m"),
    "onset": (0.3, "-"),
    "speed_share": (3.0, "-"),
    "direct": (0.008, "-"),
    "evolution": (0.013, "-"),
    "age": (0.7, "-"),
}
"""Arguments of laws that are no words of the glossary: a value and its unit."""

OTHER_OUTPUTS = {
    "over_path": "Pa",
    "nayak_parameter": "-",
    "carries_load": "-",
    "kinematic_viscosity": "m^2/s",
    "to_d341": "-",
    "from_d341": "m^2/s",
    "contact_softening": "1/K",
}
"""Units of answers that neither the name nor the end of the summary gives."""

READING = {"gear_pair": "W", "film": "m", "friction_map": "N m", "viscosity": "Pa s"}
"""Unit of the reading, by kind of recording."""


def factor(unit: str, logs: np.ndarray) -> float:
    """What a quantity of this unit is multiplied by in the other units."""
    return float(np.exp(logs @ dimension(unit)[:3]))


def belongs_to(law: Callable[..., object]) -> list[str]:
    """Units that a form with constants of its own needs, as its docstring says; none for a sound one."""
    found = re.search(r"makes?\s+th(?:e|is)\s+form\s+belong\s+to\s+([^.;]+)", inspect.getdoc(law) or "")
    if not found:
        return []
    words = re.split(r",\s*|\s+and\s+", found.group(1).strip())
    return ["kg", "m", "s"] if words == ["SI"] else [re.sub(r"^mm", "m", word) for word in words]


def keeping(units: list[str]) -> np.ndarray:
    """Logarithms of odd factors that leave these units as they are."""
    fixed = np.array([dimension(unit)[:3] for unit in units], dtype=float)
    return ODD - np.linalg.pinv(fixed) @ (fixed @ ODD)


def laws() -> list[tuple[str, Callable[..., object]]]:
    modules = [importlib.import_module(f"mixedlub.laws.{m.name}") for m in pkgutil.iter_modules(mixedlub.laws.__path__)]
    return [
        (f"{module.__name__.rsplit('.', 1)[-1]}.{name}", law)
        for module in (*modules, mccool)
        for name, law in inspect.getmembers(module, inspect.isfunction)
        if law.__module__ == module.__name__ and not name.startswith("_")
    ]


def output_unit(name: str, law: Callable[..., object]) -> str:
    """Unit of what a law returns: of its name, of its place in a chain, or as its summary says in brackets."""
    word = name.rsplit(".", 1)[-1]
    if word in GLOSSARY:
        return GLOSSARY[word].unit
    for chain in (base_models.GEAR_LOSS, base_models.LINE, base_models.POINT):
        for quantity, candidate in chain:
            if candidate is law:
                return GLOSSARY[quantity].unit
    if word in OTHER_OUTPUTS:
        return OTHER_OUTPUTS[word]
    found = re.search(r"\(([^()]*(?:\([^()]*\))?[^()]*)\)[.,;:]", (inspect.getdoc(law) or "").split(".. math")[0])
    assert found, f"{name}: the summary does not end in the unit of the answer in brackets"
    return found.group(1)


def same(
    law: Callable[..., Any],
    values: dict[str, Any],
    units: dict[str, str],
    outputs: tuple[str, ...],
    logs: np.ndarray = ODD,
) -> bool:
    """Whether the law answers the same when its arguments come in other units."""
    here = law(**values)
    there = law(**{k: np.multiply(v, factor(units[k], logs)) for k, v in values.items()})
    pairs = zip(here, there, strict=True) if len(outputs) > 1 else ((here, there),)
    return all(
        np.allclose(np.multiply(a, factor(unit, logs)), b, rtol=1e-9, atol=1e-12 * largest(b))
        for (a, b), unit in zip(pairs, outputs, strict=True)
    )


def largest(values: Any) -> float:
    """Size of the largest finite value, against which a value that cancels to nothing is nothing."""
    return float(np.max(np.abs(np.where(np.isfinite(values), values, 0.0)), initial=0.0))


def check(
    law: Callable[..., Any], cases: list[dict[str, Any]], units: dict[str, str], outputs: tuple[str, ...]
) -> None:
    """Other units change nothing; where the docstring names units, nothing but those, and those really do."""
    own = belongs_to(law)
    assert all(same(law, values, units, outputs) for values in cases) is not bool(own)
    if own:
        assert all(same(law, values, units, outputs, keeping(own)) for values in cases)


@pytest.mark.parametrize(("name", "law"), laws(), ids=[name for name, _ in laws()])
def test_law_answers_the_same_in_other_units(name: str, law: Callable[..., object]) -> None:
    values, units = {}, {}
    for word, argument in inspect.signature(law).parameters.items():
        if argument.default is not argument.empty:
            continue
        if word in OTHER_ARGUMENTS:
            values[word], units[word] = OTHER_ARGUMENTS[word]
        else:
            assert word in GLOSSARY, f"{name}: {word!r} is neither in the glossary nor in OTHER_ARGUMENTS"
            values[word], units[word] = states()["gear_pair"][word], GLOSSARY[word].unit
    check(law, [values], units, (output_unit(name, law),))


def units_of(effect: Effect) -> tuple[dict[str, str], tuple[str, ...]]:
    reading = READING.get(effect.kinds[0], "-") if effect.kinds else "W"
    units = {w: GLOSSARY[w].unit.replace("*", reading) for w in (*effect.acts_on, *effect.reads)}
    outputs = tuple(units[w] for w in effect.acts_on)
    return units | {p.name: p.unit for p in effect.parameters}, outputs


@pytest.mark.parametrize("effect", EFFECTS, ids=[e.id for e in EFFECTS])
def test_effect_answers_the_same_in_other_units(effect: Effect) -> None:
    units, outputs = units_of(effect)
    cases = [{w: states()[n][w] for w in (*effect.acts_on, *effect.reads)} | moved(effect) for n in RIGS]
    check(effect.law, cases, units, outputs)
