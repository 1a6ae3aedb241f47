"""Results as tables with a unit in the name of every column: one row a contact, and one row a node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from mixedlub.chain.ranges import flags, validity
from mixedlub.ehl.file import Problem
from mixedlub.ehl.measures import CHECKS, PROFILES, QUANTITIES
from mixedlub.ehl.mixed import SHARES
from mixedlub.laws.oil import ZERO_CELSIUS

if TYPE_CHECKING:
    import xarray

SHOWN = {"m": ("um", 1e6), "Pa": ("GPa", 1e-9), "W/m": ("W_mm", 1e-3), "1": ("", 1.0)}
"""Unit of a column and its factor, by the unit in SI."""
PERCENT = 100.0


def contact_table(problem: Problem, data: xarray.Dataset) -> pd.DataFrame:
    """A row a contact: its conditions, its status, and its results each with its error."""
    contacts = problem.contacts
    load, material = contacts.moes(*problem.oil.at_ambient(contacts.oil_temperature))
    columns: dict[str, Any] = {"contact": np.arange(1, len(contacts.radius) + 1)}
    if np.all(np.isfinite(problem.position)):
        columns["position_mm"] = problem.position * 1e3
    columns |= {
        "radius_mm": contacts.radius * 1e3,
        "line_load_N_mm": contacts.line_load * 1e-3,
        "hertz_pressure_GPa": contacts.pressure * 1e-9,
        "half_width_mm": contacts.half_width * 1e3,
        "entrainment_speed_m_s": contacts.speed,
        "slide_roll_ratio": contacts.sliding / contacts.speed,
        "oil_temperature_C": contacts.oil_temperature - ZERO_CELSIUS,
        "moes_load": load,
        "moes_material": material,
        "status": data["status"].to_numpy(),
        "validity": validity(flags(problem.reached, contacts.pressure.shape), contacts.pressure.shape),
    }
    for name, quantity in QUANTITIES.items():
        values = data[name].to_numpy()
        columns[_named(name, quantity.unit)] = _changed(values, quantity.unit)
        columns[f"{name}_error_percent"] = PERCENT * data[f"{name}_error"].to_numpy()
    columns |= {name: data[name].to_numpy() for name in (*CHECKS, *SHARES) if name in data}
    return pd.DataFrame(columns)


def profile_table(data: xarray.Dataset) -> pd.DataFrame:
    """A row a node of each contact that has a solution."""
    contact, node = np.nonzero(np.isfinite(data["position"].to_numpy()))
    columns: dict[str, Any] = {"contact": contact + 1}
    for name, quantity in PROFILES.items():
        values = data[name].to_numpy()[contact, node]
        if name == "position":
            columns["position_mm"] = values * 1e3
        elif name == "shear_stress":
            columns["shear_stress_MPa"] = values * 1e-6
        else:
            columns[_named(name, quantity.unit)] = _changed(values, quantity.unit)
    return pd.DataFrame(columns)


def _named(name: str, unit: str) -> str:
    ending = "C" if unit == "K" else SHOWN[unit][0]
    return f"{name}_{ending}" if ending else name


def _changed(values: np.ndarray, unit: str) -> np.ndarray:
    return values - ZERO_CELSIUS if unit == "K" else values * SHOWN[unit][1]
