"""A case folder: description of the rig, its recordings, and the conditions to predict."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from mixedlub.case.columns import case_columns
from mixedlub.case.import_file import read_import_file
from mixedlub.case.missing_part import MissingPart, table_columns
from mixedlub.case.reach import Reach, reach_of
from mixedlub.chain.effect import Effect
from mixedlub.full_base.words import WORDS
from mixedlub.kinds import Kind, kind
from mixedlub.own_laws import as_hypothesis, by_id, distinct, read_laws
from mixedlub.rig.rig import Rig
from mixedlub.running.shell import quoted
from mixedlub.schema import system_file, toml_file
from mixedlub.schema.findings import Finding, collected, finding, listed, report
from mixedlub.schema.shown import Summarised, span
from mixedlub.schema.table import (
    BOOKKEEPING,
    RUN,
    Column,
    Table,
    frame_of,
    read_table,
    table_of,
)
from profiles.errors import InputError, as_path, nearest

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import ArrayLike

    Frame: TypeAlias = pd.DataFrame | Mapping[str, ArrayLike]

SUMMARY_WIDTH = 80
"""Characters of the summary of a table."""
HYPOTHESES = "hypotheses"
"""Folder of a case with laws that compete with the catalogue."""
RUNS_LISTED = 5
"""Largest number of runs that a note lists."""


@dataclass(frozen=True)
class Case(Summarised):
    """Everything in a case folder, checked. ``laws``: laws of the user by id, of which the ``hypotheses`` compete with
    the catalogue and the others are named in ``[effects]``. It prints as a summary:

    >>> import mixedlub as ml
    >>> drive = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm"}}
    >>> rows = {"speed_rpm": [100.0, 200.0, 300.0], "friction_torque_Nm": [0.51, 0.62, 0.69]}
    >>> ml.case.case_of(drive, rows, name="joint")
    Case 'joint': friction_map, recorded quantity friction_torque_Nm
      recordings: 3 rows; speed_rpm 100 to 300; friction_torque_Nm 0.51 to 0.69
      conditions: none
    """

    name: str
    folder: Path
    system: system_file.System
    kind: Kind
    rig: Rig
    recordings: Table | None
    conditions: Table | None
    notes: tuple[Finding, ...]
    laws: Mapping[str, Effect] = field(default_factory=dict)
    hypotheses: tuple[str, ...] = ()
    reach: Reach = field(default_factory=Reach)
    missing: MissingPart | None = None

    def __repr__(self) -> str:
        tables = {"recordings": self.recordings, "conditions": self.conditions}
        lines = [f"Case {self.name!r}: {self.kind.name}, recorded quantity {self.quantity}"]
        lines += [f"{name}: {'none' if table is None else _summary(table)}" for name, table in tables.items()]
        lines += [f"notes: {listed([one.code for one in self.notes])}"] if self.notes else []
        return "\n  ".join(lines)

    @property
    def quantity(self) -> str:
        """Name of the recorded column, with its unit."""
        return self.system.recording.quantity

    @property
    def base_model(self) -> str:
        """The base model as text."""
        return self.kind.base_model if self.system.base == "formulas" else WORDS

    @property
    def is_filed(self) -> bool:
        """Whether it was read from its folder, and not made of tables in memory."""
        return self.recordings is not None and self.recordings.source == "recordings.csv"


def _summary(table: Table) -> str:
    """Rows and columns of a table in one line; the last columns are left out if too long."""
    spans = [span(name, values) for name, values in table.columns.items() if name != RUN.name]
    text = f"{len(table)} rows"
    for number, one in enumerate(spans):
        if len(text) + len(one) > SUMMARY_WIDTH:
            return f"{text} and {len(spans) - number} more columns"
        text += f"; {one}"
    return text


def read_case(folder: Path, *, need_recordings: bool = True) -> Case:
    """Read and check a case folder."""
    if not folder.is_dir():
        raise InputError("no such case folder", where=str(folder))
    file = folder / "system.toml"
    system = toml_file.parse(system_file.System, toml_file.read_toml(file), str(file))

    def table(name: str, columns: tuple[Column, ...]) -> Table | None:
        path = folder / f"{name}.csv"
        if path.exists():
            return read_table(path, columns, imported=True)
        if name == "conditions" or not need_recordings:
            return None
        raise InputError(f"no such file{other_recordings(folder)}", where=str(path))

    hypotheses = sorted((folder / HYPOTHESES).glob("*.toml"))
    headers = header_of(folder, ("recordings", "conditions"))
    found = _checked(folder.resolve().name, folder, system, str(file), table, headers, hypotheses)
    return replace(found, notes=(*read_import_file(folder), *found.notes))


@contextmanager
def _in_file(where: str) -> Iterator[None]:
    """Add the file to errors about its keys."""
    try:
        yield
    except InputError as error:
        raise InputError(error.rule, where=f"{where}: {error.where}", value=error.value) from None


def check_rows(found: Kind, system: system_file.System, folder: Path, table: Table, recorded: Table | None) -> None:
    """Raise the error of the kind about the rows of a table, with the folder."""
    try:
        found.check(system, table, recorded)
    except InputError as error:
        raise InputError(error.rule, where=str(folder / error.where), value=error.value) from None


def header_of(folder: Path, names: Sequence[str]) -> list[str]:
    """Columns of the first of these tables that is a text file; none if its reading will report an error."""
    for name in names:
        path = folder / f"{name}.csv"
        if path.is_file():
            with path.open(encoding="utf-8-sig", errors="replace") as lines:
                return [cell.strip() for cell in next(csv.reader(lines), [])]
    return []


def other_recordings(folder: Path) -> str:
    """Hint on a file of recordings in another format, with the command that makes its table and keeps the rest of the
    case; else empty."""
    others = [p for p in sorted(folder.glob("*")) if p.name.lower().startswith("recordings.") and p.is_file()]
    if not others:
        return ""
    (file, *_), case = others, quoted(str(folder))
    command = f"mixedlub import {quoted(str(file))} --out {case} --answers {case}/system.toml --overwrite"
    return f"; {file.name} is there, and `{command}` makes recordings.csv of it"


def case_of(
    system: Mapping[str, Any],
    recordings: Frame,
    conditions: Frame | None = None,
    *,
    name: str = "case",
    folder: str | Path = ".",
    hypotheses: Sequence[str | Path] = (),
) -> Case:
    """A case from the sections of its system and from data frames (or lists by column), checked like a case folder.

    Files that the system names, such as traces, are read relative to ``folder``. ``hypotheses``: law files that compete
    with the catalogue in a diagnosis.

    >>> import mixedlub as ml, pandas as pd
    >>> drive = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm"}}
    >>> rows = pd.DataFrame({"speed_rpm": [100.0, 200.0, 300.0], "friction_torque_Nm": [0.51, 0.62, 0.69]})
    >>> len(ml.case.case_of(drive, rows).recordings)
    3
    """
    if not isinstance(system, Mapping):
        raise InputError("must be a table of keys", where=f"{name}: system", value=system)
    frames = {"recordings": frame_of(recordings, "recordings")}
    if conditions is not None:
        frames["conditions"] = frame_of(conditions, "conditions")

    def table(which: str, columns: tuple[Column, ...]) -> Table | None:
        return table_of(frames[which], columns, which) if which in frames else None

    parsed = toml_file.parse(system_file.System, {"schema": "mixedlub-case/1", **system}, name)
    headers = list(map(str, frames["recordings"].columns))
    return _checked(name, Path(folder), parsed, name, table, headers, hypotheses)


def _checked(
    name: str,
    folder: Path,
    system: system_file.System,
    where: str,
    table: Callable[[str, tuple[Column, ...]], Table | None],
    headers: Sequence[str],
    hypotheses: Sequence[str | Path],
) -> Case:
    """The checked case of a parsed system; ``table`` returns its recordings or conditions for the allowed columns, and
    ``headers`` are the columns of its recordings."""
    named = kind(system.kind)
    with _in_file(where):
        found = named.of_case(system, headers)
    for section in found.sections:
        if not getattr(system, section):
            raise InputError(f"a case of kind {system.kind!r} needs the section [{section}]", where=where)
    quantity = system.recording.quantity
    if quantity not in found.quantities:
        raise InputError(
            f"a case of kind {system.kind!r} records {' or '.join(found.quantities)}",
            where=f"{where}: recording.quantity",
            value=quantity,
        )
    reach = reach_of(system, found, where)
    with collected() as notes:
        recordings = table("recordings", case_columns(found, system, True))
        if recordings is not None:
            _refuse_stuck(recordings, quantity, folder)
            check_rows(found, system, folder, recordings, None)
            recordings = _with_filled_sds(recordings, f"{quantity}_sd")
        _report_missing_check(system.recording.check, recordings)
        conditions = table("conditions", case_columns(found, system, False))
        conditions = None if conditions is None else _with_filled_sds(conditions, f"{quantity}_sd")
        if conditions is not None and recordings is not None:
            check_rows(found, system, folder, conditions, recordings)
        missing = _missing_part(folder, system, found)
    effects, laws = by_id(system.effects, folder, found.numbers)
    if laws:
        system = system.model_copy(update={"effects": effects})
    rows = recordings or conditions
    if rows is not None and "shear_stress" in dict(found.chain(system, rows)):
        system = _with_traction(system, notes)
    rig = Rig(system, folder, found.unread_of_oil)
    if system.base != "formulas":
        from mixedlub.case.full_base import refuse

        refuse(found, system, rig, (recordings, conditions))
    case = Case(
        name, folder, system, found, rig, recordings, conditions, tuple(notes), laws, reach=reach, missing=missing
    )
    return with_hypotheses(case, hypotheses)


def _with_traction(system: system_file.System, notes: list[Finding]) -> system_file.System:
    """System with the traction part of its oil as known effects, and the uncertainty of its Eyring stress."""
    part = None if system.lubricant is None else system.lubricant.traction
    if part is None:
        return system
    notes += part.told(system.effects.keys())
    stress, sds = part.eyring_stress_MPa, system.uncertainty
    if sds.eyring_stress == 0.0 and stress.sd > 0.0:
        sds = sds.model_copy(update={"eyring_stress": stress.sd / stress.value})
    effects = {} if system.base != "formulas" else part.effects(uncertain=True)
    return system.model_copy(update={"effects": {**effects, **system.effects}, "uncertainty": sds})


def with_hypotheses(case: Case, paths: Sequence[str | Path]) -> Case:
    """The case with further law files that compete with the catalogue."""
    files = [as_path(one, "hypotheses") for one in paths]
    rivals = {name: as_hypothesis(law) for name, law in read_laws(files, case.kind.numbers).items()}
    laws = distinct([*case.laws.values(), *rivals.values()])
    return replace(case, laws=laws, hypotheses=(*case.hypotheses, *rivals))


def _missing_part(folder: Path, system: system_file.System, found: Kind) -> MissingPart | None:
    """The table that the system names for the part that the model lacks."""
    if system.missing_part is None:
        return None
    path = toml_file.named_file(folder, system.missing_part, "missing_part")
    return MissingPart(read_table(path, table_columns(found), key=()), found.part_rigs).checked(str(path))


def read_conditions(case: Case, path: Path) -> Table:
    """Another table of conditions for the case; without a column ``run``, rows are numbered after the recorded runs."""
    columns = case_columns(case.kind, case.system, False)
    found = read_table(path, columns, first_run=_free_run(case), imported=True)
    if case.recordings is not None:
        check_rows(case.kind, case.system, path.parent, found, case.recordings)
    return _with_filled_sds(found, f"{case.quantity}_sd")


def conditions_for(case: Case, at: Frame) -> Table:
    """Conditions to predict from a data frame; without a column ``run``, numbered after the recorded runs."""
    frame = frame_of(at, "conditions")
    if RUN.name not in frame:
        first = _free_run(case)
        frame = frame.assign(run=np.arange(first, first + len(frame)))
    wanted = table_of(frame, case_columns(case.kind, case.system, False), "conditions")
    if case.recordings is not None:
        check_rows(case.kind, case.system, case.folder, wanted, case.recordings)
    refuse_used_runs(case, wanted, Path(wanted.source))
    return wanted


def unpredicted_runs(case: Case, wanted: Table | None) -> list[Finding]:
    """Report conditions with the run number of a reading at other conditions; they are not predicted."""
    runs = _used_runs(case, wanted)
    if wanted is None or not runs:
        return []
    text = f"not predicted, as readings at other conditions have the same run numbers: {', '.join(map(str, runs))}"
    return [finding("run_number_reused", text, wanted.source)]


def refuse_used_runs(case: Case, wanted: Table | None, path: Path) -> None:
    """Raise an error for conditions with the run number of a reading at other conditions."""
    used = _used_runs(case, wanted)
    if used:
        rule = f"the run number is that of a reading at other conditions; number them from {_free_run(case)} on"
        raise InputError(rule, where=f"{path}: run", value=used[0] if len(used) == 1 else used[:RUNS_LISTED])


def _free_run(case: Case) -> int:
    """First number after the recorded runs."""
    return 1 if case.recordings is None else int(case.recordings["run"].max()) + 1


def _used_runs(case: Case, wanted: Table | None) -> list[int]:
    if wanted is None or case.recordings is None:
        return []
    rows = case.recordings
    _, here, there = np.intersect1d(wanted["run"], rows["run"], return_indices=True)
    shared = (*(c.name for c in BOOKKEEPING), *(c.name for c in case.kind.columns))
    names = [name for name in shared if name in wanted and name in rows]
    other = np.any([wanted[name][here] != rows[name][there] for name in names], axis=0)
    return [int(run) for run in wanted["run"][here][other]]


def at_programme_end(case: Case, wanted: Table) -> Table:
    """Conditions to predict, at the end of the test programme if they have no place in it."""
    if case.recordings is None or "sequence" in wanted or "sequence" not in case.recordings:
        return wanted
    text = "no column sequence: predicted for the end of the test programme"
    report(finding("sequence_assumed", text, wanted.source))
    return replace(wanted, columns={**wanted.columns, "sequence": np.ones(len(wanted))})


def _refuse_stuck(recordings: Table, quantity: str, folder: Path) -> None:
    """Raise an error for a recorded channel with all readings equal."""
    if np.ptp(recordings[quantity]) == 0 and len(recordings) > 2:
        raise InputError(
            "all readings are the same number; a stuck channel cannot be diagnosed",
            where=f"{folder / recordings.source}: {quantity}",
            value=float(recordings[quantity][0]),
        )


def _report_missing_check(name: str | None, recordings: Table | None) -> None:
    """Report a check channel that is not a column of the recording."""
    if name is None or recordings is None or name in recordings:
        return
    there = nearest(name, [*recordings.columns, *recordings.ignored])
    text = f"{name!r}: no such column in {recordings.source}, so nothing is compared with it; {there}"
    report(finding("check_column_missing", text, "system.toml, recording.check"))


def _with_filled_sds(table: Table, name: str) -> Table:
    """The table with missing or zero standard deviations replaced by the median of the others."""
    if name not in table:
        return table
    known = table[name] > 0.0
    if known.all():
        return table
    if not known.any():
        text = "0 or left out everywhere, so it says nothing of the scatter of a reading and is ignored"
        report(finding("sd_missing", text, f"{table.source}, {name}"))
        return replace(table, columns={k: v for k, v in table.columns.items() if k != name})
    runs = listed(table["run"][~known].tolist(), RUNS_LISTED)
    middle = float(np.median(table[name][known]))
    text = f"0 or left out at run {runs}: taken as the median of the others, {middle:.3g}"
    report(finding("sd_filled", text, f"{table.source}, {name}"))
    return replace(table, columns={**table.columns, name: np.where(known, table[name], middle)})


__all__ = ["Case", "case_of", "read_case", "read_conditions", "refuse_used_runs", "unpredicted_runs"]
