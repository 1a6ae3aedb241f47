"""`mixedlub gear`: load distribution, transmission error, stiffness and loss factors of a gear pair."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from mixedlub.commands.console import busy, input_errors_from
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.running.origin import origin_of_file
from mixedlub.schema.result import Result

NAME = "gear"
EXAMPLE = "mixedlub new gear --out my_gears\nmixedlub gear my_gears/gear.toml"
MOST_PRINTED = 8
"""Largest number of torques printed."""


@delivers(NAME)
def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Gear pair, its load sharing, torques.")], how: How
) -> None:
    """Load distribution, transmission error and loss factors of gears.

    Of spur and helical pairs with modifications and deviations: summary.csv, load_share.csv (which a case or a study
    reads), line_loads.csv, transmission_error.csv, loss_factors.csv, geometry.csv and figures.
    """
    from mixedlub.gear import iso_stiffness
    from mixedlub.gear.analysis import tooth_contact
    from mixedlub.gear.analysis.file import read_problem
    from mixedlub.gear.analysis.table import TABLES, tables
    from mixedlub.report.gear import gear_figures
    from mixedlub.schema.findings import collected

    with input_errors_from(str(file)):
        problem = read_problem(file)
        to = how.open(file.stem, origin_of_file(file), TABLES)
        with busy("solving"):
            found = tooth_contact(problem.pair, problem.sharing, problem.torque, problem.conditions)
        given, pair = problem.file.iso_6336, problem.pair
        loads = given.application_factor * found.torque / pair.reference_radius[0] / pair.face_width
        with collected() as findings:
            iso = [iso_stiffness(pair, load, blank_factor=given.blank_factor) for load in loads]
    notes = [str(one) for one in (*findings, *problem.sharing.check(pair))]
    if found.distribution is None:
        notes.append('rigid teeth or a table: no transmission error and no stiffness; model = "ldp" has them')
    if any(found.beyond_path > 0.0):
        beyond = 100 * found.beyond_path.max()
        notes.append(f"edges of tips carry up to {beyond:.2g} % of the load beyond the path of contact")
    made = tables(found, iso)
    lines = tuple(map(_line, made["summary"].head(MOST_PRINTED).to_dict("records")))
    figures = gear_figures(problem.file.title, found, made)
    deliver(Result(problem.file.title, made, figures, lines, tuple(dict.fromkeys(notes)), columns=TABLES), to)


def _line(row: Mapping[Any, Any]) -> str:
    error = row.get("peak_to_peak_transmission_error_um")
    elastic = "" if error is None else f", transmission error {error:.3g} um peak to peak"
    return (
        f"  {row['torque_Nm']:.5g} N m: loss factor {row['local_loss_factor']:.4f}, largest line load "
        f"{row['largest_line_load_N_mm']:.4g} N/mm and pressure {row['largest_hertz_pressure_MPa']:.4g} MPa, face load "
        f"factor {row['face_load_factor']:.3f}{elastic}"
    )
