"""Columns that the tables of a case may have."""

from __future__ import annotations

from dataclasses import replace

from mixedlub.gear import ROUNDED
from mixedlub.kinds import Kind
from mixedlub.schema import system_file
from mixedlub.schema.table import BOOKKEEPING, RUN, Column, check_column, sd_column


def case_columns(found: Kind, system: system_file.System, measured: bool) -> tuple[Column, ...]:
    """Columns allowed in a table of the case; kinds with surfaces take the names of the system's surfaces."""
    names = tuple(system.surfaces) if "surfaces" in found.sections else ()
    own = (replace(c, names=names) if c.dtype == "name" and "surface" in c.name else c for c in found.columns)
    reach = found.column_limits(system)
    own = (_rounded(c, *reach[c.name]) if c.name in reach else c for c in own)
    return (RUN, *BOOKKEEPING, *own, *found.instrument_channels, *_measured(found, system, measured))


def _rounded(column: Column, low: float, high: float) -> Column:
    """The column limited to the range of the rig, widened by the rounding of recordings."""
    margin = ROUNDED * (high - low)
    return replace(column, at_least=low - margin, at_most=high + margin)


def _measured(found: Kind, system: system_file.System, required: bool) -> tuple[Column, ...]:
    """The recorded quantity, its standard deviation, and the check channel."""
    quantity = system.recording.quantity
    (reading,) = (replace(column, required=required) for column in found.readings if column.name == quantity)
    check = system.recording.check
    return (reading, sd_column(quantity), *([] if check is None else [check_column(check)]))
