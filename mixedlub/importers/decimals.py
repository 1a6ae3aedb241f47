"""Decimal marks, comma or point, from the numbers of a file."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Sequence, Set

from profiles.errors import InputError

Line = tuple[int, list[str]]
"""Line number in the file, and cells."""
Place = tuple[int, str]
"""Line number in the file, and a cell."""
DECIMAL = "import.decimal"
MARKS = (",", ".")
OTHER = {",": ".", ".": ","}

GROUPED = {mark: re.compile(rf"[+-]?[1-9]\d{{0,2}}(?:\{mark}\d{{3}})+") for mark in MARKS}
WITH_BOTH = {mark: re.compile(rf"[+-]?[1-9]\d{{0,2}}(?:\{OTHER[mark]}\d{{3}})+\{mark}\d*") for mark in MARKS}
PLAIN = re.compile(r"[+-]?\d+(?:[eE][+-]?\d+)?")
WITH_ONE = {mark: re.compile(rf"[+-]?(?:\d+\{mark}\d*|\{mark}\d+)(?:[eE][+-]?\d+)?") for mark in MARKS}
NUMBER = re.compile(
    "|".join(form.pattern for forms in (GROUPED, WITH_BOTH, WITH_ONE) for form in forms.values()) + f"|{PLAIN.pattern}"
)
SPACED = re.compile(r"[+-]?[1-9]\d{0,2}(?:[ \u00a0\u2009\u202f'\u2019]\d{3})+(?:[.,]\d*)?")
"""Number with a blank or an apostrophe as thousands separator."""
GAP = re.compile(r"[ \u00a0\u2009\u202f'\u2019]")
DIGITS = str.maketrans("23456789", "11111111")


def proves(cell: str) -> str | None:
    """Decimal mark of a number; None if it is absent or could be a thousands separator.

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


def with_points(rows: Sequence[Line], name: str, given: str | None = None) -> tuple[list[Line], list[str]]:
    """Rows with decimal points and without thousands separators, and notes on ambiguous numbers.

    ``given``: decimal mark from an answer. The numeric columns of the most common row length decide first, since lines
    around a table may come from another program.
    """
    width = common_length([row for _, row in rows])
    table = [line for line in rows if len(line[1]) == width]
    outside_rows = [line for line in rows if len(line[1]) != width]
    columns = [list(cells) for cells in zip(*(row for _, row in table), strict=True)]
    forms = [forms_of(cells) for cells in columns]
    closed = []
    for i, column in enumerate(columns):
        if any(SPACED.fullmatch(form) for form in set(forms[i])):
            spaced = [row for row, cell in enumerate(column) if SPACED.fullmatch(cell)]
            closed.append((table[spaced[0]][0], column[spaced[0]]))
            columns[i] = [GAP.sub("", cell) if SPACED.fullmatch(cell) else cell for cell in column]
            forms[i] = forms_of(columns[i])
    numeric = [i for i, column in enumerate(forms) if _holds_numbers(column)]

    def inner() -> Iterator[Place]:
        return ((number, row[i]) for number, row in table for i in numeric)

    written = set().union(*(forms[i] for i in numeric))
    decimal = given or _decided(written, inner, outside_rows, name)
    thousands = OTHER[decimal]
    if any(_is_other(form, thousands) for form in written):
        number, cell = next(place for place in inner() if _is_other(place[1], thousands))
        rule = f"is no number with {decimal!r} as decimal mark; {DECIMAL} names another"
        raise InputError(rule, where=f"{name}: line {number}", value=cell)
    for i in numeric:
        marked = [form for form in set(forms[i]) if "," in form or thousands in form]
        if marked and all(WITH_ONE[decimal].fullmatch(form) for form in marked):
            columns[i] = "\n".join(columns[i]).replace(decimal, ".").split("\n")
        elif marked:
            columns[i] = [_read(cell, decimal) for cell in columns[i]]
    inside = zip((number for number, _ in table), map(list, zip(*columns, strict=True)), strict=True)
    outside = ((number, [_read(cell, decimal) for cell in row]) for number, row in outside_rows)
    notes = [] if given else _thousands_taken(written, inner, decimal)
    notes += [f"line {number}: {cell!r} is read as {_read(GAP.sub('', cell), decimal)}" for number, cell in closed]
    return sorted([*inside, *outside], key=lambda line: line[0]), notes


