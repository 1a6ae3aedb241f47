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
    "stylus_misc/dektak-1.csv",
    "stylus_misc/xy-4.txt",
]


@pytest.mark.parametrize("path", FILES)
def test_points_step_and_rms_height_equal_the_manifest(shared, path):
    folder = shared / "data" / "profiles"
    entry = next(f for f in json.loads((folder / "manifest.json").read_text())["files"] if f["path"] == path)
    peer = entry["peer_values"]
    profile = read(folder / path)
    assert profile.heights.size == peer["points"]
    assert profile.spacing * 1e6 == pytest.approx(peer["dx_um"], rel=2e-5)
    assert profile.length * 1e6 == pytest.approx(peer["length_um"], rel=2e-5)
    first, last = peer["window"] or (0.0, 1.0)
    z = profile.heights[int(first * profile.heights.size) : int(last * profile.heights.size)] * 1e6
    x = np.linspace(-1, 1, z.size)
    z = z - np.polynomial.Polynomial.fit(x, z, peer["poly_degree"] or 0)(x)
    # The peer's polynomial is fitted by another routine and its window may differ by a point.
    expected = peer["surfacetopography_1_27_1_before_filter"]["Rq"]
    assert np.sqrt(np.mean(z**2)) == pytest.approx(expected, rel=1e-4)


def test_text_twin_of_a_binary_scan_is_read_in_metres(shared):
    profile = read(shared / "data" / "profiles" / "stylus_misc" / "opdx-3.txt")
    assert profile.heights.size == 3001
    assert profile.spacing == pytest.approx(1.6655563e-8, rel=1e-7)
    assert profile.heights[0] == pytest.approx(1.3718306e-9, rel=1e-12)
