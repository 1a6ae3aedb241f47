"""Every prior rises with its coordinate; one of either sign has the probabilities it says."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from mixedlub.chain.priors import SignedLogNormal
from tests.contracts.rigs import EFFECTS

SIZE = SignedLogNormal(200.0, 0.25)


def test_every_prior_rises_with_its_coordinate() -> None:
    z = np.linspace(-12.0, 12.0, 97)
    for prior in {p.prior for e in EFFECTS for p in e.parameters}:
        values = np.array([prior.value(float(x)) for x in z])
        assert np.isfinite(values).all(), prior
        assert (np.diff(values) >= 0.0).all(), prior


@pytest.mark.parametrize("value", [60.0, 150.0, 200.0, 260.0, 400.0, 900.0])
def test_either_sign_is_as_probable_and_its_size_lognormal(value: float) -> None:
    chance = 0.5 + 0.5 * stats.lognorm(0.25, scale=200.0).cdf(value)
    z = float(-stats.norm.isf(chance)) if chance < 0.9 else float(stats.norm.isf(0.5 * _above(value)))
    assert SIZE.value(z) == pytest.approx(value, rel=1e-6)
    assert SIZE.value(-z) == pytest.approx(-value, rel=1e-6)


def test_either_sign_is_continuous_where_its_forms_meet_and_finite_far_out() -> None:
    meet = 0.7 * np.sqrt(2.0)
    assert SIZE.value(meet * (1.0 - 1e-9)) == pytest.approx(SIZE.value(meet), rel=1e-8)
    assert 0.0 < SIZE.value(1e-12) < 60.0
    assert np.isfinite(SIZE.value(60.0))


def _above(value: float) -> float:
    return float(stats.lognorm(0.25, scale=200.0).sf(value))
