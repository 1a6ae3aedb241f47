"""Power loss of a gear pair over conditions, and the contact along its path, as labelled arrays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from mixedlub.schema.findings import as_texts, warn_of
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.surface_file import SurfaceSection
from mixedlub.schema.system_file import Gears
from mixedlub.schema.toml_file import parse
from mixedlub.study.curves import ALONG_PATH, OF_POINTS
from mixedlub.study.friction_comparison import judged
from mixedlub.study.plan import Study, read_study
from mixedlub.study.results import results_of, run_study
from mixedlub.study.schema import StudyFile
from profiles.errors import InputError, refuse_masked

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import ArrayLike

Part = TypeVar("Part")
Surfaces = SurfaceSection | Sequence[SurfaceSection]


def power_loss(
    gears: Gears,
    oil: Lubricant,
    surfaces: Surfaces,
    *,
    torque_Nm: ArrayLike,
    speed_rpm: ArrayLike,
    oil_temperature_C: ArrayLike,
    boundary_friction: float = 0.1,
    options: Mapping[str, Any] | None = None,
    effects: Mapping[str, Mapping[str, float | str]] | None = None,
) -> xr.Dataset:
    """Power loss of a gear pair at every combination of torque, speed and oil temperature.

    Parameters
    ----------
    gears : Gears
        Gear pair of ``ml.gear_pair``.
    oil : Lubricant
        Oil of ``ml.oil``.
    surfaces : SurfaceSection or sequence of two SurfaceSection
        Surfaces of ``ml.surface``: of both gears, or of pinion and gear.
    torque_Nm : array_like
        Torque on the pinion (N m), scalar or 1-d.
    speed_rpm : array_like
        Speed of the pinion (1/min), scalar or 1-d.
    oil_temperature_C : array_like
        Oil temperature (°C), scalar or 1-d.
    boundary_friction : float, optional
        Friction coefficient of the asperities (-).
    options, effects : mapping, optional
        Sections ``[options]`` and ``[effects]`` of a study file.

    Returns
    -------
    xarray.Dataset
        Columns of a study's table with their units; each condition given as a list is a dimension.
        ``attrs["findings"]`` lists all notes, cautions and doubts; cautions and doubts are also issued as
        ``ml.CautionWarning``.

    Raises
    ------
    profiles.errors.InputError
        If an argument is invalid.

    Examples
    --------
    >>> import mixedlub as ml
    >>> pair = ml.gear_pair(teeth=(17, 26), normal_module_mm=4.2333, pressure_angle_deg=22.5, face_width_mm=14.0)
    >>> ground = ml.surface(m0_um2=0.137, m2=0.0031, m4_per_um2=0.0021)
    >>> loss = ml.power_loss(
    ...     pair, ml.oil("mineral"), ground, torque_Nm=[50, 100, 150], speed_rpm=1500, oil_temperature_C=60
    ... )
    >>> loss["power_loss_W"].dims, loss["power_loss_W"].attrs["units"]
    (('torque_Nm',), 'W')
    """
    conditions = {"torque_Nm": torque_Nm, "speed_rpm": speed_rpm, "oil_temperature_C": oil_temperature_C}
    study = _study("power_loss", gears, oil, surfaces, conditions, boundary_friction, options, effects)
    results = run_study(study)
    warn_of(results.findings)
    grid = results.to_xarray().isel(pairing=0, drop=True)
    single = {name: 0 for name, values in conditions.items() if np.ndim(values) == 0}
    return grid.isel(single)


def along_path(
    gears: Gears,
    oil: Lubricant,
    surfaces: Surfaces,
    *,
    torque_Nm: float,
    speed_rpm: float,
    oil_temperature_C: float,
    boundary_friction: float = 0.1,
    options: Mapping[str, Any] | None = None,
    effects: Mapping[str, Mapping[str, float | str]] | None = None,
) -> xr.Dataset:
    """Load, film, contact and friction of a tooth pair along the path of contact, at one condition.

    Parameters
    ----------
    gears : Gears
        Gear pair of ``ml.gear_pair``.
    oil : Lubricant
        Oil of ``ml.oil``.
    surfaces : SurfaceSection or sequence of two SurfaceSection
        Surfaces of ``ml.surface``: of both gears, or of pinion and gear.
    torque_Nm : float
        Torque on the pinion (N m).
    speed_rpm : float
        Speed of the pinion (1/min).
    oil_temperature_C : float
        Oil temperature (°C).
    boundary_friction : float, optional
        Friction coefficient of the asperities (-).
    options, effects : mapping, optional
        Sections ``[options]`` and ``[effects]`` of a study file.

    Returns
    -------
    xarray.Dataset
        Variables with their units over ``roll_angle_deg`` of the pinion, for a sliced face also over
        ``face_position_mm``. ``friction_validity``: whether a friction law of ``options`` holds at the point.
        ``attrs["findings"]`` as for ``ml.power_loss``.

    Raises
    ------
    profiles.errors.InputError
        If an argument is invalid, or a condition is not a single number.

    Examples
    --------
    >>> import mixedlub as ml
    >>> pair = ml.gear_pair(teeth=(17, 26), normal_module_mm=4.2333, pressure_angle_deg=22.5, face_width_mm=14.0)
    >>> ground = ml.surface(m0_um2=0.137, m2=0.0031, m4_per_um2=0.0021)
    >>> path = ml.along_path(pair, ml.oil("mineral"), ground, torque_Nm=100, speed_rpm=1500, oil_temperature_C=60)
    >>> path["friction"].dims, float(path["load_share"].max())
    (('roll_angle_deg',), 1.0)
    """
    import xarray as xr

    conditions = {"torque_Nm": torque_Nm, "speed_rpm": speed_rpm, "oil_temperature_C": oil_temperature_C}
    for name, value in conditions.items():
        if np.ndim(value) > 0:
            rule = "takes one number; ml.power_loss takes lists, or call it for each"
            raise InputError(rule, where=f"along_path: {name}", value=value)
    study = _study("along_path", gears, oil, surfaces, conditions, boundary_friction, options, effects)
    with np.errstate(all="ignore"):
        state = study.plan.model(OF_POINTS)(study.plan.inputs, study.plan.parameters)
        findings = results_of(study, state).findings
    points = study.mesh
    shape = (points.position.size // points.slices, points.slices)
    angle = np.degrees(points.roll_angle).reshape(shape)[:, 0]
    face = 1e3 * points.face_position.reshape(shape)[0]
    variables = {
        c.name: (
            ("roll_angle_deg", "face_position_mm"),
            c.of(np.broadcast_to(state[c.output], (1, 1, 1, 1, points.position.size)).reshape(shape)),
            {"units": c.unit, "long_name": c.meaning},
        )
        for c in ALONG_PATH
    }
    law = study.plan.friction
    if law is not None:
        holds = judged(law, state, (points.position.size,))
        variables["friction_validity"] = (
            ("roll_angle_deg", "face_position_mm"),
            holds.reshape(shape),
            {"long_name": f"whether {law.name} holds at the point"},
        )
    warn_of(findings)
    whole = {**conditions, "findings": as_texts(findings)}
    found = xr.Dataset(variables, {"roll_angle_deg": angle, "face_position_mm": face}, whole)
    return found.isel(face_position_mm=0, drop=True) if points.slices == 1 else found


def _study(
    call: str,
    gears: Gears,
    oil: Lubricant,
    surfaces: Surfaces,
    conditions: Mapping[str, ArrayLike],
    boundary_friction: float,
    options: Mapping[str, Any] | None,
    effects: Mapping[str, Mapping[str, float | str]] | None,
) -> Study:
    """Study of one pairing; traces are read from the current folder. ``call``: place named in errors."""
    pinion, gear = _both(surfaces, f"{call}: surfaces")
    file = {
        "schema": "mixedlub-study/1",
        "boundary_friction": boundary_friction,
        "gears": _made(gears, Gears, "gear_pair", f"{call}: gears"),
        "lubricant": _made(oil, Lubricant, "oil", f"{call}: oil"),
        "surfaces": {"pinion": pinion, "gear": gear},
        "pairings": {"pinion": ["pinion"], "gear": ["gear"]},
        "conditions": {name: _levels(values, f"{call}: {name}") for name, values in conditions.items()},
        "options": _plain(options or {}),
        "effects": _plain(effects or {}),
    }
    return read_study(Path(call), parse(StudyFile, file, call))


def _both(surfaces: Surfaces, where: str) -> tuple[SurfaceSection, SurfaceSection]:
    """Surfaces of pinion and gear."""
    single = isinstance(surfaces, SurfaceSection | str | PathLike)
    pair = (surfaces, surfaces) if single else surfaces
    if not isinstance(pair, Sequence) or len(pair) != 2:
        rule = "must be one surface for both, or two, of pinion and gear"
        given = f"{len(pair)} of them" if isinstance(pair, Sequence) else type(pair).__name__
        raise InputError(f"{rule}, not {given}", where=where)
    pinion, gear = (_made(one, SurfaceSection, "surface", where) for one in pair)
    return pinion, gear


def _made(given: object, kind: type[Part], maker: str, where: str) -> Part:
    """Return a part; raise an error if no function of the package made it, e.g. for the name of a part."""
    if isinstance(given, kind):
        return given
    if isinstance(given, str | PathLike) and kind is not Gears:
        raise InputError(f"is a name; write ml.{maker}({str(given)!r})", where=where)
    raise InputError(f"must be made by ml.{maker}(...), not {type(given).__name__}", where=where)


def _levels(values: ArrayLike, where: str) -> list[Any]:
    """Levels of a condition as a list."""
    rule = "must be a number or a list of numbers"
    refuse_masked(values, where)
    try:
        levels = np.atleast_1d(np.asarray(values))
    except ValueError:
        raise InputError(rule, where=where, value=values) from None
    if levels.ndim > 1 or isinstance(values, Mapping):
        raise InputError(rule, where=where, value=values)
    return levels.tolist()


def _plain(values: Any) -> Any:
    """Nested mappings as dictionaries, as in a file."""
    return {key: _plain(value) for key, value in values.items()} if isinstance(values, Mapping) else values
