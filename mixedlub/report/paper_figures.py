"""Figures 4 to 10 of Hong, Aneshansley and Talbot for the pairings of a study: normalised, one column wide."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.report.figures import Drawn, groups, shaded
from mixedlub.report.plots import (
    AXIS,
    MOST_LEVELS,
    MOST_TORQUES,
    OUTSIDE,
    has_bands,
    mark,
    paired_title,
    points,
    shown,
    spread,
    torque_labels,
    with_hollow,
)
from mixedlub.report.style import shades, styled
from mixedlub.study.bands import HIGH, LOW
from mixedlub.study.fits import can_be_fitted, straight_line
from mixedlub.study.results import Results

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WIDTH = 3.46
"""Width of a journal column (inches), 88 mm."""
TEXT = 7.0
SIZES: dict[Any, Any] = {
    "font.size": TEXT,
    "axes.titlesize": 7.0,
    "axes.labelsize": 7.0,
    "legend.fontsize": 6.5,
    "lines.linewidth": 1.0,
    "lines.markersize": 2.6,
    "axes.titlepad": 3.0,
    "axes.labelpad": 2.0,
}
"""Settings of text and lines at that width; journals ask for 6 points or more."""
SHAPES = "^sD"
"""Marks of the torques, if not separated by panels."""
LOSS = "normalised power loss (-)"
RATIO = "boundary area ratio (-)"
HOLLOW = f" Hollow: {OUTSIDE}."
SIDE_BY_SIDE, LONGEST_LINE = 13, 16
"""Numbers of letters, of two names and of a line, that fit above a panel of a third of the width."""


def paper_figures(results: Results) -> Iterator[Drawn]:
    """The figures by their number in the paper, at the lowest oil temperature."""
    import matplotlib

    theta = int(np.argmin(results.study.file.conditions.oil_temperature_C))
    oil = f"oil at {results.study.file.conditions.oil_temperature_C[theta]:g} °C"
    with styled(), matplotlib.rc_context(SIZES):
        number = 4
        for quantity, label, words in (
            ("normalised_loss", LOSS, "Normalised power loss"),
            ("area_ratio", RATIO, RATIO[:-4]),
        ):
            for key, which, chosen in groups(results):
                caption = f"{words[:1].upper()}{words[1:]} against speed: {which}, {oil}.{HOLLOW}{shaded(results)}"
                figure = _small(results, quantity, chosen, theta, label)
                yield Drawn(f"paper_{number:02}_{quantity}_{key}", caption, figure)
                number += 1
        for number, quantity in ((8, "composite_roughness"), (9, "film_parameter"), (10, "area_ratio")):
            what = AXIS[quantity][0].partition(" (")[0]
            caption = f"Normalised power loss against {what} for all pairings, {oil}.{HOLLOW}"
            draw = _by_torque if quantity == "composite_roughness" else _together
            yield Drawn(f"paper_{number:02}_loss_over_{quantity}", caption, draw(results, quantity, theta))


def _small(results: Results, quantity: str, chosen: Sequence[int] | np.ndarray, theta: int, label: str) -> Figure:
    """A quantity over speed, a small panel per pairing and a line per torque."""
    from matplotlib.figure import Figure
    from matplotlib.ticker import MaxNLocator

    levels = results.study.file.conditions
    torques, order = spread(levels.torque_Nm, MOST_LEVELS), np.argsort(levels.speed_rpm)
    thousands = np.array(levels.speed_rpm)[order] * 1e-3
    titles = [paired_title(results, pairing, fit=SIDE_BY_SIDE) for pairing in chosen]
    lines = [line for title in titles for line in title.split("\n")]
    columns = min(len(chosen), 3 if max(map(len, lines)) <= LONGEST_LINE else 2)
    rows = -(-len(chosen) // columns)
    height = 1.15 if len(lines) == len(titles) else 1.3
    figure = Figure(figsize=(WIDTH, height * rows + 0.6), layout="constrained")
    axes = list(figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).flat)
    for panel, pairing, title in zip(axes, chosen, titles):
        for colour, t in zip(shades(len(torques)), torques):
            y = results[quantity][pairing, theta, t, order]
            panel.plot(thousands, y, color=colour)
            if has_bands(results):
                low, high = (results[end + quantity][pairing, theta, t, order] for end in (LOW, HIGH))
                panel.fill_between(thousands, low, high, color=colour, alpha=0.2, linewidth=0.0)
            points(panel, thousands, y, results.outside[pairing, theta, t, order], colour)
        panel.set_title(title, loc="left")
    for empty in axes[len(chosen) :]:
        empty.set_visible(False)
    for lowest in axes[max(0, len(chosen) - columns) : len(chosen)]:
        lowest.tick_params(labelbottom=True)
    first = figure.axes[0]
    first.set_ylim(bottom=0.0, top=max(1.05, first.get_ylim()[1]) if quantity == "normalised_loss" else None)
    first.set_xlim(0.0, 1.05 * thousands.max())
    first.xaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
    first.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
    figure.supxlabel(f"{results.study.file.options.conditions_of} speed (1000 rpm)", fontsize=TEXT)
    figure.supylabel(label, fontsize=TEXT)
    handles = [mark("o", colour) for colour in shades(len(torques))]
    outside = results.outside[chosen, theta][:, torques]
    _legend(figure, *with_hollow(handles, torque_labels(results, torques), outside), 3)
    return figure


def _by_torque(results: Results, quantity: str, theta: int) -> Figure:
    """The normalised loss of all pairings over a quantity: panels (a), (b), (c) by torque, a line per speed."""
    from matplotlib.figure import Figure

    levels = results.study.file.conditions
    torques, speeds = spread(levels.torque_Nm, MOST_TORQUES), spread(levels.speed_rpm, MOST_LEVELS)
    figure = Figure(figsize=(WIDTH, 1.55 * len(torques) + 0.6), layout="constrained")
    axes = figure.subplots(len(torques), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    for panel, t, text, letter in zip(axes, torques, torque_labels(results, torques), "abc"):
        for colour, n in zip(shades(len(speeds)), speeds):
            x, y = _points(results, quantity, theta, int(t), int(n))
            if can_be_fitted(results):
                line, ends = straight_line(x, y), np.array([x.min(), x.max()])
                panel.plot(ends, line.intercept + line.slope * ends, color=colour, linewidth=0.7)
            points(panel, x, y, results.outside[:, theta, t, n], colour)
        panel.set_title(f"({letter}) {text}", loc="left")
    _finish(figure, axes, quantity)
    _legend(figure, *with_hollow(*_speeds(results, speeds), results.outside[:, theta][:, torques][..., speeds]), 3)
    return figure


def _together(results: Results, quantity: str, theta: int) -> Figure:
    """The normalised loss of all pairings over a quantity in one panel: colours by speed, marks by torque."""
    from matplotlib.figure import Figure

    levels = results.study.file.conditions
    torques, speeds = spread(levels.torque_Nm, MOST_TORQUES), spread(levels.speed_rpm, MOST_LEVELS)
    figure = Figure(figsize=(WIDTH, 3.1), layout="constrained")
    panel = figure.subplots()
    for shape, t in zip(SHAPES, torques):
        for colour, n in zip(shades(len(speeds)), speeds):
            x, y = _points(results, quantity, theta, int(t), int(n))
            points(panel, x, y, results.outside[:, theta, t, n], colour, shape)
    if quantity == "film_parameter":
        panel.axvline(1.0, color="0.35", linewidth=0.8, linestyle=(0, (4, 3)), zorder=0)
    _finish(figure, [panel], quantity)
    handles, names = _speeds(results, speeds)
    outside = results.outside[:, theta][:, torques][..., speeds]
    shapes, told = with_hollow(
        [mark(shape, "0.35") for shape, _ in zip(SHAPES, torques)], torque_labels(results, torques), outside
    )
    rows = max(-(-len(names) // 2), len(told))
    empty = 2 * rows - len(names)  # torques take the last column
    _legend(figure, [*handles, *[mark("", "none")] * empty, *shapes], [*names, *[""] * empty, *told], 3)
    return figure


def _points(results: Results, quantity: str, theta: int, torque: int, speed: int) -> tuple[np.ndarray, np.ndarray]:
    x = results[quantity][:, theta, torque, speed] * AXIS[quantity][1]
    return x, results["normalised_loss"][:, theta, torque, speed]


def _finish(figure: Figure, axes: Sequence[Axes] | np.ndarray, quantity: str) -> None:
    axes[-1].set_xlabel(AXIS[quantity][0])
    axes[0].set_ylim(0.0, 1.05)
    axes[0].set_xlim(left=0.0)
    figure.supylabel(LOSS, fontsize=TEXT)


def _speeds(results: Results, places: Sequence[int] | np.ndarray) -> tuple[list[Any], list[str]]:
    names = [f"{text} rpm" for text in shown([results.study.file.conditions.speed_rpm[n] for n in places])]
    return [mark("o", colour) for colour in shades(len(places))], names


def _legend(figure: Figure, handles: Sequence[Any], names: Sequence[str], columns: int) -> None:
    figure.legend(
        handles,
        names,
        loc="outside upper center",
        ncols=min(columns, len(names)),
        columnspacing=1.0,
        handletextpad=0.2,
        borderpad=0.2,
    )
