"""Contacts for the regression of friction, and their solutions as a table."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd

from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.solve import Way, contacts
from mixedlub.friction.condensed import INPUTS, OIL
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.solutions.rigs import STEEL, inside
from profiles.errors import InputError

RANGES = {
    "hertz_pressure": (0.4e9, 2.0e9),
    "slide_roll_ratio": (0.01, 1.2),
    "entrainment_speed": (0.5, 30.0),
    "oil_temperature": (40.0 + ZERO_CELSIUS, 110.0 + ZERO_CELSIUS),
    "radius": (3e-3, 30e-3),
}
"""Ranges of gear contacts, in SI."""
_ENOUGH = 20
"""Cost limit. Contacts tried per contact inside the ranges."""


def draw(oil: Oil, count: int, seed: int) -> Contacts:
    """Contacts spread evenly over the ranges, with both signs of sliding, restricted to Moes' M and L of gears.

    >>> from mixedlub.ehl import example_oil
    >>> found = draw(example_oil(), 8, seed=1)
    >>> len(found.radius), bool((found.sliding < 0.0).any()), bool((found.sliding > 0.0).any())
    (8, True, True)
    """
    from scipy.stats import qmc

    places = qmc.LatinHypercube(len(RANGES), rng=seed).random(_ENOUGH * count)
    given: dict[str, Any] = {}
    for (name, (low, high)), place in zip(RANGES.items(), places.T, strict=True):
        even = name in ("hertz_pressure", "oil_temperature")
        given[name] = low + (high - low) * place if even else low * (high / low) ** place
    pressure, ratio, speed = (given[name] for name in ("hertz_pressure", "slide_roll_ratio", "entrainment_speed"))
    every = contacts(
        radius=given["radius"],
        line_load=2.0 * np.pi * given["radius"] * pressure**2 / STEEL,
        speed=speed,
        sliding_speed=np.where(np.arange(len(ratio)) % 2, -1.0, 1.0) * ratio * speed,
        oil_temperature=given["oil_temperature"],
    )
    fits = np.flatnonzero(inside(oil, every))[:count]
    if len(fits) < count:
        raise InputError(f"only {len(fits)} of {count} contacts of gears are in the range of the oil", where=oil.name)
    return every.take(fits)


def solved_table(oil: Oil, found: Contacts, way: Way) -> pd.DataFrame:
    """Table with a row per contact: regression inputs, sign of sliding, absolute friction, error and status."""
    data = way.solved(oil, found, thermal=True)
    values = inputs_of(oil, found)
    table = pd.DataFrame({one.column: values[one.name] / one.factor for one in INPUTS})
    table["oil_temperature_C"] = found.oil_temperature - ZERO_CELSIUS
    table["sliding"] = np.where(found.sliding < 0.0, "first faster", "second faster")
    table["friction"] = np.abs(data["friction_coefficient"].to_numpy())
    table["friction_error_percent"] = 100.0 * data["friction_coefficient_error"].to_numpy()
    table["status"] = data["status"].to_numpy()
    return table


def properties_of(oil: Oil) -> dict[str, float]:
    """Coefficients for comparing the oil of a study with this oil."""
    found = {}
    for name, one in OIL.items():
        viscosity, coefficient = oil.at_ambient(np.array(one.temperature))
        own = {"viscosity": viscosity, "pressure_viscosity": coefficient, "eyring_stress": np.array(oil.eyring_stress)}
        found[name] = float(own[one.quantity]) / one.factor
    return found


def inputs_of(oil: Oil, found: Contacts) -> dict[str, np.ndarray]:
    """Inputs of the regression, in SI."""
    values = (
        found.pressure,
        np.abs(found.sliding) / found.speed,
        found.speed,
        oil.at_ambient(found.oil_temperature)[0],
        found.radius,
    )
    return {one.name: value for one, value in zip(INPUTS, values, strict=True)}
