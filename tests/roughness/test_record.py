"""The profile.json row."""

import json
from dataclasses import replace

import numpy as np
import pytest

from profiles import InputError, Profile
from roughness import evaluation_profile, profile_record, trace_record

KEYS = {"file", "steps", "parameters", "moments", "asperities", "gaussian", "warnings"}


@pytest.fixture
def record(gaussian_trace):
    return trace_record(gaussian_trace(16_000, short=12e-6))[1]


def test_row_has_the_agreed_names(record):
    assert set(record) == KEYS
    assert {"Ra_um", "Rq_um", "Rz_um", "Rsk", "Rku"} <= set(record["parameters"])
    assert {"m0_um2", "m2", "m4_per_um2", "spacing_um", "short_cutoff_um", "cutoff_mm"} <= set(record["moments"])
    assert {"density_per_mm2", "radius_um", "sigma_um", "plane_offset_um", "nayak"} <= set(record["asperities"])
    assert {"verdict", "from_percent", "to_percent"} <= set(record["gaussian"])


def test_row_survives_json(record):
    assert json.loads(json.dumps(record, allow_nan=False)) == record


def test_units_are_those_of_the_names(record):
    m, a = record["moments"], record["asperities"]
    assert m["cutoff_mm"] == pytest.approx(0.8)
    assert m["short_cutoff_um"] == pytest.approx(2.5)
    assert a["nayak"] == pytest.approx(m["m0_um2"] * m["m4_per_um2"] / m["m2"] ** 2)
    assert a["radius_um"] == pytest.approx(0.375 * np.sqrt(np.pi / m["m4_per_um2"]))
    assert record["parameters"]["Rq_um"] == pytest.approx(np.sqrt(m["m0_um2"]), rel=0.05)


def test_band_is_half_one_and_two_short_cutoffs(record):
    band = record["asperities"]["short_cutoff_band"]
    assert [row["short_cutoff_um"] for row in band] == pytest.approx([1.25, 2.5, 5.0])
    assert band[1]["radius_um"] == pytest.approx(record["asperities"]["radius_um"])
    assert band[0]["density_per_mm2"] > band[2]["density_per_mm2"]


def test_bootstrap_interval_holds_the_value(record):
    low, high = record["asperities"]["bootstrap90"]["radius_um"]
    assert low < record["asperities"]["radius_um"] < high


def test_steps_tell_the_story(record):
    told = " | ".join(record["steps"])
    for word in (
        "form line",
        "cut-off 0.8 mm by ISO 4288",
        "short cut-off 2.5 um",
        "high-pass",
    ):
        assert word in told


def test_ends_are_trimmed_where_asked(gaussian_trace):
    p = evaluation_profile(gaussian_trace(), trim_cutoffs=0.5)
    assert any("trimmed 0.4 mm and 0.4 mm" in s for s in p.steps)
    assert p.heights.size == 9600 - 1600


def test_outliers_are_masked_where_asked(gaussian_trace):
    trace = gaussian_trace()
    pitted = replace(trace, heights=trace.heights - np.where(np.abs(np.arange(9600) - 5000) < 20, 2e-5, 0.0))
    assert evaluation_profile(pitted).valid.all()
    p = evaluation_profile(pitted, outliers=6.0)
    assert not p.valid[5000]
    assert profile_record(p)["parameters"]["Rq_um"] == pytest.approx(
        profile_record(evaluation_profile(trace))["parameters"]["Rq_um"], rel=0.05
    )


def test_edges_are_cut_told_and_kept_on_request(gaussian_trace):
    trace = gaussian_trace()
    fallen = replace(trace, heights=trace.heights - 0.5 * np.maximum(0.0, trace.positions - 4.4e-3))
    cut, row = trace_record(fallen)
    assert cut.length < 4.45e-3
    told = next(w for w in row["warnings"] if w.startswith("edges cut: 0 mm at the start, 0."))
    removed = float(told.split(", ")[1].split(" mm")[0])
    assert removed == pytest.approx((trace.length - cut.length) * 1e3, abs=5e-3)
    kept, row = trace_record(fallen, edges=False)
    assert kept.length == trace.length
    assert not any("edges cut" in w for w in row["warnings"])


