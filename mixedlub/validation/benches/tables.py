"""Tables of the benches as text in the format of a data logger."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

WHOLE = ("run", "tooth", "revolution")
"""Columns of whole numbers."""


def as_csv(columns: Mapping[str, Sequence[float] | Sequence[str]], digits: int = 7) -> str:
    """Comma-separated text with a header line."""
    rows = [",".join(columns)]
    for cells in zip(*columns.values(), strict=True):
        named = zip(columns, cells, strict=True)
        shown = [c if isinstance(c, str) else f"{c:.0f}" if n in WHOLE else f"{c:.{digits}g}" for n, c in named]
        rows.append(",".join(shown))
    return "\n".join(rows) + "\n"
