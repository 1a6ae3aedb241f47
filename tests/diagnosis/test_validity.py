"""Whether an answer says where its laws were used beyond their range."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.case import reference_rigs
from mixedlub.diagnosis.assessment.validity import beyond_range, unpublished
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.problem import Problem
from mixedlub.effects import catalogue, find
from mixedlub.schema.findings import Severity
from mixedlub.schema.table import Table


def test_a_fit_is_judged_by_the_quantities_it_passes_through() -> None:
    """A third of the readings of the standard disc slide at 0.6."""
    forward = reference_rigs.forward("disc")
    y = forward.predict()
    rows = Table({**forward.table.columns, forward.case.quantity: y}, forward.table.source)
    problem = Problem.of(replace(forward.case, recordings=rows), forward)
    z = np.zeros(problem.size(Explanation.of("contact_creep")))
    (said,) = beyond_range(problem, Explanation.of("contact_creep"), z)
    assert (said.code, said.place, said.severity) == ("law_extrapolated", "contact creep", Severity.NOTE)
    assert f"of {y.size} readings {y.size // 3} extrapolated a little" in said.text
    assert "0 to 0.5, here up to 0.6" in said.text
    slow = problem.take(np.flatnonzero(forward.table["slide_roll_ratio"] < 0.5))
    assert beyond_range(slow, Explanation.of("contact_creep"), z) == ()


def fitted(strength: float, spread: float) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates of churning with a power of viscosity, and how far it is known."""
    return np.array([0.0, strength, 0.0, 0.0]), np.array([0.1, spread, 0.1, 0.1])


def test_powers_that_no_cited_law_has_are_a_doubt() -> None:
    """A jet that hits the wheel goes with the square of speed and not with viscosity."""
    (said,) = unpublished(find(["churning"]), *fitted(-0.66, 0.1))
    assert (said.code, said.place, said.severity) == ("parameter_unpublished", "churning", Severity.DOUBT)
    assert "is 0.00" in said.text
    assert "(0.21 to 1)" in said.text


def test_powers_that_may_be_those_of_a_cited_law_are_no_doubt() -> None:
    (said,) = unpublished(find(["churning"]), *fitted(-0.5, 0.2))
    assert (said.code, said.severity) == ("parameter_beyond_published", Severity.CAUTION)


def test_a_power_of_another_law_that_it_contains_is_no_doubt() -> None:
    """Boness' turbulent branch, nu^(-1/3), lies off the range of the others."""
    assert not unpublished(find(["churning"]), *fitted(-3.0, 0.3))
    assert unpublished(find(["churning"]), *fitted(0.0, 0.3)) == []


def test_published_ranges_lie_within_what_is_tried() -> None:
    for e in catalogue().values():
        for p in e.parameters:
            if p.published is not None:
                low, high = p.published
                assert p.prior.value(-4.5) <= low + 1e-4 < high <= p.prior.value(4.5) + 1e-4
