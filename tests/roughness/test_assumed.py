"""Moments of a surface by one number: against traces, and in a study."""

import json

import numpy as np
import pytest

from mixedlub.schema.findings import collected
from profiles import InputError, read, shipped
from roughness import evaluation_profile, moments
from roughness.assumed import CURVATURE, LEAST_NAYAK, PER_RQ, assumed_moments
from roughness.parameters import height_parameters
from tests.roughness.conftest import rig_of

SHIPPED = ("0036", "0122", "0219", "0258", "0302", "0450")
MEASURED = ("bearing_steel/81212-RE-1.txt", "bearing_steel/NU206-RE-1.txt", "bearing_steel/NU206-RE-2.txt")
GAUGES = ("reference/edm.xml", "reference/mill.xml")


def held(profile, name):
    """Whether the bands by one number of a profile hold each of its moments."""
    p, own = height_parameters(profile), moments(profile)
    found = assumed_moments(name, getattr(p, name))
    return {key: found.ends(key)[0] <= getattr(own, key) <= found.ends(key)[1] for key in ("m0", "m2", "m4")}


@pytest.mark.parametrize("name", PER_RQ)
def test_bands_hold_the_moments_of_traces(shared, name):
    """Six flanks, three bearing parts, two reference surfaces, after 2.5 um; the milled one is smoother than most."""
    raw = [shipped(f"shipped:{one}", "t") for one in SHIPPED]
    raw += [read(shared / "data" / "profiles" / one) for one in (*MEASURED, *GAUGES)]
    rows = [held(evaluation_profile(one, short_cutoff=2.5e-6), name) for one in raw]
    shares = {key: np.mean([row[key] for row in rows]) for key in ("m2", "m4")}
    assert shares["m2"] >= 10 / 11
    assert shares["m4"] >= 9 / 11
    if name != "Rq":
        assert np.mean([row["m0"] for row in rows]) >= 9 / 11


def test_curvature_over_slope_is_that_of_traces(shared):
    """m4/m2 (1/um2) after 2.5 um: spark-eroded 0.33, milled, bearing steel and flanks 0.68 to 1.5."""
    raw = [shipped(f"shipped:{one}", "t") for one in SHIPPED]
    raw += [read(shared / "data" / "profiles" / one) for one in (*MEASURED, *GAUGES)]
    each = [moments(evaluation_profile(one, short_cutoff=2.5e-6)) for one in raw]
    ratios = np.array([m.m4 / m.m2 * 1e-12 for m in each])
    assert ratios.min() == pytest.approx(CURVATURE[0], rel=0.03)
    assert CURVATURE[1] < np.median(ratios) < ratios.max() < CURVATURE[2]


def test_the_band_of_rq_over_ra_holds_a_sine():
    """Rq/Ra of a sine, near that of turned flanks, is 1.1107; the middle of CURVATURE is a geometric mean."""
    assert PER_RQ["Ra"][0] == pytest.approx(np.pi / np.sqrt(8.0), abs=1e-3)
    assert CURVATURE[1] == pytest.approx(np.sqrt(CURVATURE[0] * CURVATURE[2]), rel=0.01)


def test_roughness_beyond_a_correlation_is_cautioned(evaluated):
    caution = "Rq lies above 1.6 um, beyond the range of one of the three correlations"
    for text, beyond in (("Rq:1.7um", True), ("Rq:1.5um", False)):
        assert (caution in evaluated(text)["warnings"][0]) == beyond


@pytest.mark.parametrize(("name", "value"), [("Ra", 0.4e-6), ("Rq", 0.03e-6), ("Rz", 3e-6), ("Rq", 8e-6)])
def test_assumed_moments_belong_to_a_gaussian_surface(name, value):
    found = assumed_moments(name, value)
    assert found.m0 * found.m4 / found.m2**2 >= LEAST_NAYAK
    assert all(found.ends(key)[0] < getattr(found, key) < found.ends(key)[1] for key in ("m2", "m4"))


def test_one_number_on_the_command_line(evaluated):
    row = evaluated("Ra:0.4um")
    assert row["kind"] == "assumed"
    assert row["moments"]["m0_um2"] == pytest.approx(0.4**2 * np.pi / 2, rel=1e-9)
    assert "machined surfaces" in row["assumption"]
    low, high = row["moments"]["band"]["m2"]
    assert low < row["moments"]["m2"] < high
    json.dumps(row)


@pytest.mark.parametrize(
    ("text", "rule"), [("Ra:40um", "from 0.02 to 10 um"), ("Ra:0.4", "a number and a unit"), ("Rq:-1um", "above zero")]
)
def test_a_number_that_cannot_be_is_one_sentence(tmp_path, capsys, text, rule):
    from mixedlub.cli import main

    assert main(["profile", text, "--no-figures", "--out", str(tmp_path / "o")]) == 2
    assert rule in capsys.readouterr().err


def test_a_surface_of_a_study_may_have_one_number(tmp_path):
    with collected() as found:
        made = rig_of(tmp_path, rough={"Ra_um": 0.4}).surface("rough")
    known = assumed_moments("Ra", 0.4e-6)
    assert (made.m0, made.m2, made.m4) == (known.m0, known.m2, known.m4)
    assert [one.code for one in found] == ["moments_assumed"]


@pytest.mark.parametrize(
    ("keys", "rule"),
    [({"Ra_um": 0.4, "m0_um2": 0.1}, "both Ra_um and moments"), ({"Ra_um": 0.4, "Rz_um": 2.0}, "both Ra_um and Rz_um")],
)
def test_one_number_beside_another_is_refused(tmp_path, keys, rule):
    with pytest.raises((InputError, ValueError), match=rule):
        rig_of(tmp_path, rough=keys)
