"""The answer in one picture: residuals over a condition, probabilities, and the fit with readings measured later."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING
from mixedlub.diagnosis.labels import axis_label, explanation_words, in_units_of_case
from mixedlub.diagnosis.report.figures.charts import colour_of
from mixedlub.diagnosis.report.figures.maps import frame_of
from mixedlub.diagnosis.report.figures.style import AFTER, BEFORE, INK, MUTED, OUTLIER, PAPER, blank, look
from mixedlub.diagnosis.report.text.headline import chance

if TYPE_CHECKING:
    from collections.abc import Iterator

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SHOWN = 4
"""Judgement: most explanations beside none and unknown, so that a bar has room for its words."""
LEGEND = 0.25
"""Judgement: room for a legend of two lines, as a share of the scale."""
LEAST = 0.005
"""Judgement: smallest probability with a bar that is seen."""


LATER: dict[str, Any] = {
    **{"marker": "D", "mfc": "none", "mec": OUTLIER, "mew": 1.1, "ms": 5, "zorder": 5},
    "label": "predicted, then measured",
}
"""Style of readings that were measured after their prediction."""


def main_condition(d: Diagnosis) -> str:
    """The condition of the mismatch where it is a number, else the first varied condition, else the run."""
    numeric = [w["column"] for w in d.region.where if "low" in w]
    return next(iter([*numeric, frame_of(d).across]), "") or "run"


@in_units_of_case
def in_one(d: Diagnosis, over: str, later: np.ndarray | None = None) -> Figure:
    """Figure of three panels over a condition; ``later``: readings measured at the requested conditions."""
    with look():
        figure = blank(9.6, 3.1)
        first, middle, last = figure.subplots(1, 3, width_ratios=(1.15, 0.8, 1.25))
        _residuals(first, d, over)
        _probabilities(middle, d)
        (_along if _alone(d, over) else _one_to_one)(last, d, over, later)
        last.set_title("What it predicts")
        bottom, top = last.get_ylim()
        last.set_ylim(bottom, top + 1.7 * LEGEND * (top - bottom))
        last.legend(loc="upper left")
    return figure


def _label(over: str) -> str:
    return axis_label(over) if over != "run" else "run"


def _residuals(axes: Axes, d: Diagnosis, over: str) -> None:
    """Draw residuals (sigma) of the calibrated base model and of the answer."""
    before, after = d.residuals
    x = d.recorded.table[over]
    axes.axhspan(-2.0, 2.0, color=PAPER, lw=0)
    for z, colour, name in ((before, BEFORE, "base model, calibrated"), (after, AFTER, "with the answer")):
        rms = np.sqrt(np.mean(z[d.counted] ** 2))
        axes.plot(x, z, "o", color=colour, ms=3.2, label=f"{name}: rms {rms:.1f}")
    axes.set_title("What the simulation misses")
    axes.set_xlabel(_label(over))
    axes.set_ylabel("residual (sigma of the noise)")
    low, high = axes.get_ylim()
    axes.set_ylim(low - LEGEND * (high - low), high)
    axes.legend(loc="lower left")


def _probabilities(axes: Axes, d: Diagnosis) -> None:
    """Draw the probabilities of the best explanations, of none and of unknown as bars."""
    weights = d.posterior.weights
    rows = [key for key in weights if weights[key] >= LEAST][:SHOWN]
    rows += [key for key in (NOTHING, DISCREPANCY) if key not in rows]
    for place, key in enumerate(rows):
        axes.barh(place, weights.get(key, 0.0), color=colour_of(d, key), height=0.6)
        text = f"{explanation_words(key.ids)}  {chance(weights.get(key, 0.0))}"
        axes.annotate(text, (0.0, place - 0.33), xytext=(1, 1), textcoords="offset points", va="bottom", fontsize=7.5)
    axes.set_xlim(0.0, 1.0)
    axes.set_ylim(len(rows) - 0.5, -0.9)
    axes.set_yticks([])
    axes.grid(axis="y", visible=False)
    axes.set_title("Why")
    axes.set_xlabel("probability")


def _one_to_one(axes: Axes, d: Diagnosis, over: str, later: np.ndarray | None) -> None:
    """Draw readings over simulated values, where more conditions than ``over`` were varied."""
    p = d.handed(d.recorded)
    ends = [float(d.readings.min()), float(d.readings.max())]
    axes.plot(ends, ends, color=MUTED, lw=0.8)
    axes.plot(p.calibrated, d.readings, "o", color=BEFORE, ms=2.6, label="base model, calibrated")
    axes.plot(p.predicted, d.readings, "o", color=AFTER, ms=2.6, label="with the answer")
    if later is not None and d.wanted is not None:
        w = d.handed(d.wanted)
        axes.hlines(later, w.low90, w.high90, color=OUTLIER, lw=1.6, zorder=4)
        axes.plot(w.predicted, later, ls="", **LATER)
    axes.set_xlabel(f"simulated {axis_label(d.case.quantity)}")
    axes.set_ylabel(f"recorded {axis_label(d.case.quantity)}")


def _along(axes: Axes, d: Diagnosis, over: str, later: np.ndarray | None) -> None:
    """Draw readings, the base model and the answer over the only varied condition, and later readings.

    A drive with readings in both directions is drawn by sizes, so that both branches share one scale.
    """
    p = d.handed(d.recorded)
    x = np.asarray(p.table[over], dtype=float)
    both_ways = bool((x < 0).any() and (x > 0).any() and (np.sign(x) == np.sign(d.readings)).all())

    def turned(values: np.ndarray, at: np.ndarray) -> np.ndarray:
        return values * np.where(both_ways & (at < 0), -1.0, 1.0)

    for part in _branches(x) if both_ways else [np.argsort(x, kind="stable")]:
        own = x[part]
        at, low, high = (turned(v, own) for v in (own, p.low90[part], p.high90[part]))
        base, answer = (turned(v[part], own) for v in (p.calibrated, p.predicted))
        axes.fill_between(at, low, high, color=AFTER, alpha=0.2, lw=0)
        axes.plot(at, base, color=BEFORE, lw=1.1, ls="--")
        axes.plot(at, answer, color=AFTER, lw=1.3)
        if both_ways:
            end, name = int(np.argmax(at)), "backward" if own[0] < 0 else "forward"
            place: dict[str, Any] = {"xytext": (0, -20), "textcoords": "offset points", "ha": "right"}
            axes.annotate(name, (at[end], answer[end]), fontsize=7.5, color=MUTED, **place)
    axes.plot(turned(x, x), turned(d.readings, x), "o", color=INK, ms=2.6, label="readings")
    axes.plot([], [], color=BEFORE, ls="--", label="base model, calibrated")
    axes.plot([], [], color=AFTER, label="with the answer, 90 %")
    if later is not None and d.wanted is not None:
        w = d.handed(d.wanted)
        own = np.asarray(w.table[over], dtype=float)
        at, low, high, read = (turned(v, own) for v in (own, w.low90, w.high90, later))
        axes.vlines(at, low, high, color=OUTLIER, lw=1.6, zorder=4)
        axes.plot(at, read, ls="", **LATER)
    axes.set_xlabel(f"{'size of ' if both_ways else ''}{_label(over)}")
    axes.set_ylabel(f"{'size of ' if both_ways else ''}{axis_label(d.case.quantity)}")


def _alone(d: Diagnosis, over: str) -> bool:
    """Whether no other condition was varied."""
    names = [c.name for c in d.case.kind.columns if c.name in d.recorded.table and c.name != over]
    return all(np.unique(d.recorded.table[name]).size == 1 for name in names)


def _branches(x: np.ndarray) -> Iterator[np.ndarray]:
    """Rows in the order of a condition, apart below and above zero, where friction jumps."""
    order = np.argsort(x, kind="stable")
    cut = int(np.count_nonzero(x < 0))
    for start, stop in pairwise([0, cut, x.size]):
        yield order[start:stop]
