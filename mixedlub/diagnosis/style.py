"""The look of the figures, and how they become SVG that is the same every time."""

from __future__ import annotations

import io
import re
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INK, MUTED, GRID, PAPER = "#22262b", "#7d868f", "#e3e6e9", "#e9ebee"
BEFORE, AFTER, FAULT, UNNAMED = "#c8553d", "#1d6f8a", "#8a6d1d", "#7a4d9b"
OUTLIER = "#b00020"
SERIES = ("#1d6f8a", "#c8553d", "#8a6d1d", "#5b8c5a", "#7a4d9b", "#d39b2a", "#4a4f57", "#b56a94")
DIVERGING = "RdBu_r"

RULES: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 8.5,
    "axes.titlesize": 9.0,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.labelsize": 8.5,
    "axes.edgecolor": MUTED,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "text.color": INK,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
    "svg.hashsalt": "mixedlub",
    "svg.fonttype": "path",
    "mathtext.fontset": "dejavusans",
}


def look() -> AbstractContextManager[None]:
    """Everything drawn and saved inside has the look of the figures."""
    from matplotlib import rc_context

    return rc_context(RULES)


def blank(width: float, height: float) -> Figure:
    """An empty figure, size in inches."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def as_svg(figure: Figure) -> str:
    """The figure as SVG without a date, so that equal figures are equal text."""
    text = io.StringIO()
    with look():
        figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    return text.getvalue()


def equation_svg(latex: str) -> str | None:
    """An equation drawn as SVG; None where it is beyond matplotlib's mathematical text."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.mathtext import MathTextParser

    text = latex.replace(r"\text{", r"\mathrm{").replace(r"\le ", r"\leq ").replace(r"\ge ", r"\geq ")
    with look():
        font = FontProperties(size=11)
        try:
            width, height, *_ = MathTextParser("path").parse(f"${text}$", 72, font)
        except ValueError:
            return None
        figure = blank((width + 4.0) / 72.0, (height + 8.0) / 72.0)
        figure.set_layout_engine("none")
        figure.text(0.0, 0.5, f"${text}$", fontproperties=font, color=INK, va="center")
        figure.patch.set_alpha(0.0)
    return as_svg(figure)


def inline(svg: str, prefix: str) -> str:
    """An SVG without its XML head, its ids made unique by a prefix so that many can stand in one page."""
    body = svg[svg.index("<svg") :]
    body = re.sub(r'\bid="([^"]+)"', rf'id="{prefix}-\1"', body)
    body = re.sub(r"url\(#([^)]+)\)", rf"url(#{prefix}-\1)", body)
    return re.sub(r'xlink:href="#([^"]+)"', rf'xlink:href="#{prefix}-\1"', body)


def wide(values: np.ndarray, ratio: float = 8.0) -> bool:
    """Whether positive numbers span so much that they belong on a logarithmic axis."""
    return bool((values > 0).all() and values.max() > ratio * values.min())


def log_ticks(axes: Axes, which: str) -> None:
    """Plain numbers at 1, 2, 5 on a logarithmic axis."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axis = axes.xaxis if which == "x" else axes.yaxis
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
    axis.set_minor_formatter(NullFormatter())
