"""The score tables of the blind batteries, read from the text that `mixedlub prove` writes."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from markdown_tables import table

FOLDER = Path(__file__).parents[2] / "examples/proof"
TOOL = "mixedlub diagnose"

_ROW = re.compile(
    r"^(?P<name>.*?)\s{2,}(?P<value>-?[\d.]+(?:e[-+]?\d+)?|-)\s*(?:\[(?P<low>[^,]+), (?P<high>[^\]]+)\])?"
    r"\s+(?P<n>\d+)\s*(?P<goal>.*?)\s*(?P<met>NOT met|met)?$"
)
_GAP = re.compile(r"\s{2,}")


@dataclass(frozen=True)
class Row:
    """One figure: value, 90 % interval, number of cases, goal and whether it is met (None: no goal)."""

    name: str
    value: str
    interval: str
    n: int
    goal: str
    met: bool | None

    @property
    def part(self) -> bool:
        """Whether the row is a part of the row above it."""
        return self.name.startswith(" ")


def scores(text: str) -> dict[str, dict[str, Row]]:
    """By tool, its rows by name; a part of a row goes by its own name.

    >>> text = "mixedlub diagnose\\nfigure  value  90 %  n  goal\\nworst case  53   240  <= 30  NOT met\\n"
    >>> scores(text)["mixedlub diagnose"]["worst case"]
    Row(name='worst case', value='53', interval='', n=240, goal='<= 30', met=False)
    """
    found: dict[str, dict[str, Row]] = {}
    for block in text.split("\n\n"):
        tool, _, rest = block.strip("\n").partition("\n")
        if not rest.startswith("figure"):
            continue
        rows = [_row(line) for line in rest.splitlines()[1:]]
        found[tool] = {row.name.strip(): row for row in rows}
    return found


def _row(line: str) -> Row:
    cells = _ROW.match(line)
    if cells is None:
        raise ValueError(f"no row of a score table: {line!r}")
    interval = f"{cells['low']} to {cells['high']}" if cells["low"] else ""
    met = None if cells["met"] is None else cells["met"] == "met"
    return Row(cells["name"], cells["value"], interval, int(cells["n"]), cells["goal"], met)


def all_rows(rows: dict[str, Row]) -> str:
    """Markdown table of every row of one tool."""
    lines = ["| figure | value | 90 % interval | cases | goal | |", "|---|---|---|---|---|---|"]
    for row in rows.values():
        name = f"&emsp;{row.name.strip()}" if row.part else row.name
        met = {None: "", True: "met", False: "**missed**"}[row.met]
        lines.append(f"| {name} | {row.value} | {row.interval} | {row.n} | {_plain(row.goal)} | {met} |")
    return "\n".join(lines)


def missed(rows: dict[str, Row]) -> str:
    """Sentences on the goals that were missed."""
    names = [f"{row.name.strip()} ({row.value}, goal {_plain(row.goal)})" for row in rows.values() if row.met is False]
    if not names:
        return "No goal was missed."
    return f"Goals missed: {len(names)}. " + "; ".join(names) + "."


def compared(tools: dict[str, dict[str, Row]], names: tuple[str, ...]) -> str:
    """Markdown table of some rows, a column a tool."""
    return table(("figure", *tools), ((name, *(rows[name].value for rows in tools.values())) for name in names))


def counts(text: str, title: str = "by kind") -> str:
    """Markdown table of the counts a kind of rig, or a flaw, from the block that starts with the title."""
    (block,) = (b for b in text.split("\n\n") if b.startswith(title))
    head, *rows = (_GAP.split(line.strip()) for line in block.splitlines())
    return table(head, rows)


def by_form(texts: Iterable[str]) -> dict[tuple[str, str], tuple[int, ...]]:
    """Right, right or tied, and all cases by effect and source, summed over the blocks that start with ``by form``.

    >>> text = "by form  source  right  tied  identifiable  cases\\nchurning  Boness 1989  1  2  2  3\\n"
    >>> by_form([text, text])
    {('churning', 'Boness 1989'): (2, 4, 6)}
    """
    found: dict[tuple[str, str], tuple[int, ...]] = {}
    blocks = [block for text in texts for block in text.split("\n\n") if block.startswith("by form")]
    for block in blocks:
        for row in (_GAP.split(line.strip()) for line in block.splitlines()[1:]):
            key, more = (row[0], row[1]), (int(row[2]), int(row[3]), int(row[5]))
            found[key] = tuple(map(sum, zip(found.get(key, (0, 0, 0)), more, strict=True)))
    return found


def _plain(goal: str) -> str:
    return goal.replace(">=", "≥").replace("<=", "≤").strip()
