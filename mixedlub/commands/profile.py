"""`mixedlub profile`: parameters, moments and asperities of roughness traces and height maps."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from mixedlub.commands.console import note, print_findings
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.report.surface_rows import SURFACE_COLUMNS, summary, surface_table
from mixedlub.running.origin import origin_of_file
from mixedlub.schema.findings import finding
from mixedlub.schema.result import Drawing, Result
from profiles.errors import InputError

if TYPE_CHECKING:
    from profiles import Profile
    from profiles.maps import HeightMap
    from roughness.maps.surface import EvaluatedMap

NAME = "profile"
EXAMPLE = "mixedlub profile shipped:0258 --out out/profile"

Record = Mapping[str, Any]


@delivers(NAME)
def command(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE...",
            help="Traces or height maps, each also .gz; shipped:NAME; or Ra:0.4um, Rq:... or Rz:... where only that "
            "number is known.",
        ),
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
    holes: Annotated[
        str, typer.Option(metavar="NAME", help="Points of a map without a height: mask (left out) or fill.")
    ] = "mask",
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
        typer.Option(
            metavar="LENGTH",
            help="Step of the heights of a trace or map, as '0.5 um'; overrules a trace's own, and says so.",
        ),
    ] = None,
) -> None:
    """Parameters, moments and asperities of traces and height maps.

    ISO parameters, spectral moments, asperities and Gaussian verdict, with figures; of a map also the areal parameters,
    lay, and traces across and along it. Several surfaces share one table and one figure.
    """
    from roughness.assumed import assumed_record, one_number

    options = Options(
        form=form,
        cutoff="auto" if cutoff_mm is None else cutoff_mm * 1e-3,
        short_cutoff="auto" if short_cutoff_um is None else short_cutoff_um * 1e-6,
        method=method,
        outliers=outliers,
        trim_cutoffs=trim,
        edges=edges,
        convention=convention,
        holes=holes,
    )
    done: list[Surface] = []
    wrong: list[InputError] = []
    told_already: set[str] = set()
    for file in files:
        try:
            if (known := one_number(str(file))) is not None:
                done.append(Surface(file, {**assumed_record(*known), "file": str(file), "kind": "assumed"}))
                continue
            with named_options():
                read = _read(file, unit, spacing)
                told_already |= set(_tell(file, read))
            with named_options(file, read):
                done.append(_evaluated(file, read, options))
        except InputError as error:
            if error.where.removeprefix("--") in OPTIONS:
                raise
            wrong.append(error)
    if not done:
        raise _together(wrong)
    files = [one.file for one in done]
    records = [one.record for one in done]
    contents = [file.read_bytes() if file.is_file() else b"" for file in files[1:]]
    tables = {TABLE: surface_table(records)}
    to = how.open(_stem(files[0]), origin_of_file(files[0], files[1:], contents), tables, "trace", "profile.json")
    notes = (f"{record['file']}: {text}" for record in records for text in record["warnings"])
    result = Result(
        "Surfaces",
        tables,
        _figures(done),
        tuple(line for record in records for line in summary(record)),
        tuple(text for text in notes if text not in told_already),
        files={"profile.json": json.dumps(records, indent=1) + "\n", **_cut_traces(done)},
        columns={TABLE: SURFACE_COLUMNS},
    )
    drawings = to.folder / "figures"
    if not how.figures and drawings.exists():
        note(f"{drawings} is of an earlier run; without --no-figures it is drawn anew")
    written = f"details in {to.folder / 'profile.json'}, one row a surface in {to.folder / TABLE}.csv"
    deliver(result, to, written=written, drawings=f", figures in {drawings}" if result.figures else "")
    if wrong:
        raise _together(wrong, len(done))


TABLE = "surfaces"


@dataclass(frozen=True)
class Options:
    """Options of the evaluation, with lengths in m."""

    form: str
    cutoff: float | str
    short_cutoff: float | str
    method: str
    outliers: float | None
    trim_cutoffs: float
    edges: bool
    convention: str | None
    holes: str

    @property
    def of_trace(self) -> dict[str, Any]:
        """Keywords of `roughness.trace_record`."""
        return {name: value for name, value in vars(self).items() if name != "holes"}


@dataclass(frozen=True)
class Surface:
    """An evaluated surface: its file, its row of ``profile.json``, its trace as read and evaluated, and its map."""

    file: Path
    record: dict[str, Any]
    trace: Profile | None = None
    profile: Profile | None = None
    area: EvaluatedMap | None = None


def _read(file: Path, unit: str | None, spacing: str | None) -> Profile | HeightMap:
    from profiles import SHIPPED_MARK, shipped
    from profiles.maps import read_any

    if str(file).startswith(SHIPPED_MARK):
        return shipped(str(file), "FILE")
    return read_any(file, unit=unit, spacing=spacing)


def _tell(file: Path, read: Profile | HeightMap) -> Iterator[str]:
    """Print doubts about units and steps before the evaluation, which may fail for them."""
    from roughness.guards import overruled

    for text in overruled(read):
        note(f"{file}: {text}")
        yield f"{file}: {text}"
    if text := str(read.origin.get("units_doubtful", "")):
        print_findings([finding("value_unusual", text, str(file))])
        yield f"{file}: {text}"


def _evaluated(file: Path, read: Profile | HeightMap, options: Options) -> Surface:
    from profiles import Profile
    from roughness import trace_record
    from roughness.maps.surface import evaluated_map

    if isinstance(read, Profile):
        profile, record = trace_record(read, **options.of_trace)
        return Surface(file, {**record, "file": str(file), "kind": "trace"}, read, profile)
    area = evaluated_map(read, **vars(options))
    return Surface(file, {**area.record, "file": str(file), "kind": "map"}, area.trace, area.profile, area)


def _together(wrong: list[InputError], done: int = 0) -> InputError:
    """Error naming all files that cannot be evaluated, and the number of evaluated files."""
    first, *others = wrong
    rule = "; and ".join((first.rule, "; ".join(str(error) for error in others))) if others else first.rule
    left = f" ({done} other file{'s' * (done > 1)} evaluated)" if done else ""
    return InputError(f"{rule}{left}", where=first.where, value=first.value)


OPTIONS = ("unit", "spacing", "form", "method", "convention", "holes")


@contextmanager
def named_options(file: Path | None = None, read: Profile | HeightMap | None = None) -> Iterator[None]:
    """Context for errors of an option, trace or map, reported by the name on the command line."""
    try:
        yield
    except InputError as error:
        place = f"--{error.where}" if error.where in OPTIONS else error.where
        if read is not None:
            for kind in ("profile", "map"):
                place = place.replace(f"{kind} {read.name!r}", str(file))
        rule = error.rule.replace("as unit '", "as --unit '").replace("as spacing '", "as --spacing '")
        raise InputError(rule, where=place, value=error.value) from None


def _stem(file: Path) -> str:
    """Name of the results of a surface."""
    from roughness.assumed import one_number

    if one_number(str(file)):
        return str(file).replace(":", "_").replace(" ", "")
    bare = file.with_suffix("") if file.suffix.lower() == ".gz" else file
    return bare.stem.rpartition(":")[2] if bare.stem.startswith("shipped:") else bare.stem.replace(":", "_")


def _names(done: list[Surface]) -> list[str]:
    """Names of the results by surface, numbered where they would be alike."""
    names = [_stem(one.file) for one in done]
    return [name if names.count(name) == 1 else f"{name}_{number}" for number, name in enumerate(names, start=1)]


def _cut_traces(done: list[Surface]) -> dict[str, str]:
    """Traces of the maps across and along their lay as files that this command and studies read."""
    files = {}
    for one, name in zip(done, _names(done)):
        for which, trace in ({} if one.area is None else one.area.traces).items():
            rows = np.column_stack((trace.positions * 1e6, np.where(trace.valid, trace.heights * 1e6, np.nan)))
            lines = (f"{x:.10g},{z:.10g}" for x, z in rows)
            files[f"{name}_{which}.csv"] = "\n".join(("x_um,z_um", *lines)) + "\n"
    return files


def _figures(done: list[Surface]) -> dict[str, Drawing]:
    from roughness import plots
    from roughness.comparison import comparison_figure
    from roughness.maps import plots as map_plots
    from roughness.record import rules_of_the_file

    drawn: dict[str, Drawing] = {}
    names = _names(done)
    for one, stem in zip(done, names):
        if one.area is not None:
            drawn[f"{stem}_map"] = partial(map_plots.map_figure, one.area.area, one.area.angles)
            drawn[f"{stem}_texture"] = partial(map_plots.texture_figure, one.area.area)
            drawn[f"{stem}_material"] = partial(map_plots.material_figure, one.area.area)
        if one.profile is None or one.trace is None:
            continue
        rule, (_, sections) = one.record["parameters"]["convention"], rules_of_the_file(one.profile, one.trace)
        drawn[f"{stem}_trace"] = partial(plots.trace_figure, one.profile, convention=rule, sections=sections)
        drawn[f"{stem}_probability"] = partial(plots.probability_figure, one.profile)
        drawn[f"{stem}_abbott"] = partial(plots.abbott_figure, one.profile, convention=rule, sections=sections)
        drawn[f"{stem}_spectrum"] = partial(plots.spectrum_figure, one.profile)
    shown = [(one.profile, stem) for one, stem in zip(done, names) if one.profile is not None]
    if len(shown) > 1:
        profiles, labels = zip(*shown)
        drawn["compared"] = partial(comparison_figure, profiles, labels)
    return drawn
