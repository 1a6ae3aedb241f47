"""Text files of PCS Instruments rigs: mini and extreme traction machines, film rigs."""

from __future__ import annotations

import re
from dataclasses import dataclass
from datetime import datetime

import numpy as np

from mixedlub.headers import BY_NAME, convert, rounded, split, target_of
from mixedlub.importers.draft import WARNING, Answers, Draft, Question, questions_of, refuse_unknown
from profiles.errors import InputError

STEP = re.compile(r'^Step (\d+)(?: "[^"]*")? started at (\d\d/\d\d/\d{4} \d\d:\d\d(?::\d\d)?)')
SAID = re.compile(r"^Number of steps (completed|in profile):\t(\d+)", re.MULTILINE)
TYPE = re.compile(r"^Step type\t([^\t]*)(?:\tStep description\t([^\t]*))?")
FILM_TYPES = ("FILM",)
PROBES = {"lube": ("lube temp", "lube rtd temp"), "pot": ("pot temp", "pot rtd temp")}
DISAGREE_K = 10.0


@dataclass(frozen=True)
class Step:
    """One step with readings: its type, its start, its columns by header."""

    number: int
    form: str
    start: datetime
    columns: dict[str, np.ndarray]


def matches(text: str) -> bool:
    """Whether the text is a file of these rigs: steps with a start and a type."""
    return any(STEP.match(line) for line in text.splitlines()[:200]) and "Step type\t" in text


def steps(text: str, name: str) -> tuple[Step, ...]:
    """The steps that hold readings."""
    found: list[Step] = []
    number, start, form = 0, None, ""
    lines = iter(enumerate(text.splitlines(), start=1))
    for place, line in lines:
        if begun := STEP.match(line):
            number, start = int(begun.group(1)), _moment(begun.group(2))
        elif typed := TYPE.match(line):
            form = typed.group(1).strip().upper()
        elif start is not None and _is_header(line):
            rows = []
            for _, row in lines:
                if not row.strip():
                    break
                rows.append(row.split("\t"))
            if rows:
                found.append(Step(number, form, start, _columns(line, rows, f"{name}: line {place}")))
    return tuple(found)


def without_cut_line(text: str) -> tuple[str, int | None]:
    """The text less a row that breaks off at its end, and the number of that line where there is one.

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


def _lost(text: str, name: str, cut: int | None) -> tuple[str, ...]:
    """What the file's own header counts and the file does not hold."""
    said = {which: int(count) for which, count in SAID.findall(text)}
    expected = said.get("completed", said.get("in profile", 0))
    held = sum(bool(STEP.match(line)) for line in text.splitlines())
    notes = []
    if held < expected:
        notes.append(
            f"{WARNING}{name}: holds {held} of the {expected} steps that its header counts; the rest is missing"
        )
    if cut is not None:
        notes.append(f"{WARNING}{name}: line {cut} breaks off at the end of the file and is left out")
    return tuple(notes)


def _moment(text: str) -> datetime:
    return datetime.strptime(text, "%d/%m/%Y %H:%M:%S" if text.count(":") == 2 else "%d/%m/%Y %H:%M")


def _is_header(line: str) -> bool:
    cells = line.split("\t")
    return len(cells) > 5 and sum("(" in cell for cell in cells) > 5


def _columns(header: str, rows: list[list[str]], where: str) -> dict[str, np.ndarray]:
    """Columns that hold numbers; of a header that comes twice the later, more precise one."""
    found: dict[str, np.ndarray] = {}
    for i, name in enumerate(header.split("\t")):
        cells = [row[i].strip() if i < len(row) else "" for row in rows]
        if not name.strip() or not any(cells):
            continue
        try:
            values = np.array([float(cell) if cell else np.nan for cell in cells])
        except ValueError:
            continue
        if np.isfinite(values).all():
            found[name.strip()] = values
    if not found:
        raise InputError("a table without a complete column of numbers", where=where)
    return found


