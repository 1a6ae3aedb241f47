"""Filled holes, and parameters of maps with holes."""

import numpy as np
import pytest

from profiles import InputError
from profiles.maps import HeightMap
from roughness.maps import filled, height_parameters, hybrid_parameters, material_parameters, prepared_map
from tests.roughness.maps.test_analytic import gaussian


def holed(area, share, seed=0):
    z = np.array(area.heights)
    z[np.random.default_rng(seed).random(z.shape) < share] = np.nan
    return HeightMap(z, area.spacing_x, area.spacing_y, "holed")


def test_a_plane_and_a_harmonic_surface_are_filled_smoothly():
    """A stretched skin over a rim of x^2 - y^2 is x^2 - y^2."""
    y, x = np.mgrid[-40:41, -40:41] * 1e-7
    for z in (0.2 * x + 0.3 * y, (x**2 - y**2) / 1e-5):
        gone = np.hypot(x, y) < 1e-6
        found = filled(np.where(gone, np.nan, z))
        assert np.abs(found - z)[gone].max() < 1e-4 * np.ptp(z)
        assert (found == z)[~gone].all()


@pytest.mark.parametrize("holes", ["mask", "fill"])
def test_parameters_with_holes_are_those_of_the_whole(holes):
    area = gaussian(512, 10.0, 20.0, seed=4)
    whole, part = (prepared_map(one, holes=holes) for one in (area, holed(area, 0.08)))
    for function, names in ((height_parameters, ("Sa", "Sq")), (material_parameters, ("Sk", "Vmp", "Vvv"))):
        a, b = function(whole), function(part)
        for name in names:
            assert getattr(b, name) == pytest.approx(getattr(a, name), rel=0.02), name
    assert hybrid_parameters(part).Sdq == pytest.approx(hybrid_parameters(whole).Sdq, rel=0.03)


def test_too_many_holes_are_refused():
    with pytest.raises(InputError, match="more than 50 %, which is too much to fill"):
        prepared_map(holed(gaussian(64), 0.6), holes="fill")
    with pytest.raises(InputError, match=r"more than 20 %. Fill them"):
        prepared_map(holed(gaussian(64), 0.3))
    assert prepared_map(holed(gaussian(64), 0.3), holes="fill").holes == 0.0


def test_outliers_of_a_map_are_masked():
    area = gaussian(128)
    z = np.array(area.heights)
    z[10, 10] = 1e-4
    found = prepared_map(HeightMap(z, 1e-6, 1e-6), outliers=8.0)
    assert np.isnan(found.heights[10, 10])
    assert found.steps[0] == "1 outliers beyond 8 sigma masked"
