"""One figure for several surfaces: excerpts, material ratio curves, probability plots and spectra on common axes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from profiles import Profile
from roughness.material_ratio import material_ratio_curve
from roughness.spectrum import log_binned, power_density

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST = 8
"""Grid. Most surfaces in one figure: more colours are not told apart."""
EXCERPT = 0.8e-3
"""Judgement. Length (m) of the excerpts: one usual cut-off shows the single asperities and the waves."""
_PERCENT = (0.1, 1, 10, 50, 90, 99, 99.9)


def comparison_figure(profiles: Sequence[Profile], names: Sequence[str]) -> Figure:
    """Roughness profiles of several surfaces by name: excerpts, material ratio, normal probability, spectrum."""
    import matplotlib
    from matplotlib.figure import Figure
    from scipy.special import ndtri

    shown = list(zip(profiles[:MOST], names[:MOST], strict=True))
    colours = matplotlib.colormaps["tab10"].colors  # type: ignore[attr-defined]
    figure = Figure(figsize=(8.4, 6.6), layout="constrained")
    (trace, ratio), (normal, spectrum) = figure.subplots(2, 2)
    lift = 1.1 * max(float(np.ptp(one.heights)) for one, _ in shown) * 1e6
    for place, (one, name) in enumerate(shown):
        colour = colours[place]
        part = _middle(one)
        x = np.arange(part.size) * one.spacing * 1e3
        trace.plot(x, part * 1e6 - place * lift, color=colour, linewidth=0.7, label=name)
        share, heights = material_ratio_curve(one)
        keep = np.unique(np.linspace(0, share.size - 1, 1500).astype(int))
        ratio.plot(share[keep], heights[keep] * 1e6, color=colour, linewidth=1.2)
        quantiles = ndtri(1.0 - share[keep] / 100.0)
        normal.plot(heights[keep] * 1e6, quantiles, color=colour, linewidth=1.2)
        centre, density = log_binned(*power_density(one))
        spectrum.loglog(1e6 / centre, density * 1e18, color=colour, linewidth=1.2)
    trace.set_xlabel("distance (mm)")
    trace.set_ylabel("height (µm), one below the other")
    ratio.set_xlim(0, 100)
    ratio.set_xlabel("material ratio (%)")
    ratio.set_ylabel("height (µm)")
    normal.set_yticks(ndtri(np.array(_PERCENT) / 100), [f"{p:g}" for p in _PERCENT])
    normal.set_xlabel("height (µm)")
    normal.set_ylabel("heights below (%)")
    top = max(line.get_ydata().max() for line in spectrum.get_lines())
    spectrum.set_ylim(top * 1e-8, top * 3.0)
    spectrum.invert_xaxis()
    spectrum.set_xlabel("wavelength (µm)")
    spectrum.set_ylabel("power density (µm³)")
    for axes in (trace, ratio, normal, spectrum):
        axes.spines[["top", "right"]].set_visible(False)
        axes.grid(color="0.92", linewidth=0.6)
        axes.set_axisbelow(True)
    figure.legend(loc="outside upper left", ncols=min(4, len(shown)))
    return figure


def _middle(profile: Profile) -> np.ndarray:
    """Heights of the middle of a profile, as long as an excerpt."""
    count = min(profile.heights.size, int(EXCERPT / profile.spacing) + 1)
    start = (profile.heights.size - count) // 2
    return profile.heights[start : start + count]
