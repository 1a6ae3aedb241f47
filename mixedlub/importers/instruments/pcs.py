"""Text files of PCS Instruments rigs: traction machines and film rigs, step by step."""

from __future__ import annotations

import re
from collections.abc import Sequence, Set
from dataclasses import dataclass, replace
from datetime import datetime

import numpy as np

from mixedlub.importers.answer_keys import COLUMNS
from mixedlub.importers.base import Answers, Draft, Question, answered_kind, questions_of, read_note, refuse_unknown
from mixedlub.importers.column_units import target_for
from mixedlub.importers.input_file import InputFile
from mixedlub.importers.likeness import likely_spread, spare_notes, spare_questions
from mixedlub.importers.odd_rows import count, places
from mixedlub.importers.text_table import not_above_zero
from mixedlub.importers.vocabulary import BY_NAME, convert, target_of
from mixedlub.kinds import kind as kind_of
from mixedlub.schema.cells import is_missing, is_number
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.units import rounded, split
from profiles.errors import InputError, nearest

STEP = re.compile(r'^Step (\d+)(?: "[^"]*")? started at (\d\d/\d\d/\d{4} \d\d:\d\d(?::\d\d)?)')
TYPE = re.compile(r"^Step type\t([^\t]*)(?:\tStep description\t([^\t]*))?")
RECORDED_SHARE = 0.5
"""Judgement. Least share of filled cells of a recorded column."""
TIMED = "TIMED"
"""Suffix of the types of steps at constant conditions."""
SWEPT_RANGE = 0.2
"""Range of the middle 80 % over the largest value above which a condition is swept."""


@dataclass(frozen=True)
class Step:
    """Step with readings: type, start, columns by header (nan for missing values), lines."""

    number: int
    step_type: str
    start: datetime
    columns: dict[str, np.ndarray]
    lines: tuple[int, ...]

    def header(self, target: str) -> str | None:
        """Header of a column; among several, with the fewest gaps, then the later, more precise header."""
        exact = [h for h in self.columns if (t := target_of(h)) is not None and t.name == target]
        return max(exact, key=lambda h: (int(np.isfinite(self.columns[h]).sum()), exact.index(h)), default=None)

    def has(self, target: str) -> bool:
        """Whether the step has a column."""
        return self.header(target) is not None

    def whole(self, target: str) -> bool:
        """Whether the step has a column without gaps."""
        header = self.header(target)
        return header is not None and bool(np.isfinite(self.columns[header]).all())

    def read(self, target: str, name: str) -> np.ndarray:
        """Column in the unit of a case."""
        header = self.header(target)
        assert header is not None
        unit = split(header)[1] or ("-" if BY_NAME[target].unit == "ratio" else None)
        if unit is None:
            raise InputError("header without a unit", where=f"{name}: step {self.number}", value=header)
        return convert(self.columns[header], unit, BY_NAME[target], f"{name}: {header}")

    def varies(self, target: str) -> bool:
        """Whether a condition is swept."""
        header = self.header(target)
        if header is None or self.step_type.endswith(TIMED):
            return False
        values = self.columns[header]
        low, high = np.nanquantile(values, (0.1, 0.9))
        return bool(high - low > SWEPT_RANGE * np.nanmax(np.abs(values)))

    def since(self, first: datetime, name: str) -> np.ndarray:
        """Times of the readings since the start of the first step (s)."""
        before = (self.start - first).total_seconds()
        return rounded(before + self.read("time_s", name), before)


def steps_of(text: str, name: str) -> tuple[Step, ...]:
    """Steps with readings."""
    steps: list[Step] = []
    number, start, step_type = 0, None, ""
    lines = iter(enumerate(text.splitlines(), start=1))
    for header_line, line in lines:
        if begun := STEP.match(line):
            number, start = int(begun.group(1)), _moment(begun.group(2))
        elif typed := TYPE.match(line):
            step_type = typed.group(1).strip().upper()
        elif start is not None and _is_header(line):
            rows = {}
            for row_line, row in lines:
                if not row.strip():
                    break
                rows[row_line] = row.split("\t")
            if rows:
                columns = _columns(line, list(rows.values()), f"{name}: line {header_line}")
                steps.append(Step(number, step_type, start, columns, tuple(rows)))
    return tuple(steps)


