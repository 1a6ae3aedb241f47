"""The fast evidence against sampling: both integrate the same likelihood over the same prior."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.reference import importance_evidence, nested_evidence
from mixedlub.effect import catalogue

LEADING = 30.0
"""Nats behind the best beyond which an explanation's weight is nothing whatever its error."""


@pytest.mark.parametrize("answer", ["complete", "offset"])
def test_fast_evidence_is_that_of_importance_sampling(request: pytest.FixtureRequest, answer: str) -> None:
    found = request.getfixturevalue(answer).found
    best = max(fit.evidence for fit in found.fits.values())
    leaders = [fit for fit in found.fits.values() if fit.evidence > best - LEADING and len(fit.explanation) < 2]
    assert leaders
    for fit in leaders:
        slow = importance_evidence(found.problem, fit, draws=1500)
        assert slow.effective_share > 0.01
        assert fit.evidence == pytest.approx(slow.value, abs=0.5 + 3.0 * slow.error), fit.explanation


def test_importance_sampling_agrees_with_nested_sampling(make_case: Callable[..., Path], tmp_path: Path) -> None:
    pytest.importorskip("dynesty")
    others = tuple(name for name in catalogue() if name != "sensor_gain")
    found: Diagnosis = diagnose_case(make_case(tmp_path / "case", "disc"), exclude=others)
    fit = found.found.fits["sensor_gain",]
    slow = importance_evidence(found.found.problem, fit)
    slowest = nested_evidence(found.found.problem, fit.explanation, points=100)
    assert slow.value == pytest.approx(slowest.value, abs=3.0 * (slow.error + slowest.error))
