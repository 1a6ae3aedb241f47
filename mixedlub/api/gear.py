"""Loaded tooth contact of a gear pair from Python, as labelled arrays."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.gear.analysis import MeshConditions, tooth_contact
from mixedlub.gear.build import gear_pair, sharing
from mixedlub.gear.checks import torques_above_zero
from mixedlub.schema.findings import collected, warn_of
from mixedlub.schema.system_file import Gears
from profiles.errors import InputError

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import ArrayLike


def load_distribution(
    gears: Gears,
    torque_Nm: ArrayLike,
    *,
    positions: int = 64,
    slices: int | None = None,
    edge_contact: bool = False,
    pitch_deviation_um: Sequence[float] = (0.0,),
) -> xr.Dataset:
    """Loaded tooth contact of a gear pair at torques on the pinion.

    Parameters
    ----------
    gears : Gears
        Gear pair of ``ml.gear_pair``; its ``load_sharing`` sets rigid or elastic teeth and their modifications.
    torque_Nm : array_like
        Torque on the pinion (N m), positive.
    positions : int, optional
        Mesh positions per base pitch.
    slices : int, optional
        Slices across the face width; default: chosen by the model.
    edge_contact : bool, optional
        Whether contact off the path of contact, at tip edges, carries load.
    pitch_deviation_um : sequence of float, optional
        Pitch deviations of consecutive tooth pairs (µm).

    Returns
    -------
    xarray.Dataset
        ``load_share``, ``line_load_N_mm`` and ``hertz_pressure_MPa`` of one tooth pair over ``roll_angle_deg`` of the
        pinion (line load and pressure also over ``face_position_mm``); face load factor and local loss factor over
        ``torque_Nm``. Elastic teeth only: transmission error (µm) and mesh stiffness (N/µm) over ``base_pitches``.

    Raises
    ------
    profiles.errors.InputError
        If an argument is invalid.

    Examples
    --------
    >>> import mixedlub as ml
    >>> pair = ml.gear_pair(preset="fzg_c", load_sharing={"model": "ldp"})
    >>> found = ml.load_distribution(pair, [100, 300])
    >>> found["line_load_N_mm"].dims, found["local_loss_factor"].round(3).values.tolist()
    (('torque_Nm', 'roll_angle_deg', 'face_position_mm'), [0.192, 0.191])
    """
    import xarray as xr

    if not isinstance(gears, Gears):
        rule = f"must be made by ml.gear_pair(...), not {type(gears).__name__}"
        raise InputError(rule, where="load_distribution: gears")
    torque = np.unique(torques_above_zero(torque_Nm))
    conditions = MeshConditions(positions, slices, edge_contact, tuple(1e-6 * float(d) for d in pitch_deviation_um))
    with collected() as findings:
        found = tooth_contact(gear_pair(gears), sharing(gears.load_sharing, Path()), torque, conditions)
    warn_of(findings)
    variables: dict[str, Any] = {
        "load_share": (("torque_Nm", "roll_angle_deg"), found.load_share),
        "line_load_N_mm": (("torque_Nm", "roll_angle_deg", "face_position_mm"), found.line_load * 1e-3),
        "hertz_pressure_MPa": (("torque_Nm", "roll_angle_deg", "face_position_mm"), found.pressure * 1e-6),
        "path_position_mm": (("roll_angle_deg", "face_position_mm"), found.position * 1e3),
        "sliding_over_base_speed": (("roll_angle_deg", "face_position_mm"), found.sliding),
        "face_load_factor": ("torque_Nm", found.face_load_factor),
        "local_loss_factor": ("torque_Nm", found.loss_factor),
    }
    axes = {
        "torque_Nm": torque,
        "roll_angle_deg": np.degrees(found.roll_angle),
        "face_position_mm": found.face * 1e3,
    }
    solved = found.distribution
    if solved is not None:
        over_mesh = ("torque_Nm", "base_pitches")
        axes["base_pitches"] = (np.arange(solved.phase.size) + 0.5) / conditions.positions
        variables["transmission_error_um"] = (over_mesh, solved.approach * 1e6)
        variables["mesh_stiffness_N_um"] = (over_mesh, solved.stiffness * 1e-6)
    return xr.Dataset(variables, axes)