def without_gaps(steps: tuple[Step, ...], targets: Sequence[str], name: str) -> tuple[tuple[Step, ...], list[str]]:
    """Steps without readings that lack one of the columns, and a note for every column with gaps."""
    gaps: dict[str, list[int]] = {}
    complete = []
    for step in steps:
        has_all = np.ones(len(step.lines), dtype=bool)
        for header in filter(None, map(step.header, targets)):
            has_value = np.isfinite(step.columns[header])
            has_all &= has_value
            gaps.setdefault(header, []).extend(np.array(step.lines)[~has_value].tolist())
        columns = {h: values[has_all] for h, values in step.columns.items()}
        complete.append(replace(step, columns=columns, lines=tuple(np.array(step.lines)[has_all].tolist())))
    notes = [
        f"{count(len(lines), 'row')} left out, as {header!r} is missing: {places(lines)}"
        for header, lines in gaps.items()
        if lines
    ]
    with_rows = tuple(step for step in complete if step.lines)
    if not with_rows:
        raise InputError(f"no reading is complete: {'; '.join(notes)}", where=name)
    return with_rows, notes


def _moment(text: str) -> datetime:
    return datetime.strptime(text, "%d/%m/%Y %H:%M:%S" if text.count(":") == 2 else "%d/%m/%Y %H:%M")


def _is_header(line: str) -> bool:
    cells = line.split("\t")
    return len(cells) > 5 and sum("(" in cell for cell in cells) > 5


def _columns(header: str, rows: list[list[str]], where: str) -> dict[str, np.ndarray]:
    """Columns of numbers; of a repeated header, the later, more precise column."""
    columns: dict[str, np.ndarray] = {}
    for i, name in enumerate(header.split("\t")):
        cells = [row[i] if i < len(row) else "" for row in rows]
        if not name.strip() or not all(is_missing(cell) or is_number(cell) for cell in cells):
            continue
        values = np.array([np.nan if is_missing(cell) else float(cell) for cell in cells])
        values[~np.isfinite(values)] = np.nan
        earlier = columns.get(name.strip(), np.array([]))
        n_values = int(np.isfinite(values).sum())
        if n_values > RECORDED_SHARE * len(rows) and n_values >= int(np.isfinite(earlier).sum()):
            columns[name.strip()] = values
    if not columns:
        raise InputError("a table without a complete column of numbers", where=where)
    return columns


STEP_COUNT = re.compile(r"^Number of steps (completed|in profile):\t(\d+)", re.MULTILINE)
FILM_TYPES = ("FILM",)
PROBES = {"lube": ("lube temp", "lube rtd temp"), "pot": ("pot temp", "pot rtd temp")}
DISAGREE_K = 10.0
CONDITIONS = ("load_N", "entrainment_speed_m_s", "slide_roll_ratio")
TAKEN = {
    "film": (*CONDITIONS, "film_thickness_nm"),
    "friction_history": (*CONDITIONS, "friction_coefficient"),
    "disc": (*CONDITIONS, "friction_coefficient"),
    "friction_map": ("load_N", "friction_coefficient"),
}
"""Columns of each kind recorded by these rigs, the reading last."""
SWEPT, SLIDING = ("entrainment_speed_m_s", "slide_roll_ratio"), "sliding_speed_m_s"
SWEPT_NOTE = (
    "speeds are swept within the steps, and taken as friction in time; --set 'kind=\"disc\"' takes the film "
    "at each into account, --set 'kind=\"friction_map\"' makes it friction against sliding speed"
)
SWEPT_KIND = Question(
    "kind",
    "Speeds are swept within the steps: kind of recording, friction_history where left open",
    '"disc"',
    needed=False,
    options=("disc", "friction_map", "friction_history"),
)
SURFACES = (
    Question("import.surface_1", "Name of the surface of the ball, as in [surfaces.NAME]", '"ball"', offered=True),
    Question("import.surface_2", "Name of the surface of the disc, as in [surfaces.NAME]", '"disc"', offered=True),
)


def matches(text: str) -> bool:
    """Whether the text is a file of these rigs: steps with a start and a type."""
    return any(STEP.match(line) for line in text.splitlines()[:200]) and "Step type\t" in text


def without_cut_line(text: str) -> tuple[str, int | None]:
    """Text without a truncated last row, and the number of that line or None.

    >>> without_cut_line("a\\t(b)\\tc\\n1\\t2\\t3\\n4\\t5")
    ('a\\t(b)\\tc\\n1\\t2\\t3\\n', 3)
    >>> without_cut_line("1\\t2\\n\\nAll steps completed")
    ('1\\t2\\n\\nAll steps completed', None)
    """
    before, end, last = text.rpartition("\n")
    row = before.rpartition("\n")[2]
    if not last.strip() or last.count("\t") >= row.count("\t") or not re.match(r"[-+\d.\t]", last):
        return text, None
    return before + end, text.count("\n") + 1


def _incomplete(text: str, name: str, cut: int | None) -> tuple[Finding, ...]:
    """Findings on missing steps, by the count in the file header, and on a truncated row."""
    stated = {which: int(count) for which, count in STEP_COUNT.findall(text)}
    expected = stated.get("completed", stated.get("in profile", 0))
    n_steps = sum(bool(STEP.match(line)) for line in text.splitlines())
    notes = []
    if n_steps < expected:
        text = f"holds {n_steps} of the {expected} steps that its header counts; the rest is missing"
        notes.append(finding("file_incomplete", text, name))
    if cut is not None:
        text = f"line {cut} breaks off at the end of the file and is left out"
        notes.append(finding("file_incomplete", text, name))
    return tuple(notes)


