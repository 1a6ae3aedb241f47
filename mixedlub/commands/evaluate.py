"""`mixedlub evaluate`: recordings of a rig turned into friction, with intervals."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import busy, echo, input_errors_from, note, output_folder, print_findings
from mixedlub.commands.figure_options import FiguresOrTables, Formats, chosen_formats
from mixedlub.running.atomic import writing
from mixedlub.schema.findings import collected

NAME = "evaluate"
EXAMPLE = "mixedlub new calorimetric --out rig\nmixedlub evaluate calorimetric rig/calorimetric.toml"
METHODS = "calorimetric, strain-gauge, off-line, two-disc, regression or calibration."
CASE = "case"
"""Folder of the results that `mixedlub diagnose` reads."""


def command(
    method: Annotated[str, typer.Argument(metavar="METHOD", help=METHODS)],
    file: Annotated[Path, typer.Argument(metavar="FILE", help="The rig, its meters, and the tables it recorded.")],
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder for the results; default out/evaluate/NAME.")
    ] = None,
    figures: FiguresOrTables = True,
    format_: Formats = "svg",
) -> None:
    """Recordings of a rig into friction, with intervals.

    calorimetric: heat of the oil into gear loss and mean friction. strain-gauge: strains of teeth into normal and
    friction force. off-line: displacement off the line of action into friction force. two-disc: torque into traction.
    regression: traction into a friction law. calibration: gear loss into the coefficients of a friction law.

    Tables, figures, a case folder for `mixedlub diagnose`, or friction laws for studies.
    """
    from mixedlub.evaluate import evaluate
    from mixedlub.importers.case_writer import write_case
    from mixedlub.report.evaluation import evaluation_figures
    from mixedlub.report.style import save_all

    formats = chosen_formats(format_)
    with input_errors_from(str(file)), busy("evaluating"), collected() as findings:
        found = evaluate(method, file)
    print_findings(findings)
    for text in found.notes:
        note(text)
    folder = output_folder(out, NAME, file.stem)
    with writing(folder) as aside:
        for name, table in found.tables.items():
            table.to_csv(aside / f"{name}.csv", index=False, lineterminator="\n", float_format="%.8g")
        for name, text in found.files.items():
            (aside / name).write_text(text, encoding="utf-8", newline="\n")
        if found.case is not None:
            write_case(aside / CASE, found.case.system, found.case.columns, attachments=found.case.attachments)
        if figures:
            save_all(evaluation_figures(found), aside, formats)
    for line in found.lines:
        echo(f"  {line}")
    echo(f"{', '.join((*(f'{name}.csv' for name in found.tables), *found.files))} in {folder}")
    if found.case is not None:
        echo(f"a case of kind {found.case.system['kind']}:")
        echo(f"  mixedlub diagnose {folder / CASE} --out out/diagnose/{file.stem}")
