"""The shipped traces: published Ra, Rq, Rz, the recipe that rebuilds them, and the shape of their heights."""

import numpy as np
import pytest
from scipy.special import ndtri

import profiles
from profiles.traces.build import recipes, text
from roughness import height_parameters, moments, roughness_profile

# Hong, Aneshansley and Talbot, "Mechanical Power Loss of Spur Gears Subject to Various Surface Finish
# Pairings", table 1: Ra, Rq, Rz (um).
TABLE_1 = {
    "0036": (0.036, 0.046, 0.275),
    "0122": (0.122, 0.151, 0.510),
    "0219": (0.219, 0.274, 1.400),
    "0258": (0.258, 0.321, 1.643),
    "0302": (0.302, 0.374, 1.777),
    "0450": (0.450, 0.579, 3.400),
}


def band(name):
    return roughness_profile(profiles.shipped(name), cutoff=0.8e-3, short_cutoff=2.5e-6)


def test_there_are_six():
    assert tuple(TABLE_1) == profiles.SHIPPED


@pytest.mark.literature(
    "Hong, Aneshansley and Talbot, Mechanical Power Loss of Spur Gears Subject to Various Surface Finish Pairings, "
    "Gear Technology, table 1"
)
@pytest.mark.parametrize("name", TABLE_1)
def test_height_parameters_equal_the_published_table_to_its_last_digit(name):
    found = height_parameters(band(name))
    assert found.sections == 6
    assert tuple(round(v * 1e6, 3) for v in (found.Ra, found.Rq, found.Rz)) == TABLE_1[name]


@pytest.mark.parametrize("name", TABLE_1)
def test_the_trace_says_that_it_is_synthetic_and_is_long_enough(name):
    trace = profiles.shipped(name)
    assert "synthetic" in trace.origin["kind"]
    assert trace.length >= 4.8e-3
    assert trace.spacing <= 2.5e-6 / 8


@pytest.mark.parametrize("name", TABLE_1)
def test_the_recipe_rebuilds_the_file_bit_for_bit(name):
    from importlib import resources

    kept = resources.files("profiles.traces").joinpath(f"{name}.txt").read_text(encoding="utf-8")
    assert text(name, recipes()[name]) == kept


@pytest.mark.parametrize("name", TABLE_1)
def test_the_bulk_of_the_heights_lies_on_the_normal_line(name):
    heights = np.sort(band(name).heights)
    line = ndtri((np.arange(heights.size) + 0.5) / heights.size)
    off = heights / heights.std() - line
    assert np.abs(off[np.abs(line) < 2]).max() < 0.2


def test_slope_and_curvature_do_not_grow_with_amplitude():
    found = {name: moments(band(name)) for name in TABLE_1}
    assert all(m.bandwidth > 1.5 for m in found.values())
    ground = [found[name] for name in ("0219", "0258", "0302", "0450")]
    for quantity in ("m2", "m4"):
        values = [getattr(m, quantity) for m in ground]
        assert max(values) / min(values) < 1.4  # while m0 grows 4.5 times
    assert all(1e-4 < m.m2 < 9.5e-3 for m in found.values())


@pytest.mark.parametrize("name", ["0036", "0122", "0219", "0258", "0302"])
def test_rms_of_the_whole_equals_rq_so_that_composite_roughness_adds(name):
    assert np.sqrt(moments(band(name)).m0) * 1e6 == pytest.approx(TABLE_1[name][1], abs=2.5e-4)


def test_unknown_name_gets_the_nearest():
    with pytest.raises(profiles.InputError, match="nearest known: '0258'"):
        profiles.shipped("258")
