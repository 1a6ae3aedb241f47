"""Positions that fall, that are unequal, and steps that contradict them."""

import re

import numpy as np
import pytest

from profiles import InputError, read
from roughness import trace_record
from roughness.guards import overruled
from tests.profiles.test_text import HEIGHTS, POSITIONS, rows, written

COUNT = 8000


def waves(x):
    """Heights (um) of six waves of 12 to 200 um at places in um: their m2 and m4 are known exactly."""
    return sum(0.1 * np.cos(2 * np.pi * x / length + length) for length in (12.0, 20.0, 33.0, 52.0, 90.0, 200.0))


def uneven():
    """Positions (um) with steps of 0.2 to 0.8 um."""
    return np.cumsum(np.random.default_rng(2).uniform(0.2, 0.8, COUNT))


def moments_of(trace):
    return trace_record(trace, cutoff=None, short_cutoff=None, edges=False)[1]["moments"]


def test_unequal_positions_are_resampled_and_said(tmp_path):
    x = uneven()
    trace = read(written(tmp_path, "x_um,z_um\n" + rows(x, waves(x), ",")))
    assert trace.spacing == pytest.approx(0.5e-6, rel=0.02)
    assert trace.length == pytest.approx((x[-1] - x[0]) * 1e-6, abs=1e-6)
    (said,) = (step for step in trace.steps if "resampled" in step)
    steps = np.diff(np.round(x, 6))
    spacings = [float(number) for number in re.findall(r"\d+\.\d+", said)]
    assert spacings == pytest.approx([steps.min() / np.median(steps), steps.max() / np.median(steps)], rel=1e-3)
    assert trace.valid.all()
    lengths = np.array((12.0, 20.0, 33.0, 52.0, 90.0, 200.0))
    found = moments_of(trace)
    assert found["m2"] == pytest.approx((0.005 * (2 * np.pi / lengths) ** 2).sum(), rel=0.02)
    assert found["m4_per_um2"] == pytest.approx((0.005 * (2 * np.pi / lengths) ** 4).sum(), rel=0.05)


def test_a_step_that_is_told_against_unequal_positions_is_said(tmp_path):
    x = uneven()
    trace = read(written(tmp_path, "x_um,z_um\n" + rows(x, waves(x), ",")), spacing="0.5 um")
    assert (trace.spacing, trace.heights.size) == (0.5e-6, COUNT)
    (said,) = overruled(trace)
    assert "0.4008 to 1.603 times their median" in said
    assert "resampled" in said


@pytest.mark.parametrize(("factor", "told"), [(0.6, True), (1e-3, False), (1.0, False), (2.0, False)])
def test_a_step_that_is_told_against_positions_without_a_unit(tmp_path, factor, told):
    """0.3 contradicts 0.5 um in any unit; 0.0005 is 0.5 um in mm, and whole numbers count the points."""
    x = POSITIONS * factor
    trace = read(written(tmp_path, rows(x, HEIGHTS, ",")), unit=None, spacing="0.5 um")
    assert trace.spacing == 0.5e-6
    assert ("spacing_overruled" in trace.origin) == told


def test_falling_positions_are_turned_and_said(tmp_path):
    heights = HEIGHTS + 0.01 * np.arange(50)
    rising = read(written(tmp_path, "x_um,z_um\n" + rows(POSITIONS, heights, ",")))
    falling = read(written(tmp_path, "x_um,z_um\n" + rows(POSITIONS[::-1], heights[::-1], ",")))
    assert np.array_equal(rising.heights, falling.heights)
    assert rising.spacing == falling.spacing
    assert any("turned" in step for step in falling.steps)
    assert rising.steps == ()


def test_a_gap_between_positions_is_bridged_and_masked(tmp_path):
    x, kept = 0.5 * np.arange(200), np.r_[0:80, 95:200]
    trace = read(written(tmp_path, "x_um,z_um\n" + rows(x[kept], waves(x[kept]), ",")))
    assert trace.heights.size == 200
    assert np.flatnonzero(~trace.valid).tolist() == list(range(80, 95))
    assert trace.heights[trace.valid] == pytest.approx(waves(x)[trace.valid] * 1e-6, abs=1e-9)


@pytest.mark.parametrize(
    ("positions", "rule"),
    [
        ([0, 1, 3, 2, 4, 5], "point 4: 2.0: positions must increase"),
        ([5, 4, 2, 3, 1, 0], "point 4: 3.0: positions must increase"),
        ([0, 0.1, 0.1, 2, 5, 9], "none may repeat"),
        ([0, 1, 2, 3, 4, 1e6], "too unequal"),
    ],
)
def test_positions_that_are_none_of_a_trace(tmp_path, positions, rule):
    with pytest.raises(InputError, match=rule):
        read(written(tmp_path, rows(positions, HEIGHTS[:6], ",")), unit="um")
