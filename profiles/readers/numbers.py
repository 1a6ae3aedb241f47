"""Columns of numbers in text, as written by programs and people."""

from __future__ import annotations

import itertools
import math
import re
from collections import Counter
from dataclasses import dataclass

import numpy as np

from profiles.errors import InputError
from profiles.readers.base import MAX_POINTS
from profiles.units import known_unit, number_of

_NUMBER = re.compile(r"[-+]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][-+]?\d+)?\Z")
_WRITTEN = re.compile(r"[-+]?[\d.,]*\d[\d.,]*(?:[eE][-+]?\d+)?\Z")
"""Number with marks that may separate thousands too."""
_ABSENT = re.compile(r"[-+]?(?:nan|inf|infinity|n/a|na|null|none|-+|\*+|#n/a|bad)\Z", re.IGNORECASE)
_SAMPLE = 200
_COUNT = re.compile(r"\d{1,9}\Z")
_COUNT_LINES = 3
"""First lines of numbers searched for a count of the rows."""
_FEWEST_COUNTED = 10
"""Fewest rows below a count: fewer rows may equal a height by chance."""
_FAR = 20.0
"""Departures of whole-number heights from their median beyond which a whole number above them is a count."""
_RUN = 4
"""Fewest lines of numbers above an empty line that parts two blocks: a count and its length are fewer."""
_FEW = 10
"""Most lines of results below an empty line."""
WIDE = 4
"""Fewest columns of a matrix of heights, in which every cell may be missing."""
NO_NUMBERS = "no column of numbers found in the text"


@dataclass(frozen=True)
class Counted:
    """Number of heights stated in a file above the heights, its line, and the length beside it."""

    count: int
    line: int
    length: float | None = None


@dataclass(frozen=True)
class Table:
    """Columns of numbers, the lines above and below, and the count of rows among the lines above."""

    header: tuple[str, ...]
    columns: np.ndarray
    delimiter: str | None
    quantum: float
    counted: Counted | None = None
    footer: tuple[str, ...] = ()
    footer_line: int = 0

    def alone(self, where: str) -> Table:
        """The table, for formats without words below the numbers."""
        if self.footer:
            rule = "the numbers end above this line; delete what is below"
            raise InputError(rule, where=f"{where}: line {self.footer_line}", value=self.footer[0])
        return self


