"""Style of the diagnosis figures, added to the common one: colours by meaning, plain logarithmic ticks."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.report.style import as_svg, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INK, MUTED, GRID, PAPER = "#22262b", "#7d868f", "#e3e6e9", "#e9ebee"
BEFORE, AFTER, FAULT, UNNAMED = "#c8553d", "#1d6f8a", "#8a6d1d", "#7a4d9b"
OUTLIER = "#b00020"
SERIES = ("#1d6f8a", "#c8553d", "#8a6d1d", "#5b8c5a", "#7a4d9b", "#d39b2a", "#4a4f57", "#b56a94")
DIVERGING = "RdBu_r"

RULES: Any = {
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.edgecolor": MUTED,
    "axes.labelcolor": INK,
    "grid.color": GRID,
    "text.color": INK,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
}


@contextmanager
def look() -> Iterator[None]:
    """Context in which figures are drawn in the style of a diagnosis."""
    from matplotlib import rc_context

    with styled(), rc_context(RULES):
        yield


def blank(width: float, height: float) -> Figure:
    """An empty figure, size in inches."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def as_drawn(figure: Figure) -> str:
    """Figure as an `svg` element; layout and saving share the style, as larger tick labels would lack room."""
    with look():
        engine = figure.get_layout_engine()
        if engine is not None:
            engine.execute(figure)
            figure.set_layout_engine(None)
        return as_svg(figure)


def inline(svg: str, prefix: str) -> str:
    """An SVG element with ids made unique by a prefix, so that one page can hold many."""
    body = re.sub(r'\bid="([^"]+)"', rf'id="{prefix}-\1"', svg)
    body = re.sub(r"url\(#([^)]+)\)", rf"url(#{prefix}-\1)", body)
    return re.sub(r'xlink:href="#([^"]+)"', rf'xlink:href="#{prefix}-\1"', body)


def wide(values: np.ndarray, ratio: float = 8.0) -> bool:
    """Whether all values are positive and span enough for a logarithmic axis."""
    return bool((values > 0).all() and values.max() > ratio * values.min())


def by_decades(values: np.ndarray) -> bool:
    """Whether a condition was varied by factors rather than by steps.

    >>> by_decades(np.array([0.5, 1.5, 10.0])), by_decades(np.arange(1.0, 100.0))
    (True, False)
    """
    levels = np.unique(values)
    return wide(levels, 10.0) and float(np.median(levels)) < 0.35 * float(levels[-1])


def log_ticks(axes: Axes, which: str) -> None:
    """Put plain numbers on a logarithmic axis: at 1, 2 and 5, or at decades on a wide axis."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

    axis = axes.xaxis if which == "x" else axes.yaxis
    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < 300.0 * low else (1.0,)))
    axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
    axis.set_minor_locator(NullLocator())
