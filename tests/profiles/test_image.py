"""Traces across height maps and out of charts, against surfaces and curves known beforehand."""

import numpy as np
import pytest

from profiles import InputError
from profiles.image import across, along_direction, digitised
from profiles.maps import HeightMap, read_map

WAVE = 40e-6


def wavy(angle, rows=160, columns=200, dx=1e-6, dy=1.5e-6):
    """A wave of 1 um that runs along a direction."""
    y, x = np.mgrid[0:rows, 0:columns]
    phase = 2 * np.pi / WAVE * (x * dx * np.cos(angle) + y * dy * np.sin(angle))
    return HeightMap(1e-6 * np.cos(phase), dx, dy, "wave")


@pytest.mark.parametrize("degrees", [0, 30, 45, 90, 120, 200])
def test_a_trace_in_any_direction_sees_the_wave_at_its_projected_length(degrees):
    area = wavy(np.radians(30))
    trace = along_direction(area, np.radians(degrees))
    stretch = np.cos(np.radians(degrees - 30))
    reach = (area.size / np.maximum(np.abs([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))]), 1e-9)).min() / 2
    s = trace.positions - reach
    middle = 2 * np.pi / WAVE * (99.5e-6 * np.cos(np.radians(30)) + 119.25e-6 * np.sin(np.radians(30)))
    # Splines bend differently in the outermost cells.
    inner = slice(5, -5)
    assert trace.heights[inner] == pytest.approx(
        1e-6 * np.cos(middle + 2 * np.pi / WAVE * stretch * s)[inner], abs=2e-9
    )


def test_missing_points_are_masked():
    heights = np.array(wavy(0.0).heights)
    heights[:, 50:53] = np.nan
    trace = across(HeightMap(heights, 1e-6, 1e-6), (0.0, 5e-6), (199e-6, 5e-6))
    assert np.flatnonzero(~trace.valid).tolist() == [50, 51, 52]
    assert np.isfinite(trace.heights).all()


@pytest.mark.parametrize(("start", "end"), [((0, 0), (1.0, 0)), ((-1e-6, 0), (1e-4, 0)), ((0, 0), (1e-6, 0))])
def test_a_line_off_the_map_or_too_short_is_refused(start, end):
    with pytest.raises(InputError, match=r"off the map|at least three points"):
        across(wavy(0.0), start, end)


def test_maps_come_from_sdf_and_x3p_files(tmp_path):
    import sdfio
    import x3pio

    area = wavy(0.3)
    x3pio.write(tmp_path / "a.x3p", area.heights, x_scale=1e-6, y_scale=1.5e-6)
    sdfio.write(tmp_path / "a.sdf", area.heights, x_scale=1e-6, y_scale=1.5e-6)
    for name in ("a.x3p", "a.sdf"):
        found = read_map(tmp_path / name)
        assert found.heights == pytest.approx(area.heights, abs=1e-12)
        assert (found.spacing_x, found.spacing_y) == pytest.approx((1e-6, 1.5e-6))
    with pytest.raises(InputError, match="no such file"):
        read_map(tmp_path / "b.sdf")


def chart(x, z, grid):
    """Pixels of a chart, drawn so that its axes are the whole picture."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(12, 4), dpi=100)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.plot(x, z, color="#c00000", linewidth=1.2)
    axes.set(xlim=(x[0], x[-1]), ylim=(-2, 2))
    if grid:
        axes.grid(color="#909090")
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())


@pytest.mark.parametrize("grid", [False, True])
def test_a_digitised_chart_gives_the_curve_back_to_a_pixel(grid):
    x = np.linspace(0, 1200, 3000)
    z = np.sin(2 * np.pi * x / 300) + 0.3 * np.cos(2 * np.pi * x / 90)
    trace = digitised(
        chart(x, z, grid), box=(0, 0, 1200, 400), x_range=(0, 1.2e-3), z_range=(-2e-6, 2e-6), colour=(192, 0, 0)
    )
    assert trace.spacing == pytest.approx(1e-6)
    expected = np.interp(trace.positions * 1e6 + 0.5, x, z) * 1e-6
    off = np.abs(trace.heights - expected)[trace.valid]
    assert np.median(off) < 0.5 * trace.origin["pixel_height_m"]
    # A grid line over the curve takes whole columns, an edge a little of the curve.
    assert np.quantile(off, 0.99) < 2.5 * trace.origin["pixel_height_m"]
    assert trace.valid.mean() > 0.97


def test_a_chart_without_that_colour_is_refused():
    with pytest.raises(InputError, match="no pixel of that colour"):
        digitised(np.full((20, 30, 3), 255, np.uint8), box=(0, 0, 30, 20), x_range=(0, 1e-3), z_range=(0, 1e-6))
    with pytest.raises(InputError, match="within the picture"):
        digitised(np.full((20, 30, 3), 255, np.uint8), box=(0, 0, 99, 20), x_range=(0, 1e-3), z_range=(0, 1e-6))
