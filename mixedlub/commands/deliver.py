"""Delivery of a result: options, folder, tables before figures, and messages."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import wraps
from pathlib import Path
from typing import Annotated, Any, get_type_hints

import typer

from mixedlub.commands.console import (
    busy,
    echo,
    fail,
    is_full,
    named_folder,
    note,
    output_folder,
    print_findings,
    save_traceback,
    tables_written,
)
from mixedlub.running.atomic import clear_parts, fill, is_own, writing
from mixedlub.running.origin import FIGURES, Origin, as_left
from mixedlub.schema.findings import Finding, listed
from mixedlub.schema.result import Result
from mixedlub.schema.table_files import STYLES, LongTable, write_frame, write_long, write_workbook
from profiles.errors import InputError, nearest

FORMATS = ("svg", "pdf", "png")
"""Formats of a figure's file."""
CASE = "case"
"""Folder of a result that `mixedlub diagnose` reads."""
WORKBOOK = "results.xlsx"
Page = Callable[[Path, Callable[[str], None]], Iterable[Finding]]
"""Function that draws a page and its figures into a folder; the callback receives its next step."""


@dataclass(frozen=True)
class How:
    """Options of every command that writes a result."""

    command: str
    out: Path | None
    replace: bool
    figures: bool
    formats: tuple[str, ...]
    xlsx: bool
    csv_style: str

    def open(self, name: str, origin: Origin, tables: Iterable[str], what: str = "file", *files: str) -> Delivery:
        """Open the result folder of an input; raise an error if it contains tables or files of another origin."""
        to = Delivery(output_folder(self.out, self.command, name, knows_own=True), origin, what, self)
        earlier = to.check([*to.names(tables), *files])
        if earlier:
            note(earlier)
        return to


OPTIONS: dict[str, tuple[Any, Any]] = {
    "replace": (
        Annotated[bool, typer.Option("--replace", help="Replace the result of another input, or other files, there.")],
        False,
    ),
    "figures": (Annotated[bool, typer.Option("--figures/--no-figures", help="Figures, or only the tables.")], True),
    "format_": (
        Annotated[
            str,
            typer.Option(
                "--format", metavar="LIST", help="Formats of the figures: svg, pdf, png, with commas between."
            ),
        ],
        "svg",
    ),
    "xlsx": (Annotated[bool, typer.Option("--xlsx", help=f"Also {WORKBOOK}: a sheet a table, with units.")], False),
    "csv_style": (
        Annotated[
            str,
            typer.Option(
                metavar="NAME", help="CSV: plain (comma, decimal point) or german (semicolon, decimal comma)."
            ),
        ],
        "plain",
    ),
}


