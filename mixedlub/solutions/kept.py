"""Stored full solutions of rigs as a table: conditions, status, and results with errors."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd

from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.oil.file import oil_of
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.solve import CONVERGED, DIVERGED, Way, contacts
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.solutions.rigs import draw
from profiles.errors import InputError, nearest

KEPT = Path(__file__).parent / "solutions.csv"
"""Solutions shipped with the package."""
CONDITIONS = {
    "radius_mm": 1e-3,
    "line_load_N_mm": 1e3,
    "entrainment_speed_m_s": 1.0,
    "slide_roll_ratio": 1.0,
    "oil_temperature_C": 1.0,
}
"""Columns of conditions with their factor to SI."""
RESULTS = {
    "central_film": ("central_film_nm", 1e9),
    "minimum_film": ("minimum_film_nm", 1e9),
    "flow_film": ("flow_film_nm", 1e9),
    "friction_coefficient": ("friction", 1.0),
    "rolling_power": ("rolling_W_m", 1.0),
}
"""Results of an isothermal and a thermal solution: column and factor from SI."""
ERRORS = {"central_film_error": "film_error_percent", "friction_coefficient_error": "friction_error_percent"}
WAYS = ("isothermal", "thermal")
STATUSES = (CONVERGED, DIVERGED)
_EITHER = " or ".join(map(repr, STATUSES))


def oils(names: Sequence[str]) -> dict[str, Oil]:
    """Oils by name or by file."""
    return {name: oil_of(name, Path(), "OIL") for name in names}


def solve_rigs(of: dict[str, Oil], count: int, seed: int, way: Way) -> pd.DataFrame:
    """Isothermal and thermal solutions of ``count`` rigs per oil."""
    tables = []
    for place, (name, oil) in enumerate(of.items()):
        rigs = draw(oil, count, seed + place)
        table = conditions(rigs.contacts).map(lambda value: float(f"{value:.4g}"))
        table.insert(0, "oil", name)
        table.insert(1, "rig", rigs.number)
        tables.append(table.assign(**solve_both(oil, contacts_of(table), way)))
    return pd.concat(tables, ignore_index=True)


def solve_both(oil: Oil, found: Contacts, way: Way) -> dict[str, np.ndarray]:
    """Result columns of contacts."""
    columns: dict[str, np.ndarray] = {}
    for kind in WAYS:
        data = way.solved(oil, found, thermal=kind == "thermal")
        columns[f"{kind}_status"] = data["status"].to_numpy()
        for name, (column, factor) in RESULTS.items():
            columns[f"{kind}_{column}"] = data[name].to_numpy() * factor
        for name, column in ERRORS.items():
            columns[f"{kind}_{column}"] = 100.0 * data[name].to_numpy()
    walls = [data[f"largest_{wall}_wall_temperature"].to_numpy() for wall in ("first", "second")]
    return columns | {"thermal_wall_rise_K": 0.5 * (walls[0] + walls[1]) - found.oil_temperature}


def conditions(found: Contacts) -> pd.DataFrame:
    """Condition columns of contacts."""
    values = (
        found.radius,
        found.line_load,
        found.speed,
        found.sliding / found.speed,
        found.oil_temperature - ZERO_CELSIUS,
    )
    return pd.DataFrame({name: v / factor for (name, factor), v in zip(CONDITIONS.items(), values, strict=True)})


def contacts_of(table: pd.DataFrame) -> Contacts:
    """Contacts from condition columns."""
    radius, load, speed, ratio, celsius = (table[name].to_numpy(float) * f for name, f in CONDITIONS.items())
    return contacts(
        radius=radius, line_load=load, speed=speed, sliding_speed=speed * ratio, oil_temperature=celsius + ZERO_CELSIUS
    )


def read_solutions(path: Path) -> pd.DataFrame:
    """Read and check the table of a file."""
    if path.is_dir():
        raise InputError("is a folder; name a file in it", where="--solutions", value=str(path))
    try:
        table = pd.read_csv(path)
    except FileNotFoundError:
        raise InputError("no such file", where="--solutions", value=str(path)) from None
    except (OSError, ValueError) as error:
        rule = f"is no table of solutions ({str(error).strip()})"
        raise InputError(rule, where="--solutions", value=str(path)) from None
    if not len(table):
        raise InputError("has no rows", where=str(path))
    for name in columns():
        if name not in table:
            near = nearest(name, list(map(str, table.columns)))
            raise InputError(f"the column {name} is missing; {near}", where=str(path))
        if name != "oil" and not name.endswith("_status") and table[name].dtype.kind not in "fi":
            wrong = int(pd.to_numeric(table[name], errors="coerce").isna().argmax())
            value = str(table[name].iloc[wrong])
            raise InputError("must be a number", where=f"{path}: line {wrong + 2}: {name}", value=value)
    table = table.astype({name: str for name in columns() if name == "oil" or name.endswith("_status")})
    _check_values(table, path)
    return table[columns()]


def _check_values(table: pd.DataFrame, path: Path) -> None:
    """Raise an error for impossible conditions or an unknown status."""
    rules = {f"{kind}_status": (table[f"{kind}_status"].isin(STATUSES), f"must be {_EITHER}") for kind in WAYS}
    for name in ("radius_mm", "line_load_N_mm", "entrainment_speed_m_s"):
        rules[name] = (table[name] > 0.0) & np.isfinite(table[name]), "must be above 0"
    for name in ("slide_roll_ratio", "oil_temperature_C"):
        rules[name] = np.isfinite(table[name]), "must be a finite number"
    for name, (fine, rule) in rules.items():
        if not fine.all():
            wrong = int(np.argmin(fine.to_numpy()))
            raise InputError(rule, where=f"{path}: line {wrong + 2}: {name}", value=table[name].tolist()[wrong])


def columns() -> list[str]:
    """Columns of the table, in order."""
    found = ["oil", "rig", *CONDITIONS]
    for kind in WAYS:
        found += [f"{kind}_{name}" for name in ("status", *(c for c, _ in RESULTS.values()), *ERRORS.values())]
    return [*found, "thermal_wall_rise_K"]


def solved_line(table: pd.DataFrame) -> str:
    """Number of solved contacts as text.

    >>> solved_line(pd.DataFrame({"isothermal_status": [CONVERGED, "no solution"], "thermal_status": [CONVERGED] * 2}))
    '2 contacts: 1 solved isothermally, 2 with heat'
    """
    without, heat = (int((table[f"{kind}_status"] == CONVERGED).sum()) for kind in WAYS)
    return f"{len(table)} contacts: {without} solved isothermally, {heat} with heat"
