"""The common style of all figures: sizes, colours, and conversion to SVG."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.schema.units import unit_of, without_unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SMALL = 7.5
"""Font size (points) of legends and long titles."""
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
    "legend.fontsize": SMALL,
    "lines.linewidth": 1.3,
    "lines.markersize": 3.6,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
    "svg.hashsalt": "mixedlub",
}
WIDTH = 7.2
"""Width of a figure across a page (inches)."""


@contextmanager
def styled() -> Iterator[None]:
    """Context in which figures are drawn in the common style."""
    import matplotlib

    with matplotlib.rc_context(SETTINGS):
        yield


def shades(count: int) -> np.ndarray:
    """Colours for ordered levels, light to dark; distinct in grey and for the colour-blind."""
    import matplotlib

    return matplotlib.colormaps["viridis_r"](np.linspace(0.12, 0.95, max(count, 2)))[:count]


def panels(
    count: int, columns: int, *, height: float = 2.2, sharex: bool = True, sharey: bool = True
) -> tuple[Figure, list[Axes], int]:
    """A figure of equal panels, with common axes if shared; and the number of columns."""
    from matplotlib.figure import Figure

    columns = 2 if count == 4 else min(columns, count)
    rows = -(-count // columns)
    figure = Figure(figsize=(WIDTH, height * rows + 0.5), layout="constrained")
    axes = figure.subplots(rows, columns, sharex=sharex, sharey=sharey, squeeze=False)
    for panel in axes.flat:
        panel.tick_params(labelbottom=True)
    for empty in axes.flat[count:]:
        empty.set_visible(False)
    return figure, list(axes.flat[:count]), columns


def legend_above(
    figure: Figure, entries: Axes | tuple[Sequence[Any], Sequence[str]], title: str, columns: int = 6
) -> None:
    """Draw a legend above the panels over the whole width, with as many rows as needed."""
    handles, labels = entries if isinstance(entries, tuple) else entries.get_legend_handles_labels()
    figure.legend(
        handles,
        labels,
        title=title,
        title_fontsize=SMALL,
        alignment="left",
        loc="outside upper left",
        ncols=min(columns, len(labels)),
        columnspacing=1.2,
        handletextpad=0.4,
    )


def normalised_axis(axes: Axes, most: float) -> None:
    """A second axis on the right: the values over the largest one of the study."""
    right = axes.secondary_yaxis("right", functions=(lambda y: np.divide(y, most), lambda y: np.multiply(y, most)))
    right.spines["right"].set_visible(True)
    right.set_ylabel("share of largest (-)")


def in_words(name: str) -> str:
    """The words of a column, without its unit.

    >>> in_words("face_width_mm")
    'face width'
    """
    return without_unit(name).replace("_", " ")


def labelled(name: str) -> str:
    """The words of a column with its unit, for an axis.

    >>> labelled("face_width_mm"), labelled("boundary_friction")
    ('face width (mm)', 'boundary friction (-)')
    """
    return f"{in_words(name)} ({unit_of(name) or '-'})"


FONTS = "'DejaVu Sans', Verdana, 'Bitstream Vera Sans', sans-serif"
"""Fonts of equal width, so that text still fits if the first is missing."""


def as_svg(figure: Figure) -> str:
    """The figure as an `svg` element, without prologue; the same input gives the same text."""
    text = io.StringIO()
    with styled():
        figure.savefig(text, format="svg", metadata={"Date": None, "Creator": OWNER})
    svg = text.getvalue()
    return svg[svg.index("<svg") :].replace("'DejaVu Sans'", FONTS)


OWNER = "mixedlub"
"""Creator in the metadata of a figure."""
PNG_DPI = 300
"""Smallest resolution (dots per inch) required by journals for line art in colour."""
_MADE_BY = {"pdf": {"Creator": OWNER, "CreationDate": None}, "png": {"Software": OWNER}}


def save(figure: Figure, path: Path) -> None:
    """Write a figure as SVG, or for print as PDF or PNG, by the suffix of its name."""
    if path.suffix == ".svg":
        path.write_text(as_svg(figure), encoding="utf-8")
        return
    with styled():
        figure.savefig(path, dpi=PNG_DPI, metadata=_MADE_BY[path.suffix[1:]])
