"""Findings on conditions of a study outside the validity range of the laws."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

import numpy as np

from mixedlub.chain.effect import Effect
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.friction import FrictionLaw
from mixedlub.rig.plausibility import YIELD_RATIO
from mixedlub.schema.findings import Finding, finding
from mixedlub.study.plan import Study
from mixedlub.study.range_flags import EXTRAPOLATED


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
    return tuple(_finding(results, code, where) for code, where in results.flags.items())


def _finding(results: Results, code: str, where: np.ndarray) -> Finding:
    count = f"{int(where.sum())} of {where.size} conditions ({_pairings(results, where)})"
    if code.startswith(EXTRAPOLATED):
        law = results.study.plan.friction
        if law is not None and EXTRAPOLATED + law.name == code:
            return finding("law_extrapolated", f"in {count} {_friction_range(law)}", "options.friction")
        (used,) = (e for e in results.study.effects if EXTRAPOLATED + e.id == code)
        return finding("law_extrapolated", f"in {count} {_range(used)}", f"effects.{used.id}")
    return finding(code, _TEXTS[code](results, count))


def _overloaded(results: Results, count: str) -> str:
    plan = results.study.plan
    yielding = "asperity_plasticity" in plan.parameters or plan.options.hardness_GPa is not None
    return (
        f"{count} are outside the model's range: {'yielding' if yielding else 'elastic'} asperities would carry up to "
        f"{results['asperity_load_ratio'].max():.3g} times the mean Hertz pressure, so the boundary area ratio and the "
        'loss of these conditions are not quantitative; balance = "johnson_greenwood_poon" lets the film give way'
    )


def _pressed(results: Results, count: str) -> str:
    bearable = YIELD_RATIO * float(results.study.plan.inputs["reduced_modulus"])
    return (
        f"in {count} the Hertz pressure, up to {1e-9 * results['hertz_pressure'].max():.3g} GPa, is above what hard "
        f"flanks bear, {1e-9 * bearable:.2g} GPa: check torque_Nm, and module and face width in [gears]"
    )


_TEXTS: Mapping[str, Callable[[Results, str], str]] = {
    "pressure_above_yield": _pressed,
    "asperities_overloaded": _overloaded,
    "balance_not_found": lambda results, count: (
        f"in {count} no film was found at which film and asperities carry the load, which they miss by up to "
        f"{results['balance_error'].max():.2g} of it"
    ),
    "film_carries_too_little": lambda results, count: (
        f"in {count} the film carries so little of the load that its own contact is isoviscous, for which its law is "
        "not made; asperities carry the rest, so the loss hangs on their friction and area"
    ),
    "area_ratio_limited": lambda results, count: f"in {count} the boundary area ratio was limited to 1",
    "bandwidth_limited": lambda results, count: (
        f"in {count} the Nayak bandwidth is below 1.5, which no isotropic Gaussian surface has; 1.5 was used"
    ),
}


def _range(used: Effect) -> str:
    spans = (
        f"{GLOSSARY[name].meaning} {low:g} to {high:g} {GLOSSARY[name].unit.removeprefix('-')}".rstrip()
        for name, (low, high) in used.valid.items()
    )
    return f"its law is used outside the range of its source: {', '.join(spans)}"


def _friction_range(law: FrictionLaw) -> str:
    spans = "; ".join(law.ranges()) or "no negative friction"
    return f"{law.name} is used at points of the path that are outside the range of its source: {spans}"


def _pairings(results: Results, flagged: np.ndarray) -> str:
    which = np.flatnonzero(flagged.any(axis=(1, 2, 3)))
    count = len(results.study.pairings)
    if which.size == count:
        return "all pairings"
    return f"{which.size} of {count} pairings"
