"""Figure of a recording before it is diagnosed: the reading over a column."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.report.style import WIDTH, styled
from mixedlub.schema.units import unit_of, without_unit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_POINTS = 4000
"""Largest number of points drawn; of more, an even selection."""
FIRST = "time_s"


def abscissae(columns: Mapping[str, np.ndarray], quantity: str) -> list[str]:
    """Columns over which a reading can be drawn: time, then the others by their number of different values.

    >>> abscissae({"load_N": np.array([1.0, 1, 2]), "speed_rpm": np.array([1.0, 2, 3]), "x": np.ones(3)}, "x")
    ['speed_rpm', 'load_N']
    """
    numeric = [n for n, v in columns.items() if np.asarray(v).dtype.kind in "fiu" and n not in (quantity, "run")]
    counts = {name: len(np.unique(np.asarray(columns[name]))) for name in numeric if not name.endswith("_sd")}
    return sorted(counts, key=lambda name: (name != FIRST, -counts[name]))


def readings_figure(columns: Mapping[str, np.ndarray], quantity: str, over: str = "") -> Figure:
    """The reading over a column, by default the first of `abscissae`; without any, over its row."""
    from matplotlib.figure import Figure

    values = np.asarray(columns[quantity], dtype=float)
    known = abscissae(columns, quantity)
    over = over if over in known else next(iter(known), "")
    at = np.asarray(columns[over], dtype=float) if over else np.arange(1, values.size + 1)
    shown = np.unique(np.linspace(0, values.size - 1, min(values.size, MOST_POINTS)).astype(int))
    with styled():
        figure = Figure(figsize=(WIDTH, 3.0), layout="constrained")
        axes: Any = figure.subplots()
        size = 3.5 if shown.size < 400 else 1.6
        axes.plot(at[shown], values[shown], "o", ms=size, mew=0, alpha=0.75, color="#21618c")
        axes.set_xlabel(_label(over) if over else "row")
        axes.set_ylabel(_label(quantity))
    return figure


def _label(column: str) -> str:
    """Name of a column with its unit, for an axis."""
    unit = unit_of(column)
    words = without_unit(column).replace("_", " ")
    return f"{words} ({unit})" if unit else words
