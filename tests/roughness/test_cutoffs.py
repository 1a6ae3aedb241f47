"""Cut-off tables and the automatic choice."""

import numpy as np
import pytest

from profiles import InputError, Profile
from roughness import choose_cutoffs, cutoff_for, short_cutoff_for


@pytest.mark.parametrize(
    ("parameter", "value_um", "cutoff_mm"),
    [
        ("Ra", 0.02, 0.08),
        ("Ra", 0.021, 0.25),
        ("Ra", 2.0, 0.8),
        ("Ra", 2.1, 2.5),
        ("Ra", 50, 8),
        ("Rz", 0.5, 0.25),
        ("Rz", 0.51, 0.8),
        ("RSm", 130, 0.25),
        ("RSm", 400, 0.8),
        ("RSm", 401, 2.5),
    ],
)
def test_table_of_iso_4288(parameter, value_um, cutoff_mm):
    assert cutoff_for(parameter, value_um * 1e-6) == pytest.approx(cutoff_mm * 1e-3)


@pytest.mark.parametrize(
    ("cutoff_mm", "short_um", "ratio"),
    [(0.08, 2.5, 30), (0.25, 2.5, 100), (0.8, 2.5, 300), (2.5, 8, 300), (8, 25, 300)],
)
def test_table_of_iso_3274(cutoff_mm, short_um, ratio):
    found = short_cutoff_for(cutoff_mm * 1e-3).short_cutoff
    assert found == pytest.approx(short_um * 1e-6)
    assert cutoff_mm * 1e-3 / found == pytest.approx(ratio, rel=0.08)


@pytest.mark.parametrize(("ra_um", "cutoff_mm"), [(0.05, 0.25), (0.4, 0.8), (4, 2.5)])
def test_choice_follows_the_roughness(gaussian_trace, ra_um, cutoff_mm):
    p = gaussian_trace(60_000)
    scaled = Profile(p.heights * ra_um / (0.3 * np.sqrt(2 / np.pi)), p.spacing)
    assert choose_cutoffs(scaled).cutoff == pytest.approx(cutoff_mm * 1e-3)


def test_periodic_profile_goes_by_its_spacing():
    turned = Profile(0.3e-6 * np.sin(2 * np.pi * np.arange(40_000) / 400), 0.5e-6)
    found = choose_cutoffs(turned)
    assert found.cutoff == 0.8e-3
    assert "periodic" in found.reason


def test_short_trace_takes_what_fits(gaussian_trace):
    found = choose_cutoffs(gaussian_trace(1600))
    assert found.cutoff == 0.25e-3
    assert "too short" in found.reason


def test_unknown_parameter_is_refused():
    with pytest.raises(InputError, match="has no rule"):
        cutoff_for("Rk", 1e-6)
