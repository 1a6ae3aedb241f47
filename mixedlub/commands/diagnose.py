"""`mixedlub diagnose`: which physics is missing from the base model of a recorded case."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import (
    CONDITIONS,
    busy,
    case_folder,
    echo,
    input_errors_from,
    named_folder,
    note,
    output_folder,
    print_findings,
)

NAME = "diagnose"
EXAMPLE = "mixedlub new case --out my_case\nmixedlub diagnose my_case"


def command(
    case: Annotated[Path, typer.Argument(metavar="CASE", help="Case folder with system.toml and recordings.csv.")],
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", parser=named_folder, help="Folder for the report; default out/diagnose/NAME."),
    ] = None,
    predict: Annotated[
        Path | None,
        typer.Option(metavar="conditions.csv", help=f"Conditions to predict; default the case's own. {CONDITIONS}"),
    ] = None,
    exclude: Annotated[
        list[str] | None, typer.Option(metavar="ID...", help="Leave effects out of the catalogue.")
    ] = None,
    level: Annotated[
        float, typer.Option(metavar="CHANCE", help="Level of the mismatch test, from 1e-9 to 0.5.")
    ] = 0.01,
    replace: Annotated[
        bool, typer.Option("--replace", help="Replace the result of another case, or other files, in that folder.")
    ] = False,
) -> None:
    """Name the missing physics of a recording.

    How sure, where it shows, what it is confused with, and what to test next.
    """
    from mixedlub.diagnosis.report.files import WRITTEN, case_origin, diagnose

    folder = output_folder(out, NAME, case_folder(case).resolve().name)
    earlier = "" if replace else case_origin(case).check_folder(folder, WRITTEN, "case")
    if earlier:
        note(earlier)
    with busy("reading") as progress, input_errors_from(str(case)):
        found = diagnose(case, folder, predict=predict, exclude=tuple(exclude or ()), level=level, progress=progress)
    print_findings(found.case.notes)
    echo((folder / "report.txt").read_text(encoding="utf-8"))
    echo(f"written to {folder}")
