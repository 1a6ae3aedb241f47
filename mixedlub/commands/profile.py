"""`mixedlub profile`: parameters, moments and asperities of roughness traces."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mixedlub.chain.effect import entry
from mixedlub.commands.console import note, print_findings
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.running.origin import origin_of_file
from mixedlub.schema.findings import finding
from mixedlub.schema.result import Drawing, Result
from profiles.errors import InputError

if TYPE_CHECKING:
    from profiles import Profile

NAME = "profile"
EXAMPLE = "mixedlub profile shipped:0258 --out out/profile"

Record = Mapping[str, Any]


@delivers(NAME, "xlsx", "csv_style")
def command(
    files: Annotated[
        list[Path],
        typer.Argument(metavar="FILE...", help="Traces or height maps, each also .gz, or shipped:NAME."),
    ],
    how: How,
    form: Annotated[
        str,
        typer.Option(
            metavar="FORM", help="Form to remove: none, mean, line, polynomial-N, circle, involute-BASE_RADIUS_MM."
        ),
    ] = "line",
    cutoff_mm: Annotated[
        float | None, typer.Option(metavar="MM", min=1e-6, help="Long cut-off; default by ISO 4288.")
    ] = None,
    short_cutoff_um: Annotated[
        float | None, typer.Option(metavar="UM", min=1e-6, help="Short cut-off; default by ISO 3274.")
    ] = None,
    method: Annotated[
        str, typer.Option(metavar="NAME", help="Filter of the long cut-off: gaussian, robust, spline.")
    ] = "gaussian",
    outliers: Annotated[
        float | None,
        typer.Option(metavar="SIGMAS", min=1.0, help="Mask spikes and pits further off than so many robust sigmas."),
    ] = None,
    edges: Annotated[
        bool,
        typer.Option("--edges/--no-edges", help="Cut chamfers and falling ends of the part off the trace, or not."),
    ] = True,
    trim: Annotated[
        float,
        typer.Option(metavar="CUTOFFS", min=0.0, help="Cut-offs to cut off each end afterwards; instruments cut 0.5."),
    ] = 0.0,
    convention: Annotated[
        str | None,
        typer.Option(
            metavar="NAME",
            help="'ISO 4287:1997', 'ISO 21920-2:2021', NIST, Mitutoyo; default the file's, else the first.",
        ),
    ] = None,
    unit: Annotated[
        str | None, typer.Option(metavar="UNIT", help="Unit of plain numbers, as um or 'mm, um' (place, height).")
    ] = None,
    spacing: Annotated[
        str | None,
        typer.Option(metavar="LENGTH", help="Step of the heights, as '0.5 um'; overrules the file's, and says so."),
    ] = None,
) -> None:
    """Parameters, moments and asperities of traces.

    ISO parameters, spectral moments, asperities and Gaussian verdict, with figures.
    """
    from roughness import trace_record
    from roughness.guards import overruled
    from roughness.over_cutoffs import trace_of

    done: list[tuple[Path, Profile, Profile, Record]] = []
    wrong: list[InputError] = []
    told_already: set[str] = set()
    for file in files:
        try:
            with named_options():
                trace = trace_of(file, unit, spacing)
                for text in overruled(trace):
                    note(f"{file}: {text}")
                    told_already.add(f"{file}: {text}")
                if text := str(trace.origin.get("units_doubtful", "")):
                    print_findings([finding("value_unusual", text, str(file))])
                    told_already.add(f"{file}: {text}")
            with named_options(file, trace):
                evaluated = trace_record(
                    trace,
                    form=form,
                    cutoff="auto" if cutoff_mm is None else cutoff_mm * 1e-3,
                    short_cutoff="auto" if short_cutoff_um is None else short_cutoff_um * 1e-6,
                    method=method,
                    outliers=outliers,
                    trim_cutoffs=trim,
                    edges=edges,
                    convention=convention,
                )
            done.append((file, trace, *evaluated))
        except InputError as error:
            if error.where.removeprefix("--") in OPTIONS:
                raise
            wrong.append(error)
    if not done:
        raise _together(wrong)
    files, traces = [file for file, *_ in done], [trace for _, trace, *_ in done]
    records: list[dict[str, Any]] = [{**record, "file": str(file)} for file, *_, record in done]
    contents = [file.read_bytes() if file.is_file() else b"" for file in files[1:]]
    to = how.open(_stem(files[0]), origin_of_file(files[0], files[1:], contents), (), "trace", "profile.json")
    notes = (f"{record['file']}: {text}" for record in records for text in record["warnings"])
    result = Result(
        "Traces",
        {},
        _figures([_stem(file) for file in files], traces, [profile for *_, profile, _ in done], records),
        tuple(line for record in records for line in summary(record)),
        tuple(text for text in notes if text not in told_already),
        files={"profile.json": json.dumps(records, indent=1) + "\n"},
    )
    drawings = to.folder / "figures"
    if not how.figures and drawings.exists():
        note(f"{drawings} is of an earlier run; without --no-figures it is drawn anew")
    written = f"details in {to.folder / 'profile.json'}"
    deliver(result, to, written=written, drawings=f", figures in {drawings}")
    if wrong:
        raise _together(wrong, len(done))


def _together(wrong: list[InputError], done: int = 0) -> InputError:
    """Error naming all files that cannot be evaluated, and the number of evaluated files."""
    first, *others = wrong
    rule = "; and ".join((first.rule, "; ".join(str(error) for error in others))) if others else first.rule
    left = f" ({done} other file{'s' * (done > 1)} evaluated)" if done else ""
    return InputError(f"{rule}{left}", where=first.where, value=first.value)


OPTIONS = ("unit", "spacing", "form", "method", "convention")


@contextmanager
def named_options(file: Path | None = None, trace: Profile | None = None) -> Iterator[None]:
    """Context for errors of an option or trace, reported by the name on the command line."""
    try:
        yield
    except InputError as error:
        place = f"--{error.where}" if error.where in OPTIONS else error.where
        if trace is not None:
            place = place.replace(f"profile {trace.name!r}", str(file))
        rule = error.rule.replace("as unit '", "as --unit '").replace("as spacing '", "as --spacing '")
        raise InputError(rule, where=place, value=error.value) from None


def _stem(file: Path) -> str:
    """Name of the results of a trace."""
    bare = file.with_suffix("") if file.suffix.lower() == ".gz" else file
    return bare.stem.rpartition(":")[2]


def summary(record: Record) -> Iterator[str]:
    """Summary of a trace in lines that fit a terminal."""
    p, m, a, g = (record[key] for key in ("parameters", "moments", "asperities", "gaussian"))
    yield str(record["file"])
    yield _entry("steps", "; ".join(record["steps"]) or "none: evaluated as read")
    yield _entry("by", f"{p['convention']}, sampling lengths: {p['sections']}")
    yield _entry("heights", ", ".join(f"{name} {_number(p[key], 5)}{unit}" for name, key, unit in _HEIGHTS))
    yield _entry(
        "moments", f"m0 {_number(m['m0_um2'])} um2, m2 {_number(m['m2'])}, m4 {_number(m['m4_per_um2'])} 1/um2"
    )
    yield _entry(
        "asperities",
        f"{_number(a['density_per_mm2'])} per mm2, radius {_number(a['radius_um'])} um, "
        f"sigma {_number(a['sigma_um'])} um, Nayak alpha {_number(a['nayak'])}",
    )
    for row in a["short_cutoff_band"]:
        if row["short_cutoff_um"] != m["short_cutoff_um"]:
            yield _entry(
                "",
                f"at short cut-off {_number(row['short_cutoff_um'])} um: m2 {_number(row['m2'])}, "
                f"m4 {_number(row['m4_per_um2'])} 1/um2, {_number(row['density_per_mm2'])} per mm2, "
                f"radius {_number(row['radius_um'])} um",
            )
    yield _entry("Gaussian?", g.get("words", "cannot be judged, so not taken as Gaussian"))


def _entry(name: str, text: str) -> str:
    """A name and its text, wrapped."""
    return entry(f"  {name}", text, _INDENT)


_INDENT = 13
_HEIGHTS = (
    *((name, f"{name}_um", " um") for name in ("Ra", "Rq", "Rz")),
    *((name, name, "") for name in ("Rsk", "Rku", "Rdq")),
)


def _number(value: float | None, digits: int = 4) -> str:
    return "-" if value is None else f"{value:.{digits}g}"


def _figures(
    names: list[str], traces: list[Profile], profiles: list[Profile], records: list[dict[str, Any]]
) -> dict[str, Drawing]:
    from roughness import plots
    from roughness.record import rules_of_the_file

    drawn: dict[str, Drawing] = {}
    for number, (name, trace, profile, record) in enumerate(zip(names, traces, profiles, records), start=1):
        stem = name if names.count(name) == 1 else f"{name}_{number}"
        rule, (_, sections) = record["parameters"]["convention"], rules_of_the_file(profile, trace)
        drawn[f"{stem}_trace"] = partial(plots.trace_figure, profile, convention=rule, sections=sections)
        drawn[f"{stem}_probability"] = partial(plots.probability_figure, profile)
        drawn[f"{stem}_abbott"] = partial(plots.abbott_figure, profile, convention=rule, sections=sections)
        drawn[f"{stem}_spectrum"] = partial(plots.spectrum_figure, profile)
    return drawn
