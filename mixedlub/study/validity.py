"""Conditions of a study outside the valid ranges."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Protocol

import numpy as np

from mixedlub.base_model.limits import BALANCE, YIELDING, contact_limits, of_bearing_asperities
from mixedlub.chain.ranges import EXTRAPOLATED, Reached, findings, flags
from mixedlub.chain.slots import SLOTS
from mixedlub.full_base.words import FULL
from mixedlub.laws.oil import kinematic
from mixedlub.schema.findings import Finding
from mixedlub.study.batch import BEYOND
from mixedlub.study.plan import Plan, Study
from roughness.mccool import nayak_parameter

OF_SHARING = f"{EXTRAPOLATED}:load_sharing"
"""Flag of a law of load sharing; a note on the gears names the law."""


class Results(Protocol):
    """Results of a study, as needed to judge their ranges."""

    @property
    def study(self) -> Study:
        """The study that was run."""

    @property
    def values(self) -> Mapping[str, np.ndarray]:
        """Outputs and checks in SI."""


def reached(plan: Plan, values: Mapping[str, np.ndarray]) -> Reached:
    """All limits of a study with the values of its conditions."""
    moments = [np.asarray(plan.inputs[name]).reshape(-1, 1, 1, 1) for name in ("m0", "m2", "m4")]
    with np.errstate(divide="ignore", over="ignore"):
        known = {"nayak_bandwidth": nayak_parameter(*moments)}
    nu = kinematic(plan.inputs["viscosity"], plan.inputs["oil_density"])
    at_oil = {"oil_temperature": plan.inputs["oil_temperature"], "kinematic_viscosity": nu}
    known |= {name: np.asarray(value)[..., 0] for name, value in at_oil.items()} | dict(values)
    real = "asperity_real_pressure"
    known[real] = of_bearing_asperities(known[real], known["asperity_load_ratio"])
    limits = contact_limits(plan.inputs, tuple(plan.parameters))
    of_contact = [(limit, known[limit.quantity]) for limit in limits if limit.quantity in known]
    return [*of_contact, *((limit, values[BEYOND + limit.key]) for limit in plan.limits)]


def flags_of(plan: Plan, values: Mapping[str, np.ndarray], notes: Iterable[Finding] = ()) -> dict[str, np.ndarray]:
    """Grades of the conditions of a study by code, worst code first, without codes that never apply.

    ``notes``: findings on load sharing, whose laws are extrapolated for all conditions or for none.
    """
    found = flags(reached(plan, values), plan.shape)
    if any(note.code == EXTRAPOLATED for note in notes):
        found[OF_SHARING] = np.ones(plan.shape, dtype=np.int8)
    return found


def out_of_range(results: Results) -> tuple[Finding, ...]:
    """Findings on conditions outside the valid range of the laws, worst first."""
    plan, count = results.study.plan, len(results.study.pairings)
    more = {"asperities_above_hardness": YIELDING} if plan.friction is None else {}
    more |= {"asperities_overloaded": BALANCE} if plan.friction is None and not plan.balanced else {}
    rows = f"conditions of {count} pairings" if count > 1 else "conditions"
    return findings(reached(plan, results.values), plan.shape, rows, lambda code: _place(results.study, code), more)


def _place(study: Study, code: str) -> str:
    """Key that chose an effect or law; empty for other codes."""
    kind, _, name = code.partition(":")
    if kind != EXTRAPOLATED:
        return ""
    options = study.file.options
    if name in {e.id for e in study.effects}:
        return f"effects.{name}"
    if name == FULL:
        return "options.base"
    if name == "rough_film":
        return "options.film_roughness"
    slots = (s.option for s in SLOTS if s.choices[getattr(options, s.option)].law.__name__ == name)
    return f"options.{next(slots, 'friction')}"
