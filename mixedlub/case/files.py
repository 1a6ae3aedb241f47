"""The files of a case folder: `system.toml`, its tables, and the traces and tables that it names."""

from __future__ import annotations

from pathlib import Path, PurePosixPath
from typing import Any

from mixedlub.case.folder import HYPOTHESES, Case
from mixedlub.case.missing_part import FILE as MISSING_PART
from mixedlub.own_laws import path_of, text_of
from mixedlub.schema.surface_file import SURFACE_FILES
from mixedlub.schema.table import Table
from mixedlub.schema.toml_file import named_file, to_toml
from profiles import SHIPPED_MARK

LAWS = "laws"
"""Folder of the law files that ``[effects]`` names, in a written case."""
TABLES = ("recordings", "conditions")


def case_files(case: Case) -> dict[str, str | bytes]:
    """Contents by path in the folder; traces and tables from elsewhere are stored in the folder `profiles`, law files
    in the folders `laws` and `hypotheses`.

    >>> import mixedlub as ml, pandas as pd
    >>> drive = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm"}}
    >>> rows = pd.DataFrame({"speed_rpm": [100.0, 200.0, 300.0], "friction_torque_Nm": [0.51, 0.62, 0.69]})
    >>> print(case_files(ml.case.case_of(drive, rows))["recordings.csv"].splitlines()[1])
    1,100.0,0.51
    """
    system = case.system.model_dump(by_alias=True, exclude_unset=True)
    system.get("lubricant", {}).pop("oil", None)  # its values are all there
    carried: dict[str, bytes] = {}
    sharing = system.get("gears", {}).get("load_sharing", {})
    if sharing.get("table"):
        sharing["table"] = _carry(carried, case.folder, sharing["table"], "gears.load_sharing.table")
    for name, surface in system.get("surfaces", {}).items():
        for key in SURFACE_FILES:
            given = surface.get(key)
            if given is None:
                continue
            place = f"surfaces.{name}.{key}"
            files = [
                one if one.startswith(SHIPPED_MARK) else _carry(carried, case.folder, one, place)
                for one in ([given] if isinstance(given, str) else given)
            ]
            surface[key] = files[0] if isinstance(given, str) else files
    carried |= law_files(case, system)
    tables = {f"{name}.csv": _csv(getattr(case, name)) for name in TABLES if getattr(case, name) is not None}
    if case.missing is not None:
        system["missing_part"] = MISSING_PART
        tables[MISSING_PART] = _csv(case.missing.table)
    return {"system.toml": to_toml(system), **tables, **carried}


def law_files(case: Case, system: dict[str, Any]) -> dict[str, bytes]:
    """Law files of a case by path; ``[effects]`` of the written system then names these paths."""
    places = {name: f"{HYPOTHESES if name in case.hypotheses else LAWS}/{name}.toml" for name in case.laws}
    # A law beside the case, as one that a diagnosis found, stays there.
    beside = {name: path_of(law) for name, law in case.laws.items()}
    places |= {name: path.name for name, path in beside.items() if path == Path(path.name)}
    if places:
        system["effects"] = {places.get(name, name): own for name, own in system.get("effects", {}).items()}
    return {path: text_of(case.laws[name]).encode() for name, path in places.items()}


def _carry(carried: dict[str, bytes], folder: Path, name: str, key: str) -> str:
    """Add a file to the carried files; return its new name, relative to the folder of the case."""
    content = named_file(folder, name, key).read_bytes()
    own = PurePosixPath(Path(name).as_posix())
    if own.is_absolute() or ".." in own.parts:
        own = PurePosixPath("profiles", own.name)
    place, number = str(own), 1
    while carried.get(place, content) != content:
        number += 1
        place = str(own.with_name(f"{number}_{own.name}"))
    carried[place] = content
    return place


def _csv(table: Table) -> str:
    import pandas as pd

    first = {"run": table["run"]} if "run" in table else {}
    columns: dict[str, Any] = {**first, **table.columns}
    return str(pd.DataFrame(columns).to_csv(index=False, lineterminator="\n"))
