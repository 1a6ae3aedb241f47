"""`mixedlub prove`: the blind test battery of the project."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from mixedlub.commands.console import echo, named_folder, output_folder
from profiles.errors import InputError

NAME = "prove"
EXAMPLE = "mixedlub prove --out out/prove"


FULL, QUICK = 240, 10
RIGS, RIGS_QUICK = 200, 25
OUTSIDE, SOLVED, SOLVED_QUICK = 100, 60, 12


def command(
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", parser=named_folder, help="Folder for the score table; default out/prove/battery."),
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help=f"{QUICK} cases and no baselines instead of all.")] = False,
    rigs: Annotated[
        bool,
        typer.Option(
            "--rigs", help="Films, histories, maps, viscosities and tooth contacts instead of gear pairs and discs."
        ),
    ] = False,
    worlds: Annotated[
        bool,
        typer.Option("--worlds", help="Rigs of all kinds that follow other published laws than the base model's."),
    ] = False,
    poor: Annotated[
        bool,
        typer.Option("--poor", help="Poor recordings of all kinds: few readings, noise that lasts, wrong sds, ..."),
    ] = False,
    forms: Annotated[
        bool,
        typer.Option(
            "--forms", help="Single effects alone, every published form of each in turn, on rigs of all kinds."
        ),
    ] = False,
    outside: Annotated[
        bool,
        typer.Option("--outside", help="Physics outside the catalogue: is it said, and is its law found?"),
    ] = False,
    solved: Annotated[
        bool,
        typer.Option("--solved", help="Gears and discs with film and friction of full solutions by an own solver."),
    ] = False,
    real: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", parser=named_folder, help="Recordings of real rigs in this folder, with concealed truths."
        ),
    ] = None,
    loop: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            min=1,
            help="N campaigns from ties, unknowns and misses: the proposed next readings against others.",
        ),
    ] = None,
    split: Annotated[
        str, typer.Option(metavar="NAME", help="Sources of --real to use: development or test.")
    ] = "development",
    kinds: Annotated[
        str | None, typer.Option(metavar="KIND,...", help="Kinds of rig to deal, such as gear_pair,film.")
    ] = None,
    seed: Annotated[
        int, typer.Option(metavar="N", min=0, help="Which battery: every seed deals other cases.")
    ] = 969710,
    cases: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            min=5,
            help=f"How many cases to deal; default {FULL}, with --rigs {RIGS}, --outside {OUTSIDE}, --solved {SOLVED}, "
            "--forms one a form.",
        ),
    ] = None,
    export: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            parser=named_folder,
            help="Write the battery as a benchmark for other programs into this folder, and diagnose nothing.",
        ),
    ] = None,
    jobs: Annotated[int, typer.Option(metavar="N", min=1, help="Cases at a time.")] = 2,
) -> None:
    """Test the diagnosis blindly.

    Cases with planted effects, made by an independent model of the rigs, are diagnosed, and the score is printed. An
    interrupted run is resumed by the same command.
    """
    from rich.console import Console
    from rich.progress import Progress

    from mixedlub.diagnosis.report.files import diagnose
    from mixedlub.validation import run
    from mixedlub.validation.battery import fewest, plan
    from mixedlub.validation.forms import every_form, plan_forms
    from mixedlub.validation.outside import KINDS as UNLISTED
    from mixedlub.validation.outside import plan_outside
    from mixedlub.validation.poor import plan_poor
    from mixedlub.validation.real import judge
    from mixedlub.validation.rigs import CONTACTS, OTHERS
    from mixedlub.validation.solved.deal import plan_solved
    from mixedlub.validation.worlds.deal import plan_worlds, worlds_of

    planners = {
        "": plan,
        "worlds": plan_worlds,
        "poor": plan_poor,
        "forms": plan_forms,
        "outside": plan_outside,
        "solved": plan_solved,
    }
    asked = {"worlds": worlds, "poor": poor, "forms": forms, "outside": outside, "solved": solved}
    dealing = next((name for name, wanted in asked.items() if wanted), "")
    planner = planners[dealing]
    if export is not None and (real is not None or loop is not None or out is not None):
        taken = "--out" if out is not None else "--real" if real is not None else "--loop"
        raise InputError(f"exports dealt batteries into its own folder: leave out {taken}", where="--export")
    if (real is not None or loop is not None) and (rigs or dealing):
        raise InputError("is a battery of its own", where="--real" if real is not None else "--loop")
    if worlds and poor:
        raise InputError("is dealt of rigs that follow the base laws: leave out --worlds", where="--poor")
    if forms and (worlds or poor):
        raise InputError("is dealt of good recordings of rigs that follow the base laws", where="--forms")
    if (outside or solved) and (rigs or worlds or poor or forms or (outside and solved)):
        raise InputError("is a battery of its own", where="--outside" if outside else "--solved")
    if loop is not None:
        echo(
            _loop(
                loop, output_folder(out, NAME, "loop"), seed, tuple(_chosen(kinds)) if kinds else ("gear_pair", "disc")
            )
        )
        return
    every = worlds_of((*CONTACTS, *OTHERS)) if worlds and not rigs else worlds_of(OTHERS) if worlds else ()
    every = (*CONTACTS, *OTHERS) if (poor or forms) and not rigs else every
    every = UNLISTED if outside else every
    chosen = _chosen(kinds) if kinds else every or (OTHERS if rigs else CONTACTS)
    contacts = set(chosen) <= set(CONTACTS) and not dealing
    least = len(every_form(chosen)) if forms else 5 if outside else fewest(chosen) * (2 if poor else 1)
    full = FULL if contacts or worlds or poor else RIGS
    most = {"forms": least, "outside": OUTSIDE, "solved": SOLVED}.get(dealing, full)
    few = {"forms": least, "solved": SOLVED_QUICK}.get(dealing, QUICK if contacts or outside else RIGS_QUICK)
    default = max(few if quick else most, least)
    prefix = "" if chosen in (CONTACTS, every) else "rigs_" if chosen == OTHERS else f"{'_'.join(chosen)}_"
    if export is not None:
        _export(export, cases or default, seed, chosen, jobs, not quick, planner)
        return
    dealt = f"{dealing}_{prefix}" if dealing else prefix
    name = f"real_{split}" if real is not None else dealt + ("quick" if quick else "battery")
    folder = output_folder(out, NAME, name)
    with Progress(console=Console(stderr=True)) as bar:
        tasks = {}

        def show(stage: str, done: int, total: int) -> None:
            if stage not in tasks:
                tasks[stage] = bar.add_task(stage, total=total)
            bar.update(tasks[stage], completed=done)

        if real is not None:
            judge.validate(real, folder, diagnose, split, seed, jobs, show)
        else:
            run.validate(
                folder,
                diagnose,
                cases or default,
                seed,
                chosen,
                jobs=jobs,
                baselines=contacts and not quick,
                progress=show,
                dealt=planner,
            )
    echo((folder / "score.txt").read_text(encoding="utf-8"))
    echo(f"written to {folder}")


def _export(
    folder: Path, cases: int, seed: int, kinds: tuple[str, ...], jobs: int, baselines: bool, planner: Any
) -> None:
    """Write a battery as a benchmark."""
    from mixedlub.commands.console import busy
    from mixedlub.validation.benchmark_scorer import table
    from mixedlub.validation.export import export

    output_folder(folder, NAME, "export", knows_own=True)
    with busy("benchmark") as doing:

        def show(stage: str, done: int, total: int) -> None:
            doing(f"{stage}: {done} of {total}")

        scores = export(folder, cases, seed, kinds, jobs, baselines, show, planner)
    for one in scores:
        echo(f"{one['name']}, on the blind part\n{table(one['figures'])}\n")
    echo(f"{folder / 'benchmark'} is for entrants, who start from its README.md; keep {folder / 'sealed'} to yourself")


def _loop(campaigns: int, folder: Path, seed: int, kinds: tuple[str, ...]) -> str:
    """Score of campaigns with added readings, played into a folder."""
    from mixedlub.commands.console import busy
    from mixedlub.diagnosis.campaign import diagnose_added
    from mixedlub.diagnosis.diagnose import diagnose_case
    from mixedlub.diagnosis.report.files import texts
    from mixedlub.running.atomic import fill
    from mixedlub.validation.loop import play

    with busy("campaigns") as doing:
        return play(
            folder,
            lambda case, to: fill(texts(diagnose_case(case), None), to),
            lambda case, added, answered, to: fill(texts(diagnose_added(case, added, answered), None), to),
            campaigns,
            seed,
            kinds,
            lambda stage, done, total: doing(f"{stage}: {done} of {total}"),
        )


def _chosen(kinds: str) -> tuple[str, ...]:
    """The named kinds, in the order of the battery."""
    from mixedlub.validation.rigs import KINDS

    named = {kind.strip() for kind in kinds.split(",")}
    if unknown := sorted(named - set(KINDS)):
        raise InputError(f"must be among {', '.join(KINDS)}", where="--kinds", value=", ".join(unknown))
    return tuple(kind for kind in KINDS if kind in named)
