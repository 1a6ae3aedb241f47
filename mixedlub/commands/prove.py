"""`mixedlub prove`: the project's own blind battery."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.output import output_folder, say, working

NAME = "prove"
EXAMPLE = "mixedlub prove --quick --out out/prove"


def command(
    out: Annotated[Path | None, typer.Option(help="Folder for the score table; default out/prove/battery.")] = None,
    quick: Annotated[bool, typer.Option("--quick", help="A handful of cases, no baselines.")] = False,
    cases: Annotated[int, typer.Option(min=1, help="Cases to deal; 12 with --quick.")] = 240,
    seed: Annotated[int, typer.Option(min=0, help="Seed the battery is sealed with.")] = 1,
) -> None:
    """Put the diagnosis to a blind test.

    Concealed cases made by an independent rig model are diagnosed, and the score is printed.
    """
    from mixedlub.diagnosis.write import diagnose
    from mixedlub.proof.prove import prove

    folder = output_folder(out, NAME, "battery")
    with working("dealing") as progress:
        scores = prove(
            folder,
            diagnose,
            cases=12 if quick else cases,
            seed=seed,
            jobs=len(os.sched_getaffinity(0)),
            baselines=not quick,
            progress=lambda stage, done, total: progress(f"{stage}: {done} of {total}"),
        )
    for score in scores:
        say(score.text())
    say(f"details in {folder}")
