"""NIST and NPL softgauges: the values and filtered profiles that the institutes stored in the files."""

import numpy as np
import pytest

from profiles import Profile
from roughness import height_parameters, primary_profile

# NIST surface metrology algorithm testing system, values in um as stored with each softgauge
STORED = {
    "edm": {"Ra": 0.46434, "Rq": 0.55994, "Rsk": -0.13265, "Rku": 2.36461, "Rz": 2.86230},
    "sine": {"Ra": 0.63663, "Rq": 0.70711, "Rsk": 0.0, "Rku": 1.49998, "Rz": 2.0},
    "mill": {"Ra": 0.19942, "Rq": 0.24942, "Rsk": -0.11802, "Rku": 2.99606, "Rz": 1.41213},
    "square": {"Ra": 1.0, "Rq": 1.0, "Rsk": 0.0, "Rku": 1.0, "Rz": 2.0},
}


@pytest.mark.parametrize(("name", "lost"), [("mill", 3), ("square", 1)])
def test_short_cutoff_filter_is_nists(nist, name, lost):
    profile, filtered = nist(name)
    ours = primary_profile(profile, 0.8e-6, floored=True).heights[lost:-lost]
    assert np.abs(ours - filtered).max() < 1e-12 * 1e-6


@pytest.mark.parametrize(("name", "lost"), [("mill", 3), ("square", 1)])
def test_exact_mode_is_not_the_floored_one(nist, name, lost):
    profile, filtered = nist(name)
    ours = primary_profile(profile, 0.8e-6).heights[lost:-lost]
    assert np.abs(ours - filtered).max() > 1e-10


@pytest.mark.parametrize("name", STORED)
def test_primary_parameters_are_nists_to_all_digits(nist, name):
    profile, filtered = nist(name)
    evaluated = profile if filtered is None else Profile(filtered, profile.spacing)
    found = height_parameters(evaluated, convention="NIST")
    for symbol, value in STORED[name].items():
        ours = getattr(found, symbol) * (1 if symbol in ("Rsk", "Rku") else 1e6)
        assert ours == pytest.approx(value, abs=6e-6), symbol
