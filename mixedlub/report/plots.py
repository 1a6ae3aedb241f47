"""Plots of a study, after Hong, Aneshansley and Talbot, as functions of its results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.report.style import SMALL, WIDTH, legend_above, normalised_axis, panels, shades
from mixedlub.study.bands import HIGH, LOW
from mixedlub.study.columns import COLUMNS
from mixedlub.study.results import Results

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_LEVELS = 6
MOST_TORQUES = 3
MOST_PAIRINGS = 120
LONGEST = 22
SIDE_BY_SIDE = 24
"""Number of characters of two names that fit above a panel of a third of the width."""
MOST_MARKED = 25
"""Largest number of levels along an axis with a marker each."""
WIDE = 100.0
"""Largest over smallest value from which an axis is logarithmic: a linear one would hide the small values."""
LEAST_RATIO = 1e-4
"""Boundary area ratio below which asperity friction is negligible: the end of a logarithmic axis."""
SCALE_RATIO = 4.0
"""Ratio of the largest losses of two panels above which each panel has a separate scale."""

AXIS = {
    "composite_roughness": ("composite roughness Rq (µm)", 1e6),
    "film_parameter": ("film parameter (-)", 1.0),
    "area_ratio": ("boundary area ratio (-)", 1.0),
    "mean_asperity_load_share": ("asperity load share (-)", 1.0),
    "power_loss": ("power loss (W)", 1.0),
}
"""Label of each quantity, and the factor from SI to its unit."""
OUTSIDE = "outside the model's range"
"""Meaning of a hollow mark in every figure of a study; shapes only distinguish torques within a panel."""


def some(count: int, most: int) -> np.ndarray:
    """Indices of at most ``most`` levels, evenly spaced, ends included.

    >>> some(4, 6).tolist(), some(10, 4).tolist()
    ([0, 1, 2, 3], [0, 3, 6, 9])
    """
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))


def spread(levels: Sequence[float], most: int) -> np.ndarray:
    """Indices of at most ``most`` levels, lowest first, independent of their order in the study.

    >>> spread([3000, 500, 1500], 6).tolist()
    [1, 2, 0]
    """
    return np.argsort(levels)[some(len(levels), most)]


def shown(levels: Sequence[float]) -> list[str]:
    """Levels with four digits, or more if two levels would look equal.

    >>> shown([68.7342, 2987.12, 12000]), shown([0.98711, 0.98714])
    (['68.73', '2987', '12000'], ['0.98711', '0.98714'])
    """
    for digits in range(4, 17):
        texts = [np.format_float_positional(v, digits, unique=False, fractional=False, trim="-") for v in levels]
        if len(set(texts)) == len(set(levels)):
            break
    return texts


def paired_title(results: Results, pairing: int, more: str = "", fit: int = SIDE_BY_SIDE) -> str:
    """Title of a pairing; a line per surface if a single line would exceed ``fit`` letters."""
    pinion, gear = (s if len(s) <= LONGEST else f"{s[: LONGEST - 1]}…" for s in results.study.pairings[pairing])
    between = " /\n" if len(pinion) + len(gear) > fit else " / "
    names = between.join(s.replace("$", r"\$") for s in (pinion, gear))
    return f"{names}\n{more}" if more else names


def _whose(results: Results) -> str:
    return results.study.file.options.conditions_of


def points(panel: Axes, x: np.ndarray, y: np.ndarray, outside: np.ndarray, colour: Any, shape: str = "o") -> None:
    """Marks of points, hollow where a condition is outside the model's range."""
    for face, at in ((colour, ~outside), ("white", outside)):
        panel.plot(x[at], y[at], shape, color=colour, markerfacecolor=face, markeredgewidth=0.6)


def mark(shape: str, colour: Any, face: Any = None) -> Any:
    """A mark for a legend."""
    from matplotlib.lines import Line2D

    return Line2D([], [], marker=shape, color=colour, linestyle="", markerfacecolor=face or colour)


