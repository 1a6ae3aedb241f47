"""`mixedlub law-errors`: errors of laws of line contacts against full solutions."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import input_errors_from, print_findings, progress_bar
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.commands.study import Scheduler
from mixedlub.running.origin import origin_of_file
from mixedlub.schema.result import Result
from profiles.errors import InputError

NAME = "law-errors"
EXAMPLE = "mixedlub law-errors"
RIGS, SEED = 10, 1


@delivers(NAME)
def command(
    how: How,
    oil: Annotated[
        list[str] | None,
        typer.Argument(metavar="[OIL]...", help="Oils by name, or their files: solve; left out: kept solutions."),
    ] = None,
    solutions: Annotated[
        Path | None, typer.Option(metavar="FILE.csv", help="solutions.csv of an earlier run, in place of kept ones.")
    ] = None,
    rigs: Annotated[
        int | None, typer.Option(metavar="NUMBER", min=2, help=f"Rigs of each oil that are solved; default {RIGS}.")
    ] = None,
    seed: Annotated[
        int | None, typer.Option(metavar="NUMBER", min=0, help=f"Choice of the rigs; default {SEED}.")
    ] = None,
    scheduler: Scheduler = None,
) -> None:
    """Errors of laws of film, heat and friction of line contacts against full solutions.

    Contacts of gears, M 1 to 300 and L 3 to 22, as rigs of several speeds, loads and oil temperatures. Without OIL the
    shipped solutions are used; with OIL they are computed, which takes some seconds a rig. An interrupted run resumes
    when it is started again.
    """
    from mixedlub.ehl.solve import Way
    from mixedlub.report.law_errors import figures, fit_lines, law_lines
    from mixedlub.schema.findings import collected
    from mixedlub.solutions import fits, kept, ratios
    from mixedlub.solutions.result_columns import LAW_ERRORS

    if oil and solutions is not None:
        raise InputError("are solved already; leave the oils out", where="--solutions", value=str(solutions))
    for option, value in {"--rigs": rigs, "--seed": seed, "--scheduler": scheduler}.items():
        if value is not None and not oil:
            raise InputError("is for oils that are solved; name them", where=option, value=value)
    with collected() as findings, input_errors_from(NAME):
        given = None if oil else kept.read_solutions(kept.KEPT if solutions is None else solutions)
        of = kept.oils(oil or [] if given is None else list(given["oil"].unique()))
    print_findings(findings)
    name, source = "_".join(Path(name).stem for name in oil or ["kept"]), Path("_".join(oil or ["kept solutions"]))
    to = how.open(name, origin_of_file(solutions or source, rigs, seed), LAW_ERRORS, "set of solutions")
    if given is None:
        with progress_bar("solving") as bar:
            given = kept.solve_rigs(of, rigs or RIGS, SEED if seed is None else seed, Way(to.folder, scheduler, bar))
    laws, fitted = ratios.by_contact(given, of)
    by_law, by_rig = ratios.summary(laws), fits.of_rigs(fitted)
    tables = {"laws": by_law, "fits": fits.summary(by_rig, fitted), "rigs": by_rig}
    tables |= {"ratios": laws, "fitted": fitted, "solutions": given}
    lines = (kept.solved_line(given), "", *law_lines(by_law, ratios.ALL), "", *fit_lines(tables["fits"], ratios.ALL))
    notes = () if len(by_rig) else ("no rig has enough solved contacts for exponents of its own",)
    result = Result("Laws and full solutions", tables, figures(laws, fitted), lines, notes, columns=LAW_ERRORS)
    deliver(result, to, written=f"\nresults in {to.folder / ', '.join(f'{name}.csv' for name in tables)}")
