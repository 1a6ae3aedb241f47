"""Figures of an experiment: influence of each factor on the response."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.report.style import SMALL, WIDTH, in_words, labelled, panels
from mixedlub.study.factor_tables import Decided

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from mixedlub.schema.result import Drawing

MOST_NAMED = 18
"""Largest number of characters of a name on an axis."""
MOST_NAMES = 6
"""Largest number of level names along an axis."""
MOST_PAIRS = 10
"""Largest number of interactions drawn."""
ALONE, WITH_OTHERS = "#21618c", "#a9cce3"


def factor_figures(decided: Decided) -> tuple[dict[str, Drawing], dict[str, str]]:
    """Indices as bars, interactions and main effects, with captions."""
    what = in_words(decided.response)
    ends = "" if decided.indices.total_ends is None else " Bars of error: 95 % intervals of the resampled runs."
    captions = {
        "indices": f"Share of the variance of {what} that each factor decides alone (dark) and together with others "
        f"(light).{ends}",
        "interactions": f"Share of the variance of {what} that two factors decide only together, the largest "
        f"{MOST_PAIRS}.",
        "main_effects": f"Mean of {what} at the levels of each factor, over all else. The dashed line is the mean of "
        "all.",
    }
    drawn = {"indices": _indices, "interactions": _interactions, "main_effects": _main_effects}
    names = [name for name in drawn if name != "interactions" or decided.interactions]
    return {name: partial(drawn[name], decided) for name in names}, {name: captions[name] for name in names}


def _indices(decided: Decided) -> Figure:
    from matplotlib.figure import Figure

    order = np.argsort(decided.indices.total)
    first, total = (np.maximum(values[order], 0.0) for values in (decided.indices.first, decided.indices.total))
    figure = Figure(figsize=(WIDTH * 0.65, 0.28 * len(order) + 1.0), layout="constrained")
    panel = figure.subplots()
    places = np.arange(len(order))
    panel.barh(places, total, color=WITH_OTHERS, label="with others")
    panel.barh(places, first, color=ALONE, label="alone")
    ends = decided.indices.total_ends
    if ends is not None:
        reach = np.abs(ends[:, order] - decided.indices.total[order])
        panel.errorbar(total, places, xerr=reach, fmt="none", ecolor="0.25", elinewidth=0.8, capsize=2)
    panel.set_yticks(places, [in_words(decided.names[i]) for i in order])
    panel.set_xlabel(f"share of the variance of {in_words(decided.response)} (-)")
    panel.set_xlim(left=0.0)
    panel.grid(axis="y", visible=False)
    figure.legend(loc="outside upper right", ncols=2)
    return figure


def _interactions(decided: Decided) -> Figure:
    from matplotlib.figure import Figure

    largest = sorted(decided.interactions.items(), key=lambda item: -item[1])[:MOST_PAIRS][::-1]
    figure = Figure(figsize=(WIDTH * 0.65, 0.28 * len(largest) + 0.8), layout="constrained")
    panel = figure.subplots()
    panel.barh(
        [f"{in_words(decided.names[a])} × {in_words(decided.names[b])}" for (a, b), _ in largest],
        [max(share, 0.0) for _, share in largest],
        color=ALONE,
    )
    panel.set_xlabel(f"share of the variance of {in_words(decided.response)} (-)")
    panel.set_xlim(left=0.0)
    panel.grid(axis="y", visible=False)
    return figure


def _main_effects(decided: Decided) -> Figure:
    figure, axes, columns = panels(len(decided.main_effects), 3, height=1.9, sharex=False)
    for number, (panel, (name, effect)) in enumerate(zip(axes, decided.main_effects.items(), strict=True)):
        if all(isinstance(level, int | float) for level in effect.levels) and name != "replicate":
            x = np.array(effect.levels, dtype=float)
            order = np.argsort(x)
            panel.plot(x[order], effect.mean[order], color=ALONE, marker="o")
            panel.set_xlabel(labelled(name))
        else:
            order = np.argsort(effect.mean)
            panel.plot(np.arange(order.size), effect.mean[order], color=ALONE, marker="o", linestyle="")
            _name_levels(panel, [str(effect.levels[i]) for i in order])
            panel.set_xlabel(in_words(name))
        panel.axhline(decided.mean, color="0.35", linewidth=0.8, linestyle=(0, (4, 3)))
        if number % columns == 0:
            panel.set_ylabel(f"{in_words(decided.response)} ({decided.unit})", fontsize=SMALL)
    return figure


def _name_levels(panel: Axes, names: list[str]) -> None:
    """Name the levels along the axis if there are few."""
    if len(names) > MOST_NAMES:
        panel.set_xticks([])
        return
    short = [name if len(name) <= MOST_NAMED else f"{name[: MOST_NAMED - 1]}…" for name in names]
    panel.set_xticks(range(len(names)), short, rotation=20, ha="right")
