"""Figures of a study from Python, as on its page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.report.figures import equal_pairings
from mixedlub.report.plots import loss_over, over_speed, over_temperature
from mixedlub.report.style import styled
from mixedlub.study.columns import FIRST
from mixedlub.study.results import LEVELS, Results
from profiles.errors import InputError, nearest, refuse_other

if TYPE_CHECKING:
    from matplotlib.figure import Figure

OIL, TORQUE, SPEED = LEVELS
DRAWN = ("power_loss", "area_ratio", "film_parameter", "composite_roughness")
NAMES = {c.name: c.output for c in FIRST if c.output in DRAWN}
"""Columns drawn in figures, each with its name inside the model."""
LOSS, ROUGHNESS = "power_loss_W", "composite_roughness_um"


def plot(
    results: Results,
    quantity: str = "power_loss_W",
    over: str = "speed_rpm",
    *,
    oil_temperature_C: float | None = None,
    pairings: str | Sequence[str] = (),
) -> Figure:
    """Plot a column of a study over a condition, or the loss of all pairings over another column.

    Parameters
    ----------
    results : Results
        Results of ``ml.study.run``.
    quantity : str, optional
        ``power_loss_W``; over ``speed_rpm`` also ``boundary_area_ratio`` or ``film_parameter``.
    over : str, optional
        ``speed_rpm``: a line per torque and a panel per pairing. ``oil_temperature_C``: loss at the highest speed.
        ``composite_roughness_um``, ``film_parameter`` or ``boundary_area_ratio``: a point per pairing and
        a panel per torque.
    oil_temperature_C : float, optional
        Oil temperature (°C), a level of the study; default: the lowest. Not with ``over="oil_temperature_C"``.
    pairings : str or sequence of str, optional
        Pairings as in ``results.to_xarray()``; default: surfaces paired with themselves, at most six.

    Returns
    -------
    matplotlib.figure.Figure
        Panels in ``figure.axes``. Hollow marks and triangles are outside the range of the model.

    Raises
    ------
    profiles.errors.InputError
        If an argument is invalid.
    """
    refuse_other(results, Results, "the results of ml.study.run(...)", "plot: results")
    _refuse_unknown("quantity", quantity, [name for name in NAMES if name != ROUGHNESS])
    _refuse_unknown("over", over, [SPEED, OIL, *(name for name in NAMES if name != LOSS)])
    if quantity != LOSS and over != SPEED:
        raise InputError(f"only {LOSS} is drawn over {over}", where="plot: quantity", value=quantity)
    if over == OIL and oil_temperature_C is not None:
        raise InputError("all temperatures are drawn; leave it out", where=f"plot: {OIL}", value=oil_temperature_C)
    if over in NAMES and len(pairings):
        raise InputError(f"over {over} all pairings are drawn; leave it out", where="plot: pairings", value=pairings)
    with styled():
        if over in NAMES:
            return loss_over(results, NAMES[over], _temperature(results, oil_temperature_C))
        chosen = _pairings(results, pairings)
        if over == OIL:
            return over_temperature(results, chosen)
        return over_speed(results, NAMES[quantity], chosen, _temperature(results, oil_temperature_C))


def _refuse_unknown(key: str, name: str, known: Sequence[str]) -> None:
    if name not in known:
        raise InputError(f"cannot be drawn; {nearest(name, known)}", where=f"plot: {key}", value=name)


def _temperature(results: Results, wanted: float | None) -> int:
    """Index of an oil temperature of the study."""
    levels = results.study.file.conditions.oil_temperature_C
    if wanted is None:
        return int(np.argmin(levels))
    if wanted not in levels:
        known = ", ".join(f"{level:g}" for level in sorted(levels))
        raise InputError(f"no such level in the study; known: {known}", where=f"plot: {OIL}", value=wanted)
    return levels.index(wanted)


def _pairings(results: Results, wanted: str | Sequence[str]) -> np.ndarray:
    """Indices of the named pairings, by default of surfaces paired with themselves."""
    if not len(wanted):
        return equal_pairings(results)
    known = [f"{a} / {b}" for a, b in results.study.pairings]
    names = [wanted] if isinstance(wanted, str) else list(wanted)
    for name in names:
        if name not in known:
            raise InputError(f"no such pairing; {nearest(name, known)}", where="plot: pairings", value=name)
    return np.array([known.index(name) for name in names])
