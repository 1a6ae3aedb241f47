"""Efficiency of a gearbox from Python, as labelled arrays."""

from __future__ import annotations

from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.efficiency import read_gearbox
from mixedlub.efficiency.gearbox import MESH
from mixedlub.efficiency.table import present
from mixedlub.efficiency.thermal import ThermalModel
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.schema.findings import collected, warn_of
from profiles.errors import as_path

if TYPE_CHECKING:
    import xarray as xr


def gearbox_efficiency(file: str | PathLike[str]) -> xr.Dataset:
    """Losses and efficiencies of a gearbox at every torque and speed of its ``[conditions]``.

    Parameters
    ----------
    file : str or PathLike
        Gearbox file (TOML) of `mixedlub efficiency`.

    Returns
    -------
    xarray.Dataset
        Variables over (``torque_Nm``, ``speed_rpm``), before them ``oil_temperature_C`` if the file has such levels:
        losses (W) in total and by origin, tooth and gearbox efficiency (percent; NaN at zero torque), and validity;
        ``part_loss_W`` also over ``part``. With ``[thermal]`` also ``sump_temperature_C``, and
        ``balanced_loss_W`` and ``balanced_efficiency_percent`` at that temperature; NaN without a balance.

    Raises
    ------
    profiles.errors.InputError
        If the file is missing or invalid.

    Examples
    --------
    >>> import mixedlub as ml
    >>> from mixedlub.efficiency import EXAMPLE
    >>> found = ml.gearbox_efficiency(str(EXAMPLE))
    >>> found["total_loss_W"].dims, bool((found["total_loss_W"] > 0).all())
    (('torque_Nm', 'speed_rpm'), True)
    >>> found["gearbox_efficiency_percent"].sel(torque_Nm=120, speed_rpm=3000).round(1).item()
    98.5
    """
    import xarray as xr

    with collected() as findings:
        gearbox, notes = read_gearbox(as_path(file, "gearbox_efficiency: file"))
        losses = gearbox.map()
        balance = None if gearbox.file.thermal is None else ThermalModel(gearbox).at_map()
    warn_of([*losses.findings, *findings, *notes, *(() if balance is None else balance.findings)])
    levels = gearbox.file.conditions
    axes = tuple(name for name in ("oil_temperature_C", "torque_Nm", "speed_rpm") if getattr(levels, name) is not None)
    shape = tuple(len(getattr(levels, name)) for name in axes)

    def over(values: np.ndarray) -> tuple[tuple[str, ...], np.ndarray]:
        return axes, values.reshape(shape)

    parts = np.array([value.reshape(shape) for value in losses.by_origin.values()])
    variables: dict[str, Any] = {
        "input_power_W": over(losses.input_power),
        "total_loss_W": over(losses.total()),
        "tooth_efficiency_percent": over(100.0 * losses.efficiency(MESH)),
        "gearbox_efficiency_percent": over(100.0 * losses.efficiency()),
        **{f"{origin}_loss_W": over(losses.total(origins=(origin,))) for origin in present(losses)},
        "part_loss_W": (("part", *axes), parts),
        "validity": over(np.array(losses.validity)),
    }
    if balance is not None:
        steady = {
            "sump_temperature_C": balance.sump - ZERO_CELSIUS,
            "balanced_loss_W": balance.losses.total(),
            "balanced_efficiency_percent": 100.0 * balance.losses.efficiency(),
        }
        variables |= {name: over(np.where(balance.found, values, np.nan)) for name, values in steady.items()}
    names = [" ".join(filter(None, origin)) for origin in losses.by_origin]
    coordinates = {"part": names, **{name: list(getattr(levels, name)) for name in axes}}
    return xr.Dataset(variables, coordinates, {"title": gearbox.file.title})
