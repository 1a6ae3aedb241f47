"""Figures of a study, after those of Hong, Aneshansley and Talbot: functions of its results."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.report.style import normalised_axis, panels, shades, styled
from mixedlub.study.results import Results

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_PANELS = 6
MOST_LEVELS = 6
MOST_TORQUES = 3
MOST_PAIRINGS = 300
LONGEST = 22
SIDE_BY_SIDE = 12


def _markers(results: Results) -> str:
    """What the symbols mean, and how many of the pairings they stand for."""
    count = len(results.study.pairings)
    part = f" {MOST_PAIRINGS} of {count} pairings are shown." if count > MOST_PAIRINGS else ""
    return f"Filled: both surfaces alike; open: unlike.{part}"


@dataclass(frozen=True, eq=False)
class Drawn:
    """A figure with the name of its file and its caption."""

    name: str
    caption: str
    figure: Figure


def some(count: int, most: int) -> np.ndarray:
    """Places of at most so many levels, spread evenly, ends included.

    >>> some(4, 6).tolist(), some(10, 4).tolist()
    ([0, 1, 2, 3], [0, 3, 6, 9])
    """
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))


def spread(levels: Sequence[float], most: int) -> np.ndarray:
    """Places of at most so many levels, lowest first, whatever their order in the study.

    >>> spread([3000, 500, 1500], 6).tolist()
    [1, 2, 0]
    """
    return np.argsort(levels)[some(len(levels), most)]


def _some_of(levels: Sequence[float], most: int, what: str, unit: str) -> str:
    """Which levels are drawn, as a sentence after a caption; empty where all are.

    >>> _some_of([500, 1000, 1500, 2000], 2, "speeds", "rpm"), _some_of([500], 2, "speeds", "rpm")
    (' Drawn are 2 of 4 speeds: 500 and 2000 rpm.', '')
    """
    places = spread(levels, most)
    if len(places) == len(levels):
        return ""
    *others, last = (f"{levels[i]:.5g}" for i in places)
    return f" Drawn are {len(places)} of {len(levels)} {what}: {', '.join(others)} and {last} {unit}."


def figures(results: Results) -> Iterator[Drawn]:
    """All figures of a study; at its coldest and its hottest oil where there are several temperatures."""
    levels = results.study.file.conditions.oil_temperature_C
    with styled():
        for place in spread(levels, 2):
            yield from _at_temperature(results, int(place), len(levels) > 1)


def _at_temperature(results: Results, theta: int, several: bool) -> Iterator[Drawn]:
    oil = results.study.file.conditions.oil_temperature_C[theta]
    suffix, at = (f"_{oil:g}C", f", oil at {oil:g} °C") if several else ("", f" (oil at {oil:g} °C)")
    alike = any(a == b for a, b in results.study.pairings)
    groups = [("equal", "equal surfaces" if alike else "some pairings", equal_pairings(results))]
    smoothest = smoothest_surface(results)
    groups.append(("smooth", f"surfaces paired with {smoothest}", pairings_with(results, smoothest)))
    whose = results.study.file.options.conditions_of
    levels = results.study.file.conditions
    some_torques = _some_of(levels.torque_Nm, MOST_LEVELS, "torques", "Nm")
    told = "Above each panel, pinion / gear and their composite roughness." + some_torques
    for quantity, title in (("power_loss", "Power loss"), ("area_ratio", "Boundary area ratio")):
        for key, words, chosen in groups:
            if len(chosen):
                figure = over_speed(results, quantity, chosen, theta)
                yield Drawn(f"{quantity}_{key}{suffix}", f"{title} against {whose} speed: {words}{at}. {told}", figure)
    symbols = _markers(results)
    drawn = _some_of(levels.torque_Nm, MOST_TORQUES, "torques", "Nm")
    drawn += _some_of(levels.speed_rpm, MOST_LEVELS, "speeds", "rpm")
    fitted = f"with a straight line fitted at each torque and speed{' drawn' if drawn else ''}"
    yield Drawn(
        f"loss_over_roughness{suffix}",
        f"Power loss against composite roughness, {fitted}{at}. {symbols}{drawn}",
        loss_over(results, "composite_roughness", theta, fitted=True),
    )
    yield Drawn(
        f"loss_over_film_parameter{suffix}",
        f"Power loss against film parameter{at}. {symbols} The dashed line marks a film as thick as the composite "
        f"roughness.{drawn}",
        loss_over(results, "film_parameter", theta),
    )
    yield Drawn(
        f"loss_over_area_ratio{suffix}",
        f"Power loss against boundary area ratio, {fitted}{at}. {symbols}{drawn}",
        loss_over(results, "area_ratio", theta, fitted=True),
    )
    whose_film = "the same for all pairings" if _one_film(results) else "of the smoothest pairing"
    yield Drawn(
        f"film_and_friction{suffix}",
        f"Mean film thickness, {whose_film}, and mean friction of the smoothest and the roughest pairing{at}."
        + some_torques,
        film_and_friction(results, theta),
    )


def equal_pairings(results: Results) -> np.ndarray:
    """Pairings of a surface with itself, smoothest first, at most six; some of all where there are none."""
    pairings = results.study.pairings
    same = np.array([i for i, (a, b) in enumerate(pairings) if a == b], dtype=int)
    if not same.size:
        same = np.arange(len(pairings))
    return _some_by_roughness(results, same)


def pairings_with(results: Results, surface: str) -> np.ndarray:
    """Pairings that a surface takes part in, smoothest first, at most six."""
    found = [i for i, both in enumerate(results.study.pairings) if surface in both]
    return _some_by_roughness(results, np.array(found, dtype=int))


def smoothest_surface(results: Results) -> str:
    """The surface of least Rq."""
    return min(results.study.surfaces.values(), key=lambda s: s.m0).name


def _some_by_roughness(results: Results, chosen: np.ndarray) -> np.ndarray:
    roughness = results["composite_roughness"][chosen, 0, 0, 0]
    ordered = chosen[np.argsort(roughness, kind="stable")]
    return ordered[some(ordered.size, MOST_PANELS)] if ordered.size else ordered


def _titled(results: Results, pairing: int, more: str = "") -> str:
    """A pairing above a panel, a line a surface where both do not fit into one."""
    pinion, gear = (s if len(s) <= LONGEST else f"{s[: LONGEST - 1]}…" for s in results.study.pairings[pairing])
    long = len(pinion) + len(gear) > SIDE_BY_SIDE
    pinion, gear = (s.replace("$", r"\$") for s in (pinion, gear))
    if long:
        return f"{pinion} /\n{gear}" + (f"\n{more}" if more else "")
    return f"{pinion} / {gear}" + (f"   {more}" if more else "")


def _one_film(results: Results) -> bool:
    """Whether the film is the same for all pairings; some effects make it depend on the surfaces."""
    film = results["film_thickness"]
    return bool(np.allclose(film, film[:1], rtol=1e-9, atol=0.0))


def over_speed(results: Results, quantity: str, chosen: Sequence[int] | np.ndarray, theta: int) -> Figure:
    """A quantity over speed, a line a torque, a panel a pairing."""
    levels = results.study.file.conditions
    torques = spread(levels.torque_Nm, MOST_LEVELS)
    speeds = np.argsort(levels.speed_rpm)
    rpm = np.array(levels.speed_rpm)[speeds]
    whose = results.study.file.options.conditions_of
    loss = quantity == "power_loss"
    columns = min(3, len(chosen))
    figure, axes = panels(len(chosen), columns)
    for panel, pairing in zip(axes, chosen):
        values = results[quantity][pairing, theta]
        for colour, t in zip(shades(len(torques)), torques):
            marker = "o" if len(levels.speed_rpm) <= 25 else ""
            panel.plot(rpm, values[t, speeds], marker=marker, color=colour, label=f"{levels.torque_Nm[t]:.4g} Nm")
        sigma = results["composite_roughness"][pairing, 0, 0, 0] * 1e6
        panel.set_title(_titled(results, pairing, f"Rq {sigma:.3f} µm"), loc="left")
    left, bottom, right = _edges(axes, columns)
    for panel in left:
        panel.set_ylabel("power loss (W)" if loss else "boundary area ratio (-)")
    for panel in bottom:
        panel.set_xlabel(f"{whose} speed (rpm)")
    axes[0].set_ylim(bottom=0.0)
    axes[0].set_xlim(left=0.0)
    handles, labels = axes[0].get_legend_handles_labels()
    title = f"{whose} torque"
    figure.legend(
        handles,
        labels,
        title=title,
        title_fontsize=7.5,
        alignment="left",
        loc="outside upper left",
        ncols=len(labels),
    )
    if loss:
        most = float(results["power_loss"].max())
        for panel in right:
            normalised_axis(panel, most)
    return figure


def _edges(axes: Sequence[Axes], columns: int) -> tuple[Sequence[Axes], Sequence[Axes], Sequence[Axes]]:
    """Panels with nothing to their left, beneath, and to their right."""
    right = [a for i, a in enumerate(axes) if i % columns == columns - 1 or a is axes[-1]]
    return axes[::columns], axes[-columns:], right


AXIS = {
    "composite_roughness": ("composite roughness Rq (µm)", 1e6),
    "film_parameter": ("film parameter (-)", 1.0),
    "area_ratio": ("boundary area ratio (-)", 1.0),
}


def loss_over(results: Results, quantity: str, theta: int, *, fitted: bool = False) -> Figure:
    """Power loss of the pairings over a quantity, a panel a torque, a colour a speed; lines are fitted to all."""
    levels = results.study.file.conditions
    torques = spread(levels.torque_Nm, MOST_TORQUES)
    speeds = spread(levels.speed_rpm, MOST_LEVELS)
    label, scale = AXIS[quantity]
    figure, axes = panels(len(torques), 3, height=3.0)
    same = np.array([a == b for a, b in results.study.pairings])
    shown = np.zeros(same.size, dtype=bool)
    shown[np.argsort(results["composite_roughness"][:, 0, 0, 0])[some(same.size, MOST_PAIRINGS)]] = True
    for panel, t, letter in zip(axes, torques, "abc"):
        for colour, n in zip(shades(len(speeds)), speeds):
            x = results[quantity][:, theta, t, n] * scale
            y = results["power_loss"][:, theta, t, n]
            text = f"{levels.speed_rpm[n]:.5g} rpm"
            if fitted and np.ptp(x) > 1e-12 * np.abs(x).max() and np.ptp(y) > 0:
                slope, start = np.polyfit(x, y, 1)
                ends = np.array([x.min(), x.max()])
                panel.plot(ends, start + slope * ends, color=colour, linewidth=0.9)
                text += f"  {np.corrcoef(x, y)[0, 1] ** 2:.3f}"
            else:
                order = np.argsort(x)
                panel.plot(x[order], y[order], color=colour, linewidth=0.6)
            alike, unlike = shown & same, shown & ~same
            panel.plot(x[alike], y[alike], "o", color=colour, label=text)
            panel.plot(x[unlike], y[unlike], "o", color=colour, markerfacecolor="white", markeredgewidth=0.8)
        panel.set_title(f"({letter}) {levels.torque_Nm[t]:.4g} Nm", loc="left")
        panel.set_xlabel(label)
        if fitted or panel is axes[0]:
            _legend_above(panel, "speed, R² of the line" if fitted else "speed")
        if quantity == "film_parameter":
            panel.axvline(1.0, color="0.35", linewidth=0.8, linestyle=(0, (4, 3)))
    axes[0].set_ylabel("power loss (W)")
    axes[0].set_ylim(bottom=0.0)
    if results[quantity].min() < 0.3 * results[quantity].max():
        axes[0].set_xlim(left=0.0)
    normalised_axis(axes[-1], float(results["power_loss"].max()))
    return figure


def _legend_above(panel: Axes, title: str) -> None:
    """The speeds, fastest first as the curves lie, above the panel and clear of the data."""
    handles, labels = panel.get_legend_handles_labels()
    panel.legend(
        handles[::-1],
        labels[::-1],
        title=title,
        title_fontsize=7,
        alignment="left",
        loc="lower left",
        bbox_to_anchor=(-0.04, 1.1),
        ncols=2,
        fontsize=6.5,
        columnspacing=0.6,
        handletextpad=0.1,
        borderaxespad=0.0,
    )


def film_and_friction(results: Results, theta: int) -> Figure:
    """Film thickness over speed, and friction of the smoothest and roughest pairing."""
    levels = results.study.file.conditions
    torques = spread(levels.torque_Nm, MOST_LEVELS)
    speeds = np.argsort(levels.speed_rpm)
    rpm = np.array(levels.speed_rpm)[speeds]
    sigma = results["composite_roughness"][:, 0, 0, 0]
    ends = {"smoothest": int(sigma.argmin()), "roughest": int(sigma.argmax())}
    draw: list[tuple[str, Callable[[int], np.ndarray], str]] = [
        (
            "mean film thickness (µm)",
            lambda t: results["film_thickness"][ends["smoothest"], theta, t] * 1e6,
            "film, all pairings" if _one_film(results) else f"film, {_titled(results, ends['smoothest'])}",
        ),
        *(
            (
                "mean friction coefficient (-)",
                lambda t, i=i: results["mean_friction"][i, theta, t],
                _titled(results, i),
            )
            for i in dict.fromkeys(ends.values())
        ),
    ]
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.2, 2.7), layout="constrained")
    axes = figure.subplots(1, len(draw), squeeze=False)[0]
    for panel, (label, values, title) in zip(axes, draw):
        for colour, t in zip(shades(len(torques)), torques):
            marker = "o" if len(levels.speed_rpm) <= 25 else ""
            panel.plot(rpm, values(t)[speeds], marker=marker, color=colour, label=f"{levels.torque_Nm[t]:.4g} Nm")
        panel.set_title(title, loc="left")
        panel.set_ylabel(label)
        panel.set_xlabel(f"{results.study.file.options.conditions_of} speed (rpm)")
        panel.set_xlim(left=0.0)
        panel.set_ylim(bottom=0.0)
    if len(axes) > 2:
        top = 1.05 * float(results["mean_friction"][list(ends.values()), theta].max())
        for panel in axes[1:]:
            panel.set_ylim(0.0, top)
    axes[0].legend()
    return figure
