"""Charts: probabilities, cross-validation errors, next tests, and the form of the discrepancy."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mixedlub.diagnosis.assessment.power_law import DescribedDiscrepancy
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.labels import axis_label, conditions_text, explanation_words, words_of
from mixedlub.diagnosis.report.figures import maps
from mixedlub.diagnosis.report.figures.style import AFTER, BEFORE, FAULT, GRID, INK, MUTED, SERIES, UNNAMED, blank
from mixedlub.diagnosis.report.text.headline import chance
from mixedlub.diagnosis.report.text.words import distinguishable
from mixedlub.diagnosis.settings.assessment import TIE
from mixedlub.diagnosis.settings.report import USELESS_TEST
from mixedlub.schema.units import unit_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SHOWN = 10
"""Most explanations in the chart of probabilities."""
FAINT = 1e-4
"""Lower end of the axis of probabilities."""
FOLD = 58
"""Characters in a line of text at a bar."""


def colour_of(d: Diagnosis, key: Explanation) -> str:
    """Colour of an explanation: physics, instrument, nothing missing, or discrepancy."""
    if key.is_discrepancy:
        return UNNAMED
    if key == NOTHING:
        return MUTED
    return FAULT if all(e.stage == "measurement" for e in d.search.problem.effects_of(key.effects)) else AFTER


def evidence(d: Diagnosis) -> Figure:
    """Probabilities of the explanations on a logarithmic axis; the shaded zone marks ties with the best."""
    from matplotlib.lines import Line2D

    judged = d.posterior
    rows = [(k, w) for k, w in judged.weights.items() if w >= FAINT][:SHOWN]
    rows += [(key, max(judged.weights[key], FAINT)) for key in (NOTHING, DISCREPANCY) if key not in dict(rows)]
    names = [explanation_words(k.ids) for k, _ in rows]
    figure = blank(7.2, 1.1 + 0.27 * len(rows))
    axes = figure.add_subplot()
    top = rows[0][1]
    axes.axvspan(TIE * top, 1.0, color=GRID, lw=0, zorder=0)
    for place, (key, weight) in enumerate(rows):
        colour = colour_of(d, key)
        axes.plot([FAINT, weight], [place, place], color=colour, lw=2.0, solid_capstyle="butt")
        axes.plot(weight, place, "o", color=colour, ms=5.5)
        text = chance(weight) if weight >= 0.01 else (f"{weight:.0e}" if weight > FAINT else "below 1e-04")
        axes.annotate(text, (weight, place), xytext=(7, 0), textcoords="offset points", va="center", fontsize=7.5)
    axes.set_xscale("log")
    axes.minorticks_off()
    axes.set_xlim(FAINT, 2.2)
    axes.set_yticks(range(len(rows)), names)
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_xlabel("probability of the explanation\n(shaded: tied with the most probable)")
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)
    kinds = {AFTER: "physics", FAULT: "instrument", MUTED: "nothing missing", UNNAMED: "unknown"}
    shown = dict.fromkeys(colour_of(d, k) for k, _ in rows)
    marks = [Line2D([], [], color=c, marker="o", lw=2, ms=5, label=kinds[c]) for c in shown]
    axes.legend(handles=marks, loc="lower right")
    return figure


def heldout(d: Diagnosis) -> Figure:
    """Cross-validation error over whole levels of conditions, before and after, relative to noise."""
    kept = d.heldout
    values = [kept.before] if d.posterior.verdict == NOTHING else [kept.before, kept.after]
    names = ["calibration alone", "with the answer"][: len(values)]
    figure = blank(6.2, 1.0 + 0.38 * len(values))
    axes = figure.add_subplot()
    axes.barh(names, values, color=[BEFORE, AFTER][: len(values)], height=0.55)
    for place, value in enumerate(values):
        # The noise line may pass behind the number.
        paper = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}
        text = axes.annotate(f"{value:.2f}", (value, place), xytext=(4, 0), textcoords="offset points", va="center")
        text.set(bbox=paper, zorder=4)
    axes.axvline(1.0, color=INK, lw=0.9, ls="--")
    axes.annotate(
        "noise",
        (1.0, 1.0),
        xycoords=("data", "axes fraction"),
        xytext=(3, -1),
        textcoords="offset points",
        fontsize=7.5,
        va="bottom",
    )
    axes.set_xlim(0.0, 1.15 * max(*values, 1.2))
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)
    split = kept.split
    for axis in d.search.space.axes:
        split = split.replace(axis.name, words_of(axis.name))
    axes.set_xlabel(f"rms error on left-out readings (sigma)\n{split}, {kept.folds} folds")
    return figure


def absorbing_stages(extra: DescribedDiscrepancy) -> Figure | None:
    """Bars of log evidence by quantity for the discrepancy; None if the readings do not distinguish the quantities."""
    from matplotlib.ticker import MaxNLocator

    if not distinguishable(extra.stages):
        return None
    figure = blank(5.2, 0.95 + 0.27 * len(extra.stages))
    axes = figure.add_subplot()
    names = [words_of(a.quantity) for a in extra.stages]
    values = [a.evidence for a in extra.stages]
    axes.barh(names, values, height=0.55, color=UNNAMED)
    axes.axvline(0.0, color=INK, lw=0.7)
    axes.invert_yaxis()
    # Ticks are fixed before the layout, which makes room only for those present.
    ticks = MaxNLocator(5).tick_values(min(*values, 0.0), max(*values, 0.0))
    axes.set_xticks(ticks)
    axes.set_xlim(ticks[0], ticks[-1])
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel("log evidence of a smooth free factor over nothing missing (nats)")
    return figure


def empirical_form(d: Diagnosis, extra: DescribedDiscrepancy) -> Figure | None:
    """Power law of the discrepancy against the readings; None if no law holds."""
    law = extra.law
    if law is None:
        return None
    figure = blank(4.2, 2.9)
    axes = figure.add_subplot()
    unit = unit_of(d.case.quantity) or "-"
    good = d.counted
    x = law.shape * abs(law.coefficient)
    line = np.linspace(min(float(x[good].min()), 0.0), float(x[good].max()), 51)
    spread = 2.0 * law.sd / abs(law.coefficient)
    sign = np.sign(law.coefficient)
    axes.fill_between(line, sign * line * (1 - spread), sign * line * (1 + spread), color=GRID, lw=0)
    axes.plot(line, sign * line, color=UNNAMED, lw=1.2)
    axes.errorbar(
        x[good],
        law.observed[good],
        yerr=d.recorded.sd[good],
        fmt="o",
        ms=2.6,
        color=INK,
        elinewidth=0.5,
        mew=0,
        alpha=0.7,
    )
    axes.set_xlabel(f"size of the empirical form ({unit})")
    axes.set_ylabel(f"recorded − base model ({unit})")
    axes.locator_params(axis="x", nbins=5)
    axes.set_title("empirical, not physics", fontweight="normal")
    return figure


def next_test(d: Diagnosis) -> Figure | None:
    """Recommended tests among the recorded conditions, with their expected information."""
    tests = [t for t in d.next_tests if t.expected_bits >= USELESS_TEST]
    frame = maps.frame_of(d)
    if not tests or not frame.across or not frame.up:
        return None
    figure = blank(7.4, 2.9)
    left, right = figure.subplots(1, 2, width_ratios=(1.1, 1.0))
    table = d.recorded.table
    points, counts = np.unique(np.column_stack([table[frame.across], table[frame.up]]), axis=0, return_counts=True)
    size = 8.0 + 60.0 * counts / counts.max()
    left.scatter(*points.T, s=size, color=MUTED, alpha=0.45, linewidths=0, label="recorded (area: readings)")
    at: dict[tuple[float, float], list[int]] = {}
    for place, t in enumerate(tests):
        at.setdefault((float(t.conditions[frame.across]), float(t.conditions[frame.up])), []).append(place)
    for (x, y), members in at.items():
        left.scatter(x, y, s=150, marker="*", color=SERIES[members[0]], edgecolors="white", linewidths=0.6, zorder=3)
        text = ", ".join(str(m + 1) for m in members)
        left.annotate(text, (x, y), xytext=(7, 5), textcoords="offset points", fontweight="bold")
    left.set_xlabel(axis_label(frame.across))
    left.set_ylabel(axis_label(frame.up))
    left.margins(0.1)
    left.legend(loc="best")
    bits = [t.expected_bits for t in tests]
    right.barh(range(len(tests)), bits, height=0.3, color=SERIES[: len(tests)])
    for place, t in enumerate(tests):
        text = conditions_text(t.conditions)
        right.annotate(f"{place + 1}: {_folded(text)}", (0.0, place - 0.2), fontsize=6.8, va="bottom")
    right.set_yticks([])
    right.set_ylim(len(tests) - 0.55, -0.85)
    right.set_xlim(0.0, max(1.1 * max(bits), 0.1))
    right.set_xlabel("expected information of one reading (bit)")
    right.locator_params(axis="x", nbins=5)
    right.grid(axis="y", visible=False)
    return figure


def _folded(text: str) -> str:
    import textwrap

    return "\n".join(textwrap.wrap(text, FOLD))
