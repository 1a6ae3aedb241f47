"""Results as tables of described columns: a row per contact, and a row per node."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from mixedlub.chain.ranges import flags, validity
from mixedlub.ehl.file import Problem
from mixedlub.ehl.measures import CHECKS, PROFILES, QUANTITIES, Quantity
from mixedlub.ehl.mixed import SHARES
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.schema.result import ResultColumn, column, described, frame_of

if TYPE_CHECKING:
    import xarray

SHOWN = {"m": ("_um", 1e6), "Pa": ("_GPa", 1e-9), "W/m": ("_W_mm", 1e-3), "1": ("", 1.0), "K": ("_C", 1.0)}
"""Suffix of a column name and its factor, by SI unit."""
OTHERWISE = {"position": ("_mm", 1e3), "shear_stress": ("_MPa", 1e-6)}
"""Suffix and factor of quantities displayed in another unit."""


def _shown(quantities: Mapping[str, Quantity]) -> list[ResultColumn]:
    found = []
    for name, one in quantities.items():
        end, factor = OTHERWISE.get(name, SHOWN[one.unit])
        unit = "W/mm" if end == "_W_mm" else ""
        zero = ZERO_CELSIUS if one.unit == "K" else 0.0
        found.append(ResultColumn(name, f"{name}{end}", one.meaning, factor, zero, unit))
    return found


CONDITIONS = (
    column(lambda c: c.radius * 1e3, "radius_mm", "reduced radius"),
    column(lambda c: c.line_load * 1e-3, "line_load_N_mm", "load per width"),
    column(lambda c: c.pressure * 1e-9, "hertz_pressure_GPa", "largest Hertz pressure"),
    column(lambda c: c.half_width * 1e3, "half_width_mm", "half width of the contact after Hertz"),
    column(lambda c: c.speed, "entrainment_speed_m_s", "mean speed of the surfaces"),
    column(lambda c: c.sliding / c.speed, "slide_roll_ratio", "sliding speed over entrainment speed"),
    column(lambda c: c.oil_temperature - ZERO_CELSIUS, "oil_temperature_C", "temperature of the oil at the inlet"),
)
RESULTS, ALONG = _shown(QUANTITIES), _shown(PROFILES)
TABLES = {
    "contacts": (
        *described(contact="number of the contact", position_mm="place on the path of contact, where it has one"),
        *CONDITIONS,
        *described(
            moes_load="Moes' load parameter M",
            moes_material="Moes' material parameter L",
            status="text: converged, or why there is no solution",
            validity="text: valid, or each range that the contact leaves",
        ),
        *RESULTS,
        *described(QUANTITY_error_percent="estimated error of the column before"),
        *_shown(CHECKS),
        *described(**SHARES),
    ),
    "profiles": (*described(contact="number of the contact"), *ALONG),
}
"""Columns of the tables of `mixedlub ehl`."""


def contact_table(problem: Problem, data: xarray.Dataset) -> pd.DataFrame:
    """Table with a row per contact: conditions, status, and results with errors."""
    contacts = problem.contacts
    load, material = contacts.moes(*problem.oil.at_ambient(contacts.oil_temperature))
    table = frame_of(contacts, CONDITIONS).assign(moes_load=load, moes_material=material)
    table["status"] = data["status"].to_numpy()
    table["validity"] = validity(flags(problem.reached, contacts.pressure.shape), contacts.pressure.shape)
    for one in RESULTS:
        table[one.name] = one.of(data[one.output].to_numpy())
        table[f"{one.output}_error_percent"] = 100.0 * data[f"{one.output}_error"].to_numpy()
    for name in (*CHECKS, *SHARES):
        if name in data:
            table[name] = data[name].to_numpy()
    if np.all(np.isfinite(problem.position)):
        table.insert(0, "position_mm", problem.position * 1e3)
    table.insert(0, "contact", np.arange(1, len(table) + 1))
    return table


def profile_table(data: xarray.Dataset) -> pd.DataFrame:
    """Table with a row per node of each solved contact."""
    contact, node = np.nonzero(np.isfinite(data["position"].to_numpy()))
    nodes = {one.name: one.of(data[one.output].to_numpy()[contact, node]) for one in ALONG}
    return pd.DataFrame({"contact": contact + 1, **nodes})
