"""Figures of a ranking: map of the losses, places with intervals, probabilities of pairs, saving against cost."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.report.figures import Drawn
from mixedlub.report.style import SMALL, WIDTH, legend_above, styled
from mixedlub.study.rank import PAIRING

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

WRITTEN = 14
"""Largest number of rows of a map for which the numbers are written into it."""
MOST_PLACES = 30
"""Largest number of pairings in the figure of places, the best ones."""
DARK, PALE = "#21618c", "#b9c4cc"


def ranking_map(ranked: pd.DataFrame) -> Figure:
    """Mean power loss over pinion and gear surface, for the table of `mixedlub.study.ranking`."""
    from matplotlib.figure import Figure

    pinions, gears = (sorted(dict.fromkeys(ranked[f"{wheel}_surface"])) for wheel in ("pinion", "gear"))
    losses = np.full((len(pinions), len(gears)), np.nan)
    for row in ranked.itertuples():
        losses[pinions.index(row.pinion_surface), gears.index(row.gear_surface)] = row.mean_loss_W
    with styled():
        side = min(WIDTH, 1.9 + 0.62 * len(gears))
        figure = Figure(figsize=(side + 1.2, 1.2 + 0.42 * len(pinions)), layout="constrained")
        axes: Any = figure.subplots()
        image = axes.imshow(losses, cmap="viridis_r", aspect="auto")
        axes.grid(False)
        axes.set_xticks(range(len(gears)), gears, rotation=40, ha="right")
        axes.set_yticks(range(len(pinions)), pinions)
        axes.set_xlabel("gear surface")
        axes.set_ylabel("pinion surface")
        figure.colorbar(image, label="mean power loss (W)", shrink=0.9)
        if max(losses.shape) <= WRITTEN:
            middle = (np.nanmin(losses) + np.nanmax(losses)) / 2
            for (p, g), value in np.ndenumerate(losses):
                if np.isfinite(value):
                    axes.text(g, p, f"{value:.3g}", ha="center", va="center", color="w" if value > middle else "0.1")
    return figure


def ranking_drawn(tables: Mapping[str, pd.DataFrame]) -> Iterator[Drawn]:
    """Figures of the tables of `mixedlub.study.rank.ranking_tables`."""
    ranked = tables["ranking"]
    if len(ranked) < 2:
        return
    with styled():
        yield Drawn("ranking", places_caption(ranked), places_figure(ranked))
        if "comparisons" in tables:
            count = min(len(ranked), WRITTEN)
            text = (
                "Probability that the pairing of the row has the smaller mean loss, against the pairing of the column"
                + (f": the best {count} of {len(ranked)} pairings." if count < len(ranked) else ".")
            )
            yield Drawn("ranking_probabilities", text, probabilities_figure(ranked, tables["comparisons"]))
        if "relative_cost" in ranked:
            text = (
                "Mean power loss saved over the cheapest pairing against the cost of both finishes. The line joins the "
                "pairings that no cheaper one undercuts in loss: the efficient frontier, with places of the ranking."
            )
            bars = " Bars: 90 % intervals of the saving." if "saving_percent_low90" in ranked else ""
            yield Drawn("saving_over_cost", text + bars, cost_figure(ranked))


def places_caption(ranked: pd.DataFrame) -> str:
    """Caption of the figure of places."""
    left_out = f" The best {MOST_PLACES} of {len(ranked)} are shown." if len(ranked) > MOST_PLACES else ""
    text = f"Pairings, pinion / gear, in the order of their mean power loss over all conditions.{left_out}"
    if "place_low90" not in ranked:
        return text
    return (
        f"{text} Bars: 90 % intervals. Errors of oil, friction and cut-off move all losses together, and a surface has "
        "one error in all its pairings; the places show what is left. Dark: as good as the best within the uncertainty."
    )


def pairing_names(ranked: pd.DataFrame) -> list[str]:
    """Pairings of a ranking as text, pinion first."""
    return [" / ".join(both).replace("$", r"\$") for both in ranked[PAIRING].itertuples(index=False)]


def places_figure(ranked: pd.DataFrame) -> Figure:
    """Mean power loss and place of each pairing, with 90 % intervals if known."""
    from matplotlib.figure import Figure

    shown = ranked.head(MOST_PLACES)
    uncertain = "place_low90" in shown
    figure = Figure(figsize=(WIDTH, 1.1 + 0.21 * len(shown)), layout="constrained")
    axes = figure.subplots(1, 2 if uncertain else 1, sharey=True, squeeze=False)[0]
    at = np.arange(len(shown))
    good = shown["as_good_as_best"].eq("yes").to_numpy() if uncertain else at == 0
    columns = [("mean_loss_W", "mean power loss (W)"), ("place", "place (-)")]
    for panel, (name, label) in zip(axes, columns, strict=False):
        ends = _ends(shown, name)
        for chosen, colour in ((good, DARK), (~good, PALE)):
            if ends is not None:
                panel.hlines(at[chosen], *(end[chosen] for end in ends), color=colour, linewidth=3.0)
            panel.plot(shown[name].to_numpy()[chosen], at[chosen], "o", color="0.15" if colour == DARK else "0.45")
        panel.set_xlabel(label)
        panel.grid(visible=False, axis="y")
    axes[0].set_yticks(at, [f"{name}  {place}" for place, name in zip(shown["place"], pairing_names(shown))])
    axes[0].set_ylim(len(shown) - 0.5, -0.5)
    if uncertain:
        axes[1].set_xlim(0.0, float(shown["place_high90"].max()) + 1.0)
    return figure


def _ends(table: pd.DataFrame, name: str) -> tuple[np.ndarray, np.ndarray] | None:
    """Ends of the 90 % intervals of a column; None if unknown."""
    names = (f"{name}_low90", f"{name}_high90")
    return (table[names[0]].to_numpy(), table[names[1]].to_numpy()) if names[0] in table else None


def probabilities_figure(ranked: pd.DataFrame, compared: pd.DataFrame) -> Figure:
    """Map of the probability that the pairing of the row loses less than the pairing of the column."""
    from matplotlib.figure import Figure

    shown = ranked.head(WRITTEN)
    row_of = {both: i for i, both in enumerate(shown[PAIRING].itertuples(index=False, name=None))}
    values = np.full((len(shown), len(shown)), np.nan)
    known = compared["less_probability"].to_numpy()
    sides = (compared[[f"{other}{name}" for name in PAIRING]].to_numpy() for other in ("", "other_"))
    for first, second, less in zip(*sides, known, strict=True):
        a, b = row_of.get(tuple(first)), row_of.get(tuple(second))
        if a is not None and b is not None:
            values[a, b], values[b, a] = less, 1.0 - less
    names = pairing_names(shown)
    figure = Figure(figsize=(WIDTH, 1.9 + 0.28 * len(shown)), layout="constrained")
    axes: Any = figure.subplots()
    image = axes.imshow(values, cmap="RdBu", vmin=0.0, vmax=1.0, aspect="auto")
    axes.grid(False)
    axes.set_xticks(range(len(shown)), names, rotation=40, ha="right", fontsize=SMALL)
    axes.set_yticks(range(len(shown)), names, fontsize=SMALL)
    figure.colorbar(image, label="probability of the smaller loss (-)", shrink=0.9)
    for (i, j), value in np.ndenumerate(values):
        if np.isfinite(value):
            dark = abs(value - 0.5) > 0.35
            axes.text(j, i, f"{value:.2f}", ha="center", va="center", fontsize=6.5, color="w" if dark else "0.1")
    return figure


def cost_figure(ranked: pd.DataFrame) -> Figure:
    """Saving over the cheapest pairing against cost, with the efficient frontier."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    axes: Any = figure.subplots()
    cost, saving = (ranked[name].to_numpy() for name in ("relative_cost", "saving_percent"))
    on = ranked["efficient"].eq("yes").to_numpy()
    ends = _ends(ranked, "saving_percent")
    for chosen, colour, words in ((~on, PALE, "other pairings"), (on, DARK, "efficient frontier")):
        if ends is not None:
            axes.vlines(cost[chosen], *(end[chosen] for end in ends), color=colour, linewidth=1.0)
        axes.plot(cost[chosen], saving[chosen], "o", color=colour, label=words)
    order = np.argsort(cost[on])
    axes.step(cost[on][order], saving[on][order], where="post", color=DARK, linewidth=1.0)
    for row in ranked[on].itertuples():
        place = (row.relative_cost, row.saving_percent)
        axes.annotate(str(row.place), place, (-3, 4), textcoords="offset points", fontsize=SMALL, ha="right")
    axes.set_xlabel("relative cost of both finishes (-)")
    axes.set_ylabel("loss saved over the cheapest (%)")
    axes.margins(x=0.05, y=0.08)
    legend_above(figure, axes, "")
    return figure
