"""Pictures of a score: the table, reliability, identification against visibility, confusion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.validation.score import Score

if TYPE_CHECKING:
    from matplotlib.figure import Figure

INK, GOOD, BAD = "#1b1b1b", "#1b7837", "#b2182b"


def _blank(width: float, height: float) -> Figure:
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def score_table(scores: Sequence[Score]) -> Figure:
    """Figures by tool, one column per tool, green if the goal is met and red if not."""
    from matplotlib.transforms import Bbox

    rows = scores[0].rows
    figure = _blank(5.2 + 1.5 * len(scores), 0.7 + 0.27 * len(rows))
    axes = figure.add_subplot()
    axes.set_axis_off()
    columns = ["figure", *(one.tool for one in scores), "goal"]
    cells = [[row.text.replace("  ", "   "), *(_shown(one[row.key].value) for one in scores), row.aim] for row in rows]
    table = axes.table(cells, colLabels=columns, bbox=Bbox.unit(), cellLoc="center", edges="horizontal")
    table.auto_set_font_size(False)
    table.set_fontsize(8.5)
    table.auto_set_column_width(list(range(len(columns))))
    for (line, column), cell in table.get_celld().items():
        cell.set_edgecolor("#c8ccd0")
        if column == 0:
            cell.get_text().set_horizontalalignment("left")
        if line == 0:
            cell.get_text().set_fontweight("bold")
        elif 0 < column <= len(scores):
            met = scores[column - 1].rows[line - 1].met
            cell.get_text().set_color({True: GOOD, False: BAD, None: INK}[met])
    axes.set_title(f"Blind battery: goals met in green, missed in red ({_cases(scores[0])} cases)", fontsize=10)
    return figure


def _shown(value: float) -> str:
    return f"{value:.3g}" if np.isfinite(value) else "-"


def _line(place: int) -> dict[str, Any]:
    """Line style: thick for the first tool, thin for the others."""
    return {"marker": "o", "lw": 2, "zorder": 3} if place == 0 else {"marker": ".", "lw": 1, "alpha": 0.7}


def _cases(score: Score) -> int:
    return score["log_score"].count


def reliability(scores: Sequence[Score]) -> Figure:
    """Observed frequency against stated probability, with the count at each point of the first tool."""
    figure = _blank(5.2, 5.4)
    axes = figure.add_subplot()
    axes.plot([0, 1], [0, 1], color="#999999", lw=1, ls="--", label="honest")
    for place, one in enumerate(scores):
        given = [row[1] for row in one.reliability]
        so = [row[2] for row in one.reliability]
        axes.plot(given, so, label=one.tool, **_line(place))
    for place, (_, given_mean, so_mean, count) in enumerate(scores[0].reliability):
        offset: dict[str, Any] = {"xytext": (6, -10), "ha": "left"} if place % 2 else {"xytext": (-6, 6), "ha": "right"}
        axes.annotate(str(count), (given_mean, so_mean), textcoords="offset points", fontsize=7.5, **offset)
    axes.set(xlabel="probability given (-)", ylabel="share that was so (-)", xlim=(-0.12, 1.1), ylim=(-0.06, 1.06))
    axes.set_title("Reliability of the probabilities", fontsize=11)
    figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize=8.5)
    return figure


def identification(scores: Sequence[Score]) -> Figure:
    """Share of correctly named single effects against their visibility."""
    figure = _blank(6.2, 4.2)
    axes = figure.add_subplot()
    for place, one in enumerate(scores):
        seen = [row[1] for row in one.identification]
        right = [row[2] for row in one.identification]
        axes.plot(seen, right, label=one.tool, **_line(place))
    for _, seen_mean, right_mean, count in scores[0].identification:
        place_below = (0, -13)
        axes.annotate(
            f"n={count}", (seen_mean, right_mean), place_below, textcoords="offset points", fontsize=7.5, ha="center"
        )
    axes.margins(x=0.08)
    axes.set(
        xlabel="visibility: root of the chi-square that recalibration leaves (-)",
        ylabel="named rightly (-)",
        ylim=(-0.03, 1.05),
    )
    axes.set_title("Single effects named rightly, by visibility", fontsize=11)
    figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize=8.5)
    return figure


def confusion(score: Score) -> Figure:
    """Planted effect against verdict; verdicts of several effects together as 'several'."""
    truths = sorted(score.confusion, key=_order)
    verdicts = sorted({_one(name) for row in score.confusion.values() for name in row} | set(truths), key=_order)
    counts = np.zeros((len(truths), len(verdicts)))
    for i, truth in enumerate(truths):
        for name, count in score.confusion[truth].items():
            counts[i, verdicts.index(_one(name))] += count
    share = counts / np.maximum(counts.sum(axis=1, keepdims=True), 1)
    figure = _blank(3.2 + 0.27 * len(verdicts), 2.6 + 0.24 * len(truths))
    axes = figure.add_subplot()
    axes.imshow(share, cmap="Blues", vmin=0, vmax=1, aspect="auto")
    for i, j in zip(*np.nonzero(counts)):
        color = "white" if share[i, j] > 0.6 else INK
        axes.text(j, i, f"{counts[i, j]:.0f}", ha="center", va="center", fontsize=7, color=color)
    axes.set_xticks(range(len(verdicts)), [name.replace("_", " ") for name in verdicts], rotation=90, fontsize=7)
    axes.set_yticks(range(len(truths)), [name.replace("_", " ") for name in truths], fontsize=7)
    axes.set(xlabel="verdict", ylabel="hidden")
    figure.suptitle(f"Hidden against named, cases\n({score.tool})", fontsize=10)
    return figure


def _one(name: str) -> str:
    return "several" if "+" in name else name


def _order(name: str) -> tuple[int, str]:
    """Effects in the order of the chain, then several, unknown, none."""
    from mixedlub.validation.planted import NAMED

    last = {"several": 97, "unknown": 98, "none": 99}
    return (last[name] if name in last else list(NAMED).index(name) if name in NAMED else 96, name)
