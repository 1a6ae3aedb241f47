"""`mixedlub fit`: published laws fitted to own readings, ranked by evidence."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import busy, input_errors_from, print_findings
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.running.origin import origin_of, origin_of_file
from mixedlub.schema.findings import collected, report
from mixedlub.schema.result import Result
from profiles.errors import InputError
from profiles.units import number_of

NAME = "fit"
CASE_FILES = ("system.toml", "recordings.csv")
EXAMPLE = "mixedlub new case --kind viscosity --out oil\nmixedlub fit oil"


@delivers(NAME)
def command(
    file: Annotated[
        Path,
        typer.Argument(metavar="FILE", help="Readings with units in the header (.csv, .txt, .xlsx), or a case folder."),
    ],
    how: How,
    quantity: Annotated[
        str | None,
        typer.Option(
            metavar="COLUMN",
            help="What to fit: friction_coefficient, friction_torque_Nm, film_thickness_nm or viscosity_mPa_s; "
            "default the first that the table has.",
        ),
    ] = None,
    constants: Annotated[
        list[str],
        typer.Option("--set", metavar="COLUMN=NUMBER", help="A value that all rows share, as --set radius_mm=20."),
    ] = [],  # noqa: B006  (typer reads the default, which is never changed)
    relative_sd: Annotated[
        float | None,
        typer.Option(
            metavar="NUMBER",
            help="Standard deviation of a reading over its size; default a column ending in _sd, else estimated.",
        ),
    ] = None,
    law: Annotated[
        str | None, typer.Option(metavar="NAME", help="Law whose coefficients are exported; default the best.")
    ] = None,
    own: Annotated[
        list[Path],
        typer.Option("--own", metavar="LAW.toml", help="A law file of your own that competes too."),
    ] = [],  # noqa: B006  (typer reads the default, which is never changed)
) -> None:
    """Which published law fits the readings?

    Friction laws, Stribeck curves, film laws and viscosity laws are fitted to readings of discs, a mesh, a journal, a
    drive or a viscometer. The report ranks them by evidence, with AICC, BIC, parameters and 90 % intervals, names the
    laws that are tied, the condition at which a law misfits, and the column that a law lacks.

    The fitted law is written for studies, cases and the solver: law.toml, options.toml, oil.toml, viscosity.toml. Of a
    case of two discs with its oil, oil.toml has Eyring stress and limiting stress over pressure and temperature.
    """
    from mixedlub.fit import TABLES, ranking, read_readings, result

    with input_errors_from(str(file)):
        choices = (quantity, constants, relative_sd, law, *(path.read_bytes() for path in own if path.is_file()))
        case = file.is_dir()
        origin = origin_of(file, CASE_FILES, *choices) if case else origin_of_file(file, *choices)
        to = how.open(file.name if case else file.stem, origin, TABLES)
        with busy("fitting"), collected() as findings:
            readings = read_readings(file, quantity, numbers_of(constants), relative_sd)
            found = ranking(readings, tuple(own))
            answer = with_traction(result(found, f"Laws fitted to {file.name}", law), file)
    print_findings([*readings.notes, *findings, *found.range_findings(found.best)])
    deliver(answer, to, written=f"laws.csv, parameters.csv, {', '.join(answer.files)} in {to.folder}")


def with_traction(answer: Result, file: Path) -> Result:
    """Result with the traction part of the oil, of a case of two discs with the viscosities of its oil."""
    from mixedlub.case.folder import read_case
    from mixedlub.evaluate.result_columns import TRACTION_PART
    from mixedlub.evaluate.traction_fit import fits_traction, fitted_traction

    case = None
    if file.is_dir():
        with collected():
            case = read_case(file)
    if case is None or not fits_traction(case):
        return answer
    part = fitted_traction(case, file.name)
    for one in part.findings:
        report(one)
    return replace(
        answer,
        tables={**answer.tables, "traction_part": part.table},
        columns={**answer.columns, "traction_part": TRACTION_PART},
        lines=(*answer.lines, "Traction part of the oil, in oil.toml:", *(f"  {line}" for line in part.lines)),
        files={**answer.files, "oil.toml": part.file},
    )


def numbers_of(settings: list[str]) -> dict[str, float]:
    """Values of settings such as ``radius_mm=20``.

    >>> numbers_of(["radius_mm=20"])
    {'radius_mm': 20.0}
    """
    found = {}
    for setting in settings:
        name, mark, text = setting.partition("=")
        if name.strip() in found:
            raise InputError(f"{name.strip()} is set twice", where="--set", value=setting)
        try:
            found[name.strip()] = number_of(text.strip())
        except ValueError:
            mark = ""
        if not mark:
            raise InputError("is COLUMN=NUMBER, as radius_mm=20", where="--set", value=setting)
    return found
