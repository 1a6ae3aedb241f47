"""Masks find what was put in and leave the rest."""

import numpy as np
import pytest

from profiles import InputError, Profile
from roughness import height_parameters, mask_edges, mask_outliers, moments, without_edges
from roughness.defects import masked


def spoiled(profile, depth, at=(2000, 5000, 7000), width=15):
    z = np.array(profile.heights)
    for k in at:
        z[k : k + width] += depth
    return Profile(z, profile.spacing)


@pytest.mark.parametrize(("depth", "side"), [(-3e-6, "valleys"), (3e-6, "peaks"), (3e-6, "both")])
def test_defects_are_found_and_the_rest_kept(gaussian_trace, depth, side):
    found = mask_outliers(spoiled(gaussian_trace(), depth), side=side)
    for k in (2000, 5000, 7000):
        assert not found.valid[k : k + 15].any()
    assert found.valid.mean() > 0.98


def test_wrong_side_is_left_alone(gaussian_trace):
    assert mask_outliers(spoiled(gaussian_trace(), -3e-6), side="peaks").valid.all()


def test_masking_restores_the_moments(gaussian_trace):
    p = gaussian_trace()
    spoilt = spoiled(p, -3e-6)
    assert moments(spoilt).m4 > 2 * moments(p).m4
    assert moments(mask_outliers(spoilt)).m4 == pytest.approx(moments(p).m4, rel=0.05)
    assert height_parameters(mask_outliers(spoilt)).Rv == pytest.approx(height_parameters(p).Rv, rel=0.05)


def test_clean_trace_stays_whole(gaussian_trace):
    p = gaussian_trace()
    assert mask_outliers(p, sigmas=6).valid.all()
    assert mask_edges(p) is p


@pytest.mark.parametrize("ends", ["left", "right", "both"])
def test_chamfers_are_cut(gaussian_trace, ends):
    z = np.array(gaussian_trace().heights)
    fall = np.arange(400) * 0.5e-6
    if ends != "right":
        z[:400] -= fall[::-1]
    if ends != "left":
        z[-400:] -= fall
    kept = without_edges(mask_edges(Profile(z, 0.5e-6)))
    chamfers = 800 if ends == "both" else 400
    assert 9600 - chamfers - 450 < kept.heights.size < 9600 - chamfers + 50
    assert np.ptp(kept.heights) < 3e-6


def test_crown_is_no_edge(gaussian_trace):
    p = gaussian_trace()
    x = np.linspace(-1, 1, p.heights.size)
    assert mask_edges(Profile(p.heights - 20e-6 * x**2, p.spacing)).valid.all()


@pytest.mark.parametrize("at", [0.1e-3, 0.9e-3, 3.9e-3, 4.75e-3])
@pytest.mark.parametrize("depth", [4e-6, -20e-6])
def test_scratch_or_spike_near_an_end_is_no_edge(gaussian_trace, at, depth):
    """The first millimetre of 4.8 mm stays, although a scratch of 4 um ends it."""
    p = gaussian_trace()
    notch = np.maximum(0.0, 1.0 - np.abs(p.positions - at) / 15e-6)
    assert mask_edges(Profile(p.heights - depth * notch, p.spacing)).valid.all()


@pytest.mark.parametrize("width", [0.1e-3, 0.3e-3, 0.6e-3])
def test_groove_with_a_flat_bottom_is_no_edge(gaussian_trace, width):
    p = gaussian_trace()
    inside = (p.positions > 4.0e-3) & (p.positions < 4.0e-3 + width)
    assert mask_edges(Profile(p.heights - 5e-6 * inside, p.spacing)).valid.all()


def test_honed_grooves_leave_the_length_whole(gaussian_trace):
    """Grooves all over, as plateau honing leaves them: 20 of 20 such traces lost three tenths of their length."""
    for seed in range(20):
        p = gaussian_trace(seed=seed)
        z = np.array(p.heights) / 3
        for at in np.random.default_rng(seed).uniform(0, p.length, 12):
            z -= 3e-6 * np.maximum(0.0, 1.0 - np.abs(p.positions - at) / 15e-6)
        assert without_edges(mask_edges(Profile(z, p.spacing))).length > 0.97 * p.length


def test_step_and_chamfer_behind_a_scratch_are_edges(gaussian_trace):
    p = gaussian_trace()
    x = p.positions
    step = p.heights - 5e-6 * (x > 4.3e-3)
    assert without_edges(mask_edges(Profile(step, p.spacing))).length == pytest.approx(4.25e-3, abs=0.1e-3)
    scratch = 4e-6 * np.maximum(0.0, 1.0 - np.abs(x - 4.0e-3) / 15e-6)
    both = p.heights - scratch - 0.2 * np.maximum(0.0, x - 4.5e-3)
    assert without_edges(mask_edges(Profile(both, p.spacing))).length == pytest.approx(4.45e-3, abs=0.1e-3)


def test_real_raceway_loses_its_chamfers(measured):
    rows = [r.split() for r in (measured / "bearing_steel" / "NU208-IR-1.txt").read_text().split("\n") if r]
    table = np.array(rows, float)
    p = Profile(table[:, 1] * 1e-6, 1.612e-6)
    kept = without_edges(mask_edges(p))
    assert np.ptp(kept.heights) < 0.3 * np.ptp(p.heights)
    assert kept.length > 0.85 * p.length


def test_bridge_is_straight_and_recorded():
    p = Profile(np.arange(10.0), 1e-6)
    away = np.zeros(10, bool)
    away[4:6] = True
    done = masked(p, away, "scratch masked")
    assert done.heights.tolist() == p.heights.tolist()
    assert done.steps == ("scratch masked: 2 points",)


def test_masking_nearly_all_is_refused():
    with pytest.raises(InputError, match="less than a fifth"):
        masked(Profile(np.arange(10.0), 1e-6), np.arange(10) > 0, "all")
