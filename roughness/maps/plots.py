"""Figures of a map: its picture with lay and traces, its texture, its material ratio curve."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from profiles.maps import HeightMap
from roughness.maps.material import areal_ratio_curve, material_parameters
from roughness.maps.texture import LEVEL, angular_spectrum, areal_autocorrelation, smoothed_spectrum, texture_direction

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LINE = "#1f4e79"
_MARK = "#c0504d"
MOST_PIXELS = 900
"""Grid. Pixels a side of a drawn map: more are not seen and make the file large."""
SHOWN = 0.5
"""Judgement. Percentage of the heights beyond either end of the colours, so that a spike does not take them all."""


def map_figure(area: HeightMap, traces: Sequence[float] = ()) -> Figure:
    """Picture of a map, holes grey, with the direction of its lay and the lines of traces at some angles (rad)."""
    from matplotlib.figure import Figure

    width, depth = area.size
    figure = Figure(figsize=(6.4, min(max(5.0 * depth / width, 2.4), 7.0) + 0.7), layout="constrained")
    axes = figure.subplots()
    thin = max(1, math.ceil(max(area.heights.shape) / MOST_PIXELS))
    z = area.heights[::thin, ::thin] * 1e6
    low, high = np.nanpercentile(z, (SHOWN, 100.0 - SHOWN))
    axes.set_facecolor("0.6")
    shown = axes.imshow(
        z,
        extent=(0.0, width * 1e3, depth * 1e3, 0.0),
        cmap="cividis",
        vmin=low,
        vmax=high,
        interpolation="nearest",
        aspect="equal",
    )
    axes.grid(False)
    figure.colorbar(shown, ax=axes, label="height (µm)", extend="both", shrink=0.85)
    for angle, style in zip(traces, ("-", "--")):
        along = _through_middle(area, angle)
        axes.plot(along[:, 0] * 1e3, along[:, 1] * 1e3, style, color="white", linewidth=1.0)
    lay = texture_direction(area)
    axes.set_title(
        f"{area.name}: lay at {math.degrees(lay):.0f} degrees"
        + ("; lines: traces across (solid) and along it" if len(traces) > 1 else ""),
        loc="left",
        fontsize=9,
    )
    axes.set_xlabel("x (mm)")
    axes.set_ylabel("y (mm)")
    return figure


def texture_figure(area: HeightMap) -> Figure:
    """Autocorrelation of a map with the edge of its central lobe, and the angular spectrum of its crests."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.4, 3.6), layout="constrained")
    left = figure.add_subplot(1, 2, 1)
    found = areal_autocorrelation(area)
    whole = np.concatenate((found[:0:-1, ::-1], found))
    reach = (found.shape[1] // 2) * area.spacing_x * 1e3, (found.shape[0] - 1) * area.spacing_y * 1e3
    thin = max(1, math.ceil(max(whole.shape) / MOST_PIXELS))
    part = whole[::thin, ::thin]
    extent = (-reach[0], reach[0], -reach[1], reach[1])
    shown = left.imshow(part, extent=extent, origin="lower", cmap="cividis", vmin=-0.5, vmax=1.0, aspect="equal")
    left.grid(False)
    left.contour(part, levels=[LEVEL], extent=extent, colors="white", linewidths=0.9)
    figure.colorbar(shown, ax=left, shrink=0.8, label="autocorrelation")
    left.set_title(f"{area.name}: line at {LEVEL:g}", loc="left", fontsize=9)
    left.set_xlabel("lag along x (mm)")
    left.set_ylabel("lag along y (mm)")
    right = figure.add_subplot(1, 2, 2)
    angles, shares = angular_spectrum(area)
    right.plot(np.degrees(angles), 100.0 * smoothed_spectrum(shares), color=_LINE, linewidth=1.2)
    right.axvline(math.degrees(texture_direction(area)), color=_MARK, linewidth=0.9, linestyle="--")
    right.set_xlim(0.0, 180.0)
    right.set_ylim(bottom=0.0)
    right.set_xticks(range(0, 181, 45))
    right.spines[["top", "right"]].set_visible(False)
    right.set_title("dashed: Std", loc="left", fontsize=9)
    right.set_xlabel("direction of the crests (degrees)")
    right.set_ylabel("share of the spectrum (% per degree)")
    return figure


def material_figure(area: HeightMap) -> Figure:
    """Material ratio curve of a map with its core line and the material ratios of its volumes."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(4.8, 3.4), layout="constrained")
    axes: Axes = figure.subplots()
    ratio, heights = areal_ratio_curve(area)
    keep = np.unique(np.linspace(0, ratio.size - 1, 1500).astype(int))
    axes.plot(ratio[keep], heights[keep] * 1e6, color=_LINE, linewidth=1.3)
    p = material_parameters(area)
    title = f"{area.name}: Vmp {p.Vmp * 1e6:.3g}, Vvv {p.Vvv * 1e6:.3g} µm³/µm²"
    if p.s_shaped:
        top = float(np.interp(p.Smr1, ratio, heights))
        axes.plot((0, 100), np.array((top, top - p.Sk)) * 1e6, color=_MARK, linewidth=1.0)
        title += f"\nSk {p.Sk * 1e6:.3g}, Spk {p.Spk * 1e6:.3g}, Svk {p.Svk * 1e6:.3g} µm"
    for at in (10.0, 80.0):
        axes.axvline(at, color="0.75", linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    axes.set_title(title, loc="left", fontsize=9)
    axes.set_xlim(0, 100)
    axes.set_xlabel("material ratio (%)")
    axes.set_ylabel("height (µm)")
    return figure


def _through_middle(area: HeightMap, angle: float) -> np.ndarray:
    """Ends of the longest line through the middle of a map at an angle (rad): rows of x and y (m)."""
    width, depth = area.size
    across = abs(math.cos(angle)), abs(math.sin(angle))
    reach = min(
        half / share if share > 1e-12 else math.inf for half, share in zip((width / 2, depth / 2), across, strict=True)
    )
    step = np.array((math.cos(angle), math.sin(angle))) * reach
    middle = np.array((width, depth)) / 2
    return np.array((middle - step, middle + step))
