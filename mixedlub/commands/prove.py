"""`mixedlub prove`: the project's own blind battery."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import output_folder, say

NAME = "prove"
EXAMPLE = "mixedlub prove --out out/prove"


FULL, QUICK = 240, 24
RIGS, RIGS_QUICK = 200, 25


def command(
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder for the score table; default out/prove/battery.")
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help=f"{QUICK} cases and no baselines instead of all.")] = False,
    rigs: Annotated[
        bool,
        typer.Option(
            "--rigs", help="Films, histories, maps, viscosities and tooth contacts instead of gear pairs and discs."
        ),
    ] = False,
    seed: Annotated[
        int, typer.Option(metavar="N", min=0, help="Which battery: every seed deals other cases.")
    ] = 969710,
    cases: Annotated[
        int | None,
        typer.Option(metavar="N", min=5, help=f"How many cases to deal; default {FULL}, with --rigs {RIGS}."),
    ] = None,
    jobs: Annotated[int, typer.Option(metavar="N", min=1, help="Cases at a time.")] = 2,
) -> None:
    """Put the diagnosis to a blind test.

    Concealed cases made by an independent rig model are diagnosed, and the score is printed. A run broken
    off goes on where it stopped.
    """
    from rich.console import Console
    from rich.progress import Progress

    from mixedlub.diagnosis.report.files import diagnose
    from mixedlub.validation.prove import prove
    from mixedlub.validation.rigs.prove import prove_rigs

    folder = output_folder(out, NAME, ("rigs_" if rigs else "") + ("quick" if quick else "battery"))
    with Progress(console=Console(stderr=True)) as bar:
        tasks = {}

        def show(stage: str, done: int, total: int) -> None:
            if stage not in tasks:
                tasks[stage] = bar.add_task(stage, total=total)
            bar.update(tasks[stage], completed=done)

        if rigs:
            prove_rigs(folder, diagnose, cases or (RIGS_QUICK if quick else RIGS), seed, jobs, show)
        else:
            prove(folder, diagnose, cases or (QUICK if quick else FULL), seed, jobs, not quick, show)
    say((folder / "score.txt").read_text(encoding="utf-8"))
    say(f"written to {folder}")
