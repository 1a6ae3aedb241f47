"""`mixedlub bevel`: geometry, contact lines and efficiency of bevel and hypoid gears."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from mixedlub.commands.console import busy, input_errors_from, print_findings
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.running.origin import origin_of_file
from mixedlub.schema.result import Result

NAME = "bevel"
EXAMPLE = "mixedlub new bevel --out my_axle\nmixedlub bevel my_axle/bevel.toml"
MOST_PRINTED = 12
"""Largest number of conditions printed."""
JSON = "bevel.json"


@delivers(NAME)
def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Bevel or hypoid pair, oil, surfaces, conditions.")],
    how: How,
) -> None:
    """Geometry and efficiency of bevel and hypoid gears.

    By ISO 23509 and exact conjugate flanks: geometry.csv, map.csv (tooth efficiency at every condition), contact.csv
    and mesh_cycle.csv (points of the contact lines, and efficiency over one pitch, at the largest torque and speed),
    vary.csv (over offset, spiral angle, ratio and roughness), bevel.json and figures.
    """
    import json

    from mixedlub.chain.ranges import findings
    from mixedlub.report.bevel import bevel_figures
    from mixedlub.skew_gears.prepare import read_pair
    from mixedlub.skew_gears.table import TABLES, contact_table, cycle_table, geometry_table, map_table, vary_table

    with input_errors_from(str(file)):
        pair, notes = read_pair(file)
        to = how.open(file.stem, origin_of_file(file), TABLES, "file", JSON)
        with busy("computing"):
            losses = pair.map()
            points = pair.points_at_largest()
            made = {"map": map_table(losses), "geometry": geometry_table(pair)}
            made |= {"contact": contact_table(pair, points), "mesh_cycle": cycle_table(pair, points)}
            if pair.file.vary is not None:
                made["vary"] = vary_table(pair)
    print_findings([*findings(losses.reached, losses.torque.shape, "conditions"), *notes])
    summary = {name: json.loads(made[name].to_json(orient="records")) for name in made if name != "contact"}
    text = json.dumps({"schema": "mixedlub-bevel-result/1", "title": pair.file.title, **summary}, indent=1) + "\n"
    lines = tuple(map(_line, made["map"].head(MOST_PRINTED).to_dict("records")))
    figures = bevel_figures(made)
    deliver(Result(pair.file.title, made, figures, lines, files={JSON: text}, columns=TABLES), to)


def _line(row: Mapping[Any, Any]) -> str:
    return (
        f"  {row['torque_Nm']:.4g} N m, {row['speed_rpm']:.4g} rpm, {row['oil_temperature_C']:.4g} °C: tooth "
        f"efficiency {row['tooth_efficiency_percent']:.3f} %, {row['power_loss_W']:.4g} W lost at a mean friction of "
        f"{row['mean_friction']:.4f}, {row['lengthwise_loss_percent']:.3g} % of it along the teeth"
    )