def with_hollow(
    handles: Sequence[Any], names: Sequence[str], outside: np.ndarray
) -> tuple[Sequence[Any], Sequence[str]]:
    """Legend entries, including hollow marks if any are drawn."""
    if not outside.any():
        return handles, names
    return [*handles, mark("o", "0.35", "white")], [*names, OUTSIDE]


def _curve(panel: Axes, x: np.ndarray, y: np.ndarray, outside: np.ndarray, colour: Any, label: str) -> None:
    """A line with marks, hollow outside the model's range; of many conditions some are marked."""
    panel.plot(x, y, color=colour, marker="o", markevery=np.flatnonzero(~outside & _marked(x.size)), label=label)
    hollow = outside & _marked(x.size)
    if hollow.any():
        panel.scatter(x[hollow], y[hollow], 13.0, facecolor="white", edgecolor=[colour], linewidth=0.8, zorder=3)


def _shade(
    panel: Axes, results: Results, quantity: str, x: np.ndarray, at: Callable[[np.ndarray], np.ndarray], colour: Any
) -> None:
    """Draw the band of a curve, if the study has bands; ``at`` extracts the curve from an output."""
    if has_bands(results):
        factor = COLUMNS[quantity].factor if quantity == "film_thickness" else 1.0
        low, high = (factor * at(results[end + quantity]) for end in (LOW, HIGH))
        panel.fill_between(x, low, high, color=colour, alpha=0.2, linewidth=0.0)


def has_bands(results: Results) -> bool:
    """Whether a study has low and high columns."""
    return bool(results.study.plan.bands)


def _marked(count: int) -> np.ndarray:
    return np.isin(np.arange(count), some(count, MOST_MARKED))


def over_speed(results: Results, quantity: str, chosen: Sequence[int] | np.ndarray, theta: int) -> Figure:
    """A quantity over speed, one line per torque, one panel per pairing."""
    levels = results.study.file.conditions
    order = np.argsort(levels.speed_rpm)

    def values(array: np.ndarray, pairing: int, torque: int) -> np.ndarray:
        return array[pairing, theta, torque][order]

    figure, axes = _over(results, quantity, chosen, np.array(levels.speed_rpm)[order], values)
    for panel in axes:
        if panel.get_xlabel():
            panel.set_xlabel(f"{_whose(results)} speed (rpm)")
        panel.set_xlim(left=0.0)
    return figure


def over_temperature(results: Results, chosen: Sequence[int] | np.ndarray) -> Figure:
    """Power loss over oil temperature at the highest speed, one line per torque, one panel per pairing."""
    levels = results.study.file.conditions
    order, fastest = np.argsort(levels.oil_temperature_C), int(np.argmax(levels.speed_rpm))

    def values(array: np.ndarray, pairing: int, torque: int) -> np.ndarray:
        return array[pairing, :, torque, fastest][order]

    figure, axes = _over(results, "power_loss", chosen, np.array(levels.oil_temperature_C)[order], values)
    for panel in axes:
        if panel.get_xlabel():
            panel.set_xlabel("oil temperature (°C)")
    return figure


