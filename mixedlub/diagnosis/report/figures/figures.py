"""Figures of a diagnosis, as functions of the answer."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.diagnosis.assessment.identifiability import confusion
from mixedlub.diagnosis.assessment.power_law import DescribedDiscrepancy
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.diagnosis.labels import axis_label, in_units_of_case, words_of
from mixedlub.diagnosis.report.figures import charts, maps
from mixedlub.diagnosis.report.figures.binning import together
from mixedlub.diagnosis.report.figures.style import (
    AFTER,
    BEFORE,
    GRID,
    INK,
    MUTED,
    OUTLIER,
    SERIES,
    blank,
    by_decades,
    log_ticks,
    look,
    wide,
)
from mixedlub.diagnosis.settings.inference import LIKELY
from mixedlub.schema.units import unit_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_POINTS = 1500
MOST_LEVELS, BINS = 12, 10
"""Most levels that a profile shows separately, and the number of bins for more."""


@in_units_of_case
def all_figures(d: Diagnosis, extra: DescribedDiscrepancy | None = None) -> dict[str, Figure]:
    """All figures with content for this case, by file name, in reading order."""
    alike = confusion(d.search)
    named = tuple(dict.fromkeys(n for k in d.posterior.tied for n in k.effects))
    with look():
        drawn = {
            "recorded_against_simulated": recorded_against_simulated(d),
            "missing_part": missing_part(d),
            "residual_map": maps.residual_map(d),
            "roll_angle_map": maps.roll_angle_map(d),
            "profiles": profiles(d),
            "absorbing_stages": None if extra is None else charts.absorbing_stages(extra),
            "empirical_form": None if extra is None else charts.empirical_form(d, extra),
            "evidence": charts.evidence(d),
            "confusability": maps.confusability(alike, named),
            "heldout": charts.heldout(d),
            "intervals": intervals(d),
            "next_test": charts.next_test(d),
        }
    return {name: figure for name, figure in drawn.items() if figure is not None}


def _shown(d: Diagnosis) -> np.ndarray:
    """Indices of the drawn rows: an even selection of at most MOST_POINTS, and all outliers."""
    count = d.readings.size
    rows = np.unique(np.linspace(0, count - 1, min(count, MOST_POINTS)).astype(int))
    return np.union1d(rows, np.flatnonzero(d.outlier_chance > LIKELY))


def recorded_against_simulated(d: Diagnosis) -> Figure:
    """Recorded against simulated, and the residuals (sigma), for the calibrated base model and the answer."""
    y, p = d.readings, d.recorded
    rows = _shown(d)
    bad = d.outlier_chance > LIKELY
    before, after = d.residuals
    figure = blank(7.4, 5.2)
    grid = figure.add_gridspec(2, 2, height_ratios=(2.3, 1.0))
    tops = [figure.add_subplot(grid[0, 0])]
    tops.append(figure.add_subplot(grid[0, 1], sharex=tops[0], sharey=tops[0]))
    feet = [figure.add_subplot(grid[1, 0], sharex=tops[0])]
    feet.append(figure.add_subplot(grid[1, 1], sharex=tops[0], sharey=feet[0]))
    every = np.concatenate([y, p.calibrated, p.predicted])
    logarithmic = wide(every)
    reach = max(4.0, float(np.quantile(np.abs(before[d.counted]), 0.99)) * 1.1)
    states = (
        (p.calibrated, before, BEFORE, "Before: calibrated base model"),
        (p.predicted, after, AFTER, "After: with the answer"),
    )
    for top, foot, (simulated, z, colour, what) in zip(tops, feet, states, strict=True):
        _one_to_one(top, every, simulated, p.sd, logarithmic)
        good = rows[~bad[rows]]
        top.scatter(simulated[good], y[good], s=11, color=colour, alpha=0.75, linewidths=0)
        top.scatter(simulated[bad], y[bad], s=24, facecolors="none", edgecolors=OUTLIER, linewidths=1.1)
        top.set_title(what)
        top.tick_params(labelbottom=False)
        _residuals(foot, simulated, z, rows, bad, reach, colour)
        rms = float(np.sqrt(np.mean(z[d.counted] ** 2)))
        foot.set_title(f"rms {rms:.2f} sigma", fontsize=8, fontweight="normal", color=MUTED)
        if not logarithmic:
            foot.locator_params(axis="x", nbins=5)
        foot.set_xlabel(f"simulated {axis_label(d.case.quantity)}")
    tops[0].set_ylabel(f"recorded {axis_label(d.case.quantity)}")
    feet[0].set_ylabel("recorded − simulated\n(sigma)")
    for right in (tops[1], feet[1]):
        right.tick_params(labelleft=False)
    if logarithmic:
        for top in tops:
            log_ticks(top, "y")
        log_ticks(feet[0], "x")
    _legend(tops[0], bool(bad.any()), bool((np.abs(np.concatenate([before[bad], after[bad]])) > reach).any()))
    return figure


def _residuals(
    axes: Axes, simulated: np.ndarray, z: np.ndarray, rows: np.ndarray, bad: np.ndarray, reach: float, colour: str
) -> None:
    """Draw residuals (sigma) over simulated values, clipped at the edges of the scale."""
    clipped = np.clip(z, -reach, reach)
    good = rows[~bad[rows]]
    axes.axhspan(-2, 2, color=GRID, lw=0)
    axes.scatter(simulated[good], clipped[good], s=9, color=colour, alpha=0.75, linewidths=0)
    for marker, there in (("o", np.abs(z) <= reach), ("^", z > reach), ("v", z < -reach)):
        marked = bad & there
        axes.scatter(
            simulated[marked],
            clipped[marked],
            s=22,
            marker=marker,
            facecolors="none",
            edgecolors=OUTLIER,
            linewidths=1.1,
        )
    axes.set_ylim(-1.08 * reach, 1.08 * reach)


def _one_to_one(axes: Axes, every: np.ndarray, simulated: np.ndarray, sd: np.ndarray, logarithmic: bool) -> None:
    low, high = float(every.min()), float(every.max())
    if logarithmic:
        axes.set_xscale("log")
        axes.set_yscale("log")
        low, high = low / 1.1, high * 1.1
    else:
        low, high = low - 0.04 * (high - low), high + 0.04 * (high - low)
    line = np.geomspace(low, high, 60) if logarithmic else np.linspace(low, high, 60)
    band = _noise_along(line, simulated, sd, logarithmic)
    lower = line - 2 * band
    axes.fill_between(line, np.maximum(lower, 0.2 * low) if logarithmic else lower, line + 2 * band, color=GRID, lw=0)
    axes.plot(line, line, color=INK, lw=0.8)
    axes.set_xlim(low, high)
    axes.set_ylim(low, high)


def _noise_along(line: np.ndarray, simulated: np.ndarray, sd: np.ndarray, logarithmic: bool) -> np.ndarray:
    """Median sd of the readings along a line of simulated values; readings of similar size may differ much in sd."""
    label, centres = together(simulated, BINS)
    typical = np.array([np.median(sd[label == k]) for k in range(centres.size)])
    if logarithmic:
        return np.asarray(np.exp(np.interp(np.log(line), np.log(centres), np.log(typical))))
    return np.asarray(np.interp(line, centres, typical))


def _legend(axes: Axes, outliers: bool, beyond: bool) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    marks: list[Line2D | Patch] = [
        Line2D([], [], color=INK, lw=0.8, label="recorded = simulated"),
        Patch(color=GRID, label="noise, ±2 sd of a typical reading"),
    ]
    if outliers:
        marks.append(Line2D([], [], ls="", marker="o", mfc="none", mec=OUTLIER, label="outlier, little weight"))
    if beyond:
        marks.append(Line2D([], [], ls="", marker="^", mfc="none", mec=OUTLIER, label="outlier beyond the scale below"))
    axes.legend(handles=marks, loc="upper left")


def missing_part(d: Diagnosis) -> Figure | None:
    """The missing part, in the unit of the reading, over the conditions: recorded and explained."""
    if d.posterior.verdict == NOTHING:
        return None
    p = d.recorded
    names = [n for n in (maps.frame_of(d).across, maps.frame_of(d).up, maps.frame_of(d).panel) if n]
    names = ["roll_angle_deg", *names[:2]] if "roll_angle_deg" in p.table else names
    if not names:
        return None
    observed, explained = d.missing
    good = _shown(d)[d.counted[_shown(d)]]
    unit = unit_of(d.case.quantity) or "-"
    figure = blank(2.75 * len(names) + 0.6, 3.0)
    axes = figure.subplots(1, len(names), sharey=True, squeeze=False)[0]
    for panel, name in zip(axes, names, strict=True):
        x = _spread(np.asarray(p.table[name], dtype=float), explained)
        panel.axhline(0.0, color=INK, lw=0.7)
        panel.errorbar(
            x[good], observed[good], yerr=p.sd[good], fmt="o", ms=2.6, color=MUTED, elinewidth=0.5, alpha=0.7, mew=0
        )
        panel.scatter(x[good], explained[good], s=8, color=AFTER, zorder=3, linewidths=0)
        panel.set_xlabel(axis_label(name))
        if by_decades(np.asarray(p.table[name], dtype=float)):
            panel.set_xscale("log")
            log_ticks(panel, "x")
        else:
            panel.locator_params(axis="x", nbins=5)
    axes[0].set_ylabel(f"missing part of the reading ({unit})")
    axes[0].errorbar([], [], yerr=[], fmt="o", ms=2.6, color=MUTED, elinewidth=0.5, label="recorded − base model")
    axes[0].scatter([], [], s=8, color=AFTER, label="the answer")
    axes[0].legend(loc="best")
    return figure


def _spread(x: np.ndarray, by: np.ndarray) -> np.ndarray:
    """Offset points of equal level slightly, in the order of another quantity, so that all remain visible."""
    levels, label = np.unique(x, return_inverse=True)
    if levels.size > 12 or levels.size < 2:
        return x
    position = np.zeros(x.size)
    for k in range(levels.size):
        members = np.flatnonzero(label == k)
        members = members[np.argsort(by[members], kind="stable")]
        position[members] = np.linspace(-1.0, 1.0, members.size) if members.size > 1 else 0.0
    if by_decades(levels):
        return np.asarray(x * (levels[1:] / levels[:-1]).min() ** (0.22 * position))
    return np.asarray(x + 0.22 * float(np.diff(levels).min()) * position)


def profiles(d: Diagnosis) -> Figure | None:
    """Mean residual along each condition, before and after; bars are two standard errors."""
    before, after = d.residuals
    good = d.counted
    table = d.recorded.table
    names = [c.name for c in d.case.kind.columns if c.name in table and np.unique(table[c.name]).size > 1]
    names += [n for n in ("sequence",) if n in table]
    names = [n for n in names if np.unique(table[n][good]).size > 1][:9]
    if not names:
        return None
    across = min(len(names), 3)
    down = -(-len(names) // across)
    figure = blank(2.6 * across + 0.6, 2.3 * down + 0.3)
    axes = figure.subplots(down, across, sharey=True, squeeze=False)
    for panel, name in zip(axes.flat, names, strict=False):
        _profile(panel, np.asarray(table[name])[good], before[good], after[good])
        if name != "sequence" and table[name].dtype.kind != "U" and by_decades(np.asarray(table[name], dtype=float)):
            panel.set_xscale("log")
            log_ticks(panel, "x")
        panel.set_xlabel(
            "place in the test programme (0 to 1)" if name == "sequence" else _condition_label(name, table[name])
        )
    for empty in axes.flat[len(names) :]:
        empty.set_visible(False)
    for left in axes[:, 0]:
        left.set_ylabel("mean residual (sigma)")
    axes[0, 0].legend(loc="best")
    return figure


def _condition_label(name: str, values: np.ndarray) -> str:
    return words_of(name) if values.dtype.kind in "US" else axis_label(name)


def _profile(axes: Axes, values: np.ndarray, before: np.ndarray, after: np.ndarray) -> None:
    label, levels = together(values, MOST_LEVELS, BINS)
    named = levels.dtype.kind in "US"
    x = np.arange(levels.size, dtype=float) if named else levels
    count = np.bincount(label)
    axes.axhline(0.0, color=INK, lw=0.7)
    # A line across zero would suggest readings at speeds that were not run.
    turns = [0, *(np.flatnonzero((x[:-1] < 0) & (x[1:] > 0)) + 1), x.size]
    for z, colour, name in ((before, BEFORE, "before"), (after, AFTER, "after")):
        mean = np.bincount(label, z) / count
        error = 2.0 / np.sqrt(count)
        for start, stop in pairwise(turns):
            segment = slice(start, stop)
            axes.errorbar(
                x[segment],
                mean[segment],
                yerr=error[segment],
                color=colour,
                marker="o",
                ms=3.2,
                lw=1.2,
                elinewidth=0.8,
                label="" if start else name,
            )
    if named:
        axes.set_xticks(
            x, levels.tolist(), rotation=30 if levels.size > 2 else 0, ha="right" if levels.size > 2 else "center"
        )


def intervals(d: Diagnosis) -> Figure:
    """Recorded readings against the 90 % predictive interval, sorted by the predicted value."""
    from matplotlib.ticker import MaxNLocator

    p, y = d.recorded, d.readings
    order = np.argsort(p.predicted, kind="stable")
    order = order[np.isin(order, _shown(d))]
    percent = bool((p.predicted > 0).all() and p.predicted.min() > 1e-3 * p.predicted.max())
    scale = 100.0 / p.predicted if percent else np.ones(y.size)
    away = ((y - p.predicted) * scale)[order]
    low, high = ((p.low90 - p.predicted) * scale)[order], ((p.high90 - p.predicted) * scale)[order]
    base = ((p.calibrated - p.predicted) * scale)[order]
    bad = d.outlier_chance[order] > LIKELY
    covered = (y >= p.low90) & (y <= p.high90)
    inside = covered[order]
    index = np.arange(order.size)
    figure = blank(7.4, 2.9)
    axes = figure.add_subplot()
    axes.fill_between(index, low, high, step="mid", color="#cfe3ea", lw=0, label="90 % interval")
    axes.scatter(index, base, s=16, marker="_", color=BEFORE, linewidths=1.1, label="calibrated base model")
    axes.scatter(index[inside & ~bad], away[inside & ~bad], s=8, color=INK, linewidths=0, label="inside")
    axes.scatter(index[~inside & ~bad], away[~inside & ~bad], s=14, color=SERIES[5], linewidths=0, label="outside")
    reach = 1.25 * float(np.max(np.abs(np.concatenate([low, high, away[~bad], np.quantile(base, [0.02, 0.98])]))))
    if bad.any():
        _outliers(axes, index[bad], away[bad], reach)
    axes.set_ylim(-reach, reach)
    axes.set_xlim(-1, order.size)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    unit = "%" if percent else unit_of(d.case.quantity) or "-"
    axes.set_ylabel(f"recorded − predicted ({unit})")
    axes.set_xlabel(f"reading, sorted by predicted {words_of(d.case.quantity)}")
    good = d.counted
    n_outliers = int((~good).sum())
    drawn = [f"{n_outliers} outlier{'s' if n_outliers > 1 else ''} not counted"] if n_outliers else []
    drawn += [f"{order.size} readings drawn"] if order.size < y.size else []
    counted = f"{int((covered & good).sum())} of {int(good.sum())} readings inside"
    axes.set_title("\n".join([counted, ", ".join(drawn)]).rstrip(), fontweight="normal")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=5, columnspacing=1.2, handletextpad=0.4)
    return figure


def _outliers(axes: Axes, place: np.ndarray, away: np.ndarray, reach: float) -> None:
    """Draw outliers as rings, and outliers beyond the scale as triangles at its edge."""
    edge = 0.94 * reach
    label: str | None = "outlier"
    for marker, there in (("o", np.abs(away) <= edge), ("^", away > edge), ("v", away < -edge)):
        if there.any():
            clipped = np.clip(away[there], -edge, edge)
            axes.scatter(place[there], clipped, s=26, marker=marker, facecolors="none", edgecolors=OUTLIER, label=label)
            label = None
