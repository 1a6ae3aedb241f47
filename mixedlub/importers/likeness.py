"""Likeness of headers to columns, for the probable kind and columns of a table."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from mixedlub.importers.answer_keys import COLUMNS
from mixedlub.importers.base import Question
from mixedlub.importers.cell_columns import Cells, is_numeric, values_of
from mixedlub.importers.time_base import TIME, counted
from mixedlub.importers.vocabulary import BY_NAME, TEXT_COLUMNS, WEIGHED, Target, family, is_kinematic, target_of
from mixedlub.kinds import NATIVE
from mixedlub.kinds import kind as kind_of
from mixedlub.running.shell import quoted
from mixedlub.schema.cells import is_missing
from mixedlub.schema.dates import is_dated
from mixedlub.schema.table import Column
from mixedlub.schema.toml_file import toml_value
from mixedlub.schema.units import fits, is_unit, split, words_of

LEAST_LIKENESS = 0.4
"""Judgement. Least likeness of an offered header: half of its words, a fitting unit, or names in the cells. Tests of
likely headers hold it and the weights below in place."""
UNIT_FITS = 0.45
NO_UNIT_FITS = 0.01
"""Likeness for a missing unit: such a number is probably a ratio."""
ABSENT = 0.5
"""Penalty for a needed column without a similar header."""
COUNTED_LIKENESS = 1.0
"""Likeness of the time to a count of cycles or a distance."""
SOLE_UNIT = 0.9
"""Least likeness for a unit of this column only: as much as unit and half of the words."""
TEXT_FITS = 0.4
MOST_NAMES = 4
"""Judgement. Most names of a short table with each name in one row only."""
SAME_WORD = 0.75
DERIVED = re.compile(
    r"(?:slope|gradient|derivative|curvature|rate|damping|stiffness|duration|interval|pause|delay|index|"
    r"error|limit|threshold|tolerance|uncertainty|variance|zero|offset|drift|gain|sensitivity|change|difference|rise|"
    r"drop|wear|roughness|steigung|dämpfung|steifigkeit|dauer|fehler|grenze|verschleiß|rauheit)s?\.?"
)
"""Words for quantities derived from a column, such as the slope of a friction."""
WEAR = re.compile(r"\bwear\b|\b(?:weight|mass|volume)[ _]loss\b|verschleiß|massenverlust")
"""Words of wear, a separate column in many tables of friction."""
AS_IT_IS = {"corrected", "compensated", "free"}
"""Words that cancel such a word, as in a friction with corrected zero."""
OTHERS = {
    "input",
    "output",
    "in",
    "out",
    "load",
    "applied",
    "sensor",
    "ideal",
    "command",
    "commanded",
    "target",
    "rated",
}
NO_READING = {
    "friction_torque_Nm": OTHERS,
    "power_loss_W": OTHERS
    | {"motor", "drive", "shaft", "heater", "heating", "pump", "electric", "electrical", "mechanical"},
}
"""Words of transmitted torque or power; the loss is the difference of two such columns."""


def likely_headers(columns: Iterable[str], cells: Cells) -> dict[str, str]:
    """Most similar header of each column, each header once; columns without similar header are left out."""
    pairs = sorted(
        ((likeness(column, header, cells[header]), column, header) for column in columns for header in cells),
        key=lambda pair: -pair[0],
    )
    taken: dict[str, str] = {}
    for score, column, header in pairs:
        if score >= LEAST_LIKENESS and column not in taken and header not in taken.values():
            taken[column] = header
    return taken


def likely_kind(cells: Cells) -> str:
    """Kind with the best match of reading and needed columns; kinds without their reading come last."""
    return max(NATIVE, key=lambda name: _share(name, cells))


def _share(name: str, cells: Cells) -> tuple[bool, float, int]:
    """Score of a kind: presence of the reading; likeness plus share of needed columns; number of columns present."""
    rules = kind_of(name)
    needed = [c.name for c in rules.columns if c.required]
    group = either(name)
    similar = likely_headers([*needed, *group, *rules.quantities], cells)
    likeness_of = {column: likeness(column, header, cells[header]) for column, header in similar.items()}
    reading = max(likeness_of_reading(quantity, cells, similar.get(quantity)) for quantity in rules.quantities)
    conditions = {c: likeness_of.get(c, 0.0) for c in needed}
    if group:
        conditions[group[0]] = max(likeness_of.get(c, 0.0) for c in group)
    share = sum(score or -ABSENT for score in conditions.values()) / (len(conditions) + 1)
    return reading > 0.0, reading + share, sum(score > 0.0 for score in conditions.values())


def likeness_of_reading(quantity: str, cells: Cells, header: str | None) -> float:
    """Likeness of a header to a reading; a difference of two columns equal to the reading counts as well.

    A unit of no other column decides: only a gear loss is in watts.
    """
    if header is None:
        return LEAST_LIKENESS if transmitted(quantity, cells) else 0.0
    near, unit = likeness(quantity, header, cells[header]), split(header)[1]
    sole = unit is not None and [t.name for t in BY_NAME.values() if fits(unit, t.unit)] == [quantity]
    return max(near, SOLE_UNIT) if sole else near


def either(kind: str) -> tuple[str, ...]:
    """Columns of a kind that exclude each other; exactly one is needed."""
    return kind_of(kind).either


def is_logarithm(header: str) -> bool:
    """Whether a header names a logarithm; with a unit, a log is a protocol.

    >>> [is_logarithm(h) for h in ("ln_kinematic_viscosity", "log10(viscosity)", "Log time (s)", "load_N")]
    [True, True, False, False]
    """
    unit = split(header)[1]
    logged = re.match(r"(?:ln|lg|log(?:2|10|e)?)(?![a-z0-9])", header.strip().lower())
    return logged is not None and (unit is None or not is_unit(unit))


SPREAD = re.compile(
    r"(?:standard deviation|std\.? dev|st\.? ?dev|stddev|std|sd|"
    r"(?:stated |expanded |standard |measurement )?uncertainty|(?:mess)?unsicherheit)\.?"
)
BEFORE, AFTER = re.compile(rf"{SPREAD.pattern}\b(?: of)?"), re.compile(rf"\b{SPREAD.pattern}$")


def spread_of(header: str) -> str | None:
    """Quantity of a standard deviation named by a header, or None.

    >>> spread_of("film_sd_nm"), spread_of("StDev of torque (Nm)"), spread_of("sd"), spread_of("film_nm")
    ('film', 'torque', '', None)
    """
    words = words_of(header)
    match = BEFORE.match(words) or AFTER.search(words)
    return None if match is None else (words[: match.start()] + words[match.end() :]).strip()


def likely_spread(reading: Target, header: str, cells: Cells) -> str | None:
    """Header of the standard deviation of the reading, with words among the words of the reading."""
    reading_words = {*words_of(header).split(), *split(reading.name)[0].split()}
    n_words = {}
    for other, values in cells.items():
        spread_words, unit = spread_of(other), split(other)[1]
        if (
            spread_words is None
            or not is_numeric(values)
            or (unit is not None and not fits(unit, family(reading, unit)))
        ):
            continue
        if set(spread_words.split()) <= reading_words:
            n_words[other] = len(spread_words.split())
    return max(n_words, key=lambda other: n_words[other], default=None)


def relative_spread_notes(free: Cells) -> list[str]:
    """Notes on columns of relative uncertainties, with the setting for their median.

    >>> relative_spread_notes({"Uncertainty (%)": ["1", "2", "2"]})
    ["'Uncertainty (%)' is not taken; if it is that of the readings: --set recording.noise.relative=0.02"]
    """
    shares = {h: values_of(cells) / 100.0 for h, cells in free.items() if spread_of(h) is not None and _percent(h)}
    return [
        f"{h!r} is not taken; if it is that of the readings: --set recording.noise.relative={np.nanmedian(share):g}"
        for h, share in shares.items()
        if np.isfinite(share).any()
    ]


def _percent(header: str) -> bool:
    return split(header)[1] == "%"


def likeness(column: str, header: str, cells: Sequence[str] = ()) -> float:
    """Similarity of a header to a column by words and unit; 0 if unit, words or cells exclude it.

    >>> likeness("speed_rpm", "Pinion speed [1/min]") > likeness("speed_rpm", "Pinion torque [Nm]")
    True
    """
    exact, unit = target_of(header), split(header)[1]
    is_exact = exact is not None and exact.name == column and (unit is None or fits(unit, exact.unit))
    if header == column or is_exact:
        return 2.0
    if column == TIME and counted(header) is not None and is_numeric(cells):
        return COUNTED_LIKENESS
    words = words_of(header)
    if (
        spread_of(header) is not None
        or is_logarithm(header)
        or (column == "viscosity_mPa_s" and "kinematic" in words.split() and not is_kinematic(unit))
    ):
        return 0.0
    if WEAR.search(words) or _is_derived(column, words) or NO_READING.get(column, set()) & set(words.split()):
        return 0.0
    numbers = is_numeric(cells)
    if column in TEXT_COLUMNS:
        if unit is not None or numbers or any(map(is_dated, set(cells))):
            return 0.0
        overlap = _overlap(words, column.replace("_", " "))
        return 0.0 if is_empty(cells) or (overlap == 0.0 and is_remark(cells)) else TEXT_FITS + overlap
    if not numbers:
        return 0.0
    target = BY_NAME.get(column)
    if target is None:
        return _overlap(words, column.replace("_", " "))
    unit_fits = unit is not None and fits(unit, family(target, unit))
    if unit is not None and not unit_fits:
        return 0.0
    overlap = max(_overlap(words, spoken) for spoken in (split(column)[0], *target.spoken, *target.offered))
    # A share in percent may be of anything, and most masses are no load.
    unit_counts = unit_fits and (
        overlap > 0.0 or not (target.unit in ("ratio", "percent") or (unit or "").lower() in WEIGHED)
    )
    is_bare_ratio = unit is None and target.unit == "ratio" and overlap > 0.0
    return overlap + (UNIT_FITS if unit_counts else 0.0) + (NO_UNIT_FITS if is_bare_ratio else 0.0)


def is_empty(cells: Sequence[str]) -> bool:
    """Whether all cells of a column are empty; False without cells."""
    return len(cells) > 0 and all(map(is_missing, cells))


def is_remark(cells: Sequence[str]) -> bool:
    """Whether text is in few cells or differs in most cells, like remarks but unlike names.

    >>> is_remark(["ground"] * 9 + ["polished"] * 9), is_remark(["", "", "restart"]), is_remark(["ground", "polished"])
    (False, True, False)
    >>> is_remark(["pump on", "noisy", "restarted", "oil added", "noisy again", "stopped"])
    True
    """
    filled = [cell for cell in cells if not is_missing(cell)]
    different = len(set(filled))
    return 2 * len(filled) < len(cells) or (different > MOST_NAMES and 2 * different > len(filled))


def transmitted(column: str, cells: Cells) -> list[str]:
    """Headers in the unit of a reading with the words of another torque or power.

    >>> transmitted("friction_torque_Nm", {"torque_sensor_Nm": ["1"], "speed_rpm": ["1"], "drag (N m)": ["1"]})
    ['torque_sensor_Nm']
    """
    words = NO_READING.get(column, set())
    spoken = [h for h in cells if words & set(words_of(h).split()) and spread_of(h) is None]
    return [h for h in spoken if fits(split(h)[1] or "", BY_NAME[column].unit) and is_numeric(cells[h])]


def _is_derived(column: str, words: str) -> bool:
    """Whether a header names a quantity derived from a column (slope, error, drift).

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
    own_words = {word for spoken in (*target.spoken, *target.offered) for word in spoken.split()}
    parts = words.split()
    if AS_IT_IS & set(parts):
        return False
    # A constant load is a load; a time constant is no time.
    return any(DERIVED.fullmatch(word) for word in parts if word not in own_words) or parts[-1:] == ["constant"]


