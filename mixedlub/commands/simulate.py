"""`mixedlub simulate`: the model of a case at its conditions, nothing fitted."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import (
    CONDITIONS,
    case_folder,
    echo,
    input_errors_from,
    named_folder,
    output_folder,
    print_findings,
)
from mixedlub.running.atomic import writing

NAME = "simulate"
EXAMPLE = "mixedlub new case --out my_case\nmixedlub simulate my_case"


def command(
    case: Annotated[Path, typer.Argument(metavar="CASE", help="Case folder with system.toml.")],
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", parser=named_folder, help="Folder for simulation.csv; default out/simulate/NAME."),
    ] = None,
    at: Annotated[
        Path | None, typer.Option(metavar="conditions.csv", help=f"Other conditions than the case's. {CONDITIONS}")
    ] = None,
) -> None:
    """Readings of the base model at the conditions of a case.

    Those of recordings.csv and conditions.csv, or of another table; nothing is fitted. Effects and calibration that
    system.toml names are part of the model, as in the folder improved of a diagnosis.
    """
    from mixedlub.case.folder import read_case, read_conditions, unpredicted_runs
    from mixedlub.case.simulation import simulate
    from mixedlub.rig.plausibility import implausible
    from mixedlub.schema.findings import collected, gravest_first

    with collected() as notes, input_errors_from(str(case)):
        found = read_case(case_folder(case), need_recordings=False)
        notes += [*found.notes, *implausible(found.rig)]
        notes += unpredicted_runs(found, found.conditions) if at is None else []
        asked = None if at is None else read_conditions(found, at)
        rows = simulate(found, asked)
    folder = output_folder(out, NAME, found.name)
    print_findings(gravest_first(dict.fromkeys(notes)))
    with writing(folder) as aside:
        rows.to_csv(aside / "simulation.csv", index=False, lineterminator="\n")
    echo(f"{len(rows)} rows of {found.quantity} in {folder / 'simulation.csv'}")
