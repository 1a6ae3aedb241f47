"""Figures of a profile: trace, normal probability plot, Abbott curve, spectrum. One panel a profile."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from profiles import Profile
from roughness.material_ratio import core_parameters, core_profile, material_ratio_curve
from roughness.parameters import height_parameters, named_convention
from roughness.probability import NormalProbability, normal_probability
from roughness.spectrum import log_binned, power_density

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LINE = "#1f4e79"
_MARK = "#c0504d"
_PERCENT = (0.1, 1, 5, 20, 50, 80, 95, 99, 99.9)
_MOST_POINTS = 4000


def trace_figure(
    *profiles: Profile,
    excerpt: float | None = None,
    one_scale: bool = True,
    convention: str = "ISO 4287:1997",
    sections: int | None = None,
) -> Figure:
    """Heights along each profile, on ``one_scale`` or a scale each; ``excerpt``: length (m) shown of the middle."""

    def draw(axes: Axes, profile: Profile) -> None:
        x, z = profile.positions, profile.heights
        if excerpt is not None and excerpt < profile.length:
            start = int((profile.length - excerpt) / 2 / profile.spacing)
            part = slice(start, start + int(excerpt / profile.spacing) + 1)
            x, z = x[part] - x[part][0], z[part]
        x, low, high = _envelope(x, z)
        axes.fill_between(x * 1e3, low * 1e6, high * 1e6, color=_LINE, linewidth=0.4)
        axes.axhline(0.0, color="0.6", linewidth=0.6)
        axes.set_title(f"{profile.name}: {_heights(profile, convention, sections)}", loc="left", fontsize=9)
        axes.set_ylabel("height (µm)")

    figure, panels = _panels(profiles, draw, columns=1, width=7.0, height=1.7)
    highest = [float(np.abs(p.heights).max()) * 1.08e6 for p in profiles]
    longest = max(p.length if excerpt is None else min(excerpt, p.length) for p in profiles)
    for axes, own in zip(panels, highest):
        reach = max(highest) if one_scale else own
        axes.set_ylim(-reach, reach)
        axes.set_xlim(0.0, longest * 1e3)
    panels[-1].set_xlabel("distance along the trace (mm)")
    return figure


def probability_figure(*profiles: Profile, results: Sequence[NormalProbability] | None = None) -> Figure:
    """Normal probability plot of each profile: Gaussian heights lie on the straight line.

    The band holds 99 of 100 Gaussian profiles with the same autocorrelation; ticks on the line mark
    between which percentages it describes the surface.
    """
    from scipy.special import ndtri

    found = list(results) if results is not None else [normal_probability(p) for p in profiles]
    judged = {id(p): r for p, r in zip(profiles, found)}

    def draw(axes: Axes, profile: Profile) -> None:
        r = judged[id(profile)]
        ordered = np.sort(profile.heights[profile.valid])
        q = ndtri((np.arange(ordered.size) + 0.625) / (ordered.size + 0.25))
        keep = np.unique(np.searchsorted(q, np.linspace(q[0], q[-1], 700)).clip(0, q.size - 1))
        line = r.mean + r.sigma * r.quantiles
        band = (line - r.band) * 1e6, (line + r.band) * 1e6
        axes.fill_betweenx(r.quantiles, *band, color="0.85", linewidth=0, label="99 of 100 Gaussian profiles")
        reach = np.array([q[0], q[-1]])
        axes.plot((r.mean + r.sigma * reach) * 1e6, reach, color=_MARK, linewidth=1.0, label="Gaussian")
        axes.plot(ordered[keep] * 1e6, q[keep], ".", color=_LINE, markersize=2.5, label="heights")
        for percent in (r.from_percent, r.to_percent):
            at = ndtri(percent / 100)
            end = (r.mean + r.sigma * at) * 1e6
            axes.plot(end, at, "_", color=_MARK, markersize=14, markeredgewidth=1.5, label="ends of the line's range")
        axes.set_yticks(ndtri(np.array(_PERCENT) / 100), [f"{p:g}" for p in _PERCENT])
        span = 1.06 * max(float(np.abs(ordered[[0, -1]]).max()), 3.2 * r.sigma) * 1e6
        axes.set_xlim(-span, span)
        axes.grid(color="0.92", linewidth=0.6)
        axes.set_axisbelow(True)
        axes.set_title(_judged(profile.name, r), loc="left", fontsize=9)
        axes.set_ylabel("heights below (%)")
        axes.set_xlabel("height (µm)")

    figure, panels = _panels(profiles, draw, columns=3, width=3.4, height=3.3)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles[:4], labels[:4], loc="outside upper left", ncols=4 if len(profiles) > 1 else 2)
    return figure


def _judged(name: str, r: NormalProbability) -> str:
    """Title of a panel: verdict, number of independent heights, and any contradiction by the contact ratio."""
    lines = [
        f"{name}: {r.verdict.replace('_', ' ')}",
        f"{r.independent_heights:.0f} independent heights, sigma {r.sigma * 1e6:.3g} µm",
        f"line from {r.from_percent:.1f} to {r.to_percent:.1f} %",
    ]
    if r.misleads:
        lines.append(f"but contact {r.contact_ratio[1]:.2g} × Gaussian at 2 sigma")
    return "\n".join(lines)


def abbott_figure(*profiles: Profile, convention: str = "ISO 4287:1997", sections: int | None = None) -> Figure:
    """Material ratio curve of each profile with the core line and Rk, Rpk, Rvk of ISO 13565-2.

    ``convention`` sets the method of the core line and, with ``sections``, the evaluated length.
    """
    method = named_convention(convention).core

    def draw(axes: Axes, profile: Profile) -> None:
        profile = core_profile(profile, convention=convention, sections=sections)
        ratio, heights = material_ratio_curve(profile)
        keep = np.unique(np.linspace(0, ratio.size - 1, 1500).astype(int))
        axes.plot(ratio[keep], heights[keep] * 1e6, color=_LINE, linewidth=1.3)
        core = core_parameters(profile, method=method)
        title = profile.name
        if core.s_shaped:
            top = float(np.interp(core.Mr1, ratio, heights))
            axes.plot((0, 100), np.array((top, top - core.Rk)) * 1e6, color=_MARK, linewidth=1.0)
            for level, at in ((top, core.Mr1), (top - core.Rk, core.Mr2)):
                axes.axhline(level * 1e6, color="0.75", linewidth=0.6)
                axes.plot((at, at), (heights[-1] * 1e6, level * 1e6), color="0.75", linewidth=0.6)
            title += (
                f"\nRk {core.Rk * 1e6:.3g}, Rpk {core.Rpk * 1e6:.3g}, Rvk {core.Rvk * 1e6:.3g} µm"
                f"\nMr1 {core.Mr1:.1f}, Mr2 {core.Mr2:.1f} %"
            )
        else:
            title += "\nnot S-shaped: Rk family undefined"
        axes.set_title(title, loc="left", fontsize=9)
        axes.set_xlim(0, 100)
        axes.set_xlabel("material ratio (%)")
        axes.set_ylabel("height (µm)")

    return _panels(profiles, draw, columns=3, width=3.4, height=3.0)[0]


def spectrum_figure(*profiles: Profile) -> Figure:
    """Power spectral density over wavelength: its spread, its mean in log steps, the filter's cut-offs."""

    def draw(axes: Axes, profile: Profile) -> None:
        f, g = power_density(profile)
        wave, low, high = _spread(f, g)
        axes.fill_between(wave * 1e6, low * 1e18, high * 1e18, color="0.85", linewidth=0.5)
        centre, mean = log_binned(f, g)
        axes.loglog(1e6 / centre, mean * 1e18, color=_LINE, linewidth=1.4)
        for key, name in (("short_cutoff", "λs"), ("cutoff", "λc")):
            if key in profile.cutoffs:
                axes.axvline(profile.cutoffs[key] * 1e6, color=_MARK, linewidth=0.8, linestyle="--")
                axes.annotate(
                    name,
                    (profile.cutoffs[key] * 1e6, 0.97),
                    xycoords=("data", "axes fraction"),
                    xytext=(3, 0),
                    textcoords="offset points",
                    va="top",
                    color=_MARK,
                )
        axes.set_ylim(max(mean.min(), mean.max() * 1e-14) * 1e18 / 5, mean.max() * 1e18 * 20)
        axes.invert_xaxis()
        axes.set_title(profile.name, loc="left", fontsize=9)
        axes.set_xlabel("wavelength (µm)")
        axes.set_ylabel("power density (µm³)")

    return _panels(profiles, draw, columns=3, width=3.4, height=3.0)[0]


