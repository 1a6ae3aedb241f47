"""Rows and cells of a table that are not readings: repeated headers, means and sums, spreadsheet errors."""

from __future__ import annotations

import re
from collections.abc import Sequence

from mixedlub.importers.decimals import Line
from mixedlub.schema.cells import is_number

LINES_SHOWN = 5
"""Most lines listed in a note."""


def count(number: int, thing: str) -> str:
    """Number of things in words.

    >>> count(1, "row"), count(3, "row")
    ('1 row', '3 rows')
    """
    return f"{number} {thing}" + ("" if number == 1 else "s")


def places(lines: Sequence[int]) -> str:
    """Line numbers in words.

    >>> places([14]), places([3, 9]), places(list(range(2, 20)))
    ('line 14', 'lines 3, 9', 'lines 2, 3, 4, 5, 6 and 13 more')
    """
    more = f" and {len(lines) - LINES_SHOWN} more" if len(lines) > LINES_SHOWN else ""
    return ("line " if len(lines) == 1 else "lines ") + ", ".join(map(str, lines[:LINES_SHOWN])) + more


def without_repeated_headers(rows: Sequence[Line]) -> tuple[list[Line], str]:
    """Rows without headers repeated between rows of numbers, and a text on them.

    >>> head, rows = ["rpm", "Nm"], [(2, ["1", "0.1"]), (5, ["2", "0.2"])]
    >>> without_repeated_headers([(1, head), rows[0], (4, head), rows[1]])[1]
    'line 4 repeats the header: the rows below are taken as of the same table'
    """
    seen: set[tuple[str, ...]] = set()
    repeated = []
    for number, row in rows:
        words = tuple(filter(None, row))
        if len(words) < 2 or any(map(is_number, words)):
            continue
        if words in seen:
            repeated.append(number)
        seen.add(words)
    if not repeated or 2 * len(repeated) > len(rows):
        return list(rows), ""
    repeats = "repeats" if len(repeated) == 1 else "repeat"
    words_of_it = f"{places(repeated)} {repeats} the header: the rows below are taken as of the same table"
    return [line for line in rows if line[0] not in set(repeated)], words_of_it


SUMMARY = re.compile(
    r"(?:arithmetic|grand)?mean|averages?|avg|sum|(?:grand)?total|median|max(?:imum)?|min(?:imum)?|n|count|std|sd|"
    r"std?d?ev[sp]?|standarddeviation|cv|rsd|rms|variance|(?:gesamt)?mittel(?:werte?)?|mw|durchschnitt|"
    r"(?:gesamt)?summe|gesamt|std?abw|standardabweichung|anzahl|moyennes?|somme|[eé]carttype"
)
"""Label of a row that summarises others, in small letters alone."""
_TAIL = re.compile(r"(?:\W*(?:values?|of all\b.*|\d+ *(?:-|–|\.\.+|to|bis) *\d+))+\W*\Z")
"""Words and ranges of numbers behind a label."""
_LONGEST = 40
"""Judgement. Most characters of a label; longer cells are remarks."""


def is_summary(cell: str) -> bool:
    """Whether a cell labels a row that summarises others, whatever its marks and the range behind it.

    >>> [is_summary(cell) for cell in ("Mittelwert 1-24", "Std.-Abw.", "CV %", "Mean of all", "n")]
    [True, True, True, True, True]
    >>> [is_summary(cell) for cell in ("Max 3", "steel", "mean speed", "7")]
    [False, False, False, False]
    """
    if not cell[:1].isalpha() or len(cell) > _LONGEST:
        return False
    return SUMMARY.fullmatch(re.sub(r"[\s.:%()_–-]+", "", _TAIL.sub("", cell.lower()))) is not None


def without_summaries(rows: Sequence[Line]) -> tuple[list[Line], str]:
    """Rows without labelled means and sums of others, and a text on them; a table of means keeps its rows.

    >>> without_summaries([(2, ["1", "0.1"]), (3, ["2", "0.3"]), (4, ["Mean:", "0.2"])])
    ([(2, ['1', '0.1']), (3, ['2', '0.3'])], "1 row left out, as it is labelled 'Mean:': line 4")
    >>> without_summaries([(2, ["mean", "0.1"]), (3, ["sd", "0.3"])])[1]
    ''
    """
    labels = {
        number: label
        for number, row in rows
        if not all(map(is_number, row))
        # behind numbers, an "N" is a flag of a reading
        if (label := next((c for i, c in enumerate(row) if is_summary(c) and (c[1:] or not any(row[:i]))), None))
    }
    if not labels or 2 * len(labels) > len(rows):
        return list(rows), ""
    named = ", ".join(map(repr, dict.fromkeys(labels.values())))
    which = "as it is" if len(labels) == 1 else "as they are"
    words = f"{count(len(labels), 'row')} left out, {which} labelled {named}: {places(list(labels))}"
    return [line for line in rows if line[0] not in labels], words


FAULT = re.compile(
    r"#(?:DIV/0|VALUE|WERT|REF|BEZUG|NAME|NUM|ZAHL|NULL|SPILL|CALC|FORMULA)[!?]?|Err:\d+|"
    r"[-+]?1\.#(?:INF|IND|QNAN)\d*|[-+]?inf(?:inity)?",
    re.IGNORECASE,
)
"""Cell with an error message of a program or an infinite number."""


def cleared(cells: list[str], lines: Sequence[int]) -> dict[int, str]:
    """Empty the cells with an error in place of a number; return their contents by line."""
    if not {"#", "i", "I", "E"} & set("".join(set(cells))):
        return {}
    faults = {i: cell for i, cell in enumerate(cells) if FAULT.fullmatch(cell)}
    for i in faults:
        cells[i] = ""
    return {lines[i]: cell for i, cell in faults.items()}
