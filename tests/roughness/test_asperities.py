"""Asperity models on surfaces whose summits are known."""

import numpy as np
import pytest

from profiles import InputError, Profile
from roughness import Moments, asperities, mccool_asperities, moments
from roughness.asperities import MODELS, summit_count, without_offset


@pytest.mark.parametrize("model", MODELS)
def test_every_model_gives_positive_finite_summits(model, gaussian_trace):
    a = asperities(gaussian_trace(), model=model)
    assert min(a.density, a.radius, a.sigma) > 0
    assert a.model == model


def test_counted_summits_agree_with_mccool_on_a_gaussian_trace(gaussian_trace):
    p = gaussian_trace(200_000, roll=25e-6, short=12e-6)
    counted, predicted = summit_count(p), mccool_asperities(moments(p))
    assert counted.density == pytest.approx(predicted.density, rel=0.05)
    assert counted.radius == pytest.approx(predicted.radius, rel=0.05)
    assert counted.plane_offset == pytest.approx(predicted.plane_offset, rel=0.05)


def test_models_scale_as_their_units(gaussian_trace):
    p = gaussian_trace()
    bigger = Profile(3 * p.heights, 3 * p.spacing)
    for model in MODELS:
        a, b = asperities(p, model=model), asperities(bigger, model=model)
        assert b.density == pytest.approx(a.density / 9, rel=1e-6)
        assert b.radius == pytest.approx(a.radius * 3, rel=1e-6)
        assert b.sigma == pytest.approx(a.sigma * 3, rel=1e-6)


def test_the_offset_and_spread_of_summits_can_be_left_out():
    m = Moments(0.16e-12, 0.01, 0.004e12)
    assert without_offset(m).sigma == pytest.approx(0.4e-6)
    assert mccool_asperities(m).sigma < 0.4e-6
    assert mccool_asperities(m).plane_offset > 0


def test_plateau_is_smoother_than_its_whole_profile(plateau_trace):
    p = plateau_trace(0.8e-6, 0.6e-6)
    assert asperities(p, model="bi-Gaussian").sigma < 0.75 * asperities(p).sigma


def test_plateau_sigma_is_that_of_the_fine_process(plateau_trace):
    found = [asperities(plateau_trace(0.8e-6, 0.6e-6, seed=s), model="bi-Gaussian").sigma for s in range(5)]
    assert np.mean(found) == pytest.approx(0.1e-6, rel=0.15)


def test_narrow_band_is_held_at_three_halves():
    a = mccool_asperities(Moments(1e-12, 1e-2, 1e8))
    assert a.nayak == pytest.approx(1.0)
    assert a.sigma == pytest.approx(1e-6 * np.sqrt(1 - 0.896806 / 1.5), rel=1e-6)


def test_unknown_model_names_the_nearest(gaussian_trace):
    with pytest.raises(InputError, match="nearest known: 'McCool'"):
        asperities(gaussian_trace(), model="Mc Cool")


def test_smooth_trace_has_no_summits_to_count():
    with pytest.raises(InputError, match="fewer than ten peaks"):
        summit_count(Profile(np.arange(100.0) ** 2, 1e-6))
