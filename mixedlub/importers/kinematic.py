"""Conversion of kinematic viscosity with the density of the oil, if known from the answers."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mixedlub.importers.base import Answers, nested
from mixedlub.importers.vocabulary import BY_NAME, is_kinematic, unknown_unit
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig import build
from mixedlub.rig.lubricant import Lubricant
from mixedlub.schema import system_file, toml_file
from mixedlub.schema.findings import collected
from mixedlub.schema.units import rounded
from profiles.errors import InputError

VISCOSITY, TEMPERATURE = "viscosity_mPa_s", "temperature_C"
GIVE_DENSITY = "or give the density of the oil, lubricant.density_15C_kg_m3, and it is converted"


def as_dynamic(
    columns: Mapping[str, np.ndarray], units: Mapping[str, str], answers: Answers, where: str
) -> tuple[dict[str, np.ndarray], str]:
    """Columns with dynamic instead of kinematic viscosities, and a note.

    mm²/s times g/cm³ is mPa s; an unknown density is an error.
    """
    kinematic = [c for c in (VISCOSITY, f"{VISCOSITY}_sd") if c in columns and is_kinematic(units.get(c, ""))]
    if not kinematic or TEMPERATURE not in columns:
        return dict(columns), ""
    oil = _oil_of_known_density(answers)
    if oil is None:
        unit = units[kinematic[0]]
        raise InputError(f"{unknown_unit(unit, BY_NAME[VISCOSITY])}; {GIVE_DENSITY}", where=where, value=unit)
    density = oil.density(columns[TEMPERATURE] + ZERO_CELSIUS)
    dynamic = {c: rounded(1e-3 * density * columns[c]) for c in kinematic}
    note = (
        f"{' and '.join(kinematic)}: kinematic, so multiplied by the density, {oil.density_15:g} kg/m³ at 15 °C that "
        f"falls by {oil.density_change:g} per K: {density.min():.4g} to {density.max():.4g} kg/m³"
    )
    return {**columns, **dynamic}, note


def _oil_of_known_density(answers: Answers) -> Lubricant | None:
    """Oil of the answers; None without a density in the answers and the named oil."""
    section = toml_file.parse(system_file.Lubricant, nested(answers).get("lubricant", {}), "lubricant")
    with collected():
        return None if section.density_15C_kg_m3 is None else build.lubricant(section)
