"""`mixedlub condense`: friction of full solutions for an oil as a friction law for studies."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import input_errors_from, print_findings, progress_bar, resumed
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.commands.study import Scheduler
from mixedlub.running.origin import origin_of_file
from mixedlub.schema.result import Result

NAME = "condense"
EXAMPLE = "mixedlub condense atf --solutions 150"
SOLUTIONS = 1000


@delivers(NAME)
def command(
    oil: Annotated[str, typer.Argument(metavar="OIL", help="An oil by name, or its file.")],
    how: How,
    solutions: Annotated[int, typer.Option(metavar="NUMBER", min=150, help="Contacts that are solved.")] = SOLUTIONS,
    seed: Annotated[int, typer.Option(metavar="NUMBER", min=0, help="Choice of the contacts.")] = 1,
    scheduler: Scheduler = None,
) -> None:
    """Condense friction of full solutions for one oil into a friction law.

    Thermal solutions of gear contacts, a regression of their friction with its error on solutions left out of the fit,
    residual plots, and the published law for comparison. The file of the law is for `[options]` of a study. An
    interrupted run resumes when it is started again.
    """
    from mixedlub.ehl.solve import Way
    from mixedlub.report.condensed import figures
    from mixedlub.schema.findings import collected
    from mixedlub.solutions.condensed_points import draw, properties_of, solved_table
    from mixedlub.solutions.kept import oils
    from mixedlub.solutions.law_file import against_published, law_file
    from mixedlub.solutions.regression import regression
    from mixedlub.solutions.result_columns import CONDENSED

    file = f"{Path(oil).stem}_friction.toml"
    with collected() as notes, input_errors_from(NAME):
        (of,) = oils([oil]).values()
        found = draw(of, solutions, seed)
        to = how.open(Path(oil).stem, origin_of_file(Path(oil), solutions, seed), CONDENSED, "oil")
        to.check([file])
    print_findings(notes)
    with progress_bar("solving") as bar:
        table = solved_table(of, found, Way(to.folder, scheduler, resumed(bar)))
    law = regression(table, properties_of(of))
    against = against_published(law)
    fit = law.fit
    own, others, published = (
        _percent(fit[name]) for name in ("rms_of_log", "left_out_rms_of_log", "rms_of_log_of_published_terms")
    )
    ratio = against["published_over_condensed"].quantile([0.05, 0.5, 0.95]).to_list()
    lines = (
        f"{fit['solutions']} contacts solved, {fit['without_solution']} without solution",
        f"rms error {own} of those fitted to, {others} of those left out",
        f"Xu and Kahraman's terms leave {published} of the same solutions",
        "their published law over this one: {1:.2g} in the middle, {0:.2g} to {2:.2g} in nine of ten".format(*ratio),
    )
    tables = {"solutions": law.table, "terms": law.terms, "against_published": against}
    files = {file: law_file(of.name, law)}
    written = f"law in {to.folder / file}, residuals in solutions.csv, terms.csv, against_published.csv"
    deliver(
        Result(f"Friction of {of.name}", tables, figures(law, against), lines, files=files, columns=CONDENSED),
        to,
        written=written,
    )


def _percent(rms_of_log: float) -> str:
    return f"{100.0 * rms_of_log:.3g} %"
