"""Missing part of an answer without a law, as a table over the recorded conditions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import prod

import numpy as np

from mixedlub.case.missing_part import ADDITION, SD, SHARE, MissingPart
from mixedlub.diagnosis.assessment.model_averaging import Predicted
from mixedlub.diagnosis.discrepancy.modulated import THERMAL_LAG
from mixedlub.diagnosis.discrepancy.smooth import DiscrepancyForm
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import (
    EDGE,
    NODES_OF_CONDITION,
    NODES_OF_PEAK,
    NODES_OF_TABLE,
    NODES_OF_WAVE,
)
from mixedlub.diagnosis.settings.inference import NINETY
from mixedlub.recording.conditions import PASSING, Coordinate
from mixedlub.recording.set_points import set_points
from mixedlub.schema.table import Table

SURFACES, ROUGHNESS = "surfaces", "composite_roughness_um"
Nodes = dict[str, np.ndarray]


@dataclass(frozen=True, eq=False)
class Tabulated:
    """A table of the missing part, and its largest and rms error by interpolation at the recorded conditions, in sd."""

    missing: MissingPart
    largest_error: float
    rms_error: float


def tabulated(search: Search, recorded: Predicted, predict: Callable[[Table], Predicted]) -> Tabulated:
    """The missing part over a grid of the recorded conditions, as a share of the reading or an addition to it.

    The form that follows the prediction of the recorded rows more closely is taken. The standard deviation contains the
    error of interpolation.
    """
    rows, kind = search.problem.rows, search.problem.case.kind
    grid = _grid(search)
    there, here = (_beside_base(search, p) for p in (predict(_filled(grid, rows)), recorded))
    tried = []
    for name in (SHARE, ADDITION):
        size = np.ones(len(grid)) if name == ADDITION else there.calibrated
        with np.errstate(all="ignore"):
            value = (there.predicted - there.calibrated) / size
            spread = _model_sd(search, there) / np.abs(size)
        value, spread = (np.nan_to_num(v, posinf=0.0, neginf=0.0) for v in (value, spread))
        part = MissingPart(Table({**grid.columns, name: value, SD: spread}), kind.part_rigs)
        off = part.at(rows)
        off = here.calibrated * (1.0 + off) if name == SHARE else here.calibrated + off
        error = (off - here.predicted) / here.sd
        typical = 1.0 if name == ADDITION else np.abs(here.calibrated)
        own = np.sqrt(np.mean((error * here.sd / np.maximum(typical, 1e-300)) ** 2))
        columns = {**part.table.columns, SD: np.hypot(spread, own)}
        table = MissingPart(Table(columns, "missing_part.csv"), kind.part_rigs)
        tried.append(Tabulated(table, float(np.max(np.abs(error))), float(np.sqrt(np.mean(error**2)))))
    return min(tried, key=lambda one: one.rms_error)


def _beside_base(search: Search, p: Predicted) -> Predicted:
    """The predictions beside the base model without the table that the case itself may name."""
    earlier = search.problem.case.missing
    return p if earlier is None else replace(p, calibrated=earlier.without(p.calibrated, p.table))


def _model_sd(search: Search, there: Predicted) -> np.ndarray:
    """Standard deviation of a prediction without the noise of a reading."""
    transform = search.problem.transform
    half = 0.5 * (transform(there.high90) - transform(there.low90)) / NINETY
    logarithmic = search.problem.case.kind.logarithmic
    size = np.abs(there.predicted) if logarithmic else np.ones(half.size)
    return np.asarray(np.sqrt(np.maximum((half * size) ** 2 - there.sd**2, 0.0)))


def _grid(search: Search) -> Table:
    """Every combination of the nodes of the conditions; names of surfaces as they were recorded together."""
    rows, form = search.problem.rows, search.discrepancy.best
    names = [c.name for c in search.problem.case.kind.columns if c.dtype == "name" and c.name in rows]
    labels: list[tuple[list[str], list[tuple[str, ...]]]] = []
    if "rig" in rows:
        labels.append((["rig"], [(str(name),) for name in np.unique(rows["rig"])]))
    swept = [axis.name for axis in search.space.axes]
    if SURFACES in swept:
        labels.append((names, sorted(set(zip(*(rows[name].astype(str).tolist() for name in names), strict=True)))))
    nodes = _nodes(search, form, prod(len(own) for _, own in labels))
    blocks: list[tuple[list[str], list[tuple[str | float, ...]]]] = [(n, [*own]) for n, own in labels]
    blocks += [([name], [(float(v),) for v in values]) for name, values in nodes.items()]
    sizes = [len(own) for _, own in blocks]
    index = np.indices(sizes).reshape(len(sizes), -1)
    columns: dict[str, np.ndarray] = {}
    for (block, own), place in zip(blocks, index, strict=True):
        for k, name in enumerate(block):
            columns[name] = np.array([one[k] for one in own])[place]
    return Table(columns, "missing_part.csv")


def _nodes(search: Search, form: DiscrepancyForm, names: int) -> Nodes:
    """Nodes of each numeric condition: its levels where they are few, fewer where the table would become too long."""
    axes = [
        (axis, values)
        for axis, values in zip(search.space.axes, search.values, strict=True)
        if not axis.named and axis.name != ROUGHNESS
    ]
    if form.modulates == THERMAL_LAG or form.past is not None:
        clock = next((n for n in ("sequence", "time_s") if n in search.problem.rows), "")
        if clock:
            return {clock: np.unique(np.asarray(search.problem.rows[clock], float))}
    counts = [NODES_OF_CONDITION] * len(axes)
    while True:
        found = {
            axis.name: _nodes_of(axis, values, count, form) for (axis, values), count in zip(axes, counts, strict=True)
        }
        sizes = [found[axis.name].size for axis, _ in axes]
        most = int(np.argmax(sizes)) if sizes else 0
        if names * prod(sizes) <= NODES_OF_TABLE or sizes[most] <= 2:
            return found
        counts[most] = min(counts[most], sizes[most]) - 1
        if len(axes) == 1 or counts[most] < 2:
            return found


def _nodes_of(axis: Coordinate, values: np.ndarray, count: int, form: DiscrepancyForm) -> np.ndarray:
    """At most ``count`` nodes of a condition, and further ones at the edges of a local form."""
    levels = np.unique(set_points(values).astype(float))
    low, high = float(np.min(values)), float(np.max(values))
    own = axis.name in form.axes
    if own and form.waves:
        count = max(count, int(NODES_OF_WAVE * form.waves) + 1)
    if levels.size > count:
        at = axis.scale(levels)
        # The nearest level, so that most nodes are conditions that were run.
        near = np.linspace(0.0, 1.0, count)
        levels = np.unique(levels[[int(np.argmin(np.abs(at - x))) for x in near]])
    return np.unique([low, *levels, high, *_edges(axis, form, low, high)])


def _edges(axis: Coordinate, form: DiscrepancyForm, low: float, high: float) -> Sequence[float]:
    """Nodes at the ends of a step or a box, and about a peak."""
    ends = [end for name, *both in form.box if name == axis.name for end in both]
    if form.at is not None and axis.name in form.axes:
        if form.length:
            middle = form.length * np.linspace(-2.0, 2.0, NODES_OF_PEAK)
            if axis.logarithmic:
                found = form.at * np.exp(middle * axis.span)
            else:
                found = form.at + middle * axis.span
            return [float(v) for v in found if low < v < high and not axis.symmetric_log]
        ends = [form.at, *([-form.at] if axis.symmetric_log else [])]
    near = [end + k * EDGE * (high - low) for end in ends for k in (-1.0, 0.0)]
    return [v for v in near if low < v < high]


def _filled(grid: Table, rows: Table) -> Table:
    """The grid with the other columns of the recording: their median, the end of the programme, the usual name.

    Over time alone they are the columns at that time.
    """
    columns = {"run": np.arange(1, len(grid) + 1), **grid.columns}
    (clock,) = grid.columns if len(grid.columns) == 1 and set(grid.columns) <= set(PASSING) else ("",)
    for name, values in rows.columns.items():
        if name in (*columns, "setup", "run"):
            continue
        if clock:
            order = np.argsort(rows[clock], kind="stable")
            near = np.searchsorted(rows[clock][order], grid[clock] * (1.0 - 1e-12))
            columns[name] = values[order][np.minimum(near, order.size - 1)]
            continue
        if values.dtype.kind in "US":
            kinds, counts = np.unique(values, return_counts=True)
            columns[name] = np.full(len(grid), kinds[np.argmax(counts)])
        else:
            columns[name] = np.full(len(grid), 1.0 if name == "sequence" else float(np.nanmedian(values)))
    return Table(columns, "missing_part.csv")