def _overlap(words: str, spoken: str) -> float:
    """Share of the spoken words in a header, minus a little for each additional word."""
    in_header, in_name = words.split(), spoken.split()
    likeness_of = [max((difflib.SequenceMatcher(None, w, h).ratio() for h in in_header), default=0.0) for w in in_name]
    share = sum(n for n in likeness_of if n >= SAME_WORD) / len(in_name)
    return share - 0.02 * max(len(in_header) - len(in_name), 0) * (share > 0)


SLIP = "slide_roll_ratio"
SLIDES = re.compile(r"\b(?:slip|schlupf|slid|gleit)")
"""Words of a percentage that may be the slip."""
NO_CONDITION = ("stress", "spannung", "friction", "traction", "reib")
"""Words that exclude a condition: a stress has the unit of a pressure, a friction may name its slip."""


def spare_headers(columns: Iterable[Column], cells: Cells) -> dict[str, str]:
    """Likely headers of optional columns; a percentage of sliding may be the slip.

    >>> spare_headers([Column("pressure_MPa"), Column("slide_roll_ratio")], {"p (bar)": ["1", "5"], "note": ["", "x"]})
    {'pressure_MPa': 'p (bar)'}
    >>> spare_headers([Column("slide_roll_ratio")], {"Schlupf (%)": ["1", "5"]})
    {'slide_roll_ratio': 'Schlupf (%)'}
    >>> spare_headers([Column("slide_roll_ratio")], {"Pump speed (%)": ["90", "100"]})
    {}
    """
    names = [column.name for column in columns if column.dtype == "number" and not column.optional_cells]
    cells = {h: values for h, values in cells.items() if not any(word in h.lower() for word in NO_CONDITION)}
    headers = likely_headers(names, cells)
    percentages = [h for h in cells if split(h)[1] == "%" and SLIDES.search(words_of(h)) and h not in headers.values()]
    slip = next((h for h in percentages if is_numeric(cells[h])), None)
    if SLIP in names and SLIP not in headers and slip is not None:
        headers[SLIP] = slip
    return headers