@pytest.mark.parametrize("method", ["robust", "spline"])
def test_other_filters_are_used_where_asked(gaussian_trace, method):
    assert any(method in s for s in evaluation_profile(gaussian_trace(), method=method).steps)


def test_rules_of_the_file_hold_for_its_own_profile_only(gaussian_trace):
    origin = {"convention": "Mitutoyo", "sampling_lengths": 4}
    done = replace(gaussian_trace(), cutoffs={"cutoff": 0.8e-3, "short_cutoff": 8e-6}, origin=origin)
    told = trace_record(done)[1]["parameters"]
    assert (told["convention"], told["sections"]) == ("Mitutoyo", 4)
    again = trace_record(done, cutoff=0.25e-3)[1]["parameters"]
    assert (again["convention"], again["sections"]) == ("ISO 4287:1997", 19)
    named = trace_record(done, convention="NIST")[1]["parameters"]
    assert (named["convention"], named["sections"]) == ("NIST", 4)


def test_filtered_trace_is_not_filtered_again(gaussian_trace):
    done = replace(gaussian_trace(), cutoffs={"cutoff": 0.8e-3, "short_cutoff": 8e-6})
    assert evaluation_profile(done) is done
    assert profile_record(done)["steps"] == []


def test_asked_cutoffs_are_used(gaussian_trace):
    p = evaluation_profile(gaussian_trace(), form="polynomial-2", cutoff=0.25e-3, short_cutoff=8e-6)
    assert p.cutoffs == {"cutoff": 0.25e-3, "short_cutoff": 8e-6}


def test_short_trace_keeps_its_ends(gaussian_trace):
    assert evaluation_profile(gaussian_trace(3000), cutoff=0.8e-3).heights.size == 3000


def test_coarse_trace_says_why_it_has_no_short_cutoff(gaussian_trace):
    p = evaluation_profile(gaussian_trace(spacing=2e-6))
    assert "short cut-off not applied: step 2 um is too coarse for 2.5 um" in p.steps


def test_plateau_is_in_the_row(plateau_trace):
    row = profile_record(plateau_trace())["gaussian"]
    assert row["verdict"] == "plateau"
    assert row["plateau"]["Rvq_um"] > 2 * row["plateau"]["Rpq_um"]


def test_tiny_trace_has_no_verdict_but_a_row():
    row = profile_record(Profile(np.sin(np.arange(40.0)) * 1e-6, 1e-6))
    assert row["gaussian"]["verdict"] == "not_gaussian"
    assert any("probability plot" in w for w in row["warnings"])


@pytest.mark.parametrize(("points", "spacing"), [(128, 2e-6), (3000, 0.0166e-6), (40, 10e-6), (12, 1e-6)])
def test_short_traces_get_a_row(points, spacing):
    z = 1e-8 * np.random.default_rng(0).normal(size=points).cumsum()
    assert set(trace_record(Profile(z, spacing))[1]) == KEYS


def test_trace_shorter_than_any_cutoff_says_so():
    p = evaluation_profile(Profile(1e-9 * np.sin(np.arange(3000.0)), 0.0166e-6))
    assert any("shorter than any" in s for s in p.steps)


@pytest.mark.parametrize("cutoff", [-1.0, "automatic", 0])
def test_bad_cutoff_is_refused(gaussian_trace, cutoff):
    with pytest.raises(InputError, match="length above zero, None or 'auto'"):
        evaluation_profile(gaussian_trace(), cutoff=cutoff)


def test_flat_trace_is_refused():
    with pytest.raises(InputError, match="all heights are the same: a stuck stylus"):
        trace_record(Profile(np.zeros(5000), 1e-6))


@pytest.mark.parametrize("scale", [1e-9, 1.0])
def test_a_trace_that_is_one_straight_line_is_refused(scale):
    with pytest.raises(InputError, match="all heights lie on one straight line"):
        trace_record(Profile(scale * (0.1 + 1e-4 * np.arange(5000.0)), 1e-6))


def test_a_trace_of_a_few_nanometres_on_a_steep_line_is_not_flat(gaussian_trace):
    trace = gaussian_trace()
    steep = Profile(trace.heights * 1e-2 + 0.1 * trace.positions, trace.spacing)
    assert evaluation_profile(steep).heights.std() > 0.0
