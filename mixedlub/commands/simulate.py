"""`mixedlub simulate`: the model of a case at its conditions, nothing fitted."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import (
    CONDITIONS,
    case_folder,
    input_errors_from,
    print_findings,
    progress_bar,
    resumed,
)
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.running.origin import origin_of
from mixedlub.schema.result import Result, described

NAME = "simulate"
EXAMPLE = "mixedlub new case --out my_case\nmixedlub simulate my_case"
INPUTS = ("system.toml", "recordings.csv", "conditions.csv")
"""Files of a case that determine a simulation."""
TABLES = {
    "simulation": described(
        run="number of the reading",
        validity="text: valid, or each range that the row leaves",
        QUANTITY="reading of the base model",
    )
}
"""Columns of the table of `mixedlub simulate`."""


@delivers(NAME, "figures", "format_")
def command(
    case: Annotated[Path, typer.Argument(metavar="CASE", help="Case folder with system.toml.")],
    how: How,
    at: Annotated[
        Path | None, typer.Option(metavar="conditions.csv", help=f"Other conditions than the case's. {CONDITIONS}")
    ] = None,
) -> None:
    """Readings of the base model at the conditions of a case.

    At the conditions of recordings.csv and conditions.csv, or of another table; nothing is fitted. Effects and
    calibration named in system.toml are part of the model, as in the folder improved of a diagnosis.
    """
    from mixedlub.case.folder import read_case, read_conditions, unpredicted_runs
    from mixedlub.case.simulation import simulate
    from mixedlub.full_base.progress import building
    from mixedlub.rig.plausibility import implausible
    from mixedlub.schema.findings import collected, gravest_first

    bar = progress_bar("full solutions")
    with collected() as notes, input_errors_from(str(case)), bar as progress, building(resumed(progress)):
        found = read_case(case_folder(case), need_recordings=False)
        notes += [*found.notes, *implausible(found.rig)]
        notes += unpredicted_runs(found, found.conditions) if at is None else []
        asked = None if at is None else read_conditions(found, at)
        rows = simulate(found, asked)
    to = how.open(found.name, origin_of(case, INPUTS, str(at), at and at.read_bytes()), TABLES, "case")
    print_findings(gravest_first(dict.fromkeys(notes)))
    written = f"{len(rows)} rows of {found.quantity} in {to.folder / 'simulation.csv'}"
    deliver(Result(found.name, {"simulation": rows}, {}, columns=TABLES), to, written=written)