def decoded(data: bytes, where: str) -> str:
    """Text of a file in UTF-8, UTF-16 with its mark, or Latin-1, with line ends unified."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        try:
            text = data.decode("utf-16")
        except UnicodeDecodeError:
            raise InputError("damaged UTF-16 text", where=where) from None
    else:
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = data.decode("latin-1")
    return text.replace("\r\r\n", "\n").replace("\r\n", "\n").replace("\r", "\n")


def split(line: str, delimiter: str | None) -> list[str]:
    """The cells of a line; empty cells at its end are dropped."""
    cells = [cell.strip() for cell in line.split(delimiter)]
    while cells and not cells[-1]:
        cells.pop()
    return cells


def _style(lines: list[str], heading: str = "") -> tuple[str | None, bool]:
    """Delimiter and whether the comma is the decimal sign, from the first lines of numbers and the line above."""
    body = "\n".join(lines)
    if ";" in body:
        return ";", "," in body
    if "\t" in body:
        return "\t", "," in body and "." not in body
    if "," not in body:
        return None, False
    # A comma beside blanks within one line, or alone with no point anywhere, may be the decimal sign.
    if all(len(line.split()) > 1 and not re.search(r",\s|,\Z", line.strip()) for line in lines):
        return None, True
    counts = {line.strip().rstrip(",").count(",") for line in lines}
    apart = _counting([line.split(",")[0] for line in lines]) or _names_columns(heading)
    if counts == {1} and "." not in body and not apart:
        return None, True
    return ",", False


def _counting(words: list[str]) -> bool:
    """Whether the words are whole numbers that count up or down: a column of positions, not integer parts."""
    try:
        values = [int(word) for word in words]
    except ValueError:
        return False
    steps = [after - before for before, after in itertools.pairwise(values)]
    return bool(steps) and (min(steps) > 0 or max(steps) < 0)


def _names_columns(heading: str) -> bool:
    """Whether a comma in the line above the numbers parts two names, not a name from its unit or a setting.

    >>> _names_columns("x_um,z_nm"), _names_columns("Height, um"), _names_columns("step: 0,5 um")
    (True, False, False)
    """
    cells = [cell.strip(' "') for cell in heading.split(",")]
    named = len(cells) == 2 and all(re.search(r"[^\W\d]", cell) for cell in cells) and not re.search(r"[:=]", heading)
    return named and (known_unit(cells[1]) is None or known_unit(cells[0]) is not None)


def _is_numbers(line: str) -> bool:
    cells = [cell for cell in re.split(r"[;\s]+", line) if cell]
    parts = [part for cell in cells for part in ([cell] if _NUMBER.match(cell) else cell.split(",")) if part]
    return bool(parts) and all(_NUMBER.match(part) for part in parts)


def _starts_numbers(lines: list[str], index: int) -> bool:
    """Whether the numbers begin here: this line and the next non-empty one are numbers."""
    following = [line for line in lines[index + 1 : index + 6] if line.strip()]
    return _is_numbers(lines[index]) and (not following or _is_numbers(following[0]) or is_absent(following[0]))


def is_absent(line: str) -> bool:
    """Whether a cell of a line stands for a missing number."""
    cells = [cell for cell in re.split(r"[,;\s]+", line.strip()) if cell]
    return any(_ABSENT.match(cell) for cell in cells)


def table(text: str, where: str) -> Table:
    """Block of numbers of a text, with the lines above and below."""
    if "\x00" in text[:4096]:
        raise InputError("not a text of numbers (it holds binary zeros)", where=where)
    lines = text.split("\n")
    while lines and not lines[-1].strip(" \t\x1a\x00"):
        lines.pop()
    start = next((i for i in range(min(len(lines), 2000)) if _starts_numbers(lines, i)), None)
    if start is None:
        raise InputError(NO_NUMBERS, where=where)
    end = _end_of_numbers(lines, start, where)
    counted = _counted(lines[:end], start)
    first = counted.line if counted else start
    body = lines[first:end]
    if len(body) > MAX_POINTS:
        raise InputError(f"at most {MAX_POINTS} points can be read", where=where, value=len(body))
    sample = [line for line in body[:_SAMPLE] if line.strip() and _is_numbers(line)]
    delimiter, comma = _style(sample, next((line for line in reversed(lines[:first]) if line.strip()), ""))
    if delimiter != ",":
        _refuse_both_marks(body, delimiter, where, first + 1)
    width = Counter(len(split(line, delimiter)) for line in sample).most_common(1)[0][0]
    columns = _parse(body, delimiter, comma, width, where, first + 1)
    below = next((i for i in range(end, len(lines)) if lines[i].strip()), end)
    footer = tuple(line for line in lines[below:] if line.strip())
    return Table(tuple(lines[:first]), columns, delimiter, _quantum(sample, delimiter), counted, footer, below + 1)


def _refuse_both_marks(body: list[str], delimiter: str | None, where: str, first: int) -> None:
    """Refuse numbers with a decimal comma beside numbers with a decimal point."""
    if not (any("," in line for line in body) and any("." in line for line in body)):
        return
    cells = [(number, cell) for number, line in enumerate(body, first) for cell in split(line, delimiter)]
    marks = [max(cell.rfind(","), cell.rfind(".")) if _WRITTEN.match(cell) else -1 for _, cell in cells]
    comma, point = (
        next((one for one, at in zip(cells, marks, strict=True) if at >= 0 and one[1][at] == mark), None)
        for mark in ",."
    )
    if comma is not None and point is not None:
        rule = f"has a decimal comma, line {point[0]} has a decimal point ({point[1]!r}); write all numbers in one way"
        raise InputError(rule, where=f"{where}: line {comma[0]}", value=comma[1])


def _end_of_numbers(lines: list[str], start: int, where: str) -> int:
    """Number of lines before the results of the instrument: words at the end, or a few lines below an empty line."""
    end = len(lines)
    while end > start and _is_below(lines[end - 1]):
        end -= 1
    blank = [not line.strip(" \t,;") for line in lines[start:end]]
    gap = next((i for i in range(_RUN, len(blank)) if blank[i] and not any(blank[i - _RUN : i])), None)
    if gap is None:
        return end
    if blank[gap:].count(False) <= min(_FEW, blank[:gap].count(False) // 4):
        return start + gap
    line = start + gap + blank[gap:].index(False)
    rule = "a second block begins here, below an empty line: save each as a file of its own, or delete the empty line"
    raise InputError(rule, where=f"{where}: line {line + 1}", value=lines[line].strip())


def _is_below(line: str) -> bool:
    """Whether a line is empty, begins with a word, or has one among its cells."""
    line = line.strip()
    cells = [cell for cell in re.split(r"[,;\s]+", line) if cell]
    if any(re.search(r"[^\W\d_]{2}", cell) and not _ABSENT.match(cell) for cell in cells):
        return True
    if cells and _ABSENT.match(cells[0]):
        return False
    return not line or not (line[0] in "+-.,;*" or line[0].isdigit())


def _counted(lines: list[str], start: int) -> Counted | None:
    """Count of rows in the first lines of numbers: equal to the rows below, or impossible as a height."""
    above: list[float] = []
    for place in range(start, min(start + _COUNT_LINES, len(lines) - _FEWEST_COUNTED)):
        words = [word for word in re.split(r"[;\s]+", lines[place].strip()) if word]
        if len(words) > 2 or not all(map(_NUMBER.match, words)):
            return None
        for word in filter(_COUNT.match, words):
            below = [line for line in lines[place + 1 :] if line.strip()]
            others = above + [_value(other) for other in words if other is not word]
            exact = int(word) == len(below) and (len(words) == 1 or _NUMBER.match(below[0].strip()))
            if len(below) >= _FEWEST_COUNTED and (exact or (len(words) == 1 and _is_no_height(word, below))):
                return Counted(int(word), place + 1, others[0] if len(others) == 1 else None)
        above += map(_value, words)
    return None


def _value(word: str) -> float:
    return number_of(word.replace(",", "."))


def _is_no_height(word: str, below: list[str]) -> bool:
    """Whether a whole number stands above rows of two numbers, or of heights that all lie far off it."""
    if int(word) < _FEWEST_COUNTED:
        return False
    sample = below[:_SAMPLE]
    if all(_is_numbers(line) and not _NUMBER.match(line.strip()) for line in sample):
        return True
    heights = [_value(line.strip()) for line in sample if _NUMBER.match(line.strip())]
    decimals = sum("." in line or "," in line for line in sample)
    if len(heights) < len(sample) or 0 < decimals < 0.9 * len(sample):
        return False
    if decimals:
        return min(abs(int(word) - height) for height in heights) > 10.0 * (max(heights) - min(heights))
    heights = [_value(line.strip()) for line in below if _NUMBER.match(line.strip())]
    middle = float(np.median(heights))
    return abs(int(word) - middle) > _FAR * max(1.0, *(abs(height - middle) for height in heights))


def _parse(body: list[str], delimiter: str | None, comma: bool, width: int, where: str, first: int) -> np.ndarray:
    """All rows at once, nan for missing heights; read line by line only if that fails."""
    words = [line.rstrip(" \t" + (delimiter or "")) for line in body]
    if comma:
        words = [line.replace(",", ".") for line in words]
    try:
        columns = np.loadtxt(words, delimiter=delimiter, ndmin=2, comments=None)
    except ValueError:
        columns = None
    if columns is not None and columns.shape[1] == width:
        whole = not np.isinf(columns).any() if width >= WIDE else np.isfinite(columns).all()
        if whole:
            return columns.T
    rows = [
        row_of(line, delimiter, width, f"{where}: line {number}")
        for number, line in enumerate(words, start=first)
        if line.strip()
    ]
    return np.array(rows).T


def row_of(line: str, delimiter: str | None, width: int, where: str) -> list[float]:
    """Numbers of a line; a height may be missing, as a word or an empty cell behind a delimiter."""
    cells = split(line, delimiter)
    if delimiter is not None and 1 < width == len(cells) + 1:
        cells.append("nan")
    values = []
    for place, cell in enumerate(cells):
        is_height = place > 0 or width == 1 or width >= WIDE
        missing = is_height and (not cell or (_ABSENT.match(cell) and "inf" not in cell.lower()))
        try:
            values.append(math.nan if missing else number_of(cell))
        except ValueError:
            raise InputError("not a number", where=where, value=cell) from None
        if not missing and not math.isfinite(values[-1]):
            what = "heights" if is_height else "positions"
            raise InputError(f"{what} must be finite numbers", where=where, value=cell)
    if len(cells) != width:
        raise InputError(f"expected {width} numbers", where=where, value=line.strip())
    return values


def _quantum(sample: list[str], delimiter: str | None) -> float:
    """Rounding of the first column: one unit of the last written digit, the finest of the sample."""
    finest = math.inf
    for line in sample:
        digits, _, power = split(line, delimiter)[0].replace(",", ".").lower().partition("e")
        places = len(digits.partition(".")[2])
        if float(digits or 0) != 0:
            finest = min(finest, 10.0 ** (max(-300, min(300, int(power or 0))) - places))
    return finest if math.isfinite(finest) else 0.0
