"""Readings added to a case: a filled-in file of tests, checked and appended to the recorded rows."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.case.columns import case_columns
from mixedlub.case.folder import RUNS_LISTED, Case
from mixedlub.case.reach import surface_columns
from mixedlub.schema.findings import collected, finding, listed, report
from mixedlub.schema.table import RUN, Column, Table, frame_of, read_table, table_of
from profiles.errors import InputError, nearest

if TYPE_CHECKING:
    from mixedlub.case.folder import Frame

STEP = 1e-6
"""Definition. Distance of two added readings in the programme: they come after it, in their order, at its end."""


def with_added(case: Case, added: Path | Frame) -> tuple[Case, Table]:
    """The case with the readings of a file or data frame appended, and the rows that were added.

    The case keeps its name and files; its recordings are a new table.
    """
    assert case.recordings is not None
    with collected() as notes:
        rows = _read(case, added)
        where = str(added) if isinstance(added, Path) else rows.source
        _check(case, rows, where)
        rows = _filled(case, rows)
    return replace(case, recordings=_joined(case.recordings, rows), notes=(*case.notes, *notes)), rows


def _read(case: Case, added: Path | Frame) -> Table:
    """The table, with the columns of the recording alone; an empty reading is not a number."""
    assert case.recordings is not None
    own = [c for c in case_columns(case.kind, case.system, measured=True) if c.name in case.recordings]
    optional = {"sequence", "rig", "setup", f"{case.quantity}_sd", case.system.recording.check}
    columns = tuple(
        replace(c, required=c.name not in optional, optional_cells=c.optional_cells or _is_read(case, c)) for c in own
    )
    with collected() as ignored:  # unknown columns are refused below
        if isinstance(added, Path):
            rows = read_table(added, columns, imported=True)
        else:
            rows = table_of(frame_of(added, "add"), columns, "add")
    if rows.ignored:
        name, where = rows.ignored[0], str(added) if isinstance(added, Path) else rows.source
        hint = next((one.text.removeprefix("column ignored: ") for one in ignored if name in one.place), "")
        rule = hint or nearest(name, [c.name for c in columns])
        raise InputError(f"is no column of recordings.csv; {rule}", where=f"{where}: header", value=name)
    return rows


def _is_read(case: Case, column: Column) -> bool:
    """Whether a column is read from an instrument, and so left empty in the file to fill in."""
    return column.name in (case.quantity, *(c.name for c in case.kind.instrument_channels))


def _check(case: Case, rows: Table, where: str) -> None:
    """Raise an error for empty readings and repeated runs; report runs outside the reach of the rig."""
    assert case.recordings is not None
    columns = case_columns(case.kind, case.system, measured=True)
    for name in (c.name for c in columns if c.name in rows and _is_read(case, c)):
        empty = rows["run"][~np.isfinite(rows[name])]
        if empty.size:
            runs = listed(empty.tolist(), RUNS_LISTED)
            rule = f"the reading is empty at run {runs}; fill it in, or leave the row out"
            raise InputError(rule, where=f"{where}: {name}")
    again = np.intersect1d(rows["run"], case.recordings["run"])
    if again.size:
        last = int(case.recordings["run"].max())
        rule = f"the recording has this run already; number new readings from {last + 1} on"
        raise InputError(rule, where=f"{where}: {RUN.name}", value=int(again[0]))
    beyond = [f"run {run}: {text}" for run, text in case.reach.beyond(rows, surface_columns(case.kind))]
    if beyond:
        text = f"outside what [rig] says can be set ({'; '.join(beyond[:RUNS_LISTED])}): check these numbers"
        report(finding("added_beyond_rig", text, rows.source))


def _filled(case: Case, rows: Table) -> Table:
    """The rows with the columns of bookkeeping that the recording has and the file leaves out."""
    assert case.recordings is not None
    recorded, count = case.recordings, len(rows)
    filled = dict(rows.columns)
    if "sequence" in recorded and "sequence" not in rows:
        filled["sequence"] = 1.0 - STEP * np.arange(count)[::-1]
    if "rig" in recorded and "rig" not in rows:
        filled["rig"] = np.full(count, whole_rig(case))
    if "setup" in recorded and "setup" not in rows:
        known = set(recorded["setup"].tolist())
        filled["setup"] = np.full(count, next(f"added {n}" for n in range(1, count + 2) if f"added {n}" not in known))
    sd = f"{case.quantity}_sd"
    if sd in recorded and sd not in rows:
        filled[sd] = np.full(count, float(np.median(recorded[sd])))
    check = case.system.recording.check
    if check is not None and check in recorded and check not in rows:
        filled[check] = np.full(count, np.nan)
    return Table(filled, rows.source)


def whole_rig(case: Case) -> str:
    """Most frequent name in the column ``rig`` of readings with the whole rig."""
    assert case.recordings is not None
    names = case.recordings["rig"].tolist()
    whole = [name for name in names if name not in case.kind.part_rigs] or names
    return str(max(set(whole), key=whole.count))


def _joined(recorded: Table, rows: Table) -> Table:
    """Recorded and added rows; added ones follow the others in the programme."""
    columns = {name: np.concatenate([values, rows[name]]) for name, values in recorded.columns.items()}
    if "sequence" in recorded:
        columns["sequence"][: len(recorded)] *= 1.0 - STEP * len(rows)
    return Table(columns, recorded.source, recorded.ignored)
