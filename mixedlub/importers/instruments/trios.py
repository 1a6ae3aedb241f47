"""Text exports of rotational rheometers: steps of tab-separated columns with a line of units."""

from __future__ import annotations

import numpy as np

from mixedlub.importers.base import Answers, Draft, answered_kind, questions_of, read_note, refuse_unknown
from mixedlub.importers.input_file import InputFile
from mixedlub.importers.odd_rows import count, places
from mixedlub.importers.vocabulary import BY_NAME, convert, target_of
from mixedlub.schema.findings import finding
from mixedlub.schema.table import Column
from mixedlub.schema.units import rounded
from profiles.errors import InputError

WANTED = ("temperature_C", "viscosity_mPa_s", "time_s")


def matches(text: str) -> bool:
    """Whether the text is such an export, with steps marked in brackets."""
    return any(line.strip().lower() == "[step]" for line in text.splitlines()[:200])


def draft(file: InputFile, answers: Answers) -> Draft:
    """Draft of a case: viscosity against temperature and time, with the steps in sequence."""
    text, name = file.text, file.name
    refuse_unknown(answers, ())
    answered_kind(answers, ("viscosity",))
    parts: dict[str, list[np.ndarray]] = {w: [] for w in WANTED}
    elapsed, taken, skipped = 0.0, 0, 0
    lost_lines: list[int] = []
    for step in _steps(text):
        values, incomplete = _read(step, name)
        if "viscosity_mPa_s" not in values or "temperature_C" not in values:
            skipped += 1
            continue
        if "time_s" not in values:
            title = next(iter(step.values()))
            raise InputError("a step without a time cannot be put after the one before", where=f"{name}: {title}")
        lost_lines += incomplete
        if not values["time_s"].size:
            continue
        duration = float(values["time_s"][-1])
        values["time_s"] = rounded(values["time_s"] + elapsed, elapsed)
        elapsed += duration
        taken += 1
        for w in WANTED:
            parts[w].append(values[w])
    if not taken:
        raise InputError("no step with viscosity and temperature", where=name)
    columns = {w: np.concatenate(v) for w, v in parts.items()}
    lost_rows = f"{count(len(lost_lines), 'row')} left out, as a value is missing: {places(lost_lines)}"
    steps = f"{taken} steps taken, {skipped} left out; time continues from step to step without the pauses between"
    notes = [*([finding("rows_left_out", lost_rows, name)] if lost_lines else []), read_note(steps, name)]
    return Draft("viscosity", "viscosity_mPa_s", columns, {}, questions_of("viscosity"), tuple(notes))


def _steps(text: str) -> list[dict[int, str]]:
    """Lines of each step by line number in the file."""
    steps: list[dict[int, str]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        if line.strip().lower() == "[step]":
            steps.append({})
        elif steps and line.strip():
            steps[-1][number] = line
    return [lines for lines in steps if len(lines) > 3]


def _read(step: dict[int, str], name: str) -> tuple[dict[str, np.ndarray], list[int]]:
    """Columns of a step in case units (title, headers, units, rows), and lines left out for missing values."""
    lines = list(step.values())
    headers, units = (line.split("\t") for line in lines[1:3])
    rows = {number: line.split("\t") for number, line in list(step.items())[3:]}
    columns: dict[str, np.ndarray] = {}
    for i, header in enumerate(headers):
        target = target_of(header)
        if target is None or target.name not in WANTED:
            continue
        where = f"{name}: {lines[0]}, {header}"
        number = Column(header, optional_cells=True)
        values = np.array(
            [
                number.parse(row[i] if i < len(row) else "", f"{name}: line {line}, {header}")
                for line, row in rows.items()
            ]
        )
        if i >= len(units) or not units[i].strip():
            raise InputError("no unit is given", where=where)
        columns[target.name] = convert(values, units[i], BY_NAME[target.name], where)
    complete = (
        np.all([np.isfinite(values) for values in columns.values()], axis=0) if columns else np.ones(len(rows), bool)
    )
    incomplete = [line for line, is_complete in zip(rows, complete, strict=True) if not is_complete]
    return {column: values[complete] for column, values in columns.items()}, incomplete