def forms_of(cells: Sequence[str]) -> list[str]:
    """Cells with 1 in place of every nonzero digit, so that a long column has few distinct forms to read."""
    return "\n".join(cells).translate(DIGITS).split("\n")


def common_length(rows: Sequence[Sequence[str]]) -> int:
    """Most common number of cells; the first of equally common numbers."""
    return max(Counter(map(len, rows)).items(), key=lambda item: item[1], default=(0, 0))[0]


def _holds_numbers(forms: Sequence[str]) -> bool:
    """Whether most cells of a column, besides header and gaps, are numbers; labels prove no decimal mark."""
    counts = Counter(forms)
    written = sum(number for form, number in counts.items() if is_written_number(form))
    return 2 * written >= sum(number for form, number in counts.items() if form) - 1


def is_written_number(cell: str) -> bool:
    """Whether a cell is a number with either decimal mark."""
    return NUMBER.fullmatch(cell) is not None


def _is_other(cell: str, mark: str) -> bool:
    """Whether a cell is a number only with this decimal mark."""
    return WITH_BOTH[mark].fullmatch(cell) is not None or (
        WITH_ONE[mark].fullmatch(cell) is not None and not GROUPED[mark].fullmatch(cell)
    )


def _decided(written: Set[str], inner: Callable[[], Iterator[Place]], outside: Sequence[Line], name: str) -> str:
    """Decimal mark proven by the numbers of the table, else of the lines around it; an error if ambiguous."""
    around = [(number, cell) for number, row in outside for cell in row]
    for forms, places in ((written, inner), ({cell for _, cell in around}, lambda: iter(around))):
        proven = {proves(form) for form in forms} - {None}
        if len(proven) == 2:
            (one, first), (other, second) = (next(p for p in places() if proves(p[1]) == mark) for mark in MARKS)
            rule = f"has a decimal comma, line {other} has a decimal point ({second!r}); write all numbers in one way"
            raise InputError(rule, where=f"{name}: line {one}", value=first)
        if proven:
            return str(proven.pop())
    if any(GROUPED[","].fullmatch(form) for form in written):
        number, cell = next(place for place in inner() if GROUPED[","].fullmatch(place[1]))
        whole, parted = cell.replace(",", ""), cell.replace(",", ".")
        rule = (
            f"could be {whole} or {parted}, and no other number of the file decides; "
            f"--set '{DECIMAL}=\".\"' for {whole}, --set '{DECIMAL}=\",\"' for {parted}"
        )
        raise InputError(rule, where=f"{name}: line {number}", value=cell)
    return "."


def _thousands_taken(written: Set[str], inner: Callable[[], Iterator[Place]], decimal: str) -> list[str]:
    """Note on a mark read as thousands separator only because of other numbers."""
    ambiguous = GROUPED[OTHER[decimal]]
    if not any(ambiguous.fullmatch(form) and proves(form) is None for form in written):
        return []
    number, cell = next(p for p in inner() if ambiguous.fullmatch(p[1]) and proves(p[1]) is None)
    other, proof = next(((n, c) for n, c in inner() if proves(c) == decimal), (0, ""))
    why = f"in line {other}: {proof!r}" if proof else "in the lines around the table"
    return [
        f"line {number}: {cell!r} is read as {_read(cell, decimal)}: the decimal mark is {decimal!r}, as {why}; "
        f"--set '{DECIMAL}=\"{decimal}\"' confirms this"
    ]


def _read(cell: str, decimal: str) -> str:
    thousands = OTHER[decimal]
    if GROUPED[thousands].fullmatch(cell) or WITH_BOTH[decimal].fullmatch(cell):
        return cell.replace(thousands, "").replace(decimal, ".")
    return cell.replace(decimal, ".") if WITH_ONE[decimal].fullmatch(cell) else cell
