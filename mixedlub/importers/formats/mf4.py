"""Measurement files of ASAM (.mf4, .mdf), read by the package asammdf: groups of channels with units and clocks."""

from __future__ import annotations

import io
import logging
from collections.abc import Iterator
from typing import Any

import numpy as np

from mixedlub.importers.measured import MeasuredTable, named, refuse_without, tables_of
from profiles.errors import InputError
from profiles.readers.base import foreign_parser


def matches(data: bytes) -> bool:
    """Whether the bytes are a file of the ASAM measurement data format."""
    return data[:8] in (b"MDF     ", b"UnFinMF ")


def tables(data: bytes, where: str) -> list[MeasuredTable]:
    """Tables of the channel groups, each with its time."""
    try:
        from asammdf import MDF
    except ImportError:
        raise refuse_without("asammdf", "a measurement file of ASAM (.mf4, .mdf)", where) from None
    if b"HD" not in data[64:68]:
        raise InputError("damaged MDF file: no header block", where=where)
    logging.getLogger("asammdf").setLevel(logging.ERROR)
    with foreign_parser("MDF", where), MDF(io.BytesIO(data)) as file:
        names = [getattr(group.channel_group, "acq_name", "") for group in file.groups]
        shown = [name if name and names.count(name) == 1 else f"group {n}" for n, name in enumerate(names, start=1)]
        return tables_of([one for number, name in enumerate(shown) for one in _channels(file, number, name)])


def _channels(file: Any, number: int, table: str) -> Iterator[tuple[str, str, np.ndarray]]:
    """Channels of a group with its time."""
    group, timed = file.groups[number], False
    for place in range(len(group.channels)):
        if place == file.masters_db.get(number):
            continue
        # Without its invalid samples a channel loses rows, and no longer fits the time of its group.
        signal = file.get(group=number, index=place, ignore_invalidation_bits=True)
        if not timed:
            timed = True
            yield table, "Time (s)", np.asarray(signal.timestamps, dtype=float)
        yield (
            table,
            named(signal.name.partition("\\")[0], signal.unit),
            _valid(np.asarray(signal.samples), signal.invalidation_bits),
        )


def _valid(samples: np.ndarray, invalid: np.ndarray | None) -> np.ndarray:
    """Samples of a channel, nan or an empty text where they are invalid."""
    if invalid is None or samples.ndim != 1 or samples.dtype.kind not in "iufbSU":
        return samples
    empty = samples.dtype.type() if samples.dtype.kind in "SU" else np.nan
    return np.where(np.asarray(invalid, dtype=bool), empty, samples)