def draft(text: str, name: str, answers: Answers) -> Draft:
    """The case that a file makes: a film against speed, or friction against time."""
    refuse_unknown(answers, ("import.temperature",))
    text, cut = without_cut_line(text)
    lost = _lost(text, name, cut)
    held = steps(text, name)
    films = tuple(s for s in held if s.form in FILM_TYPES and _has(s, "film_thickness_nm"))
    frictions = tuple(s for s in held if _has(s, "friction_coefficient") and _has(s, "time_s"))
    kind = "film" if films else "friction_history"
    chosen = films or _most_common(frictions)
    if not chosen:
        rule = "no step with films or friction coefficients"
        raise InputError("; ".join([rule, *(note.removeprefix(WARNING) for note in lost)]), where=name)
    quantity = "film_thickness_nm" if kind == "film" else "friction_coefficient"
    wanted = ["load_N", "entrainment_speed_m_s", "slide_roll_ratio", quantity]
    if kind == "film":
        wanted.append("fringe_order")
    columns = {
        w: np.concatenate([_read(s, w, name) for s in chosen]) for w in wanted if all(_has(s, w) for s in chosen)
    }
    notes = [f"{name}: {len(chosen)} of {len(held)} steps with readings taken, of type {chosen[0].form}"]
    if kind == "friction_history":
        first = min(s.start for s in chosen)
        columns = {
            "time_s": np.concatenate([_since(first, s, name) for s in chosen]),
            **columns,
        }
    temperature, questions, said = _temperature(chosen, name, answers)
    columns.update(temperature)
    system = {"contact": {"geometry": "point"}} if kind == "film" else {}
    told = (*lost, *notes, *said, *_odd(columns, quantity))
    return Draft(kind, quantity, columns, system, (*questions, *questions_of(kind)), told)


def _since(first: datetime, step: Step, name: str) -> np.ndarray:
    """Seconds of a step's readings since the start of the first step."""
    before = (step.start - first).total_seconds()
    return rounded(before + _read(step, "time_s", name), before)


def _most_common(found: tuple[Step, ...]) -> tuple[Step, ...]:
    """The steps of the type that holds most readings: what the test was run for."""
    if not found:
        return ()
    forms = [s.form for s in found for _ in s.columns[next(iter(s.columns))]]
    main = max(sorted(set(forms)), key=forms.count)
    return tuple(s for s in found if s.form == main)


def _header(step: Step, target: str) -> str | None:
    exact = [h for h in step.columns if (t := target_of(h)) is not None and t.name == target]
    return exact[-1] if exact else None


def _has(step: Step, target: str) -> bool:
    return _header(step, target) is not None


def _read(step: Step, target: str, name: str) -> np.ndarray:
    header = _header(step, target)
    assert header is not None
    unit = split(header)[1] or ("-" if BY_NAME[target].unit == "ratio" else None)
    if unit is None:
        raise InputError("header without a unit", where=f"{name}: step {step.number}", value=header)
    return convert(step.columns[header], unit, BY_NAME[target], f"{name}: {header}")


def _temperature(
    chosen: tuple[Step, ...], name: str, answers: Answers
) -> tuple[dict[str, np.ndarray], tuple[Question, ...], tuple[str, ...]]:
    """Oil temperature by the probe in the oil; a question where the two probes tell different stories."""
    probes: dict[str, np.ndarray] = {}
    for probe, words in PROBES.items():
        headers = [[h for h in s.columns if split(h)[0] in words] for s in chosen]
        if all(headers):
            probes[probe] = np.concatenate(
                [
                    convert(s.columns[h[0]], split(h[0])[1] or "?", BY_NAME["oil_temperature_C"], f"{name}: {h[0]}")
                    for s, h in zip(chosen, headers, strict=True)
                ]
            )
    if not probes:
        return {}, (), ()
    asked = str(answers.get("import.temperature", ""))
    if asked:
        if asked not in probes:
            raise InputError(f"must be one of {', '.join(probes)}", where="import.temperature", value=asked)
        return {"oil_temperature_C": probes[asked]}, (), (f"{name}: temperature of the {asked} probe taken",)
    if len(probes) == 2 and abs(np.median(probes["lube"]) - np.median(probes["pot"])) > DISAGREE_K:
        middle = {p: float(np.median(v)) for p, v in probes.items()}
        text = (
            f"Probe in the oil reads {middle['lube']:.0f} degC, the pot {middle['pot']:.0f} degC: which one is right "
            "(lube or pot)"
        )
        return {}, (Question("import.temperature", text, '"pot"'),), ()
    probe = "lube" if "lube" in probes else "pot"
    return {"oil_temperature_C": probes[probe]}, (), (f"{name}: temperature of the {probe} probe taken",)


def _odd(columns: dict[str, np.ndarray], quantity: str) -> tuple[str, ...]:
    """Readings that the instrument itself cannot mean."""
    bad = int((columns[quantity] <= 0).sum())
    return (f"{bad} readings of {quantity} are zero or below",) if bad else ()
