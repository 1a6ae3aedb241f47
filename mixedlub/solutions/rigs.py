"""Contacts for the comparison of laws: rigs over the regimes of gears, each at several speeds and loads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.solve import contacts
from mixedlub.laws.contact import reduced_modulus
from mixedlub.laws.oil import ZERO_CELSIUS
from profiles.errors import InputError

LOADS, MATERIALS = (1.0, 300.0), (3.0, 22.0)
"""Moes' parameters M and L of steel line contacts in gears."""
PRESSURES, SPEEDS = (0.2e9, 2.0e9), (0.1, 50.0)
"""Hertz pressures (Pa) and mean surface speeds (m/s) of gears."""
RADII, TEMPERATURES = (4e-3, 30e-3), (50.0 + ZERO_CELSIUS, 100.0 + ZERO_CELSIUS)
"""Reduced radii (m), and oil temperatures (K) at the centre of a rig's range."""
RATIOS = (0.02, 1.0)
"""Slide-to-roll ratios."""
SPEED_STEPS, LOAD_STEPS, WARMER = (0.35, 0.7, 1.4, 2.8), (0.4, 1.0, 2.5), (-15.0, 15.0)
"""Speeds and loads relative to the centre of a rig, and oil temperatures relative to its centre (K)."""
LEAST_CONTACTS = 12
"""Half of a full rig: fewer contacts do not determine exponents of speed and load."""
LEAST_DRAWN = 16
"""Smallest number of contacts of a rig inside the ranges, as some may have no solution."""
_MOST_TRIED = 2000
"""Cost limit. Rigs tried; the ranges of M, L and pressure overlap little for some oils."""
STEEL = reduced_modulus((206e9, 206e9), (0.3, 0.3))


@dataclass(frozen=True)
class Rigs:
    """Contacts, and the rig number of each, from 1."""

    number: np.ndarray
    contacts: Contacts


def draw(oil: Oil, count: int, seed: int) -> Rigs:
    """Rigs of an oil, spread evenly over the logarithm of M, over L, radius and temperature.

    >>> from mixedlub.ehl import example_oil
    >>> rigs = draw(example_oil(), 2, seed=1)
    >>> sorted(set(rigs.number.tolist())), len(rigs.number) >= 2 * LEAST_DRAWN
    ([1, 2], True)
    """
    from scipy.stats import qmc

    sequence = qmc.Halton(5, rng=seed)
    found: list[dict[str, Any]] = []
    for _ in range(_MOST_TRIED):
        if len(found) == count:
            break
        rig = _rig(oil, *sequence.random(1)[0])
        found += [rig] if len(rig["radius"]) >= LEAST_DRAWN else []
    if len(found) < count:
        raise InputError(f"{len(found)} of {count} rigs found whose contacts are those of gears", where=oil.name)
    number = np.concatenate([np.full(len(rig["radius"]), place) for place, rig in enumerate(found, 1)])
    every: dict[str, Any] = {name: np.concatenate([rig[name] for rig in found]) for name in found[0]}
    return Rigs(number, contacts(**every))


def _rig(oil: Oil, load: float, material: float, radius: float, warmth: float, shift: float) -> dict[str, Any]:
    """Contacts of a rig inside the ranges, from five numbers between 0 and 1."""
    middle = _geometric(LOADS, load), MATERIALS[0] + material * (MATERIALS[1] - MATERIALS[0])
    size = _geometric(RADII, radius)
    temperature = TEMPERATURES[0] + warmth * (TEMPERATURES[1] - TEMPERATURES[0])
    viscosity, coefficient = oil.at_ambient(np.array(temperature))
    twice = (middle[1] / (coefficient * STEEL)) ** 4.0
    speed, heavy, warm = (
        axis.ravel() for axis in np.meshgrid(np.array(SPEED_STEPS), np.array(LOAD_STEPS), np.array(WARMER))
    )
    places = (shift + np.arange(speed.size) * _GOLDEN) % 1.0
    entrainment = speed * twice * STEEL * size / (2.0 * viscosity)
    rig: dict[str, Any] = {
        "radius": np.full(speed.size, size),
        "line_load": heavy * middle[0] * np.sqrt(twice) * STEEL * size,
        "speed": entrainment,
        "sliding_speed": entrainment * _geometric(RATIOS, places),
        "oil_temperature": temperature + warm,
    }
    fits = inside(oil, contacts(**rig))
    return {name: values[fits] for name, values in rig.items()}


_GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)
"""Step for an even spread of any number of slide-to-roll ratios."""


def _geometric(ends: tuple[float, float], place: float | np.ndarray) -> np.ndarray:
    return np.asarray(ends[0] * (ends[1] / ends[0]) ** np.asarray(place))


def inside(oil: Oil, found: Contacts) -> np.ndarray:
    """Whether contacts are inside the ranges and inside the range of the oil's file."""
    load, material = found.moes(*oil.at_ambient(found.oil_temperature))
    rules = ((load, LOADS), (material, MATERIALS), (found.pressure, PRESSURES), (found.speed, SPEEDS))
    fits = [(value >= low) & (value <= high) for value, (low, high) in rules]
    low, high = oil.temperatures
    warm = (found.oil_temperature >= low) & (found.oil_temperature <= high)
    return np.asarray(np.all(fits, axis=0) & warm & (found.pressure <= oil.largest_pressure))