def _over(
    results: Results,
    quantity: str,
    chosen: Sequence[int] | np.ndarray,
    x: np.ndarray,
    values: Callable[[np.ndarray, int, int], np.ndarray],
) -> tuple[Figure, Sequence[Axes]]:
    """A quantity over a condition, one line per torque, one panel per pairing; the lowest panels have a label."""
    from matplotlib.ticker import NullLocator

    torques = spread(results.study.file.conditions.torque_Nm, MOST_LEVELS)
    labels = torque_labels(results, torques)
    figure, axes, columns = panels(len(chosen), 3)
    for panel, pairing in zip(axes, chosen):
        for colour, t, label in zip(shades(len(torques)), torques, labels):
            outside = values(results.outside, pairing, t)
            _curve(panel, x, values(results[quantity], pairing, t), outside, colour, label)
            _shade(panel, results, quantity, x, lambda a, p=pairing, t=t: values(a, p, t), colour)  # type: ignore[misc]
        sigma = results["composite_roughness"][pairing, 0, 0, 0] * 1e6
        panel.set_title(paired_title(results, pairing, f"Rq {sigma:.3f} µm"), loc="left")
    for number, panel in enumerate(axes):
        if number % columns == 0:
            panel.set_ylabel(AXIS[quantity][0])
        # Below an incomplete row every panel is labelled, so that all rows are of one height.
        if number + columns >= len(axes) or len(axes) % columns:
            panel.set_xlabel("-")
        if quantity == "power_loss" and number % columns == columns - 1:
            normalised_axis(panel, float(results["power_loss"].max()))
    drawn = np.concatenate([values(results[quantity], p, t) for p in chosen for t in torques])
    if quantity == "area_ratio" and is_wide(drawn):
        for panel in axes:
            panel.set_yscale("log")
            panel.yaxis.set_minor_locator(NullLocator())  # finding room for minor ticks takes longest of all
        axes[0].set_ylim(bottom=max(LEAST_RATIO, 0.7 * drawn[drawn > 0].min()), top=1.5 * drawn.max())
    else:
        axes[0].set_ylim(bottom=0.0)
    outside = np.concatenate([values(results.outside, p, t) for p in chosen for t in torques])
    _torque_legend(figure, axes[0], results, outside)
    return figure, axes


def _torque_legend(figure: Figure, panel: Axes, results: Results, outside: np.ndarray) -> None:
    handles, names = panel.get_legend_handles_labels()
    legend_above(figure, with_hollow(handles, names, outside), f"{_whose(results)} torque")


def is_wide(values: np.ndarray) -> bool:
    """Whether values differ so much that a linear axis would hide the small ones."""
    return bool(values.max() > 0) and float(values.min()) * WIDE < float(values.max())


def torque_labels(results: Results, places: Sequence[int] | np.ndarray) -> list[str]:
    return [f"{text} N m" for text in shown([results.study.file.conditions.torque_Nm[t] for t in places])]


def loss_over(results: Results, quantity: str, theta: int, *, fitted: bool = False) -> Figure:
    """Power loss of the pairings over a quantity, one panel per torque, one colour per speed; lines fit all."""
    levels = results.study.file.conditions
    torques, speeds = spread(levels.torque_Nm, MOST_TORQUES), spread(levels.speed_rpm, MOST_LEVELS)
    own_scales = has_own_scales(results, theta)
    figure, axes, _ = panels(len(torques), 3, height=2.9, sharey=not own_scales)
    squares: list[list[str]] = [[] for _ in speeds]
    for panel, t, text, letter in zip(axes, torques, torque_labels(results, torques), "abc"):
        for colour, n, fits in zip(shades(len(speeds)), speeds, squares):
            x = results[quantity][:, theta, t, n] * AXIS[quantity][1]
            y = results["power_loss"][:, theta, t, n]
            fits.append(_line(panel, x, y, colour) if fitted else "")
            at = _some_points(x, y)
            points(panel, x[at], y[at], results.outside[at, theta, t, n], colour)
        panel.set_title(f"({letter}) {text}", loc="left")
        panel.set_xlabel(AXIS[quantity][0])
        if quantity == "film_parameter":
            panel.axvline(1.0, color="0.35", linewidth=0.8, linestyle=(0, (4, 3)))
    for panel in axes:
        panel.set_ylim(bottom=0.0)
    names = [f"{text} rpm" for text in shown([levels.speed_rpm[n] for n in speeds])]
    if fitted:
        letters = ", ".join(f"({letter})" for letter, _ in zip("abc", torques))
        names = [f"{name}: R² {', '.join(fits)}" for name, fits in zip(names, squares)]
    title = f"{_whose(results)} speed" + (f", and R² of its lines in {letters}" if fitted else "")
    handles = [mark("o", colour) for colour in shades(len(speeds))]
    outside = results.outside[:, theta][:, torques][..., speeds]
    legend_above(figure, with_hollow(handles[::-1], names[::-1], outside), title, columns=2 if fitted else 6)
    axes[0].set_ylabel(AXIS["power_loss"][0])
    if results[quantity].min() < 0.3 * results[quantity].max():
        axes[0].set_xlim(left=0.0)
    if not own_scales:
        normalised_axis(axes[-1], float(results["power_loss"].max()))
    return figure


