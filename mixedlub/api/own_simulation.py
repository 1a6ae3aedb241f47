"""Case of a table of readings and a function that simulates them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.case.files import case_files
from mixedlub.case.folder import Case, case_of
from mixedlub.kinds.simulated_readings import SIMULATED
from mixedlub.kinds.table import KNOWN, MOVED, READINGS
from mixedlub.running.atomic import fill, writing
from mixedlub.schema.table import BOOKKEEPING, RUN, frame_of
from mixedlub.schema.units import unit_of
from profiles.errors import InputError, as_path, nearest

if TYPE_CHECKING:
    import pandas as pd

    from mixedlub.case.folder import Frame

Simulation = Callable[..., Any]
NO_UNIT = "-"


def case_with_simulation(
    table: Any,
    simulate: Simulation,
    predict: Frame | None = None,
    *,
    reading: str | None = None,
    units: Mapping[str, str] | None = None,
    noise: Mapping[str, float] | None = None,
    inputs: Mapping[str, tuple[float, float]] | None = None,
    system: Mapping[str, Any] | None = None,
    name: str = "table",
    folder: str | PathLike[str] | None = None,
) -> Case:
    """Case of kind ``table``; the arguments are those of ``ml.diagnose``.

    >>> import pandas as pd
    >>> rows = pd.DataFrame({"load_N": [10.0, 20.0, 30.0], "pull_N": [1.1, 1.9, 3.2]})
    >>> case = case_with_simulation(rows, lambda at, share: share * at["load_N"], inputs={"share": (0.1, 0.01)})
    >>> case.recordings["simulated_share"].round(3).tolist()
    [1.1, 2.2, 3.3]
    """
    frame = frame_of(table, "diagnose: table")
    quantity = _reading_of(frame, reading)
    conditions = _conditions(frame, quantity, units or {})
    uncertain = _uncertain(inputs or {})
    recorded = _simulated(frame, conditions, simulate, uncertain)
    wanted = None
    if predict is not None:
        asked = frame_of(predict, "diagnose: predict")
        for column in conditions:
            if column not in asked:
                rule = f"column is missing, which the table has; {nearest(column, asked.columns)}"
                raise InputError(rule, where="diagnose: predict", value=column)
        wanted = _simulated(asked, conditions, simulate, uncertain)
        if RUN.name not in wanted:
            first = 1 + (int(recorded[RUN.name].max()) if RUN.name in recorded else len(recorded))
            wanted.insert(0, RUN.name, np.arange(first, first + len(wanted)))
    recording: dict[str, Any] = {"quantity": quantity}
    if units and quantity in units:
        recording["unit"] = units[quantity]
    if noise is not None:
        recording["noise"] = dict(noise)
    given = {
        **(system or {}),
        "kind": "table",
        "recording": {**(system or {}).get("recording", {}), **recording},
        "conditions": {column: ({"unit": unit} if unit else {}) for column, unit in conditions.items()},
        "uncertainty": {one: {"value": value, "sd": sd} for one, (value, sd) in uncertain.items()},
    }
    case = case_of(given, recorded, wanted, name=name)
    if folder is not None:
        _write(case, as_path(folder, "diagnose: folder"))
    return case


def _reading_of(frame: pd.DataFrame, reading: str | None) -> str:
    """Name of the reading: as given, else the only known reading, else the last column."""
    columns = list(map(str, frame.columns))
    if reading is None:
        known = [column for column in columns if column in READINGS]
        return known[0] if len(known) == 1 else columns[-1]
    if reading not in columns:
        raise InputError(f"no such column; {nearest(reading, columns)}", where="diagnose: reading", value=reading)
    return reading


def _conditions(frame: pd.DataFrame, quantity: str, units: Mapping[str, str]) -> dict[str, str]:
    """Units of the columns of conditions; names and columns with a unit in their name have none here."""
    others = {RUN.name, *(c.name for c in BOOKKEEPING), quantity, f"{quantity}_sd"}
    columns = [str(column) for column in frame.columns if str(column) not in others]
    for column in units:
        if column not in columns and column != quantity:
            hint = nearest(column, [*columns, quantity])
            raise InputError(f"no such column; {hint}", where="diagnose: units", value=column)
    found = {}
    for column in columns:
        is_number = frame[column].dtype.kind in "fiu"
        implied = bool(unit_of(column)) or column in KNOWN
        if is_number and column not in units and not implied:
            rule = f'numbers need a unit: units={{"{column}": "..."}}; "{NO_UNIT}" for a pure number'
            raise InputError(rule, where="diagnose: units", value=column)
        found[column] = units.get(column, "")
    return found


def _uncertain(inputs: Mapping[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    for name, given in inputs.items():
        if not isinstance(given, tuple | list) or len(given) != 2:
            rule = "needs its value and its standard deviation: (value, sd)"
            raise InputError(rule, where=f"diagnose: inputs[{name!r}]", value=given)
    return {name: (float(value), float(sd)) for name, (value, sd) in inputs.items()}


def _simulated(
    frame: pd.DataFrame, conditions: Collection[str], simulate: Simulation, inputs: Mapping[str, tuple[float, float]]
) -> pd.DataFrame:
    """Table with the simulation, and with the simulation at each input one standard deviation up."""
    at = frame[list(conditions)].reset_index(drop=True)
    nominal = {name: value for name, (value, _) in inputs.items()}
    columns = {SIMULATED: _call(simulate, at, nominal)}
    for name, (value, sd) in inputs.items():
        if sd > 0:
            columns[f"{MOVED}{name}"] = _call(simulate, at, {**nominal, name: value + sd})
    return frame.reset_index(drop=True).assign(**columns)


def _call(simulate: Simulation, at: pd.DataFrame, inputs: Mapping[str, float]) -> np.ndarray:
    """Simulated readings: of the frame at once, or row by row where the function takes single conditions."""
    try:
        found = np.asarray(simulate(at.copy(), **inputs), dtype=float)
    except (TypeError, ValueError):
        found = np.array([])
    if found.shape != (len(at),):
        found = np.array([float(simulate(row, **inputs)) for row in at.to_dict("records")])
    if not np.isfinite(found).all():
        row = int(np.flatnonzero(~np.isfinite(found))[0])
        rule = f"the simulation of row {row + 1} is not a finite number, at {at.iloc[row].to_dict()}"
        raise InputError(rule, where="diagnose: simulate", value=float(found[row]))
    return found


def _write(case: Case, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    with writing(folder) as aside:
        fill(case_files(case), aside)
