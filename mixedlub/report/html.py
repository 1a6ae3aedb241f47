"""HTML of result pages: templates of one style, and figures drawn in parallel."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from importlib.resources import files
from pathlib import Path
from typing import Any

from mixedlub.report.figures import Drawn
from mixedlub.report.style import as_svg, save
from mixedlub.running.parallel import as_done

PAGE = "index.html"
MOST_GIVEN = 200_000
"""Largest number of characters of the user's file on a page."""


def rendered(template: str, **content: Any) -> str:
    """Page from a template of this folder."""
    from jinja2 import Environment, FunctionLoader

    loader = FunctionLoader(lambda name: files("mixedlub.report").joinpath(name).read_text(encoding="utf-8"))
    environment = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True, loader=loader)
    return environment.get_template(template).render(**content)


def drawn_all(
    drawn: Sequence[Drawn],
    folder: Path,
    formats: Sequence[str],
    doing: Callable[[str], None],
    *others: Callable[[], Any],
) -> tuple[list[str], list[Any]]:
    """Figures as SVG, after writing their files into a folder, and the results of other tasks; all in parallel."""
    tasks: list[Callable[[], Any]] = [*others, *(partial(_saved, one, folder, formats) for one in drawn)]
    made: dict[int, Any] = {}
    for place, one in as_done(lambda task: task(), tasks):
        made[place] = one
        doing(f"drawing: {len(made)} of {len(tasks)} figures")
    every = [made[place] for place in range(len(tasks))]
    return every[len(others) :], every[: len(others)]


def shown(drawn: Sequence[Drawn], svgs: Sequence[str]) -> list[dict[str, str]]:
    """Figures of a page: name, caption and SVG."""
    return [{"name": one.name, "caption": one.caption, "svg": svg} for one, svg in zip(drawn, svgs, strict=False)]


def _saved(drawn: Drawn, folder: Path, formats: Sequence[str]) -> str:
    """A figure as SVG, after writing its files."""
    svg = as_svg(drawn.figure)
    for form in formats:
        path = folder / f"{drawn.name}.{form}"
        path.write_text(svg, encoding="utf-8") if form == "svg" else save(drawn.figure, path)
    return svg


def start_of(given: str, name: str) -> str:
    """Beginning of the user's file, as far as a page has room.

    >>> start_of("title = 1", "study.toml")
    'title = 1'
    """
    if len(given) <= MOST_GIVEN:
        return given
    return f"{given[:MOST_GIVEN]}\n\n[The first {MOST_GIVEN} of {len(given)} characters; {name} has all.]"
