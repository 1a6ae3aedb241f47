"""Which mark of a file stands before the decimals: decided by what its numbers prove, and by nothing else."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from profiles.errors import InputError

Line = tuple[int, list[str]]
"""Number of a line in the file, and its cells."""
KEY = "import.decimal"
MARKS = (",", ".")
OTHER = {",": ".", ".": ","}

GROUPED = {mark: re.compile(rf"[+-]?[1-9]\d{{0,2}}(?:\{mark}\d{{3}})+") for mark in MARKS}
WITH_BOTH = {mark: re.compile(rf"[+-]?[1-9]\d{{0,2}}(?:\{OTHER[mark]}\d{{3}})+\{mark}\d*") for mark in MARKS}
PLAIN = re.compile(r"[+-]?\d+(?:[eE][+-]?\d+)?")
WITH_ONE = {mark: re.compile(rf"[+-]?(?:\d+\{mark}\d*|\{mark}\d+)(?:[eE][+-]?\d+)?") for mark in MARKS}


def proves(cell: str) -> str | None:
    """The mark that stands before the decimals of a number; None where it could also part thousands, or is absent.

    >>> [proves(cell) for cell in ("17,50", "0.125", "1.234,5", "1,234,567", "0,125")]
    [',', '.', ',', '.', ',']
    >>> [proves(cell) for cell in ("2,000", "1.234", "40", "ground", "01.02.2020")]
    [None, None, None, None, None]
    """
    for mark in MARKS:
        grouped = GROUPED[OTHER[mark]].fullmatch(cell)
        if WITH_BOTH[mark].fullmatch(cell) or (grouped and cell.count(OTHER[mark]) > 1):
            return mark
        if WITH_ONE[mark].fullmatch(cell) and not GROUPED[mark].fullmatch(cell):
            return mark
    return None


def with_points(rows: Sequence[Line], name: str, told: str | None = None) -> list[Line]:
    """Rows with numbers as they are read here: a point before the decimals, nothing between thousands.

    ``told`` is the mark where the file's reader was told it. Rows of the usual number of cells are asked first, as
    those around a table may be written by someone else, and of them the columns of numbers.
    """
    lengths = [len(row) for _, row in rows]
    usual = max(set(lengths), key=lengths.count)
    table = [line for line in rows if len(line[1]) == usual]
    numeric = [_holds_numbers([row[i] for _, row in table]) for i in range(usual)]
    inner = [(number, [cell for cell, so in zip(row, numeric, strict=True) if so]) for number, row in table]
    decimal = told or _decided(inner, [line for line in rows if len(line[1]) != usual], name)
    for number, cell in _cells(inner):
        if WITH_ONE[OTHER[decimal]].fullmatch(cell) and not GROUPED[OTHER[decimal]].fullmatch(cell):
            rule = f"is no number where decimals have {decimal!r} before them; {KEY} says otherwise"
            raise InputError(rule, where=f"{name}: line {number}", value=cell)
    every = [True] * max(lengths)
    kept = {len(row): numeric if len(row) == usual else every for _, row in rows}
    return [
        (number, [_read(cell, decimal) if so else cell for cell, so in zip(row, kept[len(row)], strict=False)])
        for number, row in rows
    ]


def _holds_numbers(cells: Sequence[str]) -> bool:
    """Whether a column is one of numbers: most of its cells, beside the header and gaps; labels prove no mark."""
    return 2 * sum(is_written_number(cell) for cell in cells) >= sum(bool(cell) for cell in cells) - 1


def is_written_number(cell: str) -> bool:
    """Whether a cell is a number under one mark or the other."""
    forms = (form for mark in MARKS for form in (GROUPED[mark], WITH_BOTH[mark], WITH_ONE[mark]))
    return bool(PLAIN.fullmatch(cell)) or any(form.fullmatch(cell) for form in forms)


def _decided(inner: Sequence[Line], outer: Sequence[Line], name: str) -> str:
    for lines in (inner, outer):
        found = {mark: place for place in reversed(list(_cells(lines))) if (mark := proves(place[1]))}
        if len(found) == 2:
            (one, first), (other, second) = ((f"line {found[m][0]}", found[m][1]) for m in MARKS)
            rule = f"decimals have a comma here and a point in {other} ({second!r}); write all numbers in one way"
            raise InputError(rule, where=f"{name}: {one}", value=first)
        if found:
            return next(iter(found))
    open_ones = [place for place in _cells(inner) if GROUPED[","].fullmatch(place[1])]
    if open_ones:
        number, cell = open_ones[0]
        whole, parted = cell.replace(",", ""), cell.replace(",", ".")
        rule = (
            f"could be {whole} or {parted}, and no other number of the file tells; "
            f"say --set '{KEY}=\".\"' for {whole}, --set '{KEY}=\",\"' for {parted}"
        )
        raise InputError(rule, where=f"{name}: line {number}", value=cell)
    return "."


def _cells(lines: Iterable[Line]) -> Iterable[tuple[int, str]]:
    return ((number, cell) for number, row in lines for cell in row)


def _read(cell: str, decimal: str) -> str:
    thousands = OTHER[decimal]
    if GROUPED[thousands].fullmatch(cell) or WITH_BOTH[decimal].fullmatch(cell):
        return cell.replace(thousands, "").replace(decimal, ".")
    return cell.replace(decimal, ".") if WITH_ONE[decimal].fullmatch(cell) else cell
