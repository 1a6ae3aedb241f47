"""Figures of labelled arrays and tables that the functions of the package return."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.report.style import panels, shades, styled
from mixedlub.schema.units import unit_of, without_unit
from profiles.errors import InputError, nearest

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from mixedlub.api.fit import LawFit

FIRST = ("power_loss_W", "friction", "total_loss_W", "line_load_N_mm", "load_share")
"""Variables that are drawn where none is named."""
MOST_PANELS = 6
"""Judgement: most panels that are read together."""
NAMED_LINES = 8
"""Judgement: most lines with an entry each in a legend; of more, the first and last are named."""
HOLDS = "valid"
"""Validity of a value that is drawn with a full mark."""


def of_dataset(data: xr.Dataset, quantity: str | None, over: str | None) -> Figure:
    """Figure of a variable over one dimension: a line for each level of a second one, a panel for each of a third."""
    numeric = [str(name) for name, values in data.data_vars.items() if values.dtype.kind in "fiub"]
    drawn = _chosen("quantity", quantity, numeric, next((n for n in FIRST if n in numeric), None))
    values = data[drawn]
    if values.ndim == 0:
        raise InputError("has a single value; give lists of conditions", where="plot: quantity", value=drawn)
    numbers = [str(n) for n in values.dims if data[n].dtype.kind in "fiu"]
    longest = max(numbers, key=lambda name: data.sizes[name], default=None)
    across = _chosen("over", over, numbers, longest)
    rest = sorted((str(n) for n in values.dims if n != across), key=lambda name: -data.sizes[name])
    if len(rest) > 2:
        raise InputError(f"choose one level, as .sel({rest[-1]}=...)", where="plot: results", value=drawn)
    line, panel = (*rest, None, None)[:2]
    levels = [None] if panel is None else list(data[panel].values[:MOST_PANELS])
    with styled():
        figure, axes, columns = panels(len(levels), 3)
        for place, (one, level) in enumerate(zip(axes, levels, strict=True)):
            part = data if panel is None else data.isel({panel: place})
            _lines(one, part.sortby(across), drawn, across, line)
            if panel is not None:
                one.set_title(_level(panel, level), loc="left")
            one.set_xlabel(_label(data, across))
            if place % columns == 0:
                one.set_ylabel(_label(data, drawn))
        if line is not None:
            axes[0].legend(title=_label(data, line))
    return figure


def _lines(axes: Axes, data: xr.Dataset, drawn: str, across: str, line: str | None) -> None:
    """Draw a line for each level of a dimension; hollow marks are outside the range of the model."""
    count = 1 if line is None else data.sizes[line]
    named = range(count) if count <= NAMED_LINES else (0, count - 1)
    for index, colour in zip(range(count), shades(count), strict=True):
        part = data if line is None else data.isel({line: index})
        name = _level(None, part[line].item()) if line is not None and index in named else "_"
        x, y = part[across].values, part[drawn].values
        axes.plot(x, y, color=colour, label=name)
        if "validity" in part and part["validity"].dims == part[drawn].dims:
            holds = part["validity"].values == HOLDS
            axes.plot(x[holds], y[holds], "o", color=colour)
            axes.plot(x[~holds], y[~holds], "o", color=colour, mfc="white")


def of_table(table: pd.DataFrame, quantity: str | None, over: str | None) -> Figure:
    """Figure of a column over another, as points; without names the first two columns that vary."""
    numeric = [str(n) for n in table.columns if table[n].dtype.kind in "fiu" and n != "run"]
    drawn = _chosen("quantity", quantity, numeric, next(iter(numeric), None))
    others = [n for n in numeric if n != drawn]
    varied = [n for n in others if table[n].nunique() > 1]
    across = _chosen("over", over, ["run", *others] if "run" in table else others, next(iter(varied or others), None))
    with styled():
        figure, (axes, *_), _ = panels(1, 1)
        holds = (table["validity"] == HOLDS).to_numpy() if "validity" in table else np.ones(len(table), bool)
        x, y = table[across].to_numpy(), table[drawn].to_numpy()
        axes.plot(x[holds], y[holds], "o", color="C0")
        axes.plot(x[~holds], y[~holds], "o", color="C0", mfc="white")
        axes.set_xlabel(_label(table, across))
        axes.set_ylabel(_label(table, drawn))
    return figure


def of_fit(fit: LawFit, over: str | None) -> Figure:
    """Figure of readings and of the best laws over a condition; the laws are drawn at the readings alone."""
    read = fit.ranking.readings
    names = [name for name, values in read.columns.items() if np.unique(values).size > 1]
    across = _chosen("over", over, names, next(iter(names), None))
    x = np.asarray(read.columns[across], dtype=float)
    order = np.argsort(x, kind="stable")
    with styled():
        figure, (axes, *_), _ = panels(1, 1, height=3.0)
        axes.plot(x, read.values * read.factor, "o", color="0.3", label="readings")
        for law, colour in zip(fit.tied, shades(len(fit.tied)), strict=True):
            own = fit.readings[fit.readings["law"] == law]
            fitted = own[f"fitted_{read.column}"].to_numpy()
            axes.plot(x[order], fitted[order], color=colour, label=law)
        axes.set_xlabel(_label(None, across))
        axes.set_ylabel(_label(None, read.column))
        axes.legend()
    return figure


def _chosen(key: str, name: str | None, known: Sequence[str], default: str | None) -> str:
    """A name that can be drawn, by default the given one."""
    if name is None and default is None:
        raise InputError("nothing in it can be drawn", where=f"plot: {key}")
    if name is not None and name not in known:
        raise InputError(f"cannot be drawn; {nearest(name, known)}", where=f"plot: {key}", value=name)
    return str(default if name is None else name)


def _label(data: Any, name: str) -> str:
    """Words and unit of a variable: its attributes, else its name."""
    attributes = data[name].attrs if hasattr(data, "data_vars") and name in data.variables else {}
    unit = attributes.get("units", unit_of(name))
    words = without_unit(name).replace("_", " ")
    return f"{words} ({unit})" if unit and unit != "-" else words


def _level(name: str | None, value: Any) -> str:
    """A level in words, with the name and unit of its dimension where given."""
    shown = f"{value:g}" if isinstance(value, (int, float, np.number)) else str(value)
    return shown if name is None else f"{without_unit(name).replace('_', ' ')} {shown} {unit_of(name) or ''}".rstrip()