def draft(file: InputFile, answers: Answers) -> Draft:
    """Draft of a case: film against speed, or friction against time, conditions or sliding speed."""
    name = file.name
    text, cut = without_cut_line(file.text)
    incomplete = _incomplete(text, name, cut)
    steps = steps_of(text, name)
    kind, offered = _kind(steps, answers)
    quantity = TAKEN[kind][-1]
    sd_key = f"{COLUMNS}{quantity}_sd"
    refuse_unknown(answers, ("import.temperature", sd_key, *(q.key for q in SURFACES if kind == "disc")))
    if answers.get("recording.quantity", quantity) != quantity:
        rule = f"a case of kind {kind!r} from this rig records {quantity}"
        raise InputError(rule, where="recording.quantity", value=answers["recording.quantity"])
    chosen = _chosen(steps, kind)
    if not chosen:
        rule = f"no step with {'films' if kind == 'film' else 'films or friction coefficients'}"
        raise InputError("; ".join([rule, *map(str, incomplete)]), where=name)
    types = " and ".join(dict.fromkeys(s.step_type for s in chosen))
    notes = [read_note(f"{len(chosen)} of {len(steps)} steps with readings taken, of type {types}", name)]
    first = min(s.start for s in chosen)
    chosen, gaps = without_gaps(chosen, [*TAKEN[kind], *_further(chosen, kind)], name)
    columns = {w: _joined(chosen, w, name) for w in TAKEN[kind] if all(s.has(w) for s in chosen)}
    if kind == "film" and all(s.whole("fringe_order") for s in chosen):
        columns["fringe_order"] = _joined(chosen, "fringe_order", name)
    if kind == "friction_history":
        columns = {"time_s": np.concatenate([s.since(first, name) for s in chosen]), **columns}
    if kind == "friction_map":
        columns = {"sliding_speed_m_s": _sliding_speed(chosen, name), **columns}
    temperature, questions, probe_notes = _temperature(chosen, name, answers)
    spread, offers, spread_notes = _spread(chosen, quantity, name, answers)
    columns.update({**temperature, **spread})
    if kind == "disc":
        _refuse_absent({*columns, *(["oil_temperature_C"] if questions else [])}, name)
        columns.update(
            {
                q.key.removeprefix("import."): np.full(len(columns[quantity]), str(answers[q.key]))
                for q in SURFACES
                if q.key in answers
            }
        )
        questions = (*SURFACES, *questions)
    notes += [read_note(SWEPT_NOTE, name)] if offered else []
    is_point_contact = kind in ("film", "disc") or any(key.startswith("contact.") for key in answers)
    system = {"contact": {"geometry": "point"}} if is_point_contact else {}
    warned = [finding("rows_left_out", gap, name) for gap in gaps]
    lines = [line for s in chosen for line in s.lines]
    signed = not kind_of(kind).is_unsigned(quantity)
    not_positive = [] if signed else not_above_zero(quantity, columns[quantity].tolist(), lines)
    every = (
        *incomplete,
        *warned,
        *spread_notes,
        *notes,
        *probe_notes,
        *(read_note(text, name) for text in not_positive),
    )
    return Draft(kind, quantity, columns, system, (*questions, *offers, *questions_of(kind), *offered), every)


def _kind(steps: Sequence[Step], answers: Answers) -> tuple[str, tuple[Question, ...]]:
    """Kind from the answers or the steps; other kinds are offered if speeds are swept.

    With a described contact, friction at swept speeds is taken as measured with a ball on a disc.
    """
    kind = answered_kind(answers, TAKEN)
    if kind is not None:
        return kind, ()
    if _chosen(steps, "film"):
        return "film", ()
    if not any(s.varies(w) for s in _chosen(steps, "friction_history") for w in SWEPT):
        return "friction_history", ()
    return ("disc", ()) if "contact.radius_mm" in answers else ("friction_history", (SWEPT_KIND,))


def _chosen(steps: Sequence[Step], kind: str) -> tuple[Step, ...]:
    """Steps used for a kind; for a kind against conditions, the steps that sweep them."""
    if kind == "film":
        return tuple(s for s in steps if s.step_type in FILM_TYPES and s.has("film_thickness_nm"))
    frictions = tuple(s for s in steps if s.has("friction_coefficient"))
    if kind == "friction_history":
        return _most_common(tuple(s for s in frictions if s.has("time_s")))
    return tuple(s for s in frictions if any(s.varies(w) for w in SWEPT)) or _most_common(frictions)


