"""Figures say what they show: a panel a profile, units on every axis that has one, and they render."""

import io

import numpy as np
import pytest

from roughness import roughness_profile
from roughness.plots import abbott_figure, probability_figure, spectrum_figure, trace_figure

FIGURES = [trace_figure, probability_figure, abbott_figure, spectrum_figure]


@pytest.fixture
def two(gaussian_trace, plateau_trace):
    return [roughness_profile(p, cutoff=0.8e-3, short_cutoff=8e-6) for p in (gaussian_trace(), plateau_trace())]


@pytest.mark.parametrize("draw", FIGURES)
def test_one_panel_a_profile_with_name_and_units(draw, two):
    panels = [a for a in draw(*two).axes if a.axison]
    assert len(panels) == 2
    for axes, profile in zip(panels, two):
        assert profile.name in axes.get_title(loc="left")
        assert any(unit in axes.get_ylabel() for unit in ("µm", "%"))
    assert any(unit in panels[-1].get_xlabel() for unit in ("µm", "mm", "%"))


@pytest.mark.parametrize("draw", FIGURES)
def test_figures_render(draw, two):
    file = io.BytesIO()
    draw(*two).savefig(file, format="png", dpi=40)
    assert file.tell() > 1000


def test_traces_share_one_scale(two):
    assert len({a.get_ylim() for a in trace_figure(*two).axes}) == 1


def test_thinning_a_long_trace_keeps_its_spike(gaussian_trace):
    from dataclasses import replace

    p = gaussian_trace(200_000)
    z = np.array(p.heights)
    z[123_457] = 9e-6
    axes = trace_figure(replace(p, heights=z)).axes[0]
    assert axes.get_ylim()[1] > 9
    assert max(path.vertices[:, 1].max() for path in axes.collections[0].get_paths()) == pytest.approx(9)


def test_gaussian_heights_lie_on_the_line(gaussian_trace):
    p = gaussian_trace(40_000, roll=20e-6)
    axes = probability_figure(p).axes[0]
    line, points = axes.lines[0].get_xydata(), axes.lines[1].get_xydata()
    inner = np.abs(points[:, 1]) < 2
    expected = np.interp(points[inner, 1], line[:, 1], line[:, 0])
    assert np.abs(points[inner, 0] - expected).max() < 0.15 * p.heights.std() * 1e6
