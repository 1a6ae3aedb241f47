"""What a table is likely to hold, offered as an answer and never taken: its kind, and headers near a column."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Sequence

from mixedlub.importers.dates import is_dated
from mixedlub.importers.pace import TIME, counted
from mixedlub.importers.sheet import Cells, are_numbers
from mixedlub.importers.vocabulary import BY_NAME, TEXT_COLUMNS, WEIGHED, target_of
from mixedlub.kinds import friction_map
from mixedlub.kinds import kind as kind_of
from mixedlub.schema.system_file import KINDS
from mixedlub.schema.units import fits, is_unit, split, words_of

ENOUGH = 0.4
"""Likeness from which a header is offered; a unit that fits, or names in the cells, make up for other words."""
UNIT_FITS = 0.45
NO_UNIT_FITS = 0.01
"""A number without a unit is rather one that has none than one whose unit is not said."""
ABSENT = 0.5
"""What a needed column that no header is near takes away."""
COUNTS = 1.0
"""Likeness of a time to what counts cycles or a distance instead."""
TEXT_FITS = 0.4
SAME_WORD = 0.75
DERIVED = re.compile(
    r"(?:slope|gradient|derivative|curvature|rate|damping|stiffness|duration|interval|pause|delay|index|"
    r"error|limit|threshold|tolerance|uncertainty|variance|zero|offset|drift|gain|sensitivity|change|difference|rise|"
    r"drop|wear|roughness|steigung|dämpfung|steifigkeit|dauer|fehler|grenze|verschleiß|rauheit)s?\.?"
)
"""Words that make another thing of what stands beside them: the slope of a friction is no friction."""
AS_IT_IS = {"corrected", "compensated", "free"}
"""Words behind one of those that give the thing back: a friction whose zero is corrected."""
TRANSMITTED = {"input", "output", "load", "applied"}
"""Words for a torque that a drive hands on: it loads the friction that is read beside it, and is offered last."""
LAST = 0.41


def likely_headers(columns: Iterable[str], cells: Cells) -> dict[str, str]:
    """The header nearest to each column, each header once; columns that none is near are left out."""
    pairs = sorted(
        ((likeness(column, header, cells[header]), column, header) for column in columns for header in cells),
        key=lambda found: -found[0],
    )
    taken: dict[str, str] = {}
    for score, column, header in pairs:
        if score >= ENOUGH and column not in taken and header not in taken.values():
            taken[column] = header
    return taken


def likely_kind(cells: Cells) -> str:
    """The kind whose recorded quantity and needed columns the headers come nearest to."""
    return max(KINDS, key=lambda name: _share(name, cells))


def _share(name: str, cells: Cells) -> tuple[float, int]:
    """Share of the needed columns that are there, more of them counting more, and the reading; then how many."""
    found = kind_of(name)
    needed = [c.name for c in found.columns if c.required]
    group = either(name)
    near = likely_headers([*needed, *group, *found.quantities], cells)
    near_by = {column: likeness(column, header, cells[header]) for column, header in near.items()}
    reading = max((near_by.get(q, 0.0) for q in found.quantities), default=0.0)
    conditions = [near_by.get(c, 0.0) for c in needed] + [max((near_by.get(c, 0.0) for c in group), default=0.0)]
    conditions = conditions[: len(needed) + bool(group)]
    share = sum(c or -ABSENT for c in conditions) / (len(conditions) + 1)
    return (reading + share, sum(c > 0.0 for c in conditions))


def either(kind: str) -> tuple[str, ...]:
    """Columns of which a kind needs one and takes no more."""
    return friction_map.SPEEDS if kind == "friction_map" else ()


def is_logarithm(header: str) -> bool:
    """Whether a header says that its column holds logarithms; a log with a unit is one that is kept.

    >>> [is_logarithm(h) for h in ("ln_kinematic_viscosity", "log10(viscosity)", "Log time (s)", "load_N")]
    [True, True, False, False]
    """
    unit = split(header)[1]
    logged = re.match(r"(?:ln|lg|log(?:2|10|e)?)(?![a-z0-9])", header.strip().lower())
    return logged is not None and (unit is None or not is_unit(unit))


SPREAD = re.compile(r"(?:standard deviation|std\.? dev|st\.? ?dev|stddev|std|sd)\.?")
BEFORE, AFTER = re.compile(rf"{SPREAD.pattern}\b(?: of)?"), re.compile(rf"\b{SPREAD.pattern}$")


def spread_of(header: str) -> str | None:
    """The words of what a header gives the standard deviation of; None where it gives none.

    >>> spread_of("film_sd_nm"), spread_of("StDev of torque (Nm)"), spread_of("sd"), spread_of("film_nm")
    ('film', 'torque', '', None)
    """
    words = words_of(header)
    found = BEFORE.match(words) or AFTER.search(words)
    return None if found is None else (words[: found.start()] + words[found.end() :]).strip()


def likely_spread(quantity: str, header: str, cells: Cells) -> str | None:
    """The header over the standard deviation of what was recorded, its words among those of the reading's header."""
    have = {*words_of(header).split(), *split(quantity)[0].split()}
    found = {}
    for other, values in cells.items():
        of, unit = spread_of(other), split(other)[1]
        if of is None or not are_numbers(values) or (unit is not None and not fits(unit, BY_NAME[quantity].unit)):
            continue
        if set(of.split()) <= have:
            found[other] = len(of.split())
    return max(found, key=lambda other: found[other], default=None)


