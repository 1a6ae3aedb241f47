"""`mixedlub evaluate`: friction from recordings of a rig, with intervals."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import busy, echo, input_errors_from, print_findings
from mixedlub.commands.deliver import CASE, How, deliver, delivers
from mixedlub.running.origin import origin_of_file
from mixedlub.schema.findings import collected

NAME = "evaluate"
EXAMPLE = "mixedlub new calorimetric --out rig\nmixedlub evaluate calorimetric rig/calorimetric.toml"
METHODS = "calorimetric, strain-gauge, off-line, two-disc, regression or calibration."


@delivers(NAME)
def command(
    method: Annotated[str, typer.Argument(metavar="METHOD", help=METHODS)],
    file: Annotated[Path, typer.Argument(metavar="FILE", help="The rig, its meters, and the tables it recorded.")],
    how: How,
) -> None:
    """Recordings of a rig into friction, with intervals.

    calorimetric: heat of the oil into gear loss and mean friction. strain-gauge: strains of teeth into normal and
    friction force. off-line: displacement off the line of action into friction force. two-disc: torque into traction.
    regression: traction into a friction law. calibration: gear loss into the coefficients of a friction law.

    Tables, figures, a case folder for `mixedlub diagnose`, or friction laws for studies.
    """
    from mixedlub.evaluate import evaluate, evaluation

    columns = evaluation(method).results
    with input_errors_from(str(file)):
        to = how.open(file.stem, origin_of_file(file, method), columns)
        with busy("evaluating"), collected() as findings:
            found = evaluate(method, file)
    print_findings(findings)
    names = ", ".join((*(f"{name}.csv" for name in found.tables), *found.files))
    lines = tuple(f"  {line}" for line in found.lines)
    deliver(replace(found, lines=lines, columns=columns), to, written=f"{names} in {to.folder}")
    if found.case is not None:
        echo(f"a case of kind {found.case.system['kind']}:")
        echo(f"  mixedlub diagnose {to.folder / CASE} --out out/diagnose/{file.stem}")
