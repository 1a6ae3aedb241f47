"""One look for all figures: sizes, colours, and how a figure becomes SVG."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SETTINGS: dict[Any, Any] = {
    "font.size": 8.5,
    "axes.titlesize": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.7,
    "axes.grid": True,
    "grid.color": "0.9",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "legend.fontsize": 7.5,
    "lines.linewidth": 1.3,
    "lines.markersize": 3.6,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
    "svg.hashsalt": "mixedlub",
}
WIDTH = 7.2
"""Inches of a figure across a page."""


@contextmanager
def styled() -> Iterator[None]:
    """Within it, figures are drawn in the one look."""
    import matplotlib

    with matplotlib.rc_context(SETTINGS):
        yield


def shades(count: int) -> np.ndarray:
    """Colours for ordered levels, light to dark, told apart in grey and by the colour-blind."""
    import matplotlib

    return matplotlib.colormaps["viridis_r"](np.linspace(0.12, 0.95, max(count, 2)))[:count]


def panels(count: int, columns: int, *, height: float = 2.2) -> tuple[Figure, list[Axes]]:
    """A figure of equal panels with common axes; surplus places stay empty."""
    from matplotlib.figure import Figure

    columns = min(columns, count)
    rows = -(-count // columns)
    figure = Figure(figsize=(WIDTH, height * rows + 0.5), layout="constrained")
    axes = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for empty in axes.flat[count:]:
        empty.set_visible(False)
    for column in range(columns):
        last = (count - 1 - column) // columns
        axes[last, column].tick_params(labelbottom=True)
    return figure, list(axes.flat[:count])


def normalised_axis(axes: Axes, most: float) -> None:
    """A second scale on the right: the same values over the largest of the study."""
    right = axes.secondary_yaxis("right", functions=(lambda y: np.divide(y, most), lambda y: np.multiply(y, most)))
    right.spines["right"].set_visible(True)
    right.set_ylabel("share of largest (-)")


FONTS = "'DejaVu Sans', Verdana, 'Bitstream Vera Sans', sans-serif"
"""Fonts of one width, so that text stays text and still fits where the first of them is missing."""


def as_svg(figure: Figure) -> str:
    """The figure as an `svg` element, without prologue; the same input gives the same text."""
    text = io.StringIO()
    with styled():
        figure.savefig(text, format="svg", metadata={"Date": None, "Creator": OWNER})
    found = text.getvalue()
    return found[found.index("<svg") :].replace("'DejaVu Sans'", FONTS)


OWNER = "mixedlub"
"""What a figure's file says it was made by."""
PNG_DPI = 300
"""Dots per inch that journals ask of line art in colour at least."""
_MADE_BY = {"pdf": {"Creator": OWNER, "CreationDate": None}, "png": {"Software": OWNER}}


def save(figure: Figure, path: Path) -> None:
    """The figure as a file, in the format that the ending of its name says."""
    form = path.suffix[1:]
    if form == "svg":
        path.write_text(as_svg(figure), encoding="utf-8")
        return
    with styled():
        figure.savefig(path, dpi=PNG_DPI, metadata=_MADE_BY[form])
