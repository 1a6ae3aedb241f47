"""`mixedlub condense`: friction of full solutions for one oil as a friction law that studies use."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import echo, input_errors_from, output_folder, print_findings
from mixedlub.commands.figure_options import FiguresOrTables, Formats, chosen_formats
from mixedlub.commands.study import Scheduler, progress_bar, resumed
from mixedlub.running.atomic import clear_parts, writing

NAME = "condense"
EXAMPLE = "mixedlub condense atf --solutions 150"
SOLUTIONS = 1000


def command(
    oil: Annotated[str, typer.Argument(metavar="OIL", help="An oil by name, or its file.")],
    solutions: Annotated[int, typer.Option(metavar="NUMBER", min=150, help="Contacts that are solved.")] = SOLUTIONS,
    seed: Annotated[int, typer.Option(metavar="NUMBER", min=0, help="Choice of the contacts.")] = 1,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder for the results; default out/condense/NAME.")
    ] = None,
    figures: FiguresOrTables = True,
    format_: Formats = "svg",
    scheduler: Scheduler = None,
) -> None:
    """Friction of full solutions for one oil, condensed into a friction law.

    Thermal solutions of contacts of gears, a regression of their friction with its error on solutions that it was not
    fitted to, residual plots, and the published law beside it. The file of the law is for `[options]` of a study. An
    interrupted run resumes when it is started again.
    """
    from mixedlub.ehl.solve import Way
    from mixedlub.report.condensed import figures as drawn
    from mixedlub.report.style import save_all
    from mixedlub.schema.findings import collected
    from mixedlub.solutions.condensed_points import draw, properties_of, solved_table
    from mixedlub.solutions.kept import oils
    from mixedlub.solutions.law_file import against_published, law_file
    from mixedlub.solutions.regression import regression

    formats = chosen_formats(format_)
    with collected() as notes, input_errors_from(NAME):
        (of,) = oils([oil]).values()
        found = draw(of, solutions, seed)
    print_findings(notes)
    folder = output_folder(out, NAME, Path(oil).stem)
    with progress_bar("solving") as bar:
        table = solved_table(of, found, Way(folder, scheduler, resumed(bar)))
    law = regression(table, properties_of(of))
    against = against_published(law)
    file = f"{Path(oil).stem}_friction.toml"
    with writing(folder) as aside:
        (aside / file).write_text(law_file(of.name, law), encoding="utf-8", newline="\n")
        for name, content in {"solutions": law.table, "terms": law.terms, "against_published": against}.items():
            content.to_csv(aside / f"{name}.csv", index=False, lineterminator="\n", float_format="%.6g")
        if figures:
            save_all(drawn(law, against), aside, formats)
    clear_parts(folder)
    fit = law.fit
    echo(f"{fit['solutions']} contacts solved, {fit['without_solution']} without solution")
    own, others = (_percent(fit[f"{which}rms_of_log"]) for which in ("", "left_out_"))
    echo(f"rms error {own} of those fitted to, {others} of those left out")
    echo(f"Xu and Kahraman's terms leave {_percent(fit['rms_of_log_of_published_terms'])} of the same solutions")
    ratio = against["published_over_condensed"].quantile([0.05, 0.5, 0.95]).to_list()
    echo("their published law over this one: {1:.2g} in the middle, {0:.2g} to {2:.2g} in nine of ten".format(*ratio))
    echo(f"law in {folder / file}, residuals in solutions.csv, terms.csv, against_published.csv")


def _percent(rms_of_log: float) -> str:
    return f"{100.0 * rms_of_log:.3g} %"
