"""Ranges of contacts under any laws (pressure, film, asperities, oil), and ranges declared by laws."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Step
from mixedlub.chain.ranges import Ends, Limit, declared, of_law
from mixedlub.laws.balance import LEAST_ASPERITY_SHARE
from mixedlub.laws.oil import D341_LEAST

LEAST_HARD_MODULUS = 50e9
"""Judgement. Smallest reduced modulus (Pa) of metals, ceramics and glass."""
RATED_RATIO, YIELD_RATIO = 0.018, 0.025
"""Sources: ISO 76; K. L. Johnson, Contact Mechanics (1985), section 9.2. Hertz pressure over reduced modulus to which
hard steel is rated (4.0 to 4.2 GPa), and of the shakedown limit 4 k = 2 Y, with the yield strength Y = H/2.8 of the
hardness below (5.7 GPa), beyond which every pass deforms hard bodies; polymers bear a larger share."""
HARDNESS = 8e9
"""Source: ISO 18265. Hardness (Pa) of hardened steel, 800 HV at 64 HRC."""
FAR_FROM_OIL = 30.0
"""Judgement. Temperature distance (K) from both viscosity points up to which the viscosity law is accurate enough."""
FAR_FROM_PRESSURE = 0.3e9
"""Judgement. Pressure (Pa) beyond the readings of a traction part up to which its powers are accurate enough."""
EXACT = 1e-8
"""Largest relative error of the load carried by film and asperities together."""
BROAD = 1.5
"""Definition. Smallest Nayak bandwidth of isotropic Gaussian surfaces; profiles have at least 1."""

FILMS = ("film_thickness", "law_film", "regression_film")
"""Steps of film laws, which an effect may replace."""
BALANCE = (
    '; with the options balance "johnson_greenwood_poon" and mixture "load_weighted" the film gives way, and friction '
    "follows the load that asperities carry"
)
"""Advice on overloaded asperities in studies that can share the load."""
YIELDING = "; asperities that yield are an option (asperities, with hardness_GPa)"
"""Advice on elastic asperities in studies."""


def contact_limits(inputs: Mapping[str, Any], effects: Collection[str] = ()) -> tuple[Limit, ...]:
    """Limits of contacts with these inputs, for any laws; ``effects``: names of the active ones. Asperities with a
    hardness yield, and have no limit of elastic ones."""
    found = []
    modulus = float(np.max(inputs.get("reduced_modulus", 0.0)))
    if modulus >= LEAST_HARD_MODULUS:
        rated, bearable = ((0.0, ratio * modulus) for ratio in (RATED_RATIO, YIELD_RATIO))
        advice = (
            f"hard bodies keep a dent, and above {bearable[1] * 1e-6:.4g} MPa every pass deforms them, so that Hertz' "
            "contact cannot last: check load or torque and the size of the contact"
        )
        found.append(Limit("pressure_above_yield", "hertz_pressure", rated, advice, rated, bearable))
        if "hardness" not in inputs and "asperity_plasticity" not in effects:
            found.append(_ELASTIC)
    known = ("first_known_temperature", "second_known_temperature")
    if all(name in inputs for name in known):
        low, high = sorted(float(np.max(inputs[name])) for name in known)
        near, far = ((low - n * FAR_FROM_OIL, high + n * FAR_FROM_OIL) for n in (1.0, 2.0))
        advice = "the viscosity is extrapolated far from the two that the oil is given by"
        found.append(Limit("viscosity_extrapolated", "oil_temperature", near, advice, far))
    return (*found, *_of_traction(inputs), *_OF_CONTACTS)


def _of_traction(inputs: Mapping[str, Any]) -> Iterator[Limit]:
    """Limits of the readings behind the traction part of an oil."""
    advice = "the Eyring stress and limiting stress of the oil are extrapolated from the readings of its traction part"
    for quantity, what, margin in (
        ("hertz_pressure", "pressure", FAR_FROM_PRESSURE),
        ("oil_temperature", "temperature", FAR_FROM_OIL),
    ):
        names = f"lowest_fitted_{what}", f"highest_fitted_{what}"
        if all(name in inputs for name in names):
            low, high = (float(np.max(inputs[name])) for name in names)
            yield Limit("traction_extrapolated", quantity, (low, high), advice, (low - margin, high + margin))


_ELASTIC = Limit(
    "asperities_above_hardness",
    "asperity_real_pressure",
    (0.0, HARDNESS),
    "asperities press harder than hardened steel can bear, so that they yield",
)
_SHARE, _NONE = (0.0, 1.0), (0.0, EXACT)
_D341 = (1e-6 * D341_LEAST, np.inf)
_OF_CONTACTS = (
    Limit(
        "viscosity_below_d341",
        "kinematic_viscosity",
        _D341,
        "the oil is thinner than ASTM D341 describes, whose terms steepen there",
        _D341,
    ),
    Limit(
        "film_above_contact_width",
        "film_over_contact_width",
        _SHARE,
        "the film is thicker than the contact is wide, so that no film law and no loss holds: check oil_temperature_C "
        "and the viscosity of the oil",
        _SHARE,
        _SHARE,
        meaning="film thickness over contact width",
    ),
    Limit(
        "balance_not_found",
        "balance_error",
        _NONE,
        "no film was found at which film and asperities together carry the load",
        _NONE,
        _NONE,
        meaning="error of the load that film and asperities carry, over the load",
    ),
    Limit(
        "asperities_overloaded",
        "asperity_load_ratio",
        (0.0, 1.0 + EXACT),
        "asperities would carry more than the load at the gap of the film law: the real area is too large for the "
        "load, and friction may be too large or much too small",
        meaning="their load over the whole load",
    ),
    Limit(
        "film_carries_too_little",
        "share_lacking",
        _SHARE,
        "asperities carry so much that the film's own contact is isoviscous or hardly flattened, for which its law is "
        "not made; the loss hangs on friction and area of the asperities",
        meaning="least share of the load for which the film law holds over the share that the film carries",
    ),
    Limit(
        "area_ratio_limited",
        "largest_area_ratio",
        (0.0, 1.0 - EXACT),
        "the boundary area ratio was limited to 1",
        (0.0, 1.0 - EXACT),
        meaning="real over nominal contact area",
    ),
    Limit(
        "bandwidth_limited",
        "nayak_bandwidth",
        (BROAD, np.inf),
        "no isotropic Gaussian surface has such a Nayak bandwidth; 1.5 was used",
        (1.0, np.inf),
        meaning="Nayak's bandwidth m0 m4/m2^2",
    ),
)


def of_bearing_asperities(pressure: np.ndarray, load_ratio: np.ndarray) -> np.ndarray:
    """Real pressure of asperities that carry enough of the load to be judged, else 0.

    >>> of_bearing_asperities(np.array([9e9, 9e9]), np.array([0.5, 0.01])).tolist()
    [9000000000.0, 0.0]
    """
    return np.where(load_ratio < LEAST_ASPERITY_SHARE, 0.0, pressure)


def law_limits(
    steps: Iterable[Step], effects: Iterable[Effect], values: Mapping[str, Mapping[str, float]]
) -> tuple[Limit, ...]:
    """Limits declared by the laws of a model's steps and by its effects; an effect replacing the film law has separate
    limits."""
    active = tuple(effects)
    replaced = FILMS if any(e.replaces == "film thickness" for e in active) else ()
    laws: dict[str, Mapping[str, Ends]] = {
        step.law.__name__: declared(step.law)
        for step in steps
        if step.effect is None and step.outputs[0] not in (*replaced, "pitch_film")
    }
    laws |= {e.id: e.valid_at({**e.nulls, **values.get(e.id, {})}) for e in active}
    return tuple(limit for name, ranges in laws.items() for limit in of_law(name, ranges))
