"""`mixedlub ehl`: line contacts by the full equations."""

from __future__ import annotations

import time
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mixedlub.commands.console import echo, input_errors_from, note, output_folder, print_findings
from mixedlub.commands.figure_options import FiguresOrTables, Formats, chosen_formats
from mixedlub.commands.study import Scheduler, progress_bar, resumed
from mixedlub.running.atomic import clear_parts, writing

if TYPE_CHECKING:
    import pandas as pd

NAME = "ehl"
EXAMPLE = "mixedlub new ehl --out my_contacts\nmixedlub ehl my_contacts/contacts.toml"


def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Contacts, or a gear pair and how it runs; an oil.")],
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder for the results; default out/ehl/NAME.")
    ] = None,
    figures: FiguresOrTables = True,
    format_: Formats = "svg",
    scheduler: Scheduler = None,
) -> None:
    """Film, friction and temperatures of line contacts.

    By the full equations of thermal elastohydrodynamic lubrication, each with a status and an error: contacts.csv,
    profiles.csv (through each contact) and figures.

    An interrupted run resumes when it is started again with the same inputs.
    """
    from mixedlub.ehl.file import read_problem, solved_problem
    from mixedlub.ehl.solve import CONVERGED, Way
    from mixedlub.ehl.table import contact_table, profile_table

    formats = chosen_formats(format_)
    with input_errors_from(str(file)):
        problem = read_problem(file)
    print_findings(problem.notes)
    folder = output_folder(out, NAME, file.stem)
    start = time.perf_counter()
    with progress_bar("solving") as bar:
        way = Way(folder, scheduler, resumed(bar))
        data = solved_problem(problem, way)
    taken = time.perf_counter() - start
    table, profiles = contact_table(problem, data), profile_table(data)
    failed = table.loc[table["status"] != CONVERGED, "contact"].to_list()
    with writing(folder) as aside:
        table.to_csv(aside / "contacts.csv", index=False, lineterminator="\n", float_format="%.6g")
        profiles.to_csv(aside / "profiles.csv", index=False, lineterminator="\n", float_format="%.6g")
        if figures and len(profiles):
            _draw(problem.file.title, table, profiles, aside, formats)
    clear_parts(folder)
    echo(f"{len(table) - len(failed)} of {len(table)} contacts solved in {taken:.2f} s")
    for row in table.head(MOST_PRINTED).to_dict("records"):
        echo(_line(row) if row["status"] == CONVERGED else _unsolved(row))
    if failed:
        note(f"no solution of contact {', '.join(map(str, failed[:MOST_PRINTED]))}: its results are empty")
    if problem.oil.newtonian and problem.contacts.pressure.max() > NEWTONIAN_PRESSURE:
        note("the oil is Newtonian: above 0.5 GPa its friction is far too high")
    echo(f"results in {folder / 'contacts.csv'}")


MOST_PRINTED = 12
"""Most contacts that are printed."""
NEWTONIAN_PRESSURE = 0.5e9
"""Hertz pressure (Pa) above which no oil is Newtonian in a sliding contact."""


def _line(row: Mapping[Any, Any]) -> str:
    friction = row.get("mixed_friction_coefficient", row["friction_coefficient"])
    shared = f", asperities carry {100.0 * row['asperity_load_share']:.3g} %" if "asperity_load_share" in row else ""
    return (
        f"  contact {row['contact']}: film {row['central_film_um']:.4g} um (least {row['minimum_film_um']:.4g}, error"
        f" {row['central_film_error_percent']:.1g} %), friction {friction:.4f}{shared}"
    )


def _unsolved(row: Mapping[Any, Any]) -> str:
    numbers = f"Moes' M {row['moes_load']:.3g}, L {row['moes_material']:.3g}, {row['hertz_pressure_GPa']:.3g} GPa"
    return f"  contact {row['contact']}: {row['status']}: the steps did not end ({numbers})"


def _draw(title: str, table: pd.DataFrame, profiles: pd.DataFrame, folder: Path, formats: tuple[str, ...]) -> None:
    """One figure a contact, and one of all where there are several."""
    from mixedlub.report.ehl import contact_figure, drawn, summary_figure
    from mixedlub.report.style import save_all

    numbers = drawn(table)
    made = {
        f"contact_{number}": contact_figure(title, table.iloc[number - 1], profiles[profiles["contact"] == number])
        for number in numbers
    }
    if len(table) > 1:
        made["contacts"] = summary_figure(title, table)
    save_all(made.items(), folder, formats)
