"""`mixedlub diagnose`: physics missing from the base model of a recorded case."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mixedlub.commands.console import CONDITIONS, busy, case_folder, input_errors_from, print_findings
from mixedlub.commands.deliver import Delivery, How, deliver, delivers
from mixedlub.running.atomic import fill
from mixedlub.schema.findings import Finding
from mixedlub.schema.result import Result
from profiles.errors import InputError

if TYPE_CHECKING:
    from mixedlub.diagnosis.diagnose import Diagnosis

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
    add: Annotated[
        Path | None,
        typer.Option(
            metavar="next_tests.csv",
            help="Add the readings of a filled-in file, and go on from the answer in the folder for the results. The "
            "case itself is not changed.",
        ),
    ] = None,
) -> None:
    """Identify the missing physics of a recording.

    Probability, conditions that show it, effects it can be confused with, and recommended tests.
    """
    from mixedlub.diagnosis.diagnose import diagnose_case
    from mixedlub.diagnosis.report import files
    from mixedlub.full_base.progress import building

    def solved(done: int, of: int) -> None:
        progress(f"full solutions: {done} of {of} blocks")

    origin = replace(files.case_origin(case_folder(case)), within=add)
    to = how.open(case.resolve().name, origin, (), "case", *files.WRITTEN)
    if add is None:
        _refuse_campaign(to)
    with busy("reading") as progress, input_errors_from(str(case)), building(solved):
        names = tuple(exclude or ())
        if add is None:
            found = diagnose_case(case, predict, names, level, progress)
        else:
            found = _added(case, add, to, predict, names, level, progress)
        extra = files.described(found)
        contents = files.texts(found, extra)
    print_findings(found.case.notes)

    def page(aside: Path, doing: Callable[[str], None]) -> list[Finding]:
        fill(files.drawings(found, extra), aside)
        return []

    files.drop_earlier(contents, to.folder / files.FOLDER)
    if add is None:
        shutil.rmtree(to.folder / files.CAMPAIGN, ignore_errors=True)
        (to.folder / f"{files.CAMPAIGN}.json").unlink(missing_ok=True)
    result = Result(found.case.name, {}, {}, (str(contents["report.txt"]),), files=contents)
    deliver(result, to, page=page, written=f"written to {to.folder}")


def _refuse_campaign(to: Delivery) -> None:
    """Raise an error for a folder with added readings, which a new answer would lose."""
    from mixedlub.diagnosis.report.files import CAMPAIGN

    if not to.how.replace and (to.folder / f"{CAMPAIGN}.json").exists():
        rule = "holds added readings; go on with --add, name another folder with --out, or say --replace"
        raise InputError(rule, where="--out", value=str(to.folder))


def _added(
    case: Path,
    add: Path,
    to: Delivery,
    predict: Path | None,
    exclude: tuple[str, ...],
    level: float,
    progress: Callable[[str], None],
) -> Diagnosis:
    """Diagnosis of the case, or of the campaign that went on from it, with the readings of a file."""
    from mixedlub.diagnosis.campaign import diagnose_added
    from mixedlub.diagnosis.report.files import CAMPAIGN

    current, replaces = to.origin.is_of(to.folder), to.how.replace
    goes_on = (to.folder / f"{CAMPAIGN}.json").exists()
    if goes_on and not current and not replaces:
        rule = "holds a campaign on an earlier state of the case; name another folder with --out and add all files anew"
        raise InputError(rule, where="--out", value=str(to.folder))
    # An answer to another state of the case, or with readings that are left behind, is no answer before these readings.
    answered = to.folder if current and not (goes_on and replaces) else to.folder / CAMPAIGN
    campaign = to.folder / CAMPAIGN if goes_on and not replaces else None
    return diagnose_added(case, add, answered, predict, exclude, level, progress, campaign)
