"""Any reading against the user's own simulation of it, given row by row."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations_with_replacement
from typing import Any

import numpy as np

from mixedlub.chain.effect import Parameter
from mixedlub.chain.priors import LogNormal, Normal
from mixedlub.kinds import columns, disc, film, friction_history, friction_map, gear_pair, mesh_friction, viscosity
from mixedlub.kinds.between_rows import interpolated
from mixedlub.kinds.calibration import Calibration
from mixedlub.kinds.kind import Inputs, Kind
from mixedlub.kinds.simulated_readings import SIMULATED, Place, place_of
from mixedlub.kinds.standard import StandardRig
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.findings import finding, report
from mixedlub.schema.table import BOOKKEEPING, RUN, Column, Table
from mixedlub.schema.units import tidy, unit_of
from profiles.errors import InputError, nearest

MOVED = f"{SIMULATED}_"
"""Start of the columns with an input of the simulation one standard deviation up."""
MODULES = (gear_pair, mesh_friction, disc, film, friction_history, friction_map, viscosity)
KNOWN = {c.name: replace(c, above=-np.inf) for one in reversed(MODULES) for c in one.KIND.columns}
"""Columns of the other kinds, which need no section; of either sign where the kind of the reading sets no bound."""
READINGS = {c.name: c for one in MODULES for c in one.KIND.readings}
RESULTS = ("base", "calibrated", "predicted", "low90", "high90", "mismatch_z", "validity", "surfaces")
"""Names of columns in results."""
NO_UNIT = "-"
ANY_CHANNEL = film.KIND.name
"""Kind whose faults of the channel apply to readings that no other kind has; its own effects lack their inputs."""
RESPONSE = "response"
"""Start of the names of second-order responses."""
SECOND_ORDER = 3e-3
"""Judgement. Largest product of two relative responses that no rig resolves."""
SMALLEST_SHARE = 0.1
"""Judgement. Smallest simulated reading over their median to which a response is related."""
NOMINAL = "nominal_simulation"
"""Input of the chain: the simulation before calibration."""


def of_case(system: system_file.System, headers: Sequence[str]) -> Kind:
    """The kind of a case: conditions of its sections and headers, its reading, and the place of the reading."""
    quantity = system.recording.quantity
    _refuse_reserved(system, quantity)
    place = place_of(quantity, {*headers, *system.conditions})
    found = KIND if place.kind is None else place.kind
    known = {**KNOWN, **({} if place.kind is None else {c.name: c for c in found.columns})}
    declared = {name: _condition(name, one, known.get(name)) for name, one in system.conditions.items()}
    own = {name: replace(c, required=False) for name, c in known.items() if name in headers and name != quantity}
    reading = READINGS.get(quantity) or Column(quantity, meaning="reading", words=())
    unit: str | None = getattr(system.recording, "unit", None)
    _refuse_other_unit(quantity, unit, "recording.unit")
    above = 0.0 if found.logarithmic else -np.inf
    inputs = [Column(f"{MOVED}{name}", above=above, required=False) for name in system.uncertainty.stated]
    channels = () if place.kind is None else place.kind.instrument_channels
    stated = {quantity: unit, **{name: one.unit for name, one in system.conditions.items()}}
    return replace(
        KIND,
        readings=(reading,),
        columns=tuple({**own, **declared}.values()),
        instrument_channels=(replace(KIND.instrument_channels[0], above=above), *inputs, *channels),
        chain=place.chain,
        inputs=_inputs_at(place, found.scale),
        extra_calibration=_calibration_at(place, found.logarithmic),
        instrument_fault=found.instrument_fault,
        logarithmic=found.logarithmic,
        part_rigs=gear_pair.KIND.part_rigs if found is gear_pair.KIND else (),
        scale=found.scale,
        direction=found.direction,
        is_history=found.is_history,
        filled=(SIMULATED, *(c.name for c in inputs)),
        effects_of=ANY_CHANNEL if place.kind is None else place.kind.name,
        signed=place.kind is None,
        units={name: unit for name, unit in stated.items() if unit and unit != NO_UNIT},
    )


def _condition(name: str, section: system_file.Condition, known: Column | None) -> Column:
    """Column of a condition: a number with a unit, or a name."""
    _refuse_other_unit(name, section.unit, f"conditions.{name}.unit")
    is_number = section.unit is not None or bool(unit_of(name))
    found = known or Column(name, "number" if is_number else "name")
    return replace(found, required=True, meaning=section.meaning or found.meaning)


def _refuse_reserved(system: system_file.System, quantity: str) -> None:
    """Raise an error for a condition with the name of another column of the tables or the results."""
    reserved = (*(c.name for c in (RUN, *BOOKKEEPING)), SIMULATED, quantity, f"{quantity}_sd", *RESULTS)
    for name in system.conditions:
        if name in reserved or name.startswith(MOVED):
            rule = f"is the name of another column of the tables or results; call the condition {name}_of_rig, say"
            raise InputError(rule, where=f"conditions.{name}", value=name)
    if quantity in (*(c.name for c in (RUN, *BOOKKEEPING)), SIMULATED, *RESULTS) or quantity.startswith(MOVED):
        rule = f"is the name of another column of the tables or results; call the reading {quantity}_of_rig, say"
        raise InputError(rule, where="recording.quantity", value=quantity)


def _refuse_other_unit(name: str, stated: str | None, where: str) -> None:
    """Raise an error for a unit that differs from the unit at the end of the name."""
    own = unit_of(name)
    if stated is not None and own and tidy(stated) != tidy(own):
        rule = f"the name of {name} ends in another unit, {own}; units are not converted here"
        raise InputError(rule, where=where, value=stated)


def check(system: system_file.System, table: Table, recorded: Table | None) -> None:
    """Raise an error for numbers without a unit, and for a simulation that is constant or lacks columns."""
    for name, section in system.conditions.items():
        if name in table and table[name].dtype.kind in "US" and section.unit is None and _has_numbers(table[name]):
            rule = f'numbers need a unit: [conditions.{name}] unit = "..."; "{NO_UNIT}" for a pure number'
            raise InputError(rule, where=f"{table.source}: {name}", value=str(table[name][0]))
    stated = system.uncertainty.stated
    for header in table.ignored:
        name = header.removeprefix(MOVED)
        if header.startswith(MOVED) and name not in getattr(system.uncertainty, "inputs", {}):
            hint = nearest(name, stated) if stated else "it states none"
            raise InputError(f"no such input in [uncertainty]; {hint}", where=f"{table.source}: header", value=header)
    moved = [c for c in (f"{MOVED}{name}" for name in stated) if recorded is not None and c in recorded]
    for header in moved:
        if header not in table:
            rule = f"column {header!r} is missing, which the recordings have"
            raise InputError(rule, where=f"{table.source}: header")
    if recorded is None:
        _check_recorded(table, list(stated))
        free = [name for name in table.ignored if not name.startswith(MOVED)]
        if free:
            text = f"no conditions, as no [conditions.NAME] gives their unit: {', '.join(free)}"
            report(finding("condition_undeclared", text, table.source))


def _has_numbers(cells: np.ndarray) -> bool:
    try:
        np.asarray(cells, dtype=float)
    except ValueError:
        return False
    return True


def _check_recorded(table: Table, stated: list[str]) -> None:
    if len(table) > 2 and np.ptp(table[SIMULATED]) == 0.0:
        rule = "all simulated readings are the same number; the simulation must follow the conditions"
        raise InputError(rule, where=f"{table.source}: {SIMULATED}", value=float(table[SIMULATED][0]))
    for name in stated:
        header = f"{MOVED}{name}"
        if header not in table:
            others = [one for one in table.ignored if one.startswith(MOVED)]
            hint = f"; {nearest(header, others)}" if others else ""
            text = f"[uncertainty] states {name}, but there is no column {header}, so the input counts as known{hint}"
            report(finding("simulation_derivative_missing", text, table.source))
        elif np.array_equal(table[header], table[SIMULATED]):
            text = f"equals {SIMULATED} in all rows, so the input counts as known"
            report(finding("simulation_derivative_missing", text, f"{table.source}, {header}"))


def _inputs_at(place: Place, scale: float) -> Callable[[system_file.System, Rig, Table, Table], Inputs]:
    """Function for the inputs of the chain: conditions, and the simulation in SI."""

    def inputs(system: system_file.System, rig: Rig, table: Table, recorded: Table) -> Inputs:
        found = place.inputs(system, rig, table, recorded)
        names = [SIMULATED, *(name for name in table.columns if name.startswith(MOVED))]
        simulated = {name: np.asarray(table[name], dtype=float)[:, None] / scale for name in names}
        nominal = simulated.pop(SIMULATED)
        return {**found, **simulated, NOMINAL: nominal, place.quantity(system, table): nominal}

    return inputs


def _calibration_at(place: Place, logarithmic: bool) -> Callable[[system_file.System, Table], tuple[Calibration, ...]]:
    """Function for the calibrated inputs of the simulation: those with a column in the recording."""

    def calibration(system: system_file.System, recorded: Table) -> tuple[Calibration, ...]:
        quantity = place.quantity(system, recorded)
        first = tuple(_calibrations(system, recorded, quantity, logarithmic))
        headers = [c.needs[-1] for c in first]
        return (*first, *_second_order(recorded, quantity, headers))

    return calibration


def _calibrations(
    system: system_file.System, recorded: Table, quantity: str, logarithmic: bool
) -> Iterator[Calibration]:
    """Inputs of the simulation, with a response along the difference to the column of the moved input.

    The response is a power, simulated times (moved / simulated)^z, where the input is a positive factor or readings are
    compared by their logarithm, and all simulated readings are positive; else linear, simulated + z (moved -
    simulated). z is the change of the input in standard deviations.
    """
    for name, one in getattr(system.uncertainty, "inputs", {}).items():
        header = f"{MOVED}{name}"
        if one.spread <= 0 or header not in recorded or np.array_equal(recorded[header], recorded[SIMULATED]):
            continue
        if name == "boundary_friction" and one.value is None:
            nominal, unit = system.boundary_friction, NO_UNIT
            prior: Normal | LogNormal = Normal(nominal, one.spread)
        elif one.value is None:
            nominal, unit, prior = 1.0, NO_UNIT, LogNormal(1.0, one.spread)
        else:
            nominal, unit, prior = one.value, one.unit, Normal(one.value, one.spread)
        positive = bool(np.all(recorded[SIMULATED] > 0.0) and np.all(recorded[header] > 0.0))
        as_power = positive and (logarithmic or isinstance(prior, LogNormal))
        factor = isinstance(prior, LogNormal)
        meaning = "factor on this input of the simulation" if factor else "input of the simulation"
        parameter = Parameter(name, unit, prior, meaning)
        response = _response(quantity, header, nominal, one.spread, factor, as_power)
        yield Calibration(parameter, response, nominal, (quantity, NOMINAL, header), factor=factor)


def _second_order(recorded: Table, quantity: str, headers: Sequence[str]) -> Iterator[Calibration]:
    """Unknown second-order responses to two inputs, in proportion to the product of their relative responses.

    A simulation is not linear in its inputs: without these terms a response of 20 % would look like missing physics.
    """
    changes = [_relative_change(recorded[SIMULATED], recorded[header]) for header in headers]
    for (i, first), (j, second) in combinations_with_replacement(enumerate(headers), 2):
        if np.max(np.abs(changes[i] * changes[j])) < SECOND_ORDER:
            continue
        names = [header.removeprefix(MOVED) for header in (first, second)]
        meaning = f"second-order response of the simulation to {' and '.join(dict.fromkeys(names))}"
        parameter = Parameter(f"{RESPONSE}.{'.'.join(names)}", NO_UNIT, Normal(0.0, 1.0), meaning)
        needs = (quantity, NOMINAL, first, second)
        yield Calibration(parameter, _bent(*needs), 0.0, needs, base_law=RESPONSE)


def _relative_change(simulated: np.ndarray, moved: np.ndarray) -> np.ndarray:
    size = np.maximum(np.abs(simulated), SMALLEST_SHARE * np.median(np.abs(simulated)) + 1e-300)
    return np.asarray((moved - simulated) / size)


def _bent(quantity: str, nominal: str, first: str, second: str) -> Callable[[Mapping[str, Any], float], dict[str, Any]]:
    def response(inputs: Mapping[str, Any], value: float) -> dict[str, Any]:
        simulated = inputs[nominal]
        change = _relative_change(simulated, inputs[first]) * _relative_change(simulated, inputs[second])
        return {quantity: inputs[quantity] + value * np.abs(simulated) * change}

    return response


def _response(
    quantity: str, header: str, nominal: float, spread: float, factor: bool, as_power: bool
) -> Callable[[Mapping[str, Any], float], dict[str, Any]]:
    def response(inputs: Mapping[str, Any], value: float) -> dict[str, Any]:
        z = np.log(value) / spread if factor else (value - nominal) / spread
        here, simulated, moved = inputs[quantity], inputs[NOMINAL], inputs[header]
        if not as_power:
            return {quantity: here + z * (moved - simulated)}
        same_sign = moved * simulated > 0.0
        return {quantity: here * (np.where(same_sign, moved, 1.0) / np.where(same_sign, simulated, 1.0)) ** z}

    return response


def fill_channels(table: Table, recorded: Table) -> Table:
    """Table with the simulation interpolated between recorded rows, where it has none: suggested conditions."""
    if SIMULATED in table or SIMULATED not in recorded:
        return table
    names = [name for name in recorded.columns if name == SIMULATED or name.startswith(MOVED)]
    return Table({**table.columns, **interpolated(table, recorded, names)}, table.source)


def _made_up(rows: Mapping[str, np.ndarray]) -> np.ndarray:
    power = rows["torque_Nm"] * rows["speed_rpm"] * np.pi / 30.0
    return np.asarray(1.5e-3 * power * (1.0 + 20.0 / rows["oil_temperature_C"]))


STANDARD = StandardRig(
    sections={
        "conditions": {"oil_temperature_C": {"unit": "°C", "meaning": "temperature of the oil in the sump"}},
        "uncertainty": {"friction": 0.1},
    },
    noise=0.3,
    conditions={
        "load": ("torque_Nm", (50.0, 100.0, 150.0)),
        "speed": ("speed_rpm", (500.0, 1000.0, 2000.0, 3000.0)),
        "oil_temperature": ("oil_temperature_C", (50.0, 70.0, 90.0)),
    },
    channels=lambda rows, reading: {SIMULATED: _made_up(rows), f"{MOVED}friction": 1.1 * _made_up(rows)},
)
"""A made-up simulation of the loss of gears."""

SHOWN = (
    Column("CONDITION", required=False, meaning="any conditions, numbers or names: [conditions.CONDITION]"),
    Column(SIMULATED, meaning="reading of the user's own simulation, in the unit of the reading"),
    Column(f"{MOVED}NAME", required=False, meaning="the simulation with NAME of [uncertainty] one sd up"),
    Column("READING", meaning="what the rig recorded, as recording.quantity names it"),
)

KIND = Kind(
    name="table",
    subject="simulation",
    readings=(gear_pair.POWER_LOSS,),
    columns=(columns.TORQUE, columns.SPEED, columns.OIL_TEMPERATURE),
    sections=(),
    uses=("conditions", "gears", "lubricant", "surfaces"),
    base_model="The user's own simulation, column simulated.",
    chain=lambda system, table: place_of("power_loss_W", ()).chain(system, table),
    inputs=_inputs_at(place_of("power_loss_W", ()), 1.0),
    instrument_channels=(
        Column(SIMULATED, meaning="reading of the user's own simulation, in its unit", words=(SIMULATED, "simulation")),
    ),
    fill_channels=fill_channels,
    by_case=of_case,
    check=check,
    shown=SHOWN,
    standard=STANDARD,
)
