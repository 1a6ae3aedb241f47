"""`mixedlub check`: interpretation of a case folder as text."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

from mixedlub.commands.console import case_folder, echo, input_errors_from, print_findings, progress_bar, resumed
from mixedlub.schema.findings import Finding, Severity, collected, gravest_first, grouped, of_severity
from mixedlub.schema.units import unit_of
from profiles.errors import InputError

if TYPE_CHECKING:
    from mixedlub.case.folder import Case
    from mixedlub.case.forward import Forward
    from mixedlub.kinds.calibration import Calibration
    from mixedlub.schema.table import Table

NAME = "check"
EXAMPLE = "mixedlub new case --out my_case\nmixedlub check my_case"


def command(case: Annotated[Path, typer.Argument(metavar="CASE", help="Case folder with system.toml.")]) -> None:
    """Describe how a case folder was understood.

    Data present, data missing, and defaults used.
    """
    from mixedlub.case.folder import read_case
    from mixedlub.full_base.progress import building
    from mixedlub.schema.units import stated_units

    with input_errors_from(str(case)), progress_bar("full solutions") as bar, building(resumed(bar)):
        found = read_case(case_folder(case), need_recordings=False)
        with stated_units(found.kind.units):
            lines = list(understood(found))
    print_findings(found.notes)
    for line in lines:
        echo(line)


def understood(case: Case) -> Iterator[str]:
    """Lines describing a case."""
    from mixedlub.case.defaults import assumed
    from mixedlub.case.folder import unpredicted_runs

    yield f"{case.name}: a case of kind {case.system.kind}, recording {case.quantity}."
    if case.system.description:
        yield f"  Described as: {case.system.description}"
    yield f"Base model: {case.base_model}"
    yield from _flattened(case)
    with collected() as reported:
        bodies = list(_bodies(case))
        forward = _forward(case)
    found = [
        *case.notes,
        *reported,
        *(() if forward is None else forward.notes),
        *unpredicted_runs(case, case.conditions),
    ]
    yield from bodies
    if forward is None:
        yield f"Boundary friction coefficient: {case.system.boundary_friction:g}."
    elif "boundary_friction" in forward.inputs:
        yield f"Boundary friction coefficient: {np.median(forward.inputs['boundary_friction']):.3g}."
    yield from _tables(case)
    yield from _known(case, forward)
    yield from _uncertain(case, () if forward is None else forward.calibrations)
    checked, refused = _checked(case, forward)
    yield from refused
    found = list(dict.fromkeys([*found, *checked]))
    doubtful = grouped(gravest_first(of_severity(found, Severity.CAUTION, Severity.DOUBT)))
    if doubtful:
        yield "Doubtful:"
        yield from (f"  {one}." for one in doubtful)
    notes = [*grouped(of_severity(found, Severity.NOTE)), *assumed(case, forward)]
    yield "Assumed:" if notes else "Assumed: nothing beyond what the files say."
    yield from (f"  {one}" for one in notes)


def _flattened(case: Case) -> Iterator[str]:
    """Roughness of the asperities, where the case chooses it."""
    from mixedlub.schema.system_file import FLATTENING

    chosen, share = case.system.flattening, case.system.short_cutoff_over_half_width
    cutoff = "" if share is None else f"; short cut-off at {share:g} of the half-width of the contact"
    if cutoff or chosen != "none":
        yield f"Roughness of the asperities, flattening = {chosen}: {FLATTENING[chosen]}{cutoff}."


def _bodies(case: Case) -> Iterator[str]:
    from mixedlub.laws.oil import ZERO_CELSIUS

    system = case.system
    list(case.rig.parts())
    if system.gears is not None:
        pair = case.rig.gears
        share = system.gears.load_sharing
        yield (
            f"Gears: {pair.teeth[0]}/{pair.teeth[1]} teeth, module {pair.normal_module * 1e3:.4g} mm, contact ratio "
            f"{pair.contact_ratio:.3f}, load shared by "
            f"{f'the table {share.table}' if share.table else f'the {share.model} model'}."
        )
    if system.contact is not None:
        radii = " and ".join(f"{r:g}" for r in system.contact.radius_mm)
        crowns = system.contact.transverse_radius_mm
        across = "" if crowns is None else f" along and {' and '.join(f'{r:g}' for r in crowns)} mm across the motion"
        yield f"Contact: {system.contact.geometry} contact of radii {radii} mm{across}."
    if "lubricant" in case.kind.sections or system.lubricant is not None:
        oil = case.rig.oil()
        low, high = (t - ZERO_CELSIUS for t in oil.temperature)
        eta = oil.viscosity(np.array(oil.temperature)) * 1e3
        yield f"Oil: {oil.name}, {eta[0]:.3g} mPa s at {low:g} C and {eta[1]:.3g} mPa s at {high:g} C."
    for name, section in system.surfaces.items():
        surface = case.rig.surface(name)
        named = section.map or ", ".join(section.files)
        kind = "map" if section.map else "trace" if len(section.files) == 1 else "traces"
        origin = f"the {kind} {named}" if named else "its moments"
        coated = f", coated with {section.coating.name}" if section.coating else ""
        yield (
            f"Surface {name}: Rq {np.sqrt(surface.m0) * 1e6:.3g} um, Nayak bandwidth "
            f"{surface.m0 * surface.m4 / surface.m2**2:.3g}, from {origin}{coated}."
        )


def _known(case: Case, forward: Forward | None) -> Iterator[str]:
    """Effects and calibration named by the case."""
    for effect, values in ({} if forward is None else forward.known.values).items():
        yield f"Part of the base model here: {effect.replace('_', ' ')} ({_named(values)})."
    for name in case.hypotheses:
        yield f"Your hypothesis beside the catalogue: {name.replace('_', ' ')} ({case.laws[name].summary})"
    if case.system.calibration:
        yield f"Simulated at the calibration {_named(case.system.calibration)}."


def _named(values: Mapping[str, float]) -> str:
    return ", ".join(f"{name} {value:.4g}" for name, value in values.items())


def _tables(case: Case) -> Iterator[str]:
    from mixedlub.case.folder import other_recordings

    for name, table in (("recordings.csv", case.recordings), ("conditions.csv", case.conditions)):
        if table is None:
            without = f"nothing can be diagnosed without it{other_recordings(case.folder)}"
            without = without if name == "recordings.csv" else "only recorded rows are predicted"
            yield f"{name}: missing; {without}."
            continue
        yield f"{name}: {len(table)} {'row' if len(table) == 1 else 'rows'}."
        yield from (f"  {column}: {_levels(table, column)}" for column in table.columns if column != "run")


def _levels(table: Table, column: str) -> str:
    values, counts = np.unique(table[column], return_counts=True)
    if values.dtype.kind in "US":
        return ", ".join(f"{v} ({c})" for v, c in zip(values, counts, strict=True))
    if values.size <= 8:
        return ", ".join(f"{v:g}" for v in values)
    return f"{values[0]:g} to {values[-1]:g}"


def _uncertain(case: Case, movable: Sequence[Calibration]) -> Iterator[str]:
    stated = case.system.uncertainty.stated
    if case.kind.by_case is not None:
        stated = {name: sd for name, sd in stated.items() if name in {c.name for c in movable}}
    stated |= _stated_of_effects(case)
    words = ", ".join(f"{k.replace('_', ' ')} ({v:g})" for k, v in stated.items())
    others = [c for c in movable if c.name not in stated]
    nothing = "nothing" if others else "nothing; all inputs count as known"
    yield f"May be calibrated, with its standard deviation: {words or nothing}."
    if others:
        yield "Not known, so fitted with a broad prior:"
        for c in others:
            low, high = c.parameter.typical
            unit = "" if c.parameter.unit == "-" else f" {c.parameter.unit}"
            yield f"  {c.name.replace('_', ' ')}: 80 % within {low:.3g} to {high:.3g}{unit} ({c.parameter.meaning})"
    noise = case.system.recording.noise
    own = f"{case.quantity}_sd"
    if case.recordings is not None and own in case.recordings:
        yield f"Noise of a reading: the column {own}."
    elif noise is None or not noise.of_single:
        yield "Noise of a reading: not given; it would be estimated from repeats, else from the fit."
    else:
        yield f"Noise of a reading: {_scatter(noise.relative, noise.absolute, case)}."
    if noise is not None and noise.of_setups:
        yield f"Shared within a set-up: {_scatter(noise.setup_relative, noise.setup_absolute, case)}."


def _stated_of_effects(case: Case) -> dict[str, float]:
    """Standard deviations of the parameters of known effects, by the names of their calibration."""
    from mixedlub.effects import SD

    each = ((f"{e}.{key}", value) for e, own in case.system.effects.items() for key, value in own.items())
    return {name.removesuffix(SD): value for name, value in each if name.endswith(SD) and value > 0}


def _scatter(relative: float, absolute: float, case: Case) -> str:
    """Absolute and relative part of a standard deviation, with the unit of the reading."""
    return f"{relative:g} of its value and {f'{absolute:g} {unit_of(case.quantity)}'.rstrip()}"


def _checked(case: Case, forward: Forward | None) -> tuple[list[Finding], list[str]]:
    """Findings on the system and readings, and the errors that prevent diagnosis or prediction."""
    from mixedlub.case.forward import Forward
    from mixedlub.case.validity import judge_rows
    from mixedlub.data_checks.audit import check_readings
    from mixedlub.data_checks.pooled_rows import pooled_in
    from mixedlub.diagnosis.assessment.extrapolation import beyond_recorded
    from mixedlub.rig.plausibility import implausible

    found, refused = list(implausible(case.rig)), []
    if case.recordings is not None and forward is not None:
        readings = np.asarray(case.recordings[case.quantity], dtype=float)
        try:
            found += check_readings(case, case.recordings, readings, forward)
            found += judge_rows(forward).findings
        except InputError as error:
            refused.append(f"Cannot be diagnosed: {error}.")
    if case.recordings is not None and case.recordings.ignored:
        found += pooled_in(case.folder / "recordings.csv", case.recordings, case.quantity)
    if case.conditions is not None:
        try:
            conditioned = Forward(case, case.conditions)
            conditioned.base_prediction()
            found += judge_rows(conditioned).findings
        except InputError as error:
            refused.append(f"Cannot be predicted: {error}.")
    return [*found, *beyond_recorded(case, case.conditions)], refused


def _forward(case: Case) -> Forward | None:
    """Forward model of the recordings, or else of the conditions."""
    from mixedlub.case.forward import Forward

    table = case.recordings if case.recordings is not None else case.conditions
    return None if table is None else Forward(case, table)
