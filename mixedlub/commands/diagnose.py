"""`mixedlub diagnose`: physics missing from the base model of a recorded case."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import CONDITIONS, busy, case_folder, input_errors_from, print_findings
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.running.atomic import fill
from mixedlub.schema.findings import Finding
from mixedlub.schema.result import Result

NAME = "diagnose"
EXAMPLE = "mixedlub new case --out my_case\nmixedlub diagnose my_case"


@delivers(NAME, "figures", "format_", "xlsx", "csv_style")
def command(
    case: Annotated[Path, typer.Argument(metavar="CASE", help="Case folder with system.toml and recordings.csv.")],
    how: How,
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
) -> None:
    """Identify the missing physics of a recording.

    Probability, conditions that show it, effects it can be confused with, and recommended tests.
    """
    from mixedlub.diagnosis.diagnose import diagnose_case
    from mixedlub.diagnosis.report import files

    to = how.open(case_folder(case).resolve().name, files.case_origin(case), (), "case", *files.WRITTEN)
    from mixedlub.full_base.progress import building

    def solved(done: int, of: int) -> None:
        progress(f"full solutions: {done} of {of} blocks")

    with busy("reading") as progress, input_errors_from(str(case)), building(solved):
        found = diagnose_case(case, predict, tuple(exclude or ()), level, progress)
        extra = files.described(found)
        contents = files.texts(found, extra)
    print_findings(found.case.notes)

    def page(aside: Path, doing: Callable[[str], None]) -> list[Finding]:
        fill(files.drawings(found, extra), aside)
        return []

    files.drop_earlier(contents, to.folder / files.FOLDER)
    result = Result(found.case.name, {}, {}, (str(contents["report.txt"]),), files=contents)
    deliver(result, to, page=page, written=f"written to {to.folder}")
