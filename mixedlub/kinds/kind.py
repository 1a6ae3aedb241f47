"""What a kind of recording is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub import config
from mixedlub.calibration import Calibration
from mixedlub.chain import Chain
from mixedlub.table import Column, Table

Inputs = dict[str, Any]


@dataclass(frozen=True)
class Kind:
    """Columns of a row, sections of the system it needs, the chain that predicts its reading.

    ``inputs(system, folder, table)`` gives the chain's inputs as arrays of shape (rows, points), one of
    the two of length one where a quantity does not depend on it; the chain ends in ``reading``, shape
    (rows, 1), in SI. ``scale`` turns SI into the unit of the quantity's column.
    """

    name: str
    quantities: tuple[str, ...]
    columns: tuple[Column, ...]
    sections: tuple[str, ...]
    chain: Callable[[config.System], Chain]
    inputs: Callable[[config.System, Path, Table], Inputs]
    extra_calibration: Callable[[config.System, Table], tuple[Calibration, ...]] = lambda system, table: ()


SCALE = {
    "power_loss_W": 1.0,
    "friction_coefficient": 1.0,
    "film_thickness_nm": 1e9,
    "friction_torque_Nm": 1.0,
    "viscosity_mPa_s": 1e3,
}
"""From SI to the unit of the column."""


def column(values: np.ndarray | float) -> np.ndarray:
    """Values a row, shaped (rows, 1)."""
    return np.asarray(values, dtype=float)[:, None]


def bookkeeping_inputs(system: config.System, table: Table) -> Inputs:
    """What effects on the measurement read: place in the programme, ambient temperature."""
    inputs: Inputs = {"ambient_temperature": system.recording.ambient_temperature_C + 273.15}
    if "sequence" in table:
        inputs["sequence"] = column(table["sequence"])
    return inputs
