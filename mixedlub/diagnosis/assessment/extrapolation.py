"""Extrapolation: conditions to predict beyond the recorded conditions."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mixedlub.case.folder import RUNS_LISTED, Case
from mixedlub.diagnosis.labels import amount
from mixedlub.diagnosis.settings.assessment import OUTSIDE_OF_END, OUTSIDE_OF_LOWEST, OUTSIDE_OF_SPAN
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.table import Column, Table


def beyond_recorded(case: Case, wanted: Table | None) -> list[Finding]:
    """Finding on the wanted runs beyond the recorded conditions."""
    rows = case.recordings
    if wanted is None or rows is None:
        return []
    beyond: dict[int, list[str]] = {}
    for column in case.kind.columns:
        if column.name in wanted and column.name in rows:
            for run, words in _beyond(column, wanted, rows):
                beyond.setdefault(run, []).append(words)
    if not beyond:
        return []
    listed = [f"run {run}: {', '.join(words)}" for run, words in list(beyond.items())[:RUNS_LISTED]]
    more = f"; and {len(beyond) - RUNS_LISTED} more runs" if len(beyond) > RUNS_LISTED else ""
    text = (
        f"{len(beyond)} of {len(wanted)} conditions to predict are outside the recorded range; their intervals hold "
        f"only if the laws also hold there ({'; '.join(listed)}{more})"
    )
    return [finding("prediction_extrapolates", text, wanted.source)]


def _beyond(column: Column, wanted: Table, rows: Table) -> Iterator[tuple[int, str]]:
    """Runs with a value of a column beyond the recorded values, with a description."""
    name, values = column.name, wanted[column.name]
    if column.dtype == "name":
        for i in np.flatnonzero(~np.isin(values, rows[name])):
            yield int(wanted["run"][i]), f"{name} {values[i]}, never recorded"
        return
    low, high = float(np.min(rows[name])), float(np.max(rows[name]))
    least, most = (max(OUTSIDE_OF_SPAN * (high - low), OUTSIDE_OF_END * abs(end)) for end in (low, high))
    if low > 0.0:
        least = min(least, OUTSIDE_OF_LOWEST * low)
    for i in np.flatnonzero((values < low - least) | (values > high + most)):
        ends = amount(low, name) if low == high else f"{low:.4g} to {amount(high, name)}"
        yield int(wanted["run"][i]), f"{name} {amount(float(values[i]), name)}, recorded {ends}"
