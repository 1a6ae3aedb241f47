"""Solution of many contacts in parts: parallel or on a cluster, with progress, saved for resumption."""

from __future__ import annotations

import hashlib
import zipfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from mixedlub.ehl.batch import Batch
from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.oil.oil import Oil
from mixedlub.running.atomic import PARTS, whole
from mixedlub.running.cluster import on_cluster
from mixedlub.running.origin import code_fingerprint
from mixedlub.running.parallel import as_done

BATCH = 16
"""Contacts solved together: larger batches fill no processor better, and their matrices exceed its cache."""
Rows = dict[str, np.ndarray]
Solver = Callable[[Contacts], Rows]
"""Results of contacts solved together."""
PRESSURES, TEMPERATURES, STRESSES = (0.0, 3e8, 1e9, 3e9), (280.0, 330.0, 400.0), (1e3, 1e6, 1e7)
"""Pressures (Pa), temperatures (K) and stresses (Pa) at which laws of an oil are identified."""


def run_parts(
    solve: Solver,
    contacts: Contacts,
    *,
    keep: Path | None = None,
    scheduler: str | None = None,
    progress: Callable[[int, int], None] = lambda done, of: None,
) -> Rows:
    """Results of all contacts, computed on this machine or on the workers of a Dask scheduler.

    Parts in the folder ``keep`` are reused; new parts are saved there. ``progress``: called with the numbers of
    completed parts and of all parts.
    """
    count = len(contacts.radius)
    parts = [np.arange(start, min(start + BATCH, count)) for start in range(0, count, BATCH)]
    found = dict(_kept(keep, parts))
    progress(len(found), len(parts))
    todo = [place for place in range(len(parts)) if place not in found]
    for place, rows in _solved(solve, contacts, parts, todo, scheduler):
        found[place] = rows
        if keep is not None:
            keep.mkdir(parents=True, exist_ok=True)
            with whole(_file(keep, place)) as aside, aside.open("wb") as file:
                # Its types take the arrays for the flag beside them.
                np.savez(file, **rows)  # type: ignore[arg-type]
        progress(len(found), len(parts))
    return {name: np.concatenate([found[place][name] for place in range(len(parts))]) for name in found[0]}


def _solved(
    solve: Solver, contacts: Contacts, parts: Sequence[np.ndarray], todo: Sequence[int], scheduler: str | None
) -> Iterator[tuple[int, Rows]]:
    """Numbers and results of parts, in order of completion."""
    if scheduler is not None:
        yield from on_cluster(_one, (solve, contacts, parts), todo, scheduler)
        return
    with threadpool_limits(1):
        for number, rows in as_done(lambda place: _one((solve, contacts, parts), place), todo):
            yield todo[number], rows


def _one(shared: tuple[Solver, Contacts, Sequence[np.ndarray]], place: int) -> Rows:
    """Results of one part."""
    solve, contacts, parts = shared
    return solve(contacts.take(parts[place]))


def _file(folder: Path, place: int) -> Path:
    return folder / f"{place}.npz"


def _kept(folder: Path | None, parts: Sequence[np.ndarray]) -> Iterator[tuple[int, Rows]]:
    """Parts completed by an earlier run."""
    for place, part in enumerate(parts):
        if folder is None or not _file(folder, place).is_file():
            continue
        try:
            with np.load(_file(folder, place)) as rows:
                found = {name: rows[name] for name in rows.files}
        except (OSError, ValueError, zipfile.BadZipFile):
            continue
        if found and all(len(values) == len(part) for values in found.values()):
            yield place, found


def parts_folder(out: Path, oil: Oil, contacts: Contacts, *, thermal: bool) -> Path:
    """Folder next to a result for the parts of these contacts, oil and code."""
    digest = hashlib.sha256(f"{code_fingerprint()}{thermal}".encode())
    for values in (*of_oil(oil), *_of_batch(contacts)):
        digest.update(np.ascontiguousarray(values, dtype=float).tobytes())
    return out / f"{PARTS}{digest.hexdigest()[:16]}"


def _of_batch(batch: Batch) -> Iterator[np.ndarray]:
    for field in fields(batch):
        own: Any = getattr(batch, field.name)
        yield from _of_batch(own) if isinstance(own, Batch) else (own,)


def of_oil(oil: Oil) -> Iterator[np.ndarray]:
    """Numbers that identify an oil: values of its laws, and its constants."""
    pressure, temperature = np.meshgrid(np.array(PRESSURES), np.array(TEMPERATURES))
    with np.errstate(all="ignore"):
        yield from oil.log_viscosity(pressure, temperature)
        yield from oil.density_ratio(pressure, temperature)
        yield oil.expansion(pressure, temperature)
        for stress in STRESSES:
            yield from oil.sheared(np.full_like(pressure, stress), pressure, temperature)
        yield from (oil.stress_scale(pressure), oil.stress_limit(pressure))
    constants = (oil.density, oil.conductivity, oil.heat_capacity, float(oil.newtonian))
    yield np.array(constants)
