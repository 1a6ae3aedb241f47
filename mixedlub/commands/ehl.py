"""`mixedlub ehl`: line contacts by the full equations."""

from __future__ import annotations

import time
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from mixedlub.commands.console import input_errors_from, print_findings, progress_bar, resumed
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.commands.study import Scheduler
from mixedlub.running.origin import origin_of_file
from mixedlub.schema.result import Result

NAME = "ehl"
EXAMPLE = "mixedlub new ehl --out my_contacts\nmixedlub ehl my_contacts/contacts.toml"


@delivers(NAME)
def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Contacts, or a gear pair and how it runs; an oil.")],
    how: How,
    scheduler: Scheduler = None,
) -> None:
    """Film, friction and temperatures of line contacts.

    By the full equations of thermal elastohydrodynamic lubrication, each with a status and an error: contacts.csv,
    profiles.csv (through each contact) and figures.

    An interrupted run resumes when it is started again with the same inputs.
    """
    from mixedlub.ehl.file import read_problem, solved_problem
    from mixedlub.ehl.solve import CONVERGED, Way
    from mixedlub.ehl.table import TABLES, contact_table, profile_table
    from mixedlub.report.ehl import ehl_figures

    with input_errors_from(str(file)):
        problem = read_problem(file)
    to = how.open(file.stem, origin_of_file(file), TABLES)
    print_findings(problem.notes)
    start = time.perf_counter()
    with progress_bar("solving") as bar:
        data = solved_problem(problem, Way(to.folder, scheduler, resumed(bar)))
    taken = time.perf_counter() - start
    tables = {"contacts": contact_table(problem, data), "profiles": profile_table(data)}
    table = tables["contacts"]
    failed = table.loc[table["status"] != CONVERGED, "contact"].to_list()
    lines = [f"{len(table) - len(failed)} of {len(table)} contacts solved in {taken:.2f} s"]
    for row in table.head(MOST_PRINTED).to_dict("records"):
        lines.append(_line(row) if row["status"] == CONVERGED else _unsolved(row))
    notes = []
    if failed:
        notes.append(f"no solution of contact {', '.join(map(str, failed[:MOST_PRINTED]))}: its results are empty")
    if problem.oil.newtonian and problem.contacts.pressure.max() > NEWTONIAN_PRESSURE:
        notes.append("the oil is Newtonian: above 0.5 GPa its friction is far too high")
    figures = ehl_figures(table, tables["profiles"])
    deliver(Result(problem.file.title, tables, figures, tuple(lines), tuple(notes), columns=TABLES), to)


MOST_PRINTED = 12
"""Largest number of contacts printed."""
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
