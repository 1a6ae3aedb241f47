"""Ranges of contacts: the range that a run needs, rounded outwards, and contacts spread over a range."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from mixedlub.laws.load import carries_load
from mixedlub.laws.oil import ZERO_CELSIUS

Box = Mapping[str, tuple[float, float]]
"""Lowest and highest value of each condition (SI), and of the factor on each calibrated property of the oil."""
CONDITIONS = ("radius", "hertz_pressure", "entrainment_speed", "slide_roll_ratio", "oil_temperature")
FACTORS = ("viscosity", "pressure_viscosity", "eyring_stress")
"""Calibrated properties of the oil; their factors follow the conditions in a box."""
STEP, KELVINS = 10.0**0.1, 5.0
"""Definition. Ends of ranges are in steps of the series R10, temperatures in steps of 5 °C, so that runs share
solutions."""
LEAST_SLIDING, MOST_SLIDING = 0.02, 1.9
"""Judgement. Slide-to-roll ratios that are solved: below the first, as at a pitch point, the ratio of solution and law
hardly changes; at 2 one surface stands still."""
SDS = 3.0
"""Judgement. Standard deviations of a calibrated property on each side that are solved."""


def needed(state: Mapping[str, np.ndarray]) -> Box:
    """Range of the loaded contacts of a run, from the last values of its chain.

    >>> one = dict.fromkeys(CONDITIONS, np.array([[0.01, 0.02]])) | {"line_load": np.array([[2e5, 1e3]])}
    >>> [round(end, 4) for end in needed(one)["radius"]]  # the second carries nothing
    [0.01, 0.01]
    """
    counted = carries_load(np.atleast_2d(state["line_load"]))
    if "gears_fitted" in state:
        counted = counted & (np.atleast_2d(state["gears_fitted"]) > 0.0)
    found = {}
    for name in CONDITIONS:
        values = np.broadcast_arrays(np.atleast_2d(state[name]), counted)
        loaded = values[0][values[1]]
        found[name] = (float(np.min(loaded)), float(np.max(loaded)))
    low, high = (min(max(end, LEAST_SLIDING), MOST_SLIDING) for end in found["slide_roll_ratio"])
    return {**found, "slide_roll_ratio": (low, high)}


def with_factors(box: Box, sds: Mapping[str, float]) -> Box:
    """The range with factors on the oil's properties, from the relative standard deviation of each.

    >>> with_factors({}, {"viscosity": 0.05, "eyring_stress": 0.0}).keys()
    dict_keys(['viscosity'])
    """
    return {**box, **{n: (float(np.exp(-SDS * sds[n])), float(np.exp(SDS * sds[n]))) for n in FACTORS if sds.get(n)}}


def union(boxes: Iterable[Box]) -> Box:
    """Smallest range that contains all."""
    every = list(boxes)
    return {name: (min(b[name][0] for b in every), max(b[name][1] for b in every)) for name in every[0]}


def rounded(box: Box) -> Box:
    """The range with its ends moved outwards to round numbers.

    >>> {n: (round(a, 4), round(b, 4)) for n, (a, b) in rounded({"radius": (0.0101, 0.012)}).items()}
    {'radius': (0.01, 0.0126)}
    >>> [t - ZERO_CELSIUS for t in rounded({"oil_temperature": (333.15, 333.15)})["oil_temperature"]]
    [55.0, 65.0]
    """
    found = {}
    for name, (low, high) in box.items():
        if name == "oil_temperature":
            ends = np.array([low, high]) - ZERO_CELSIUS
            first, last = _outwards(ends / KELVINS)
            found[name] = (KELVINS * first + ZERO_CELSIUS, KELVINS * last + ZERO_CELSIUS)
        else:
            first, last = _outwards(np.log([low, high]) / np.log(STEP))
            found[name] = (float(STEP**first), float(STEP**last))
    if "slide_roll_ratio" in found:
        low, high = found["slide_roll_ratio"]
        found["slide_roll_ratio"] = (max(low, LEAST_SLIDING), min(high, MOST_SLIDING))
    return found


def _outwards(steps: np.ndarray) -> tuple[int, int]:
    """Whole numbers around two numbers; a single one is set between its neighbours."""
    low, high = int(np.floor(steps[0] + 1e-6)), int(np.ceil(steps[1] - 1e-6))
    return (low, high) if high > low else (low - 1, high + 1)


def contains(box: Box, other: Box) -> bool:
    """Whether a range contains another; factors of the other may be missing.

    >>> contains({"radius": (1.0, 3.0), "viscosity": (0.8, 1.2)}, {"radius": (1.0, 2.0)})
    True
    """
    slack = 1e-9
    return all(
        n in box and box[n][0] <= a * (1.0 + slack) and box[n][1] >= b * (1.0 - slack) for n, (a, b) in other.items()
    )


def size(box: Box) -> float:
    """Volume of a range in logarithms."""
    return float(np.prod([np.log(high / low) for low, high in box.values()]))


def spread(box: Box, places: np.ndarray) -> dict[str, np.ndarray]:
    """Values in a range at places between 0 and 1, a column for each name; even in logarithms and in temperature."""
    found = {}
    for (name, (low, high)), place in zip(box.items(), places.T, strict=True):
        even = name == "oil_temperature"
        found[name] = low + (high - low) * place if even else low * (high / low) ** place
    return found
