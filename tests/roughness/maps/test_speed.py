"""Time of the areal parameters of a large map."""

import time

import numpy as np
from scipy.ndimage import gaussian_filter

from profiles.maps import HeightMap
from roughness.maps import map_record, prepared_map


def test_four_million_points_take_five_seconds_of_one_processor():
    """Plane, short and long Gaussian filter of 2.5 um and 0.8 mm, all parameters, moments in every direction."""
    noise = np.random.default_rng(0).standard_normal((2048, 2048))
    area = HeightMap(1e-6 * gaussian_filter(noise, (12.0, 4.0)), 0.5e-6, 0.5e-6)
    start = time.process_time()
    found = map_record(prepared_map(area), area)
    assert time.process_time() - start < 5.0
    assert all(value is not None for value in found["parameters"].values())
