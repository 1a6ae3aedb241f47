"""Figures of results from panel descriptions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mixedlub.report.style import legend_above, panels, shades

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from mixedlub.schema.result import Curve, Panel


SHORT = 14
"""Longest name with which six fit in a row of a legend (characters)."""


def panel_figure(title: str, drawn: tuple[Panel, ...]) -> Figure:
    """Figure of panels, two side by side."""
    figure, axes, _ = panels(len(drawn), 2, height=3.0, sharex=False, sharey=False)
    colours = shades(1 + max(curve.group for panel in drawn for curve in panel.curves))[::-1]
    for axis, panel in zip(axes, drawn, strict=True):
        for curve in panel.curves:
            _draw(axis, curve, colours[curve.group])
        axis.set_xlabel(panel.across)
        axis.set_ylabel(panel.up)
        if panel.from_zero:
            axis.set_ylim(0.0, panel.ceiling)
    named = {label: line for axis in axes for line, label in zip(*axis.get_legend_handles_labels(), strict=True)}
    columns = 6 if max(map(len, named), default=0) <= SHORT else 2
    legend_above(figure, (list(named.values()), list(named)) if named else axes[0], title, columns=columns)
    return figure


def _draw(axis: Axes, curve: Curve, colour: np.ndarray) -> None:
    label = curve.label or None
    if curve.low is None or curve.high is None:
        axis.plot(curve.x, curve.y, "o" if curve.marker else curve.style, color=colour, label=label)
    elif curve.marker:
        ends = np.abs([curve.y - curve.low, curve.high - curve.y])
        axis.errorbar(curve.x, curve.y, yerr=ends, fmt="o", color=colour, label=label, elinewidth=0.8, capsize=2.0)
    else:
        axis.fill_between(curve.x, curve.low, curve.high, color=colour, alpha=0.25, linewidth=0.0)
        axis.plot(curve.x, curve.y, color=colour, label=label)