def likeness(column: str, header: str, cells: Sequence[str] = ()) -> float:
    """How near a header comes to a column, by its words and its unit; 0 where unit or cells speak against it.

    >>> likeness("speed_rpm", "Pinion speed [1/min]") > likeness("speed_rpm", "Pinion torque [Nm]")
    True
    """
    exact, unit = target_of(header), split(header)[1]
    own = exact is not None and exact.name == column and (unit is None or fits(unit, exact.unit))
    if header == column or own:
        return 2.0
    if column == TIME and counted(header) is not None and are_numbers(cells):
        return COUNTS
    words = words_of(header)
    if (
        spread_of(header) is not None
        or is_logarithm(header)
        or (column == "viscosity_mPa_s" and "kinematic" in words.split())
    ):
        return 0.0
    if _is_derived(column, words):
        return 0.0
    numbers = are_numbers(cells)
    if column in TEXT_COLUMNS:
        dated = any(map(is_dated, cells))
        return 0.0 if unit is not None or numbers or dated else TEXT_FITS + _overlap(words, column.replace("_", " "))
    if not numbers:
        return 0.0
    target = BY_NAME.get(column)
    if target is None:
        return _overlap(words, column.replace("_", " "))
    known = unit is not None and fits(unit, target.unit)
    if unit is not None and not known:
        return 0.0
    share = max(_overlap(words, spoken) for spoken in (split(column)[0], *target.spoken, *target.offered))
    # A share in percent may be of anything, and most of what is weighed is no load.
    tells = known and (share > 0.0 or not (target.unit in ("ratio", "percent") or (unit or "").lower() in WEIGHED))
    bare = unit is None and target.unit == "ratio" and share > 0.0
    score = share + (UNIT_FITS if tells else 0.0) + (NO_UNIT_FITS if bare else 0.0)
    return min(score, LAST) if column == "friction_torque_Nm" and TRANSMITTED & set(words.split()) else score


def _is_derived(column: str, words: str) -> bool:
    """Whether the words of a header are those of another thing than a column, though its own may stand among them.

    >>> [_is_derived("load_N", words) for words in ("load damping", "ball load", "load zero", "constant load")]
    [True, False, True, False]
    >>> _is_derived("time_s", "time constant"), _is_derived("friction_coefficient", "friction zero corrected")
    (True, False)
    >>> _is_derived("position_deg", "zero position"), _is_derived("rig", "rig index")
    (True, False)
    """
    target = BY_NAME.get(column)
    if target is None:
        return False
    own = {word for spoken in (*target.spoken, *target.offered) for word in spoken.split()}
    said = words.split()
    if AS_IT_IS & set(said):
        return False
    # What is constant is still itself; a time constant is not.
    return any(DERIVED.fullmatch(word) for word in said if word not in own) or said[-1:] == ["constant"]


def _overlap(words: str, spoken: str) -> float:
    """Share of the spoken words found in a header, less a little for every word besides."""
    have, want = words.split(), spoken.split()
    near = [max((difflib.SequenceMatcher(None, w, h).ratio() for h in have), default=0.0) for w in want]
    share = sum(n for n in near if n >= SAME_WORD) / len(want)
    return share - 0.02 * max(len(have) - len(want), 0) * (share > 0)
