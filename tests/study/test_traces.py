"""Traces of a study are read and filtered as `mixedlub profile` reads and filters them."""

import numpy as np
import pytest

from mixedlub.schema.findings import codes
from mixedlub.study import read_study, run_study
from profiles import shipped
from profiles.errors import InputError
from roughness import evaluation_profile, moments


def only(surface):
    return {"surfaces": {"flank": surface}}


@pytest.fixture
def heights_alone(tmp_path):
    """A trace whose file tells neither unit nor step."""
    path = tmp_path / "heights.txt"
    np.savetxt(path, shipped("0258").heights[:8000] * 1e6, fmt="%.6f")
    return path.name


@pytest.mark.parametrize(("trace", "cutoff_mm"), [("0036", 0.25), ("0258", 0.8)])
def test_cutoff_is_by_iso_4288_where_none_is_stated(trace, cutoff_mm, write_study):
    """Ra up to 0.1 um asks for 0.25 mm, up to 2 um for 0.8 mm."""
    study = read_study(write_study(**only({"profile": f"shipped:{trace}"})))
    assert "ISO 4288" in " ".join(study.surfaces["flank"].steps)
    assert f"cutoff_mm = {cutoff_mm:g}" in next(n.text for n in study.notes if n.code == "cutoff_assumed")


def test_moments_are_those_of_profile(write_study):
    study = read_study(write_study(**only({"profile": "shipped:0036"})))
    found = moments(evaluation_profile(shipped("0036")))
    assert study.surfaces["flank"].m0 == found.m0
    assert np.sqrt(found.m0) == pytest.approx(0.0453e-6, abs=1e-10)


def test_stated_cutoffs_are_not_assumed(write_study):
    study = read_study(write_study(**only({"profile": "shipped:0036", "cutoff_mm": 0.8, "short_cutoff_um": 2.5})))
    assert "cutoff_assumed" not in codes(study.notes)
    assert "cut-off 0.8 mm" in " ".join(study.surfaces["flank"].steps)


def test_unit_and_spacing_are_keys_of_a_surface(heights_alone, write_study):
    surface = {"profile": heights_alone, "unit": "um", "spacing": "0.5 um", "cutoff_mm": 0.8}
    study = read_study(write_study(**only(surface)))
    assert study.rig.trace("flank").spacing == pytest.approx(0.5e-6)
    assert np.isfinite(run_study(study)["power_loss"]).all()


def test_the_advice_on_a_trace_without_a_step_names_a_key(heights_alone, write_study):
    with pytest.raises(InputError, match=r"surfaces\.flank.* spacing = '0\.5 um'"):
        read_study(write_study(**only({"profile": heights_alone, "unit": "um"})))


def test_the_advice_on_a_trace_without_units_names_a_key(heights_alone, write_study):
    with pytest.raises(InputError, match=r"surfaces\.flank.* unit = '"):
        read_study(write_study(**only({"profile": heights_alone, "spacing": "0.5 um"})))


@pytest.mark.parametrize(
    "surface",
    [
        {"profile": "shipped:0036", "unit": "um"},
        {"m0_um2": 0.1, "m2": 0.0025, "m4_per_um2": 0.0036, "spacing": "1 um"},
    ],
)
def test_a_unit_that_would_be_ignored_is_refused(surface, write_study):
    with pytest.raises(InputError, match=r"surfaces\.flank"):
        read_study(write_study(**only(surface)))


def test_an_unknown_unit_is_refused_with_its_surface(heights_alone, write_study):
    with pytest.raises(InputError, match=r"surfaces\.flank\.unit"):
        read_study(write_study(**only({"profile": heights_alone, "unit": "furlong"})))
