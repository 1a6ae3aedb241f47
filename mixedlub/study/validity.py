"""Findings on conditions of a study outside the validity range of the laws."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

import numpy as np

from mixedlub.chain.friction_law import unit_and_factor
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.chain.slots import SLOTS
from mixedlub.rig.plausibility import YIELD_RATIO
from mixedlub.schema.findings import Finding, finding
from mixedlub.study.batch import BEYOND, FILM_OVER_WIDTH
from mixedlub.study.plan import MOST_FRICTION, Study
from mixedlub.study.range_flags import EXTRAPOLATED, OF_SHARING


class Results(Protocol):
    """What the findings read of the results of a study, which carry them."""

    @property
    def study(self) -> Study:
        """The study that was run."""

    @property
    def flags(self) -> Mapping[str, np.ndarray]:
        """Where conditions are out of range, by code."""

    def __getitem__(self, name: str) -> np.ndarray:
        """An output in SI."""


def out_of_range(results: Results) -> tuple[Finding, ...]:
    """Findings on conditions outside the validity range of the laws, gravest first; empty where all are within."""
    return tuple(_finding(results, code, where) for code, where in results.flags.items() if code != OF_SHARING)


def _finding(results: Results, code: str, where: np.ndarray) -> Finding:
    count = f"{int(where.sum())} of {where.size} conditions ({_pairings(results, where)})"
    if code.startswith(EXTRAPOLATED):
        return finding("law_extrapolated", f"in {count} {_range(results, code)}", _place(results, code))
    return finding(code, _TEXTS[code](results, count))


def _overloaded(results: Results, count: str) -> str:
    plan = results.study.plan
    yielding = "asperity_plasticity" in plan.parameters or plan.options.hardness_GPa is not None
    return (
        f"{count} are outside the model's range: {'yielding' if yielding else 'elastic'} asperities would carry up to "
        f"{results['asperity_load_ratio'].max():.3g} times the mean Hertz pressure, so the boundary area ratio and the "
        f"loss of these conditions are not quantitative{_BALANCED if plan.friction is None else ''}"
    )


_BALANCED = (
    '; with the options balance "johnson_greenwood_poon" and mixture "load_weighted" the film gives way, and friction '
    "follows the load that asperities carry"
)
"""What can be chosen instead with the friction of the base model; other laws of friction go with no balance."""


def _pressed(results: Results, count: str) -> str:
    bearable = YIELD_RATIO * float(results.study.plan.inputs["reduced_modulus"])
    return (
        f"in {count} the Hertz pressure, up to {1e-9 * results['hertz_pressure'].max():.3g} GPa, is above what hard "
        f"flanks bear, {1e-9 * bearable:.2g} GPa: check torque_Nm, and module and face width in [gears]"
    )


def _thick(results: Results, count: str) -> str:
    return (
        f"in {count} the film is thicker than the contact is wide, up to {results[FILM_OVER_WIDTH].max():.3g} times, "
        "so that no film law and no loss holds: check oil_temperature_C and the viscosity of the oil"
    )


_TEXTS: Mapping[str, Callable[[Results, str], str]] = {
    "pressure_above_yield": _pressed,
    "film_above_contact_width": _thick,
    "asperities_overloaded": _overloaded,
    "balance_not_found": lambda results, count: (
        f"in {count} no film was found at which film and asperities carry the load, which they miss by up to "
        f"{results['balance_error'].max():.2g} of it"
    ),
    "film_carries_too_little": lambda results, count: (
        f"in {count} the film carries so little of the load that its own contact is isoviscous or hardly flattened, "
        "for which its law is not made; asperities carry the rest, so the loss hangs on their friction and area"
    ),
    "area_ratio_limited": lambda results, count: f"in {count} the boundary area ratio was limited to 1",
    "bandwidth_limited": lambda results, count: (
        f"in {count} the Nayak bandwidth is below 1.5, which no isotropic Gaussian surface has; 1.5 was used"
    ),
}


def _range(results: Results, code: str) -> str:
    name = code.removeprefix(EXTRAPOLATED)
    reached = {q: (ends, results[f"{BEYOND}{name}:{q}"]) for q, ends in results.study.plan.ranges[name].items()}
    spans = [_span(q, *ends, values) for q, (ends, values) in reached.items() if not np.isnan(values).all()]
    return f"{name} is used at points of the path that are outside the range in which it holds: {'; '.join(spans)}"


def _span(quantity: str, low: float, high: float, values: np.ndarray) -> str:
    """The range of a quantity in words, and how far beyond it the values are that are not NaN.

    >>> _span("moes_load", 2.0, np.inf, np.array([1.5, np.nan]))
    "Moes' load parameter of a line contact of at least 2, here down to 1.5"
    >>> _span("shear_stress", 0.0, 90e6, np.array([95e6, -1e6, 120e6]))
    'shear stress of the film 0 to 90 MPa, here down to -1 and up to 120 MPa'
    """
    unit, factor = unit_and_factor(quantity)
    unit = unit.removeprefix("-")
    ends = f"of at least {low * factor:.4g}"
    if high < MOST_FRICTION:
        ends = f"{low * factor:.4g} to {high * factor:.4g}"
    values = values[~np.isnan(values)] * factor
    reach = []
    if values.min() < low * factor:
        reach.append(f"down to {values.min():.4g}")
    if values.max() > high * factor:
        reach.append(f"up to {values.max():.4g}")
    return f"{GLOSSARY[quantity].meaning} {ends} {unit}".rstrip() + f", here {' and '.join(reach)} {unit}".rstrip()


def _place(results: Results, code: str) -> str:
    """The key that chose the effect or law."""
    name, options = code.removeprefix(EXTRAPOLATED), results.study.file.options
    if name in {e.id for e in results.study.effects}:
        return f"effects.{name}"
    if name == "rough_film":
        return "options.film_roughness"
    slots = (s.option for s in SLOTS if s.choices[getattr(options, s.option)].law.__name__ == name)
    return f"options.{next(slots, 'friction')}"


def _pairings(results: Results, flagged: np.ndarray) -> str:
    which = np.flatnonzero(flagged.any(axis=(1, 2, 3)))
    count = len(results.study.pairings)
    if which.size == count:
        return "all pairings"
    return f"{which.size} of {count} pairings"
