"""Every measured trace against other programs: surfalize after its filter, SurfaceTopography before it."""

import json

import numpy as np
import pytest

from profiles import Profile
from roughness import height_parameters, moments, remove_form, roughness_profile, trace_record, trim
from roughness.spectrum import power_density

FILES = [
    "bearing_steel/81212-RE-1.txt",
    "bearing_steel/NU206-IR-1.txt",
    "bearing_steel/NU206-IR-2.txt",
    "bearing_steel/NU206-RE-1.txt",
    "bearing_steel/NU206-RE-2.txt",
    "bearing_steel/NU208-IR-1.txt",
    "bearing_steel/NU2208-IR-1.txt",
    "reference/edm.xml",
    "reference/mill.xml",
    "reference/sine.xml",
    "reference/mitutoyo_2_mock.xlsx",
    "reference/mitutoyo_mock.xlsx",
    "stylus_misc/dektak-1.csv",
    "stylus_misc/hfm-1.hfm",
    "stylus_misc/opdx-3.txt",
    "stylus_misc/xy-4.txt",
]


@pytest.fixture
def trace(measured, nist, mitutoyo):
    manifest = {f["path"]: f for f in json.loads((measured / "manifest.json").read_text())["files"]}

    def read(path):
        peer = manifest[path.replace("opdx-3.txt", "opdx-3.opdx")]["peer_values"]
        if path.endswith(".xml"):
            profile = nist(path.split("/")[1][:-4])[0]
        elif path.endswith(".xlsx"):
            profile = mitutoyo(path.split("/")[1][:-5])
        else:
            rows = []
            for line in (measured / path).read_text(encoding="latin-1").splitlines():
                try:
                    rows.append([float(v) for v in line.replace(";", " ").replace(",", " ").split()[:2]])
                except ValueError:
                    continue
            table = np.array([r for r in rows if len(r) == 2])
            height = 1e-6 if "bearing" in path or "dektak" in path else 1.0 if "opdx" in path else 1e-3
            profile = Profile(table[:, 1] * height, peer["dx_um"] * 1e-6)
        assert profile.heights.size == peer["points"]
        assert profile.spacing * 1e6 == pytest.approx(peer["dx_um"], rel=1e-4)
        if peer["window"]:
            first, last = (int(w * profile.heights.size) for w in peer["window"])
            profile = Profile(profile.heights[first:last], profile.spacing)
        if peer["poly_degree"]:
            profile = remove_form(profile, f"polynomial-{peer['poly_degree']}")
        return profile, peer

    return read


@pytest.mark.literature("SurfaceTopography 1.27.1")
@pytest.mark.parametrize("path", FILES)
def test_moments_before_the_filter_are_surfacetopographys(trace, path):
    profile, peer = trace(path)
    theirs = peer["surfacetopography_1_27_1_before_filter"]
    m = moments(profile)
    assert np.sqrt(m.m0) * 1e6 == pytest.approx(theirs["Rq"], rel=2e-3)
    assert np.sqrt(m.m2) == pytest.approx(theirs["Rdq"], rel=2e-3)
    assert np.sqrt(m.m4) * 1e-6 == pytest.approx(theirs["Rddq"], rel=2e-3)


@pytest.mark.literature("surfalize 0.19.2")
@pytest.mark.parametrize("path", FILES)
def test_parameters_are_surfalizes_under_its_own_conventions(trace, path):
    """Mirrored ends, half a cut-off trimmed, re-centred, averages over the whole length."""
    profile, peer = trace(path)
    if peer["lambda_c_um"]:
        cutoff = peer["lambda_c_um"] * 1e-6
        profile = roughness_profile(profile, cutoff=cutoff, ends="reflect")
        profile = trim(profile, peer["end_trim_um"] * 1e-6, peer["end_trim_um"] * 1e-6)
    p = height_parameters(remove_form(profile, "mean"), convention="NIST")
    theirs = peer["surfalize_0_19_2"]
    for symbol in ("Ra", "Rq", "Rt"):
        assert getattr(p, symbol) * 1e6 == pytest.approx(theirs[symbol], rel=2e-3), symbol
    assert p.Rku == pytest.approx(theirs["Rku"], rel=5e-3)
    assert p.Rsk == pytest.approx(theirs["Rsk"], abs=5e-3 + 5e-3 * abs(theirs["Rsk"]))


@pytest.mark.parametrize("path", FILES)
def test_spectrum_adds_up_to_the_variance(trace, path):
    profile, _ = trace(path)
    level = remove_form(profile, "line")
    f, density = power_density(level)
    assert density.sum() * f[1] == pytest.approx(level.heights.var(), rel=0.6)


@pytest.mark.parametrize("path", FILES)
def test_every_trace_gets_a_row_that_json_takes(trace, path):
    record = trace_record(trace(path)[0])[1]
    assert json.loads(json.dumps(record, allow_nan=False))["parameters"]["Rq_um"] > 0


@pytest.mark.parametrize("path", [f for f in FILES if "bearing" in f and "IR" in f])
def test_unresolved_raceways_are_called_so(trace, path):
    """Lag-1 correlation 0.03 to 0.5: the finest waves of these traces are the instrument's."""
    warnings = trace_record(trace(path)[0])[1]["warnings"]
    assert any("does not resolve its finest waves" in w for w in warnings)
