"""The rows of the interactive chart: all of a small study, evenly spread levels of a large one."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from math import prod
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

import numpy as np

from mixedlub.chain.ranges import as_words
from mixedlub.report.plots import some, spread
from mixedlub.study.columns import VALIDITY, every_column
from mixedlub.study.results import LEVELS, Results

if TYPE_CHECKING:
    import pandas as pd

MOST_ROWS = 6_000
"""Largest number of rows of the chart, which browsers redraw within about a second."""
MOST_BYTES = 2_500_000
"""Largest text of these rows, in the chart and again as a file: a page has up to 7 MB besides, and at most 10."""
SHARES = (4, 1, 1, 1)
"""Relative numbers of levels kept for pairings, oil temperatures, torques and speeds."""
DIGITS = 5
SIDES = ("pinion_surface", "gear_surface")
_PLAIN = ",.:;/() -+_|"
"""Unescaped characters of a data address besides letters and digits."""


@dataclass(frozen=True, eq=False)
class ChartRows:
    """Rows of the table of a study, their text, and a sentence on their choice."""

    table: pd.DataFrame
    text: str
    choice: str

    @property
    def address(self) -> str:
        """The rows as a data link."""
        return f"data:text/csv;charset=utf-8,{quote(self.text, safe=_PLAIN)}"


def chart_rows(results: Results, most: int = MOST_ROWS, most_bytes: int = MOST_BYTES) -> ChartRows:
    """Rows of the chart: at most ``most``, fewer if many columns make their text too long."""
    while True:
        places = kept(results, most)
        table = _table(results, places)
        text = table.to_csv(index=False, lineterminator="\n")
        rows = ChartRows(table, text, _choice(results, places))
        size = len(text.encode()) + len(rows.address)
        if size <= most_bytes or len(table) == 1:
            return rows
        most = max(1, int(0.95 * len(table) * most_bytes / size))


def kept(results: Results, most: int) -> tuple[np.ndarray, ...]:
    """Indices of pairings by roughness, then of oil temperatures, torques and speeds; at most ``most`` conditions.

    A condition keeps all its levels, or the same number as every other thinned condition. Pairings, at least four times
    as many, take the remaining rows.
    """
    shape, levels = results.study.plan.shape, results.study.file.conditions

    def limits(count: int) -> tuple[int, ...]:
        return tuple(min(n, share * count) for n, share in zip(shape, SHARES, strict=True))

    count = max(1, bisect_right(range(1, max(shape) + 1), most, key=lambda count: prod(limits(count))))
    others = limits(count)[1:]
    roughness = results["composite_roughness"][:, 0, 0, 0]
    pairings = np.argsort(roughness, kind="stable")[some(roughness.size, max(1, most // prod(others)))]
    return (pairings, *(spread(getattr(levels, name), n) for name, n in zip(LEVELS, others, strict=True)))


def _table(results: Results, places: Sequence[np.ndarray]) -> pd.DataFrame:
    import pandas as pd

    levels = results.study.file.conditions
    at = tuple(grid.ravel() for grid in np.meshgrid(*places, indexing="ij"))
    flags, words = as_words(results.flags, results.study.plan.shape)
    columns: dict[str, Any] = {
        side: [results.study.pairings[i][n] for i in at[0].tolist()] for n, side in enumerate(SIDES)
    }
    columns |= {name: np.array(getattr(levels, name))[i] for name, i in zip(LEVELS, at[1:], strict=True)}
    columns |= {c.name: rounded(c.of(results[c.output][at])) for c in results.columns}
    columns[VALIDITY] = [words[i] for i in flags[at].tolist()]
    order = (c.name for c in every_column(results.study.plan.losing))
    return pd.DataFrame({name: columns[name] for name in order if name in columns})


def rounded(values: np.ndarray) -> np.ndarray:
    """Values with five significant digits.

    >>> rounded(np.array([123.45678, 1.2345678e-7])).tolist()
    [123.46, 1.2346e-07]
    """
    return np.array([float(f"{v:.{DIGITS}g}") for v in values.tolist()])


def _choice(results: Results, places: Sequence[np.ndarray]) -> str:
    """Number and choice of the conditions in the chart, as text."""
    counts = results.study.plan.shape
    if prod(counts) == prod(len(p) for p in places):
        return f"The chart has every condition ({results.study.conditions}), with numbers of {DIGITS} digits."
    names = ("pairings in the order of composite roughness", "oil temperatures", "torques", "speeds")
    thinned = [f"{len(p)} of {n} {name}" for p, n, name in zip(places, counts, names, strict=True) if len(p) < n]
    return (
        f"The chart has {prod(len(p) for p in places)} of the {results.study.conditions} conditions, so that the page "
        f"stays small: {', '.join(thinned)}, about evenly spaced, first and last included. "
        f"Numbers have {DIGITS} digits. "
        "All conditions with all digits are in results.csv and results.parquet beside the page."
    )
