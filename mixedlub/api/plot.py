"""Figures of studies, answers, labelled arrays and tables from Python."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.api.diagnosis import Answer
from mixedlub.api.fit import LawFit
from mixedlub.api.plot_labelled import of_dataset, of_fit, of_table
from mixedlub.api.plot_parts import DRAWN as PARTS
from mixedlub.api.plot_parts import of_part
from mixedlub.report.figures import equal_pairings
from mixedlub.report.plots import loss_over, over_speed, over_temperature
from mixedlub.report.style import as_svg, styled
from mixedlub.study.columns import FIRST
from mixedlub.study.results import LEVELS, Results
from profiles.errors import InputError, nearest

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

OIL, TORQUE, SPEED = LEVELS
DRAWN = ("power_loss", "area_ratio", "film_parameter", "composite_roughness")
NAMES = {c.name: c.output for c in FIRST if c.output in DRAWN}
"""Columns drawn in figures, each with its name inside the model."""
LOSS, ROUGHNESS = "power_loss_W", "composite_roughness_um"


def plot(
    results: Any,
    quantity: str | None = None,
    over: str | None = None,
    *,
    oil_temperature_C: float | None = None,
    pairings: str | Sequence[str] = (),
    later: ArrayLike | None = None,
) -> Figure:
    """Plot the results of a study, the answer of a diagnosis, a labelled array, a table, fitted laws or a part.

    Parameters
    ----------
    results : Results, Answer, LawFit, xarray.Dataset, pandas.DataFrame, Gears, Lubricant or SurfaceSection
        Result of ``ml.study.run``, ``ml.diagnose``, ``ml.fit_laws``, ``ml.power_loss``, ``ml.along_path``,
        ``ml.load_distribution``, ``ml.gearbox_efficiency`` or ``ml.simulate``, a table of ``ml.evaluate_recording``, or
        gears, an oil or a surface with a trace.
    quantity : str, optional
        Of a study ``power_loss_W`` (default); over ``speed_rpm`` also ``boundary_area_ratio`` or ``film_parameter``.
        Of an array or table the variable or column; default: loss, friction or load, else the first.
    over : str, optional
        Of a study ``speed_rpm`` (default): a line per torque and a panel per pairing; ``oil_temperature_C``: loss at
        the highest speed; ``composite_roughness_um``, ``film_parameter`` or ``boundary_area_ratio``: a point per
        pairing and a panel per torque. Of other results a dimension or condition; default: the longest, or the
        condition of the mismatch.
    oil_temperature_C : float, optional
        Of a study: oil temperature (°C), one of its levels; default: the lowest. Not with ``over="oil_temperature_C"``.
    pairings : str or sequence of str, optional
        Of a study: pairings as in ``results.to_xarray()``; default: surfaces paired with themselves, at most six.
    later : array_like, optional
        Of an answer: readings measured afterwards at the conditions of ``predict``, in their order.

    Returns
    -------
    matplotlib.figure.Figure
        Panels in ``figure.axes``. Hollow marks and triangles are outside the range of the model.

    Raises
    ------
    profiles.errors.InputError
        If an argument is invalid.

    Examples
    --------
    >>> import mixedlub as ml
    >>> pair = ml.gear_pair(teeth=(17, 26), normal_module_mm=4.2333, pressure_angle_deg=22.5, face_width_mm=14.0)
    >>> path = ml.along_path(
    ...     pair, ml.oil("mineral"), ml.surface(Ra_um=0.3), torque_Nm=100, speed_rpm=1500, oil_temperature_C=60
    ... )
    >>> ml.plot(path, "load_share").axes[0].get_xlabel()
    'roll angle (°)'
    """
    figure = _figure(results, quantity, over, oil_temperature_C, pairings, later)
    # A notebook shows figures that pyplot has not made by this method alone.
    setattr(figure, "_repr_svg_", partial(as_svg, figure))  # noqa: B010
    return figure


def _figure(
    results: Any,
    quantity: str | None,
    over: str | None,
    oil_temperature_C: float | None,
    pairings: str | Sequence[str],
    later: ArrayLike | None,
) -> Figure:
    """Figure of a result by its type."""
    import pandas as pd
    import xarray as xr

    if isinstance(results, Results):
        _only(later is None, "later", "an answer")
        return _of_study(results, quantity or LOSS, over or SPEED, oil_temperature_C, pairings)
    _only(oil_temperature_C is None, OIL, "a study")
    _only(not len(pairings), "pairings", "a study")
    if isinstance(results, Answer):
        _only(quantity is None, "quantity", "a study, an array or a table")
        return results.plot(over, later)
    _only(later is None, "later", "an answer")
    if isinstance(results, LawFit):
        _only(quantity is None, "quantity", "a study, an array or a table")
        return of_fit(results, over)
    if isinstance(results, PARTS):
        _only(quantity is None and over is None, "quantity, over", "results, and a part has one figure")
        return of_part(results)
    if isinstance(results, xr.Dataset):
        return of_dataset(results, quantity, over)
    if isinstance(results, pd.DataFrame):
        return of_table(results, quantity, over)
    if isinstance(results, dict) and results and all(isinstance(one, pd.DataFrame) for one in results.values()):
        raise InputError(f"draws one table; choose among {', '.join(results)}", where="plot: results")
    rule = "must be a result, as of ml.study.run(...), ml.power_loss(...) or ml.diagnose(...)"
    raise InputError(f"{rule}, not {type(results).__name__}", where="plot: results")


def _only(left_out: bool, key: str, of: str) -> None:
    if not left_out:
        raise InputError(f"belongs to {of}; leave it out", where=f"plot: {key}")


def _of_study(
    results: Results, quantity: str, over: str, oil_temperature_C: float | None, pairings: str | Sequence[str]
) -> Figure:
    """Figure of a study, as on its page."""
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