def _further(chosen: Sequence[Step], kind: str) -> tuple[str, ...]:
    """Columns needed for a kind besides the columns taken unchanged."""
    if kind == "friction_map":
        return (SLIDING,) if all(s.has(SLIDING) for s in chosen) else SWEPT
    return ("time_s",) if kind == "friction_history" else ()


def _most_common(steps: tuple[Step, ...]) -> tuple[Step, ...]:
    """Steps of the type with most readings, the purpose of the test."""
    if not steps:
        return ()
    types = [s.step_type for s in steps for _ in s.lines]
    most_common = max(sorted(set(types)), key=types.count)
    return tuple(s for s in steps if s.step_type == most_common)


def _joined(chosen: Sequence[Step], target: str, name: str) -> np.ndarray:
    return np.concatenate([s.read(target, name) for s in chosen])


def _sliding_speed(chosen: Sequence[Step], name: str) -> np.ndarray:
    """Sliding speed as recorded, or else slide-roll ratio times mean speed."""
    if all(s.has(SLIDING) for s in chosen):
        return _joined(chosen, SLIDING, name)
    if not all(s.has(w) for s in chosen for w in SWEPT):
        raise InputError("the steps hold no sliding speed, which a case of kind 'friction_map' needs", where=name)
    mean, ratio = (_joined(chosen, w, name) for w in SWEPT)
    return rounded(mean * ratio)


def _spread(
    chosen: Sequence[Step], quantity: str, name: str, answers: Answers
) -> tuple[dict[str, np.ndarray], Sequence[Question], Sequence[Finding]]:
    """Standard deviation of the reading under the answered header, or a question on a likely header."""
    column = f"{quantity}_sd"
    target, named = target_for(column), answers.get(COLUMNS + column)
    reading = chosen[0].header(quantity)
    assert target is not None
    assert reading is not None
    in_all_steps = [h for h in chosen[0].columns if all(h in s.columns for s in chosen)]
    if named is None:
        # Standard deviations of single readings are all zero.
        scattered: dict[str, list[str]] = {
            h: [] for h in in_all_steps if any(np.any(s.columns[h] > 0.0) for s in chosen)
        }
        header = likely_spread(BY_NAME[quantity], reading, scattered)
        spare = {} if header is None else {column: header}
        notes = [finding("column_not_taken", text, name) for text in spare_notes(spare)]
        return {}, spare_questions(spare), notes
    if named not in in_all_steps:
        raise InputError(f"no such header; {nearest(str(named), in_all_steps)}", where=COLUMNS + column, value=named)
    unit = split(str(named))[1] or ("-" if target.unit == "ratio" else "?")
    values = convert(np.concatenate([s.columns[named] for s in chosen]), unit, target, f"{name}: {named}")
    return {column: values}, (), [read_note(f"{named!r} taken as {column}", name)]


def _refuse_absent(columns: Set[str], name: str) -> None:
    absent = [w for w in (*CONDITIONS, "oil_temperature_C") if w not in columns]
    if absent:
        raise InputError(f"the steps hold no {', '.join(absent)}, which a case of kind 'disc' needs", where=name)


def _temperature(
    chosen: tuple[Step, ...], name: str, answers: Answers
) -> tuple[dict[str, np.ndarray], tuple[Question, ...], tuple[Finding, ...]]:
    """Oil temperature from the probe in the oil; a question if the two probes disagree."""
    probes: dict[str, np.ndarray] = {}
    for probe, words in PROBES.items():
        headers = [[h for h, v in s.columns.items() if split(h)[0] in words and np.isfinite(v).all()] for s in chosen]
        if all(headers):
            probes[probe] = np.concatenate(
                [
                    convert(s.columns[h[0]], split(h[0])[1] or "?", BY_NAME["oil_temperature_C"], f"{name}: {h[0]}")
                    for s, h in zip(chosen, headers, strict=True)
                ]
            )
    if not probes:
        return {}, (), ()
    probe_named = str(answers.get("import.temperature", ""))
    if probe_named:
        if probe_named not in probes:
            raise InputError(f"must be one of {', '.join(probes)}", where="import.temperature", value=probe_named)
        return (
            {"oil_temperature_C": probes[probe_named]},
            (),
            (read_note(f"temperature of the {probe_named} probe taken", name),),
        )
    if len(probes) == 2 and abs(np.median(probes["lube"]) - np.median(probes["pot"])) > DISAGREE_K:
        median = {p: float(np.median(v)) for p, v in probes.items()}
        text = (
            f"Probe in the oil reads {median['lube']:.0f} degC, the pot {median['pot']:.0f} degC: which one is right "
            "(lube or pot)"
        )
        return {}, (Question("import.temperature", text, '"pot"'),), ()
    probe = "lube" if "lube" in probes else "pot"
    return {"oil_temperature_C": probes[probe]}, (), (read_note(f"temperature of the {probe} probe taken", name),)
