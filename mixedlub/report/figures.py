"""The figures of a study and their captions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.report.plots import (
    LEAST_RATIO,
    MOST_LEVELS,
    MOST_PAIRINGS,
    MOST_TORQUES,
    OUTSIDE,
    film_and_friction,
    has_bands,
    has_own_scales,
    is_wide,
    loss_over,
    one_film,
    over_speed,
    over_temperature,
    shown,
    some,
    spread,
)
from mixedlub.report.style import styled
from mixedlub.study.results import Results

if TYPE_CHECKING:
    from matplotlib.figure import Figure

OVER_SPEED = {
    "power_loss": "Power loss",
    "area_ratio": "Boundary area ratio",
    "mean_asperity_load_share": "Share of the load that asperities carry",
}
"""Quantities drawn over speed, if the study has them."""
MOST_PANELS = 6
MOST_TEMPERATURES = 2


@dataclass(frozen=True, eq=False)
class Drawn:
    """A figure with the name of its file and its caption."""

    name: str
    caption: str
    figure: Figure


def figures(results: Results) -> Iterator[Drawn]:
    """All figures of a study, at its lowest and highest oil temperature."""
    levels = results.study.file.conditions.oil_temperature_C
    with styled():
        for theta in spread(levels, MOST_TEMPERATURES):
            yield from _at_temperature(results, int(theta), len(levels) > 1)
        if len(levels) > MOST_TEMPERATURES:
            yield _over_temperature(results)


def _over_temperature(results: Results) -> Drawn:
    key, words, chosen = groups(results)[0]
    whose, levels = results.study.file.options.conditions_of, results.study.file.conditions
    (fastest,) = shown([max(levels.speed_rpm)])
    return Drawn(
        f"power_loss_{key}_temperature",
        f"Power loss against oil temperature: {words} at a {whose} speed of {fastest} rpm. "
        + _title_words(_some_of(levels.torque_Nm, MOST_LEVELS, "torques", "N m"))
        + _hollow(results.outside[chosen][..., int(np.argmax(levels.speed_rpm))])
        + shaded(results),
        over_temperature(results, chosen),
    )


def _at_temperature(results: Results, theta: int, several: bool) -> Iterator[Drawn]:
    levels = results.study.file.conditions
    oil = levels.oil_temperature_C[theta]
    suffix, at = (f"_{oil:g}C", f", oil at {oil:g} °C") if several else ("", f" (oil at {oil:g} °C)")
    of_oil = _some_of(levels.oil_temperature_C, MOST_TEMPERATURES, "oil temperatures", "°C")
    whose = results.study.file.options.conditions_of
    some_torques = _some_of(levels.torque_Nm, MOST_LEVELS, "torques", "N m") + of_oil
    for quantity, title in OVER_SPEED.items():
        if quantity not in results.values:
            continue
        for key, words, chosen in groups(results):
            if len(chosen):
                caption = f"{title} against {whose} speed: {words}{at}. {_title_words(some_torques)}"
                caption += _hollow(results.outside[chosen, theta]) + shaded(results)
                if quantity == "area_ratio":
                    caption += _log_words(results["area_ratio"][chosen, theta])
                yield Drawn(f"{quantity}_{key}{suffix}", caption, over_speed(results, quantity, chosen, theta))
    drawn = _some_of(levels.torque_Nm, MOST_TORQUES, "torques", "N m")
    drawn += _some_of(levels.speed_rpm, MOST_LEVELS, "speeds", "rpm")
    fitted = f"with a straight line fitted at each torque and speed{' drawn' if drawn else ''}"
    symbols, drawn = _symbols(results, theta), drawn + of_oil
    for quantity, words, fit in (
        ("composite_roughness", "composite roughness", True),
        ("film_parameter", "film parameter", False),
        ("area_ratio", "boundary area ratio", True),
    ):
        name = quantity.removeprefix("composite_")
        text = f"Power loss against {words}{f', {fitted}' if fit else ''}{at}.{symbols}"
        text += "" if fit else " The dashed line marks a film as thick as the composite roughness."
        yield Drawn(f"loss_over_{name}{suffix}", text + drawn, loss_over(results, quantity, theta, fitted=fit))
    whose_film = "the same for all pairings" if one_film(results) else "of the smoothest pairing"
    yield Drawn(
        f"film_and_friction{suffix}",
        f"Mean film thickness, {whose_film}, and mean friction of the smoothest and the roughest pairing{at}."
        + some_torques
        + _hollow(results.outside[:, theta])
        + shaded(results),
        film_and_friction(results, theta),
    )


def _hollow(outside: np.ndarray) -> str:
    return f" Hollow marks: {OUTSIDE}, as the table says." if outside.any() else ""


def shaded(results: Results) -> str:
    """Meaning of the shaded bands; empty without bands."""
    return f" Shaded: {band_words(results)}." if has_bands(results) else ""


def band_words(results: Results) -> str:
    """Meaning of the bands of a study; empty without bands.

    The band of a study with traces and uncertain inputs adds the squares of both.
    """
    uncertain = [name.replace("_", " ") for name in results.study.file.uncertainty.stated]
    of_inputs = f"the stated uncertainty of {', '.join(uncertain)}" if uncertain else ""
    of_surfaces = BANDS.get(results.study.plan.options.bands, "")
    if not of_surfaces:
        return f"90 % intervals by {of_inputs}" if of_inputs else ""
    return f"{of_surfaces}; with {of_inputs}" if of_inputs else of_surfaces


BANDS = {
    "traces": "in 90 of 100 surfaces the true value, by the scatter of the traces",
    "short_cutoff": "from the lowest to the highest value at half, one and two short cut-offs",
    "both": "from the lowest to the highest end of the 90 % bands of the traces at half, one and two short cut-offs",
}
"""Meaning of a band, by option of the study."""


def _title_words(more: str) -> str:
    return f"Above each panel, pinion / gear and their composite roughness.{more}"


def _log_words(ratios: np.ndarray) -> str:
    if not is_wide(ratios):
        return ""
    low = f" Ratios below {LEAST_RATIO:g} are not drawn." if ratios.min() < LEAST_RATIO else ""
    return f" The axis of the ratio is logarithmic.{low}"


def _symbols(results: Results, theta: int) -> str:
    """Meaning of hollow marks, number of pairings shown, and a note on the scales."""
    count = len(results.study.pairings)
    return "".join(
        (
            _hollow(results.outside[:, theta]),
            f" {MOST_PAIRINGS} of {count} pairings are shown." if count > MOST_PAIRINGS else "",
            " Each torque has its own scale of the loss." if has_own_scales(results, theta) else "",
        )
    )


def _some_of(levels: Sequence[float], most: int, what: str, unit: str) -> str:
    """Sentence on the drawn levels for a caption; empty if all are drawn.

    >>> _some_of([500, 1000, 1500, 2000], 2, "speeds", "rpm"), _some_of([500], 2, "speeds", "rpm")
    (' Drawn are 2 of 4 speeds: 500 and 2000 rpm.', '')
    """
    places = spread(levels, most)
    if len(places) == len(levels):
        return ""
    *others, last = shown([levels[i] for i in places])
    return f" Drawn are {len(places)} of {len(levels)} {what}: {', '.join(others)} and {last} {unit}."


def groups(results: Results) -> list[tuple[str, str, np.ndarray]]:
    """Pairings drawn in one figure: key, text and indices."""
    has_equal = any(a == b for a, b in results.study.pairings)
    smoothest = smoothest_surface(results)
    return [
        ("equal", "equal surfaces" if has_equal else "some pairings", equal_pairings(results)),
        ("smooth", f"surfaces paired with {smoothest}", pairings_with(results, smoothest)),
    ]


def equal_pairings(results: Results) -> np.ndarray:
    """Pairings of a surface with itself, smoothest first, at most six; a selection of all if there are none."""
    pairings = results.study.pairings
    same = np.array([i for i, (a, b) in enumerate(pairings) if a == b], dtype=int)
    if not same.size:
        same = np.arange(len(pairings))
    return _some_by_roughness(results, same)


def pairings_with(results: Results, surface: str) -> np.ndarray:
    """Pairings with a surface, smoothest first, at most six."""
    indices = [i for i, both in enumerate(results.study.pairings) if surface in both]
    return _some_by_roughness(results, np.array(indices, dtype=int))


def smoothest_surface(results: Results) -> str:
    """Surface with the smallest Rq."""
    return min(results.study.surfaces.values(), key=lambda s: s.m0).name


def _some_by_roughness(results: Results, chosen: np.ndarray) -> np.ndarray:
    roughness = results["composite_roughness"][chosen, 0, 0, 0]
    ordered = chosen[np.argsort(roughness, kind="stable")]
    return ordered[some(ordered.size, MOST_PANELS)] if ordered.size else ordered