OTHER_QUANTITIES = {"force", "power", "work", "energy", "heat"}
"""Words of quantities outside the columns of a case."""


def rivals(column: str, taken: str, cells: Cells) -> list[str]:
    """Other headers with different numbers that may hold the same column.

    >>> cells = {"COF": ["0.1"], "COF effective": ["0.2"], "Friction integral": ["0.2"], "Friction force": ["1"]}
    >>> rivals("friction_coefficient", "COF", cells), rivals("load_N", "Load (N)", {"Load (N)": ["1"], "Tick": ["1"]})
    (['COF effective', 'Friction integral'], [])
    """
    target = BY_NAME[column]
    foreign = OTHER_QUANTITIES.union(*(t.spoken for t in BY_NAME.values() if t is not target))
    foreign -= {word for spoken in target.spoken for word in spoken.split()}
    others = [h for h in cells if h != taken and cells[h] != cells[taken]]
    alike = [h for h in others if target_of(h) in (None, target) and not foreign & set(words_of(h).split())]
    return [h for h in alike if likeness(column, h, cells[h]) >= LEAST_LIKENESS]


def rival_note(column: str, taken: str, others: Sequence[str]) -> str:
    """Note on alternatives to the header taken, with the setting for each."""
    settings = (f"{h!r}: --set {quoted(f'{COLUMNS}{column}={toml_value(h)}')}" for h in others)
    return f"{taken!r} is taken as {column}; if another is meant, {', or '.join(settings)}"


def spare_questions(spare: Mapping[str, str]) -> list[Question]:
    """Optional questions whether to take these headers."""
    text = "is used where it is recorded: header of its column"
    return [Question(COLUMNS + column, f"{column} {text}", toml_value(h), needed=False) for column, h in spare.items()]


def spare_notes(spare: Mapping[str, str]) -> Sequence[str]:
    """Notes on headers left out, with the setting for each."""
    return [
        f"{h!r} is not taken; if it is {column}: --set {quoted(f'{COLUMNS}{column}={toml_value(h)}')}"
        for column, h in spare.items()
    ]
