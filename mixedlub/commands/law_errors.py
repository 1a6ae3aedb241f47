"""`mixedlub law-errors`: how far the laws of line contacts are from full solutions."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import echo, input_errors_from, note, output_folder, print_findings
from mixedlub.commands.figure_options import FiguresOrTables, Formats, chosen_formats
from mixedlub.commands.study import Scheduler, progress_bar
from mixedlub.running.atomic import clear_parts, writing
from profiles.errors import InputError

NAME = "law-errors"
EXAMPLE = "mixedlub law-errors"
RIGS, SEED = 10, 1


def command(
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
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder for the results; default out/law-errors/NAME.")
    ] = None,
    figures: FiguresOrTables = True,
    format_: Formats = "svg",
    scheduler: Scheduler = None,
) -> None:
    """How far the laws of film, heat and friction of line contacts are from full solutions.

    Contacts of gears, M 1 to 300 and L 3 to 22, as rigs of several speeds, loads and oil temperatures. Without OIL by
    the solutions that the package has; with it they are solved anew, which takes some seconds a rig. An interrupted
    run resumes when it is started again.
    """
    from mixedlub.ehl.solve import Way
    from mixedlub.report.law_errors import figures as drawn
    from mixedlub.report.law_errors import fit_lines, law_lines
    from mixedlub.report.style import save_all
    from mixedlub.schema.findings import collected
    from mixedlub.solutions import fits, kept, ratios

    formats = chosen_formats(format_)
    if oil and solutions is not None:
        raise InputError("are solved already; leave the oils out", where="--solutions", value=str(solutions))
    for option, value in {"--rigs": rigs, "--seed": seed, "--scheduler": scheduler}.items():
        if value is not None and not oil:
            raise InputError("is for oils that are solved; name them", where=option, value=value)
    with collected() as notes, input_errors_from(NAME):
        given = None if oil else kept.read_solutions(kept.KEPT if solutions is None else solutions)
        of = kept.oils(oil or [] if given is None else list(given["oil"].unique()))
    print_findings(notes)
    folder = output_folder(out, NAME, "_".join(Path(name).stem for name in oil or ["kept"]))
    if given is None:
        with progress_bar("solving") as bar:
            given = kept.solve_rigs(of, rigs or RIGS, SEED if seed is None else seed, Way(folder, scheduler, bar))
    table = given
    laws, fitted = ratios.by_contact(table, of)
    by_law, by_rig = ratios.summary(laws), fits.of_rigs(fitted)
    tables = {"solutions": table, "ratios": laws, "fitted": fitted, "laws": by_law, "rigs": by_rig}
    tables["fits"] = fits.summary(by_rig, fitted)
    with writing(folder) as aside:
        for name, content in tables.items():
            (aside / f"{name}.csv").write_text(kept.as_csv(content), encoding="utf-8", newline="\n")
        if figures:
            save_all(drawn(laws, fitted), aside, formats)
    clear_parts(folder)
    echo(kept.solved_line(table))
    echo("\n".join(["", *law_lines(by_law, ratios.ALL), "", *fit_lines(tables["fits"], ratios.ALL)]))
    if not len(by_rig):
        note("no rig has enough solved contacts for exponents of its own")
    echo(f"\nresults in {folder / 'laws.csv'}, fits.csv, rigs.csv, ratios.csv, fitted.csv and solutions.csv")