def delivers(command: str, *without: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Decorator of a command with a last argument ``how`` for the options of a result, some left out."""
    folder = typer.Option(
        metavar="DIR", parser=named_folder, help=f"Folder for the results; default out/{command}/NAME."
    )
    options = {"out": (Annotated[Path | None, folder], None)}
    options |= {name: one for name, one in OPTIONS.items() if name not in without}

    def decorated(function: Callable[..., None]) -> Callable[..., None]:
        @wraps(function)
        def with_options(**given: Any) -> None:
            chosen = {name: given.pop(name, default) for name, (_, default) in (options | OPTIONS).items()}
            formats = chosen_formats(chosen.pop("format_"))
            if chosen["csv_style"] not in STYLES:
                rule = f"no such style; {nearest(chosen['csv_style'], STYLES)}"
                raise InputError(rule, where="--csv-style", value=chosen["csv_style"])
            function(**given, how=How(command, formats=formats, **chosen))

        hints = get_type_hints(function, include_extras=True)
        own = inspect.signature(function).parameters.values()
        kept = [one.replace(annotation=hints[one.name]) for one in own if one.name != "how"]
        added = [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)
            for name, (annotation, default) in options.items()
        ]
        parameters = [one.replace(kind=inspect.Parameter.KEYWORD_ONLY) for one in (*kept, *added)]
        with_options.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        with_options.__annotations__ = {one.name: one.annotation for one in parameters}
        return with_options

    return decorated


def chosen_formats(text: str) -> tuple[str, ...]:
    """Formats named in a comma-separated list."""
    names = tuple(dict.fromkeys(name.strip().lower() for name in text.split(",")))
    for name in names:
        if name not in FORMATS:
            raise InputError(f"no such format; {nearest(name, FORMATS)}", where="--format", value=name)
    return names


@dataclass(frozen=True)
class Delivery:
    """Folder of a result, and its input."""

    folder: Path
    origin: Origin
    what: str
    how: How
    written: set[str] = field(default_factory=set)

    @contextmanager
    def publishing(self) -> Iterator[Path]:
        """A folder for writing; its files then replace the files of an earlier run, and their origin is recorded."""
        with writing(self.folder) as aside:
            yield aside
            self.written.update(path.relative_to(aside).as_posix() for path in aside.rglob("*"))
            self.origin.write_record(aside, self.folder, as_left(self.folder))

    def names(self, tables: Iterable[str]) -> list[str]:
        """The files of tables."""
        files = [f"{table}.{ending}" for table in tables for ending in ("csv", "parquet")]
        return [*files, WORKBOOK] if self.how.xlsx else files

    def check(self, names: Sequence[str], figures: Iterable[str] = ()) -> str:
        """Raise an error for existing files of another origin; return a note for an earlier state of the input."""
        if self.how.replace:
            return ""
        drawn = [f"{FIGURES}/{name}.{form}" for name in figures for form in self.how.formats]
        foreign = [name for name in drawn if (self.folder / name).exists() and not is_own(self.folder / name)]
        return self.origin.check_folder(self.folder, [*names, *foreign], self.what)


def deliver(result: Result, to: Delivery, *, page: Page | None = None, written: str = "", drawings: str = "") -> None:
    """Write the tables of a result, then draw it; a failing figure leaves the tables, with status 1.

    ``written``: last line for the user. ``drawings``: its end if all was drawn.
    """
    how, folder = to.how, to.folder
    for text in result.notes:
        note(text)
    case = () if result.case is None else (CASE,)
    to.check([*to.names(result.tables), *result.files, *case], result.figures if how.figures else ())
    if other := _other_style(result, to):
        note(other)
    with to.publishing() as aside:
        _write_tables(result, how, aside)
        fill(result.files, aside)
        if result.case is not None:
            from mixedlub.importers.case_writer import write_case

            write_case(aside / CASE, result.case.system, result.case.columns, attachments=result.case.attachments)
    clear_parts(folder)
    tables_written()
    drawn = not how.figures or _drawn(result, to, page)
    others = sorted(set(as_left(folder)) - to.written)
    if WORKBOOK in others:  # its sheets are tables of an earlier run
        others.remove(WORKBOOK)
        (folder / WORKBOOK).unlink()
        note(f"{folder / WORKBOOK} of an earlier run was removed; --xlsx writes it anew")
    if others:
        note(f"of an earlier run, in {folder}: {listed(others)}")
    for line in result.lines:
        echo(line)
    last = written or f"results in {folder / next(iter(to.names(result.tables)), '')}"
    echo(last + (drawings if how.figures and drawn else ""))
    if not drawn:
        raise typer.Exit(1)


def _other_style(result: Result, to: Delivery) -> str:
    """Note on the other style of the CSV files that are replaced; empty if there are none."""
    own = STYLES[to.how.csv_style].separator
    for path in (to.folder / f"{name}.csv" for name in result.tables):
        if path.is_file():
            with path.open(encoding="utf-8", errors="replace") as file:
                marks = file.readline()
            other = next((n for n, style in STYLES.items() if style.separator != own and style.separator in marks), "")
            if other and own not in marks:
                return f"{path} of an earlier run has the style {other} and is replaced; --csv-style {other} keeps it"
    return ""


def _write_tables(result: Result, how: How, aside: Path) -> None:
    style = STYLES[how.csv_style]
    columns = {
        name: result.described(name, list(table.names if isinstance(table, LongTable) else map(str, table.columns)))
        for name, table in result.tables.items()
    }
    for name, table in result.tables.items():
        csv, parquet = (aside / f"{name}.{ending}" for ending in ("csv", "parquet"))
        if isinstance(table, LongTable):
            write_long(table, columns[name], csv, parquet, style)
        else:
            write_frame(table, columns[name], csv, parquet, style, result.title)
    if how.xlsx and result.tables:
        long = [name for name, table in result.tables.items() if isinstance(table, LongTable) and not table.csv]
        sheets = {name: (table, columns[name]) for name, table in result.tables.items() if name not in long}
        for name in (*long, *write_workbook(sheets, aside / WORKBOOK)):
            note(f"{name} is too long for {WORKBOOK}: the Parquet file has all of its rows")


def _drawn(result: Result, to: Delivery, page: Page | None) -> bool:
    """Draw a page, or the figures in turn; returns success, and a message on failures."""
    from mixedlub.report.style import styled

    wrong: dict[str, Exception] = {}
    findings: list[Finding] = []
    with busy("drawing") as doing, styled():
        try:
            with to.publishing() as aside:
                if page is not None:
                    findings = list(page(aside, doing))
                else:
                    wrong = _figures(result, to, aside, doing)
        except Exception as error:
            if isinstance(error, OSError) and is_full(error):
                raise
            wrong = {"page": error}
    print_findings(findings)
    for name, reason in wrong.items():
        place = f"{save_traceback(reason)}; the tables are in {to.folder}"
        fail(f"{name} is not drawn: {_reason(reason)}; {place}")
    return not wrong


def _figures(result: Result, to: Delivery, aside: Path, doing: Callable[[str], None]) -> dict[str, Exception]:
    """Draw the figures into a folder; returns errors by name."""
    from mixedlub.report.panels import panel_figure
    from mixedlub.report.style import save

    wrong: dict[str, Exception] = {}
    folder = aside / FIGURES
    folder.mkdir()
    for place, (name, drawing) in enumerate(result.figures.items(), start=1):
        doing(f"drawing figure {place} of {len(result.figures)}: {name}")
        try:
            figure = drawing() if callable(drawing) else panel_figure(result.title, drawing)
            if figure is not None:
                for form in to.how.formats:
                    save(figure, folder / f"{name}.{form}")
        except Exception as error:
            wrong[name] = error
    if result.captions:
        text = "\n\n".join(f"{name}\n{caption}" for name, caption in result.captions.items())
        (folder / "captions.txt").write_text(text + "\n", encoding="utf-8")
    if not any(folder.iterdir()):
        folder.rmdir()
    return wrong


def _reason(error: Exception) -> str:
    """Cause of a failed drawing as text."""
    if isinstance(error, MemoryError | BrokenProcessPool):
        return "memory ran out, or a process was ended from outside"
    return f"{type(error).__name__}: {error}".strip(": ")
