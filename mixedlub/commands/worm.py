"""`mixedlub worm`: friction and efficiency of worm drives in both directions of power."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from mixedlub.commands.console import input_errors_from, print_findings
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.running.origin import origin_of_file
from mixedlub.schema.result import Result

NAME = "worm"
EXAMPLE = "mixedlub new worm --out my_worm\nmixedlub worm my_worm/worm.toml"
MOST_PRINTED = 12
"""Largest number of conditions printed."""
JSON = "worm.json"


@delivers(NAME)
def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Worm drive, friction, oil, conditions.")],
    how: How,
) -> None:
    """Friction and efficiency of worm drives.

    In the forms of ISO/TR 14521, worm or wheel driving, self-locking with its number: map.csv (friction, film and
    efficiency at every condition), geometry.csv, worm.json, a figure, and
    worm_mesh.toml, the loss as a law that a friction map of the drive takes as a hypothesis.
    """
    import json

    from mixedlub.report.worm import worm_figures
    from mixedlub.worm_gears.drive import extrapolated_oil, locking, read_drive
    from mixedlub.worm_gears.mesh_law import FILE, mesh_law
    from mixedlub.worm_gears.table import TABLES, geometry_table, map_table

    with input_errors_from(str(file)):
        drive, notes = read_drive(file)
        to = how.open(file.stem, origin_of_file(file), TABLES, "file", JSON, FILE)
        losses = drive.map()
        made = {"map": map_table(losses), "geometry": geometry_table(drive)}
    print_findings([*locking(drive, losses), *extrapolated_oil(drive, losses), *notes])
    summary = {name: json.loads(table.to_json(orient="records")) for name, table in made.items()}
    text = json.dumps({"schema": "mixedlub-worm-result/1", "title": drive.file.title, **summary}, indent=1) + "\n"
    lines = tuple(map(_line, made["map"].head(MOST_PRINTED).to_dict("records")))
    files = {JSON: text, FILE: mesh_law(drive)}
    deliver(Result(drive.file.title, made, worm_figures(made["map"]), lines, files=files, columns=TABLES), to)


def _line(row: Mapping[Any, Any]) -> str:
    back = row["wheel_drives_efficiency_percent"]
    backwards = "self-locking" if row["state"] == "self-locking" else f"{back:.2f} % driven by the wheel"
    return (
        f"  {row['wheel_torque_Nm']:.4g} N m, {row['worm_speed_rpm']:.4g} rpm: {row['sliding_speed_m_s']:.3g} m/s, "
        f"friction {row['mean_friction']:.4f}, {row['worm_drives_efficiency_percent']:.2f} % driven by the worm, "
        f"{backwards}"
    )
