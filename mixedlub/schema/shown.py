"""HTML of summaries for notebooks: short tables and lists, with every text escaped."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

import numpy as np

from mixedlub.schema.findings import listed

WIDEST = 80
"""Judgement: longest text of a cell that fits a notebook."""


def table_html(title: str, rows: Iterable[Sequence[Any]], heads: Sequence[str] = ()) -> str:
    """A table with a title; texts are escaped and long ones cut.

    >>> table_html("a<b", [["x", 0.5]], ["name", "value"])
    '<table><caption>a&lt;b</caption><tr><th>name</th><th>value</th></tr><tr><td>x</td><td>0.5</td></tr></table>'
    """
    head = "".join(f"<th>{_text(one)}</th>" for one in heads)
    body = "".join(f"<tr>{''.join(f'<td>{_text(cell)}</td>' for cell in row)}</tr>" for row in rows)
    return f"<table><caption>{_text(title)}</caption>{f'<tr>{head}</tr>' if head else ''}{body}</table>"


def lines_html(summary: str) -> str:
    """A summary of lines as a title and a list.

    >>> lines_html("Case 'a&b':\\n  conditions: none")
    '<div><b>Case &#x27;a&amp;b&#x27;:</b><ul><li>conditions: none</li></ul></div>'
    """
    first, *others = (escape(line.strip()) for line in summary.splitlines())
    return f"<div><b>{first}</b><ul>{''.join(f'<li>{line}</li>' for line in others)}</ul></div>"


class Summarised:
    """Object with a repr of several lines, which a notebook shows as a title and a list."""

    def _repr_html_(self) -> str:
        return lines_html(repr(self))


def _text(value: Any) -> str:
    """Short escaped text of a value."""
    if isinstance(value, float):
        text = f"{value:.6g}"
    elif isinstance(value, tuple | list):
        text = ", ".join(f"{one:.6g}" if isinstance(one, float) else str(one) for one in value)
    else:
        text = str(value)
    return escape(text if len(text) <= WIDEST else f"{text[:WIDEST]}…")


def span(name: str, values: np.ndarray) -> str:
    """Summary of a column: lowest and highest number, or names.

    >>> span("speed_rpm", np.array([500.0, 3000.0])), span("torque_Nm", np.array([50])), span("setup", np.array(["a"]))
    ('speed_rpm 500 to 3000', 'torque_Nm 50', 'setup a')
    """
    if values.dtype.kind not in "fiu":
        return f"{name} {listed(sorted(set(values.tolist())))}"
    low, high = (f"{end:.4g}" for end in (np.nanmin(values), np.nanmax(values)))
    return f"{name} {low}" if low == high else f"{name} {low} to {high}"
