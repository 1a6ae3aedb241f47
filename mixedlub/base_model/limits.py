"""Ranges of contacts under any laws (pressure, film, asperities, oil), and ranges declared by laws."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Step
from mixedlub.chain.ranges import Ends, Limit, declared, of_law
from mixedlub.laws.oil import D341_LEAST

LEAST_HARD_MODULUS = 50e9
"""Judgement. Smallest reduced modulus (Pa) of metals, ceramics and glass."""
RATED_RATIO, YIELD_RATIO = 0.018, 0.025
"""Source: ISO 76. Hertz pressure over reduced modulus to which hard steel is rated (4.0 to 4.2 GPa), and at which hard
bodies yield under the whole contact; polymers bear a larger share."""
FAR_FROM_OIL = 30.0
"""Judgement. Temperature distance (K) from both viscosity points up to which the viscosity law is accurate enough."""
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


def contact_limits(inputs: Mapping[str, Any]) -> tuple[Limit, ...]:
    """Limits of contacts with these inputs, for any laws."""
    found = []
    modulus = float(np.max(inputs.get("reduced_modulus", 0.0)))
    if modulus >= LEAST_HARD_MODULUS:
        rated, bearable = ((0.0, ratio * modulus) for ratio in (RATED_RATIO, YIELD_RATIO))
        advice = "hard bodies yield and Hertz' contact does not hold: check load or torque and the size of the contact"
        found.append(Limit("pressure_above_yield", "hertz_pressure", rated, advice, rated, bearable))
    known = ("first_known_temperature", "second_known_temperature")
    if all(name in inputs for name in known):
        low, high = sorted(float(np.max(inputs[name])) for name in known)
        near, far = ((low - n * FAR_FROM_OIL, high + n * FAR_FROM_OIL) for n in (1.0, 2.0))
        advice = "the viscosity is extrapolated far from the two that the oil is given by"
        found.append(Limit("viscosity_extrapolated", "oil_temperature", near, advice, far))
    return (*found, *_OF_CONTACTS)


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
    ),
    Limit(
        "balance_not_found",
        "balance_error",
        _NONE,
        "no film was found at which film and asperities together carry the load",
        _NONE,
        _NONE,
    ),
    Limit(
        "asperities_overloaded",
        "asperity_load_ratio",
        (0.0, 1.0 + EXACT),
        "asperities would carry more than the load at the gap of the film law: boundary area and friction are "
        "too large",
    ),
    Limit(
        "film_carries_too_little",
        "share_lacking",
        _SHARE,
        "asperities carry so much that the film's own contact is isoviscous or hardly flattened, for which its law is "
        "not made; the loss hangs on friction and area of the asperities",
    ),
    Limit(
        "area_ratio_limited",
        "largest_area_ratio",
        (0.0, 1.0 - EXACT),
        "the boundary area ratio was limited to 1",
        (0.0, 1.0 - EXACT),
    ),
    Limit(
        "bandwidth_limited",
        "nayak_bandwidth",
        (BROAD, np.inf),
        "no isotropic Gaussian surface has such a Nayak bandwidth; 1.5 was used",
        (1.0, np.inf),
    ),
)


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
