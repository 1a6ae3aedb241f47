"""LabVIEW files (.tdms), read by the package npTDMS: groups of channels with units and clocks."""

from __future__ import annotations

import io
import logging
from collections.abc import Iterator
from typing import Any

import numpy as np

from mixedlub.importers.measured import MeasuredTable, named, refuse_without, tables_of
from profiles.readers.base import foreign_parser

UNITS = ("unit_string", "NI_UnitDescription", "Unit", "unit", "units")
"""Properties of a channel that hold its unit."""


def matches(data: bytes) -> bool:
    """Whether the bytes are a TDMS file."""
    return data[:4] == b"TDSm"


def tables(data: bytes, where: str) -> list[MeasuredTable]:
    """Tables of the channels of each group that share a clock."""
    try:
        from nptdms import TdmsFile
    except ImportError:
        raise refuse_without("npTDMS", "a LabVIEW file (.tdms)", where) from None
    logging.getLogger("nptdms").setLevel(logging.ERROR)
    with foreign_parser("TDMS", where):
        groups = TdmsFile.read(io.BytesIO(data)).groups()
        facts = [channel.properties for group in groups for channel in group.channels() if len(channel)]
        first = min((one["wf_start_time"] for one in facts if "wf_start_time" in one), default=None)
        return tables_of([one for group in groups for one in _channels(group, first)])


def _channels(group: Any, first: Any) -> Iterator[tuple[str, str, np.ndarray]]:
    """Channels of a group, with a time since the first start before the channels of each waveform clock."""
    clocks: dict[tuple[int, float, float], str] = {}
    channels = [channel for channel in group.channels() if len(channel)]
    for channel in channels:
        facts = channel.properties
        unit = next((facts[key] for key in UNITS if facts.get(key)), "")
        step = float(facts.get("wf_increment", 0.0) or 0.0)
        table = group.name
        if step > 0.0 and facts.get("wf_xname", "Time") in ("", "Time"):
            start = float(facts.get("wf_start_offset", 0.0) or 0.0)
            if "wf_start_time" in facts:
                start += float((facts["wf_start_time"] - first) / np.timedelta64(1, "us")) * 1e-6
            clock = (len(channel), step, start)
            if clock not in clocks:
                clocks[clock] = table = group.name if not clocks else f"{group.name}, clock {len(clocks) + 1}"
                yield table, "Time (s)", start + step * np.arange(len(channel))
            table = clocks[clock]
        yield table, named(channel.name, unit), np.asarray(channel[:])
