"""Every measured and reference file, against the numbers independent programs found in it."""

import json

import numpy as np
import pytest

from profiles import read

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
    "reference/mitutoyo_2_mock.xlsx",
    "reference/mitutoyo_mock.xlsx",
    "reference/sine.xml",
    "reference/square.xml",
    "stylus_misc/container-2.zip",
    "stylus_misc/dektak-1.csv",
    "stylus_misc/hfm-1.hfm",
    "stylus_misc/opdx-3.opdx",
    "stylus_misc/xy-4.txt",
]
SDF = [f"{kind}_profile_{form}.sdf" for kind in ("bcr1", "iso1", "iso2") for form in ("ascii", "binary")]
X3P = ["profile_binary.x3p", "profile_int16_binary.x3p", "profile_layers_binary.x3p", "profile_xml.x3p"]


def test_no_file_of_the_manifest_is_left_out(shared):
    listed = json.loads((shared / "data" / "profiles" / "manifest.json").read_text())["files"]
    samples = {f"format_samples/{name}" for name in (*SDF, *X3P)}
    assert {f["path"] for f in listed} == {*FILES, *samples, "stylus_misc/opdx-3.txt"}


@pytest.mark.parametrize("path", FILES)
def test_points_step_and_rms_height_equal_the_manifest(shared, path):
    folder = shared / "data" / "profiles"
    entry = next(f for f in json.loads((folder / "manifest.json").read_text())["files"] if f["path"] == path)
    peer = entry["peer_values"]
    profile = read(folder / path)
    assert profile.heights.size == peer["points"]
    assert profile.spacing * 1e6 == pytest.approx(peer["dx_um"], rel=1e-8, abs=6e-7)
    assert profile.length * 1e6 == pytest.approx(peer["length_um"], rel=2e-5)
    first, last = peer["window"] or (0.0, 1.0)
    z = profile.heights[int(first * profile.heights.size) : int(last * profile.heights.size)] * 1e6
    x = np.linspace(-1, 1, z.size)
    if peer["poly_degree"]:
        z = z - np.polynomial.Polynomial.fit(x, z, peer["poly_degree"])(x)
    z = z - z.mean()
    # The peer's polynomial is fitted by another routine and its window may differ by a point.
    expected = peer["surfacetopography_1_27_1_before_filter"]["Rq"]
    assert np.sqrt(np.mean(z**2)) == pytest.approx(expected, rel=1e-4)


def test_text_twin_of_a_binary_scan_is_read_in_metres(shared):
    profile = read(shared / "data" / "profiles" / "stylus_misc" / "opdx-3.txt")
    assert profile.heights.size == 3001
    assert profile.spacing == pytest.approx(1.6655563e-8, rel=1e-7)
    assert profile.heights[0] == pytest.approx(1.3718306e-9, rel=1e-12)


def test_binary_scan_equals_its_text_twin(shared):
    folder = shared / "data" / "profiles" / "stylus_misc"
    binary, text = read(folder / "opdx-3.opdx"), read(folder / "opdx-3.txt")
    assert binary.heights == pytest.approx(text.heights, rel=6e-8, abs=1e-18)
    assert binary.spacing == pytest.approx(text.spacing, rel=1e-7)


@pytest.mark.parametrize("name", SDF)
def test_sdf_samples_agree_and_mask_the_missing_points(shared, name):
    folder = shared / "data" / "profiles" / "format_samples"
    profile, other = read(folder / name), read(folder / SDF[0])
    assert profile.heights.size == 128
    assert profile.spacing == pytest.approx(2e-6)
    assert np.flatnonzero(~profile.valid).tolist() == [60, 61, 62, 63]
    assert profile.heights == pytest.approx(other.heights, abs=1e-13)
    assert profile.heights[1] == pytest.approx(0.291173593769542e-6, rel=1e-9)


@pytest.mark.parametrize("name", X3P)
def test_x3p_samples_agree(shared, name):
    folder = shared / "data" / "profiles" / "format_samples"
    profile, other = read(folder / name), read(folder / X3P[0])
    assert profile.heights.size == 256
    assert profile.spacing == pytest.approx(2e-6)
    # The int16 sample is quantised, and its missing points are bridged.
    step = 1e-10 if "int16" in name else 1e-13
    both = profile.valid & other.valid
    assert profile.heights[both] == pytest.approx(other.heights[both], abs=step)


def test_instrument_and_nist_values_are_kept(shared):
    folder = shared / "data" / "profiles" / "reference"
    report = read(folder / "mitutoyo_2_mock.xlsx")
    entry = next(
        f
        for f in json.loads((folder.parent / "manifest.json").read_text())["files"]
        if f["path"] == "reference/mitutoyo_2_mock.xlsx"
    )
    values = entry["reference_values"]["values"]
    kept = report.origin["stated"]
    for name in ("Ra", "Rq", "Rz", "Rp", "Rv", "RSm", "Rc", "Rt", "Rz1max", "Rk", "Rpk", "Rvk"):
        assert kept[name] * 1e6 == pytest.approx(values[name], rel=1e-12)
    for name in ("Rsk", "Rku"):
        assert kept[name] == values[name]
    assert kept["Rdq"] == values["RDq"]
    assert kept["Mr2"] == values["Mr2_%"]
    assert report.origin["sampling_lengths"] == 4
    assert report.origin["convention"] == "Mitutoyo"
    assert dict(report.cutoffs) == pytest.approx({"cutoff": 2.5e-3, "short_cutoff": 8e-6})
    mill = read(folder / "mill.xml").origin
    assert mill["stated_short_cutoff"] == pytest.approx(0.8e-6)
    assert mill["stated"]["Pq"] == pytest.approx(0.24942e-6)
    edm = read(folder / "edm.xml").origin
    assert "stated_short_cutoff" not in edm
    assert edm["stated"]["Pq"] == pytest.approx(0.55994e-6)
    assert read(folder.parent / "stylus_misc" / "dektak-1.csv").origin["tip_radius"] == pytest.approx(2.5e-6)
