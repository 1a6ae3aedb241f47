"""NIST and NPL softgauges: the values and filtered profiles that the institutes stored in the files."""

import numpy as np
import pytest

from profiles import Profile
from roughness import element_parameters, height_parameters, primary_profile
from roughness.parameters import CONVENTIONS

# NIST surface metrology algorithm testing system, values in um as stored with each softgauge
STORED = {
    "edm": {"Ra": 0.46434, "Rq": 0.55994, "Rsk": -0.13265, "Rku": 2.36461, "Rz": 2.86230}
    | {"Rp": 1.39459, "Rv": 1.46770, "Rdq": 0.10536},
    "sine": {"Ra": 0.63663, "Rq": 0.70711, "Rsk": 0.0, "Rku": 1.49998, "Rz": 2.0}
    | {"Rp": 1.0, "Rv": 1.0, "Rdq": 0.0111},
    "mill": {"Ra": 0.19942, "Rq": 0.24942, "Rsk": -0.11802, "Rku": 2.99606, "Rz": 1.41213}
    | {"Rp": 0.6827, "Rv": 0.72943, "Rdq": 0.01958},
    "square": {"Ra": 1.0, "Rq": 1.0, "Rsk": 0.0, "Rku": 1.0, "Rz": 2.0, "Rp": 1.0, "Rv": 1.0, "Rdq": 0.2494},
}

# PSm and Pc (um); those of the mill also rest on a least width of element, which NIST does not spell out
ELEMENTS = {"edm": (46.09835, 1.21012), "sine": (400.00563, 2.0), "square": (200.0, 2.0)}


@pytest.mark.literature("NIST Surface Metrology Algorithm Testing System, values stored with the softgauges")
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


@pytest.mark.literature("NIST Surface Metrology Algorithm Testing System, values stored with the softgauges")
@pytest.mark.parametrize("name", STORED)
def test_primary_parameters_are_nists_to_all_digits(nist, name):
    profile, filtered = nist(name)
    evaluated = profile if filtered is None else Profile(filtered, profile.spacing)
    found = height_parameters(evaluated, convention="NIST")
    for symbol, value in STORED[name].items():
        ours = getattr(found, symbol) * (1 if symbol in ("Rsk", "Rku", "Rdq") else 1e6)
        assert ours == pytest.approx(value, abs=6e-6), symbol


@pytest.mark.literature("NIST Surface Metrology Algorithm Testing System, values stored with the softgauges")
@pytest.mark.parametrize("name", ELEMENTS)
def test_elements_are_nists(nist, name):
    profile, filtered = nist(name)
    evaluated = profile if filtered is None else Profile(filtered, profile.spacing)
    found = element_parameters(evaluated, discrimination=CONVENTIONS["NIST"].discrimination)
    width, height = ELEMENTS[name]
    assert found.RSm * 1e6 == pytest.approx(width, abs=2e-4)
    assert found.Rc * 1e6 == pytest.approx(height, abs=6e-6)
