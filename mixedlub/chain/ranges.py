"""Valid ranges of laws, and the grade of quantities outside them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any, TypeVar

import numpy as np

from mixedlub.chain.quantities import GLOSSARY, unit_and_factor
from mixedlub.schema.findings import Finding, Severity, finding
from mixedlub.schema.units import ZEROS

Ends = tuple[float, float]
Law = TypeVar("Law", bound=Callable[..., Any])

GRADES = ("valid", "extrapolated", "not_quantitative", "impossible")
"""Grades of a row: within every range, a little beyond a range, far beyond it, impossible in a contact."""
VALID = GRADES[0]
WORDS = ("valid", "extrapolated a little", "not quantitative", "impossible")
_SEVERITIES = (Severity.NOTE, Severity.NOTE, Severity.CAUTION, Severity.DOUBT)
LITTLE = 2.0
"""Judgement. Factor on an end of a range up to which a law is extrapolated a little: published laws of one step, each
fitted to a range, differ there by up to 40 %."""
EXTRAPOLATED = "law_extrapolated"
"""Code of a law or effect outside its range; flags append a colon and its name."""
SLACK = 1e-9
"""Rounding error accepted beyond a range, relative to its end."""
FAR = 1000.0
"""Ratio to the end of a range of numbers without unit above which their digits say nothing."""
UNBOUNDED = (-np.inf, np.inf)
ENDLESS = 1e300
"""Ends of a range above this number are left out of its text."""

_DECLARED: dict[Callable[..., Any], Mapping[str, Ends]] = {}


def holds_within(ranges: Mapping[str, Ends]) -> Callable[[Law], Law]:
    """Declare the range of the law below: SI values by quantity of the glossary."""

    def register(law: Law) -> Law:
        _DECLARED[law] = ranges
        return law

    return register


def declared(law: Callable[..., Any]) -> Mapping[str, Ends]:
    """Declared range of a law, also of a wrapped law, or of a law that is an object; empty if unknown."""
    own: Mapping[str, Ends] | None = getattr(law, "valid", None)
    if own is not None:
        return own
    return _DECLARED.get(law) or _DECLARED.get(getattr(law, "__wrapped__", law), {})


@dataclass(frozen=True)
class Limit:
    """A range of a quantity, with the code and the advice of the finding on values outside it.

    ``little``: range of a small extrapolation, by default a factor `LITTLE` beyond the ends. ``possible``: range that
    exists in contacts. ``meaning``: that of a quantity without entry in the glossary.
    """

    code: str
    quantity: str
    ends: Ends
    advice: str
    little: Ends | None = None
    possible: Ends = UNBOUNDED
    meaning: str = ""

    @property
    def key(self) -> str:
        """Code and quantity."""
        return f"{self.code}:{self.quantity}"

    def grades(self, values: np.ndarray) -> np.ndarray:
        """Index in `GRADES` of each value; NaN counts as within the range.

        >>> ratio = Limit("a", "slide_roll_ratio", (0.1, 2.0), "", possible=(0.0, 9.0))
        >>> ratio.grades(np.array([np.nan, 2.0, 3.0, 0.04, 9.5])).tolist()
        [0, 0, 1, 2, 3]
        """
        low, high = self.ends
        little = self.little or (low / LITTLE if low > 0.0 else low, high * LITTLE)
        known = np.where(np.isnan(values), np.clip(1.0, low, high), values)
        off = (beyond({"": known}, {"": ends}) for ends in (self.ends, little, self.possible))
        return np.asarray(sum(o.astype(np.int8) for o in off))

    def reach(self, values: np.ndarray) -> str:
        """The range, and the extremes of the values outside it, as text; NaN values are ignored.

        >>> Limit("a", "moes_load", (2.0, np.inf), "").reach(np.array([1.5, np.nan]))
        "Moes' load parameter of a line contact of at least 2, here down to 1.5"
        >>> Limit("a", "shear_stress", (0.0, 90e6), "").reach(np.array([95e6, -1e6, 120e6]))
        'shear stress of the film 0 to 90 MPa, here down to -1 and up to 120 MPa'
        """
        known = self.quantity in GLOSSARY
        unit, factor = unit_and_factor(self.quantity) if known else ("-", 1.0)
        unit, zero = (unit.removeprefix("-"), 0.0) if unit != "K" else ("°C", float(ZEROS["degC"]))
        low, high = (end * factor - zero for end in self.ends)
        shown = values[~np.isnan(values)] * factor - zero
        ends = f"{_number(low)} to {_number(high)}" if high < ENDLESS else f"of at least {_number(low)}"
        down = [f"down to {_number(shown.min())}"] if shown.min() < low else []
        most = "over 1000" if not unit and shown.max() > FAR * max(high, 1.0) else f"up to {_number(shown.max())}"
        up = [most] if shown.max() > high else []
        meaning = GLOSSARY[self.quantity].meaning.partition(";")[0] if known else self.quantity.replace("_", " ")
        meaning = self.meaning or meaning
        return f"{meaning} {ends} {unit}".rstrip() + f", here {' and '.join(down + up)} {unit}".rstrip()


def _number(value: float) -> str:
    """Number of four digits, without exponent from 10,000 to a million.

    >>> _number(0.0001234), _number(17402.8), _number(2e9)
    ('0.0001234', '17400', '2e+09')
    """
    return f"{float(f'{value:.4g}'):.0f}" if 1e4 <= abs(value) < 1e6 else f"{value:.4g}"


def of_law(name: str, ranges: Mapping[str, Ends]) -> tuple[Limit, ...]:
    """Limits of a law or effect."""
    advice = f"{name} is used outside the range in which it holds"
    return tuple(Limit(f"{EXTRAPOLATED}:{name}", quantity, ends, advice) for quantity, ends in ranges.items())


def beyond(state: Mapping[str, Any], valid: Mapping[str, Ends]) -> np.ndarray:
    """Mask of rows with a quantity outside its range (beyond rounding) or NaN.

    >>> beyond({"slide_roll_ratio": np.array([2.0 + 1e-12, 2.1, np.nan])}, {"slide_roll_ratio": (0.0, 2.0)}).tolist()
    [False, True, True]
    """
    within = (
        (state[name] >= low - _slack(low)) & (state[name] <= high + _slack(high)) for name, (low, high) in valid.items()
    )
    return ~reduce(np.logical_and, within, np.ones(1, bool))


def _slack(end: float) -> float:
    return SLACK * abs(end) if np.isfinite(end) else 0.0


def farthest_beyond(value: np.ndarray, ends: Ends, where: np.ndarray) -> np.ndarray:
    """Value farthest beyond a range along the last axis, kept with length 1; NaN if all are within.

    >>> where = np.array([True, True, False])
    >>> farthest_beyond(np.array([[3.0, 1.5, 9.0], [1.0, 2.0, 9.0]]), (0.0, 2.0), where).tolist()
    [[3.0], [nan]]
    """
    off = where & beyond({"value": value}, {"value": ends})
    value = np.broadcast_to(np.where(np.isnan(value), np.inf, value), off.shape)
    most = np.max(value, axis=-1, keepdims=True, where=off, initial=-np.inf)
    least = np.min(value, axis=-1, keepdims=True, where=off, initial=np.inf)
    return np.where(off.any(axis=-1, keepdims=True), np.where(most > ends[1], most, least), np.nan)


Reached = Sequence[tuple[Limit, np.ndarray]]
"""Limits, each with the values of the rows; NaN counts as within the range."""


def flags(reached: Reached, shape: tuple[int, ...]) -> dict[str, np.ndarray]:
    """Grades of rows by code, worst code first, without codes that never apply.

    >>> thin, wide = Limit("a", "film", (0.0, 1.0), ""), Limit("b", "width", (0.0, 1.0), "")
    >>> {c: g.tolist() for c, g in flags([(thin, np.array([1.5, 0.5])), (wide, np.array([0.5, 3.0]))], (2,)).items()}
    {'b': [0, 2], 'a': [1, 0]}
    """
    found: dict[str, np.ndarray] = {}
    for limit, values in reached:
        grades = np.broadcast_to(limit.grades(values), shape)
        found[limit.code] = np.maximum(found.get(limit.code, np.int8(0)), grades)
    return dict(sorted(((c, g) for c, g in found.items() if g.any()), key=lambda item: -int(item[1].max())))


def as_words(found: Mapping[str, np.ndarray], shape: tuple[int, ...]) -> tuple[np.ndarray, list[str]]:
    """Validity of every row: an index of the given shape, and the text of each index, grade first.

    >>> index, words = as_words({"a": np.array([1, 0, 0]), "b": np.array([2, 1, 0])}, (3,))
    >>> [words[i] for i in index]
    ['not_quantitative; b; a', 'extrapolated; b', 'valid']
    """
    number = np.zeros(shape, dtype=np.int64)
    for place, grades in enumerate(found.values()):
        number |= grades.astype(np.int64) << 2 * place
    sets, index = np.unique(number, return_inverse=True)
    words = []
    for one in sets.tolist():
        own = sorted(((-(one >> 2 * place & 3), code) for place, code in enumerate(found)), key=lambda item: item[0])
        codes = [code for grade, code in own if grade]
        words.append("; ".join([GRADES[-own[0][0]], *codes]) if codes else VALID)
    return index.reshape(shape), words


def validity(found: Mapping[str, np.ndarray], shape: tuple[int, ...]) -> np.ndarray:
    """Text of `as_words` for every row."""
    index, words = as_words(found, shape)
    return np.array(words, dtype=object)[index]


def findings(
    reached: Reached,
    shape: tuple[int, ...],
    rows: str = "rows",
    place: str | Callable[[str], str] = "",
    more: Mapping[str, str] | None = None,
) -> tuple[Finding, ...]:
    """Findings by code, worst first: number of ``rows``, grades, values and limits.

    A law far outside its range in every row is a doubt about all numbers. ``place``: location of all findings, or of
    each code. ``more``: additional advice by code.
    """
    said = []
    for code, grades in flags(reached, shape).items():
        own = [(limit, np.broadcast_to(values, shape)) for limit, values in reached if limit.code == code]
        worst = int(grades.max())
        advice = own[0][0].advice + (more or {}).get(code, "")
        reach = "; ".join(limit.reach(np.where(g, v, np.nan)) for limit, v in own if (g := limit.grades(v) > 0).any())
        text = f"of {grades.size} {rows} {_counted(grades)}: {advice} ({reach})"
        at = place if isinstance(place, str) else place(code)
        whole = code.startswith(EXTRAPOLATED) and bool((grades > 1).all())
        severity = Severity.DOUBT if whole else _SEVERITIES[worst]
        said.append(finding(code.partition(":")[0], text, at, severity))
    return tuple(said)


def _counted(grades: np.ndarray) -> str:
    """Numbers of rows by grade, worst first.

    >>> _counted(np.array([0, 1, 2, 1]))
    '1 not quantitative, 2 extrapolated a little'
    """
    counts = ((np.count_nonzero(grades == grade), WORDS[grade]) for grade in (3, 2, 1))
    return ", ".join(f"{count} {word}" for count, word in counts if count)
