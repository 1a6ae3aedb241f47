"""`mixedlub gear`: load distribution, transmission error, stiffness and loss factors of a gear pair."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mixedlub.commands.console import busy, echo, input_errors_from, note, output_folder
from mixedlub.commands.figure_options import FiguresOrTables, Formats, chosen_formats
from mixedlub.running.atomic import writing

if TYPE_CHECKING:
    import pandas as pd

    from mixedlub.gear.analysis import ToothContact

NAME = "gear"
EXAMPLE = "mixedlub new gear --out my_gears\nmixedlub gear my_gears/gear.toml"
MOST_PRINTED = 8
"""Most torques that are printed."""


def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Gear pair, its load sharing, torques.")],
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder for the results; default out/gear/NAME.")
    ] = None,
    figures: FiguresOrTables = True,
    format_: Formats = "svg",
) -> None:
    """Load distribution, transmission error and loss factors of gears.

    Of spur and helical pairs with modifications and deviations: summary.csv, load_share.csv (which a case or a study
    reads), line_loads.csv, transmission_error.csv, loss_factors.csv, geometry.csv and figures.
    """
    from mixedlub.gear import iso_stiffness
    from mixedlub.gear.analysis import table as tables
    from mixedlub.gear.analysis import tooth_contact
    from mixedlub.gear.analysis.file import read_problem
    from mixedlub.schema.findings import collected

    formats = chosen_formats(format_)
    with input_errors_from(str(file)):
        problem = read_problem(file)
        with busy("solving"):
            found = tooth_contact(problem.pair, problem.sharing, problem.torque, problem.conditions)
        given, pair = problem.file.iso_6336, problem.pair
        loads = given.application_factor * found.torque / pair.reference_radius[0] / pair.face_width
        with collected() as notes:
            iso = [iso_stiffness(pair, load, blank_factor=given.blank_factor) for load in loads]
    for text in dict.fromkeys(str(one) for one in (*notes, *problem.sharing.check(pair))):
        note(text)
    folder = output_folder(out, NAME, file.stem)
    made = {
        "summary": tables.summary_table(found, iso),
        "load_share": tables.load_share_table(found),
        "line_loads": tables.line_load_table(found),
        "transmission_error": tables.transmission_table(found),
        "loss_factors": tables.loss_factor_table(found),
        "geometry": tables.geometry_table(pair),
    }
    with writing(folder) as aside:
        for name, table in made.items():
            if len(table):
                table.to_csv(aside / f"{name}.csv", index=False, lineterminator="\n", float_format="%.8g")
        if figures:
            _draw(problem.file.title, found, made, aside, formats)
    if found.distribution is None:
        note('rigid teeth or a table: no transmission error and no stiffness; model = "ldp" has them')
    for row in made["summary"].head(MOST_PRINTED).to_dict("records"):
        echo(_line({str(name): float(value) for name, value in row.items()}))
    if any(found.beyond_path > 0.0):
        note(f"edges of tips carry up to {100 * found.beyond_path.max():.2g} % of the load beyond the path of contact")
    echo(f"results in {folder / 'summary.csv'}")


def _line(row: dict[str, float]) -> str:
    error = row.get("peak_to_peak_transmission_error_um")
    elastic = "" if error is None else f", transmission error {error:.3g} um peak to peak"
    return (
        f"  {row['torque_Nm']:.5g} N m: loss factor {row['local_loss_factor']:.4f}, largest line load "
        f"{row['largest_line_load_N_mm']:.4g} N/mm and pressure {row['largest_hertz_pressure_MPa']:.4g} MPa, face load "
        f"factor {row['face_load_factor']:.3f}{elastic}"
    )


def _draw(
    title: str, found: ToothContact, made: dict[str, pd.DataFrame], folder: Path, formats: tuple[str, ...]
) -> None:
    from mixedlub.report.gear import distribution_figure, loss_factor_figure, pattern_figure
    from mixedlub.report.style import save_all

    drawn = {
        "load_distribution": distribution_figure(title, found, made["transmission_error"]),
        "contact_pattern": pattern_figure(title, found),
        "loss_factors": loss_factor_figure(title, made["loss_factors"]),
    }
    save_all(drawn.items(), folder, formats)