def _panels(
    profiles: Sequence[Profile],
    draw: Callable[[Axes, Profile], None],
    *,
    columns: int,
    width: float,
    height: float,
) -> tuple[Figure, list[Axes]]:
    from matplotlib.figure import Figure

    across = min(columns, len(profiles))
    down = -(-len(profiles) // across)
    figure = Figure(figsize=(max(width * across, 4.6), height * down + 0.4), layout="constrained")
    grid = list(figure.subplots(down, across, squeeze=False).flat)
    for axes, profile in zip(grid, profiles):
        axes.spines[["top", "right"]].set_visible(False)
        draw(axes, profile)
    for axes in grid[len(profiles) :]:
        axes.set_axis_off()
    return figure, grid[: len(profiles)]


def _envelope(x: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Lowest and highest height per drawn column, so that no spike is lost by thinning."""
    if z.size <= _MOST_POINTS:
        return x, z, z
    starts = np.linspace(0, z.size, _MOST_POINTS, endpoint=False).astype(int)
    return x[starts], np.minimum.reduceat(z, starts), np.maximum.reduceat(z, starts)


def _spread(f: np.ndarray, g: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Wavelengths, and the lowest and highest density in narrow steps of their logarithm."""
    steps = np.floor(np.log10(f[1:] / f[1]) * 80)
    starts = np.flatnonzero(np.diff(steps, prepend=-1.0))
    return 1.0 / f[1:][starts], np.minimum.reduceat(g[1:], starts), np.maximum.reduceat(g[1:], starts)


def _heights(profile: Profile, convention: str, sections: int | None) -> str:
    p = height_parameters(profile, convention=convention, sections=sections)
    return f"Ra {p.Ra * 1e6:.3g}, Rq {p.Rq * 1e6:.3g}, Rz {p.Rz * 1e6:.3g} µm"
