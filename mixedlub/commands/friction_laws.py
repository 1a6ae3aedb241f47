"""`mixedlub friction-laws`: friction laws as text, and their comparison on a gear pair."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from mixedlub.commands.console import busy, echo, input_errors_from, print_findings
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.running.origin import origin_of_file
from mixedlub.schema.result import Result
from profiles.errors import InputError

NAME = "friction-laws"
EXAMPLE = "mixedlub friction-laws schlenk"


@delivers(NAME)
def command(
    how: How,
    law: Annotated[str | None, typer.Argument(metavar="NAME", help="One law; a table of all when left out.")] = None,
    study: Annotated[
        Path | None,
        typer.Option("--study", "--gear", metavar="FILE.toml", help="Study file: compare all laws on its gears."),
    ] = None,
    torque: Annotated[
        float | None,
        typer.Option("--torque-Nm", metavar="NUMBER", help="Torque compared at; default the study's last."),
    ] = None,
    speed: Annotated[
        float | None, typer.Option("--speed-rpm", metavar="NUMBER", help="Speed compared at; default the study's last.")
    ] = None,
    temperature: Annotated[
        float | None,
        typer.Option("--oil-temperature-C", metavar="NUMBER", help="Oil temperature; default the study's last."),
    ] = None,
    pairing: Annotated[
        str | None, typer.Option(metavar="'A / B'", help="Surfaces of pinion and gear; default the study's first.")
    ] = None,
    coefficients: Annotated[
        Path | None,
        typer.Option(metavar="FILE.toml", help="Coefficients of laws that need them: a table for each, by its name."),
    ] = None,
) -> None:
    """The friction laws: a table, the page of one, or all of them side by side on the gears of a study.

    A page has equation, source, range, status, inputs and coefficients.

    With a study: friction along the path of contact, over the slide-to-roll ratio and of the mesh, as CSV and figures,
    grey where a law is outside its range.
    """
    condition = {"torque_Nm": torque, "speed_rpm": speed, "oil_temperature_C": temperature}
    if study is None:
        from mixedlub.report.friction_pages import friction_text

        if any(given is not None for given in (*condition.values(), pairing, coefficients, how.out)):
            raise InputError("name the study to compare the laws on: --study FILE.toml", where="--study")

        echo(friction_text(law))
        return
    if law is not None:
        raise InputError("all laws are compared on a study; leave the name out", where="NAME", value=law)
    _compare(study, condition, pairing, coefficients, how)


def _compare(
    study: Path,
    condition: dict[str, float | None],
    pairing: str | None,
    coefficients: Path | None,
    how: How,
) -> None:
    from mixedlub.chain.documented import few
    from mixedlub.report.friction_figures import figures
    from mixedlub.rig.surface import mean_assumed
    from mixedlub.schema.toml_file import read_toml
    from mixedlub.study import read_study
    from mixedlub.study.friction_comparison import TABLES, compared, mesh_table

    with input_errors_from(str(study)):
        read = read_study(study)
        given: dict[str, Any] = {} if coefficients is None else _of_files(read_toml(coefficients), coefficients.parent)
        comparison = compared(read, given, pairing=pairing, **condition)
    to = how.open(read.name, origin_of_file(study, condition, pairing, given), TABLES, "study")
    print_findings(dict.fromkeys((*read.notes, *mean_assumed(read.surfaces.values()))))
    notes = [
        f"{name} is left out: give {few(lacking)} in a file for --coefficients"
        for name, lacking in comparison.left_out.items()
    ]
    if read.file.effects:
        notes.append("the effects of the study are left out of the comparison")
    with busy("computing"):
        tables = {
            "along_path": comparison.along_path(),
            "over_slide_roll_ratio": comparison.over_ratio(),
            "mesh": mesh_table(read, comparison.coefficients),
        }
        here = mesh_table(comparison.every, comparison.coefficients)
    drawn, captions = figures(comparison, tables["along_path"], tables["over_slide_roll_ratio"], here)
    result = Result(read.file.title, tables, drawn, (), tuple(notes), columns=TABLES, captions=captions)
    deliver(result, to, written=f"along_path.csv, over_slide_roll_ratio.csv, mesh.csv and figures in {to.folder}")


def _of_files(given: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Coefficients by law; file names are relative to the folder of the naming file."""
    return {name: str(folder / own) if isinstance(own, str) else own for name, own in given.items()}
