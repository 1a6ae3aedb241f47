"""Instrument names of the columns of a case: words and units in headers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.kinds import NATIVE, kind
from mixedlub.schema.table import BOOKKEEPING
from mixedlub.schema.units import change_to, fits, is_unit, open_units, read_as, rounded, units_of, words_of
from profiles.errors import InputError

WEIGHED = {"g": "grams-force of 9.80665 mN", "kg": "kilograms-force of 9.80665 N"}
"""Units of mass of a load, and their meaning as a force."""


@dataclass(frozen=True)
class Target:
    """Column of a case with its unit, its headers in instrument files, and further possible headers."""

    name: str
    unit: str
    spoken: tuple[str, ...]
    offered: tuple[str, ...] = ()


_COLUMNS = {
    c.name: c for k in map(kind, NATIVE) for c in (*BOOKKEEPING, *k.columns, *k.instrument_channels, *k.readings)
}
TARGETS = tuple(Target(c.name, read_as(c.name), c.words, c.hints) for c in _COLUMNS.values() if c.words)
BY_NAME = {t.name: t for t in TARGETS}
TEXT_COLUMNS = tuple(c.name for c in _COLUMNS.values() if c.dtype == "name")


def target_of(header: str) -> Target | None:
    """Column denoted by a header, by exact column name or instrument words."""
    if header.strip() in BY_NAME:
        return BY_NAME[header.strip()]
    words = words_of(header)
    return next((t for t in TARGETS if words in t.spoken), None)


def is_kinematic(unit: str | None) -> bool:
    """Whether a unit is of kinematic viscosity, viscosity divided by density."""
    return unit is not None and change_to(unit, "mm2_s") is not None


def family(target: Target, unit: str) -> str:
    """Unit of a column, or the kinematic viscosity unit convertible to it by density.

    >>> family(BY_NAME["viscosity_mPa_s"], "cSt"), family(BY_NAME["viscosity_mPa_s"], "cP")
    ('mm2_s', 'mPa_s')
    """
    return "mm2_s" if target.unit == "mPa_s" and is_kinematic(unit) else target.unit


def is_of_another(unit: str, target: Target) -> bool:
    """Whether a unit belongs to a quantity other than the column's; kinematic viscosity counts as viscosity.

    >>> is_of_another("mPa s", BY_NAME["friction_coefficient"]), is_of_another("mm2/s", BY_NAME["viscosity_mPa_s"])
    (True, False)
    """
    if is_kinematic(unit):
        return target.unit != "mPa_s"
    return is_unit(unit) and not fits(unit, target.unit)


def unknown_unit(unit: str, target: Target) -> str:
    """Reason for rejecting a unit of a column, and possible units."""
    candidates = open_units(unit, target.unit)
    if candidates:
        return f"as unit of {target.name} leaves open which is meant; say {' or '.join(candidates)}"
    if target.unit == "mPa_s" and is_kinematic(unit):
        rule = "is one of kinematic viscosity: in mm²/s, times the density in g/cm³, it is in mPa s"
    else:
        rule = f"is not known; it could be {', '.join(units_of(target.unit))}"
    return f"unit of {target.name} {rule}"


def convert(values: np.ndarray, unit: str, target: Target, where: str) -> np.ndarray:
    """Values in the unit of the target's column, without spurious last digits from conversion.

    >>> convert(np.array([1.5]), "mm/s", BY_NAME["entrainment_speed_m_s"], "file").tolist()
    [0.0015]
    >>> convert(np.array([300.1]), "K", BY_NAME["temperature_C"], "file").tolist()   # not 26.9500000000000455
    [26.95]
    """
    change = change_to(unit, target.unit)
    if change is None:
        raise InputError(unknown_unit(unit, target), where=where, value=unit)
    factor, added = change
    return values if change == (1.0, 0.0) else rounded(values * factor + added, abs(added))