def has_own_scales(results: Results, theta: int) -> bool:
    """Whether losses at the drawn torques differ so much that a common scale would leave a panel empty."""
    torques = spread(results.study.file.conditions.torque_Nm, MOST_TORQUES)
    most = results["power_loss"][:, theta, torques].max(axis=(0, 2))
    return bool(most.max() > SCALE_RATIO * most.min())


def _line(panel: Axes, x: np.ndarray, y: np.ndarray, colour: Any) -> str:
    """Draw the regression line of all points and return its coefficient of determination."""
    if np.ptp(x) <= 1e-12 * np.abs(x).max() or np.ptp(y) == 0:
        return "–"
    slope, start = np.polyfit(x, y, 1)
    ends = np.array([x.min(), x.max()])
    panel.plot(ends, start + slope * ends, color=colour, linewidth=0.9)
    return f"{np.corrcoef(x, y)[0, 1] ** 2:.3f}"


def _some_points(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Drawn points: of very many a selection that includes the extremes."""
    return np.unique([*np.argsort(x)[some(x.size, MOST_PAIRINGS)], y.argmin(), y.argmax()])


def film_and_friction(results: Results, theta: int) -> Figure:
    """Film thickness over speed, and friction of the smoothest and roughest pairing."""
    from matplotlib.figure import Figure

    levels = results.study.file.conditions
    torques, order = spread(levels.torque_Nm, MOST_LEVELS), np.argsort(levels.speed_rpm)
    rpm = np.array(levels.speed_rpm)[order]
    sigma = results["composite_roughness"][:, 0, 0, 0]
    ends = tuple(dict.fromkeys((int(sigma.argmin()), int(sigma.argmax()))))
    film = "all pairings" if one_film(results) else paired_title(results, ends[0])
    draw: list[tuple[str, str, int, str]] = [
        ("mean film thickness (µm)", "film_thickness", ends[0], f"film: {film}"),
        *(("mean friction coefficient (-)", "mean_friction", i, f"friction: {paired_title(results, i)}") for i in ends),
    ]
    figure = Figure(figsize=(WIDTH, 2.9), layout="constrained")
    axes = figure.subplots(1, len(draw), squeeze=False)[0]
    for panel, (label, quantity, i, title) in zip(axes, draw):
        values = results[quantity][i, theta] * (1e6 if quantity == "film_thickness" else 1.0)
        outside = results.outside[i, theta] & (quantity != "film_thickness")
        for colour, t, text in zip(shades(len(torques)), torques, torque_labels(results, torques)):
            _curve(panel, rpm, values[t, order], outside[t, order], colour, text)
            _shade(panel, results, quantity, rpm, lambda a, i=i, t=t: a[i, theta, t, order], colour)  # type: ignore[misc]
        panel.set_title(title, loc="left", fontsize=SMALL)
        panel.set_ylabel(label)
        panel.set_xlabel(f"{_whose(results)} speed (rpm)")
        panel.set_xlim(left=0.0)
        panel.set_ylim(bottom=0.0)
    top = 1.05 * float(results["mean_friction"][list(ends), theta].max())
    for panel in axes[1:]:
        panel.set_ylim(0.0, top)
    _torque_legend(figure, axes[0], results, results.outside[list(ends), theta][:, torques])
    return figure


def one_film(results: Results) -> bool:
    """Whether the film is the same for all pairings; with some effects it depends on the surfaces."""
    film = results["film_thickness"]
    return bool(np.allclose(film, film[:1], rtol=1e-9, atol=0.0))
