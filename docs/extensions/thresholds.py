"""Tables of the numbers that decide an outcome, from the source: name, value, kind of the reason, reason."""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

from markdown_tables import table

ROOT = Path(__file__).parents[2] / "mixedlub"
SETTINGS = ("inference", "discrepancy", "search", "assessment", "report")
"""Modules of the settings of the diagnosis, in the order of its rooms."""
BELOW = ("recording", "data_checks", "kinds")
"""Rooms that the diagnosis uses, with constants of their own."""
ORDER = ("Definition", "Source", "Measured", "Grid", "Cost limit", "Judgement")
REASON = re.compile(rf"({'|'.join(ORDER)})[.:]? (.*)", re.DOTALL)


class Row(NamedTuple):
    """One constant, or several with one reason, below a heading."""

    heading: str
    name: str
    value: str
    kind: str
    reason: str


def rows(source: str) -> Iterator[Row]:
    r"""The constants of a module whose docstring has a kind, in order.

    >>> list(rows('# Grids\nSIZES = (1.0,\n    4.0)\n"\""Grid. Just visible, and plain."\""\n'))
    [Row(heading='Grids', name='SIZES', value='(1.0, 4.0)', kind='Grid', reason='Just visible, and plain.')]
    >>> [(row.kind, row.reason) for row in rows('DRAWS = 3\n"\""Measured (a.py): three do."\""\n')]
    [('Measured', '(a.py): three do.')]
    """
    lines = source.splitlines()
    body = ast.parse(source).body
    for node, below in pairwise(body):
        if not (isinstance(node, ast.Assign) and isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant)):
            continue
        found = REASON.match(str(below.value.value))
        if found:
            value = " ".join((ast.get_source_segment(source, node.value) or "").split())
            above = (line[2:] for line in lines[node.lineno - 1 :: -1] if line.startswith("# "))
            name = (ast.get_source_segment(source, node.targets[0]) or "").strip("()")
            yield Row(next(above, ""), name, value, found[1], " ".join(found[2].split()))


def tables() -> str:
    """All tables in Markdown, after the number of constants of each kind."""
    parts, count = [], Counter()
    for module in SETTINGS:
        parts.append(f"## {module.capitalize()}")
        found = list(rows((ROOT / f"diagnosis/settings/{module}.py").read_text(encoding="utf-8")))
        for heading in dict.fromkeys(row.heading for row in found):
            parts += [f"### {heading}", _table([row for row in found if row.heading == heading])]
        count.update(row.kind for row in found)
    parts.append("## Rooms that the diagnosis uses")
    for path in (path for room in BELOW for path in sorted((ROOT / room).rglob("*.py"))):
        found = list(rows(path.read_text(encoding="utf-8")))
        if found:
            parts += [f"### {path.relative_to(ROOT).with_suffix('').as_posix()}", _table(found)]
            count.update(row.kind for row in found)
    head = "| kind | constants |\n|---|---|\n" + "\n".join(f"| {kind} | {count[kind]} |" for kind in ORDER)
    return "\n\n".join([head, *parts])


def _table(found: list[Row]) -> str:
    cells = ((f"`{row.name}`", f"`{row.value}`", row.kind.lower(), row.reason) for row in found)
    return table(("name", "value", "kind", "reason"), cells)
