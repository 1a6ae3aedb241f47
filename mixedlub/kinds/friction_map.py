"""Friction of a whole drive against its speed, in both directions where both were run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.chain.effect import Parameter
from mixedlub.chain.model import Chain
from mixedlub.chain.priors import LogNormal, LogUniform, Normal
from mixedlub.kinds import acceleration, columns
from mixedlub.kinds.calibration import Calibration
from mixedlub.kinds.kind import NO_GEARS, Inputs, Kind, bookkeeping_inputs, column, gears_out, inverse_load, programme
from mixedlub.kinds.standard import StandardRig
from mixedlub.laws import drive
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.findings import finding, report
from mixedlub.schema.table import Column, Table
from profiles.errors import InputError

SPEEDS = ("speed_rpm", "sliding_speed_m_s")
LOADS = ("load_N", "torque_Nm")


def _of_drive(column: Column, meaning: str) -> Column:
    """A column of a drive, which may run in both directions and idle."""
    return replace(column, above=-np.inf, required=False, meaning=meaning)


COLUMNS = (
    _of_drive(columns.SPEED, "signed speed of the drive; this or sliding_speed_m_s"),
    Column(
        "sliding_speed_m_s", required=False, meaning="signed sliding speed; this or speed_rpm", words=("sliding speed",)
    ),
    _of_drive(columns.LOAD, "load on the drive"),
    _of_drive(columns.TORQUE, "torque that loads the drive"),
    replace(
        columns.OIL_TEMPERATURE, at_least=-100.0, at_most=400.0, required=False, meaning="temperature of oil or grease"
    ),
    Column(
        "additive_percent",
        at_least=0.0,
        at_most=100.0,
        required=False,
        meaning="content of an additive",
        words=("additive", "additive content", "additive concentration"),
    ),
    Column(
        "position_deg", required=False, meaning="angle the drive has turned", words=("position", "angle", "shaft angle")
    ),
    columns.TIME,
)
FRICTION_TORQUE = Column(
    "friction_torque_Nm",
    meaning="friction torque of the drive",
    words=("friction torque", "torque loss", "loss torque", "drag torque", "frictional torque"),
    hints=("loss", "drag"),
)
FRICTION = replace(columns.FRICTION, meaning="friction over load, signed with the speed")
MOTOR_TORQUE = Column(
    "motor_torque_Nm",
    required=False,
    meaning="torque that the controller computes from the motor current",
    words=("motor torque",),
)
"""Not a test condition: friction is its excess over the torque at the shaft."""
LARGE_QUANTILE = 0.95
"""Judgement. Quantile of the size of readings that counts as their largest."""
LEAST_SCALE = 0.3
"""Judgement. Least typical size of the readings, as a share of their largest."""
SIGNIFICANT = 2.5
"""Judgement. Difference between the slow and fast half of the readings, in standard deviations, that is significant."""
STARTING = 1e-9
"""Definition. Speed of a drive that starts, over the largest: any that has its direction."""
BARE_SHARE = 0.3
"""Judgement. Prior of the friction of motor and sensor alone, relative to that of the complete drive."""


def reading(friction_torque: np.ndarray) -> np.ndarray:
    """The rig reads the friction torque of the drive (N m), or its friction coefficient (-).

    >>> float(reading(2.5))
    2.5
    """
    return friction_torque


def drive_speed(table: Table) -> np.ndarray:
    """Signed speed of the rows: m/s if a sliding speed is recorded, else rad/s."""
    present = [name for name in SPEEDS if name in table]
    if len(present) != 1:
        raise InputError(
            f"a friction map needs one of the columns {' and '.join(SPEEDS)}", where=f"{table.source}: header"
        )
    return table[present[0]] * (np.pi / 30.0 if present[0] == "speed_rpm" else 1.0)


def inputs(system: system_file.System, rig: Rig, table: Table, recorded: Table) -> Inputs:
    """Chain inputs of the rows of a table."""
    speed = drive_speed(table)
    size = _size(system, recorded)
    found: Inputs = {
        **bookkeeping_inputs(system, table),
        **inverse_load(system, table, recorded),
        **programme(table, recorded),
        "drive_speed": column(speed),
        "reference_speed": float(np.max(np.abs(drive_speed(recorded)))) or 1.0,
        "coulomb_torque": size,
        "viscous_torque": 0.5 * size,
        "payload_torque": 0.0,
        "gears_fitted": np.where(gears_out(table), BARE_SHARE, 1.0)[:, None],
        "temperature_difference": _warmer(table, recorded),
        "log_load": _heavier(table, recorded),
    }
    name = _load_column(table, recorded)
    if name is not None:
        found["load_fraction"] = column(np.abs(table[name]) / np.max(np.abs(recorded[name])))
        if name == "torque_Nm" and {-1.0, 1.0} <= set(load_sense(recorded).tolist()):
            found["load_sense"] = column(load_sense(table))
    if "additive_percent" in table and "additive_percent" in recorded and recorded["additive_percent"].any():
        found["additive_fraction"] = column(table["additive_percent"] / np.max(recorded["additive_percent"]))
    if "oil_temperature_C" in table:
        found["oil_temperature"] = column(table["oil_temperature_C"]) + ZERO_CELSIUS
    found.update(_motor_torque(table, recorded))
    found.update(_acceleration(system, table, recorded, size))
    if "position_deg" in table:
        found["drive_angle"] = np.radians(column(table["position_deg"]))
    return found


def _warmer(table: Table, recorded: Table) -> np.ndarray:
    """Oil temperature of the rows above the mean of the recording (K); zero without temperatures."""
    name = "oil_temperature_C"
    if name not in table or name not in recorded:
        return np.zeros((len(table), 1))
    return column(table[name] - np.mean(recorded[name]))


def _load_column(table: Table, recorded: Table) -> str | None:
    """Name of the non-zero load column of the drive, preferably the torque; None without one."""
    there = (n for n in reversed(LOADS) if n in table and n in recorded and np.any(recorded[n] != 0.0))
    return next(there, None)


def _heavier(table: Table, recorded: Table) -> np.ndarray:
    """Logarithm of the load of the rows over the geometric mean of the recorded loads; zero without a load.

    An idle drive carries its weight: it counts as loaded by the smallest recorded load.
    """
    name = _load_column(table, recorded)
    if name is None:
        return np.zeros((len(table), 1))
    loaded = np.abs(recorded[name][recorded[name] != 0.0])
    least = float(loaded.min())
    idle = (recorded[name] == 0.0, table[name] == 0.0)
    known, wanted = (
        np.where(out, least, np.abs(rows[name])) for out, rows in zip(idle, (recorded, table), strict=True)
    )
    return column(np.log(wanted) - np.mean(np.log(known)))


def _motor_torque(table: Table, recorded: Table) -> Inputs:
    """Motor torque, and the largest recorded one as reference.

    A column of zeros means that the drive is unloaded; it does not give the motor's torque.
    """
    motor, own = _motor_column(recorded), _motor_column(table)
    if motor is None or own is None or not np.any(recorded[motor] != 0):
        return {}
    return {"reference_torque": float(np.max(np.abs(recorded[motor]))), "motor_torque": column(table[own])}


def _acceleration(system: system_file.System, table: Table, recorded: Table, size: float) -> Inputs:
    """Acceleration of a drive whose torque is read, and the moment of inertia that would need a typical torque."""
    if acceleration.COLUMN not in table or system.recording.quantity != FRICTION_TORQUE.name:
        return {}
    largest = float(np.max(np.abs(acceleration.accelerated(recorded, recorded)[acceleration.COLUMN])))
    changes = column(table[acceleration.COLUMN])
    speed, size_of = column(drive_speed(table)), size / (largest or 1.0)
    # A machine that starts already overcomes its dry friction.
    starting = STARTING * np.sign(changes) * float(np.max(np.abs(drive_speed(recorded))))
    moving = np.where(speed == 0.0, starting, speed)
    return {"drive_acceleration": changes, "inertia_scale": size_of, "drive_speed": moving}


def load_sense(table: Table) -> np.ndarray:
    """1 where the motor drives the load, -1 where the load drives the motor, 0 without load."""
    return np.sign(drive_speed(table) * table["torque_Nm"])


def fill_channels(table: Table, recorded: Table) -> Table:
    """Table with an added acceleration and motor torque: shaft torque plus median friction, else the motor's median."""
    table = acceleration.accelerated(table, recorded)
    if MOTOR_TORQUE.name in table or MOTOR_TORQUE.name not in recorded:
        return table
    motor = recorded[MOTOR_TORQUE.name]
    if "torque_Nm" in table and "torque_Nm" in recorded:
        torque = table["torque_Nm"] + np.median(motor - recorded["torque_Nm"])
    else:
        torque = np.full(len(table), np.median(motor))
        text = f"no {MOTOR_TORQUE.name} and no torque_Nm: predicted for the motor's median torque, {torque[0]:.3g} N m"
        report(finding("motor_torque_assumed", text, table.source))
    return Table({**table.columns, MOTOR_TORQUE.name: torque}, table.source)


def _motor_column(table: Table) -> str | None:
    """Column of the motor torque: a separate channel, or the load torque of the drive."""
    return next((name for name in (MOTOR_TORQUE.name, "torque_Nm") if name in table), None)


def _size(system: system_file.System, recorded: Table) -> float:
    """Typical size of the readings of the complete drive; a payload may cancel friction in one direction."""
    values, speed = _complete(system, recorded)
    size = np.abs(values)
    return (
        float(max(np.median(size), LEAST_SCALE * np.quantile(size, LARGE_QUANTILE), made_up_for(values, speed))) or 1.0
    )


def _largest(system: system_file.System, recorded: Table) -> float:
    """Size of the largest readings without outliers: most may be at speeds too low for viscous friction."""
    if system.recording.quantity not in recorded:
        return 1.0
    size = np.abs(recorded[system.recording.quantity])
    return float(max(np.quantile(size, LARGE_QUANTILE), made_up_for(*_complete(system, recorded)))) or 1.0


def _complete(system: system_file.System, recorded: Table) -> tuple[np.ndarray, np.ndarray]:
    """Readings of the complete drive and their speeds; of its parts if there are no others."""
    if system.recording.quantity not in recorded:
        return np.ones(1), np.ones(1)
    whole = ~gears_out(recorded)
    kept = whole if whole.any() else slice(None)
    return recorded[system.recording.quantity][kept], drive_speed(recorded)[kept]


def made_up_for(values: np.ndarray, speed: np.ndarray) -> float:
    """Difference of fast and slow readings of a direction if their signs differ: a lower bound of the parts.

    Zero if the signs agree or the difference is within the scatter of neighbouring speeds.

    >>> round(made_up_for(np.array([-0.2, 0.5, 0.6, -0.3, -0.2, 0.5]), np.array([1.0, 2.0, 2.0, 1.0, 1.0, 2.0])), 1)
    0.7
    >>> made_up_for(np.array([-0.5, -0.6, 0.5, 0.6]), np.array([-1.0, -2.0, 1.0, 2.0]))
    0.0
    """
    spans = [0.0]
    for way in (speed < 0.0, speed > 0.0):
        if np.count_nonzero(way) < 2:
            continue
        ranked = values[way][np.argsort(np.abs(speed[way]), kind="stable")]
        slow, fast = np.median(ranked[: ranked.size // 2]), np.median(ranked[-(ranked.size // 2) :])
        scatter = float(np.median(np.abs(np.diff(ranked)))) / 0.954
        apart = float(abs(fast - slow))
        spans.append(apart if slow * fast < 0.0 and apart > SIGNIFICANT * scatter else 0.0)
    return max(spans)


def extra_calibration(system: system_file.System, recorded: Table) -> tuple[Calibration, ...]:
    """Broad priors of dry, viscous and payload torque, scaled by the readings."""
    size, largest = _size(system, recorded), _largest(system, recorded)

    def unknown(name: str, prior: LogNormal | LogUniform | Normal, nominal: float, meaning: str) -> Calibration:
        torque = system.recording.quantity == "friction_torque_Nm"
        label = name if torque else name.replace("torque", "friction")
        parameter = Parameter(label, "N m" if torque else "-", prior, meaning)
        return Calibration(parameter, lambda inputs, value: {name: value}, nominal, (name,))

    found = (
        unknown("coulomb_torque", LogNormal(size, 1.0), size, "dry friction, the same in both directions"),
        unknown(
            "viscous_torque",
            LogUniform(3e-3 * size, 3.0 * largest),
            0.5 * size,
            "viscous friction at the largest speed",
        ),
        unknown("payload_torque", Normal(0.0, size), 0.0, "constant part that keeps its sign"),
    )
    if not gears_out(recorded).any():
        return found
    share = Parameter("bare_share", "-", LogNormal(BARE_SHARE, 1.0), "share of friction left without the gears")
    return (*found, Calibration(share, _bare_share, BARE_SHARE, ("gears_fitted",)))


def _bare_share(inputs: Mapping[str, Any], value: float) -> dict[str, Any]:
    fitted = inputs["gears_fitted"]
    return {"gears_fitted": np.where(fitted == 1.0, 1.0, value)}


def chain(system: system_file.System, table: Table) -> Chain:
    """The chain of Coulomb friction, viscous friction and payload."""
    return (
        ("running_friction", drive.coulomb_viscous),
        ("friction_torque", drive.motor_friction),
        ("reading", reading),
    )


STANDARD = StandardRig(
    sections={},
    noise=0.01,
    conditions={
        "load": ("torque_Nm", (0.0, 2.0, 4.0)),
        "speed": ("speed_rpm", (-3000.0, -300.0, -30.0, 30.0, 300.0, 3000.0)),
        "oil_temperature": ("oil_temperature_C", (20.0, 60.0)),
        "additive_fraction": ("additive_percent", (0.0, 2.0)),
        "drive_angle": ("position_deg", tuple(np.linspace(0.0, 3600.0, 60))),
    },
    channels=lambda columns, reading: {
        MOTOR_TORQUE.name: np.sign(columns["speed_rpm"]) * (1.0 + columns["torque_Nm"]),
        acceleration.COLUMN: 20.0 * np.cos(np.radians(columns["position_deg"])),
    },
)

KIND = Kind(
    name="friction_map",
    subject="drive",
    readings=(FRICTION_TORQUE, FRICTION),
    columns=COLUMNS,
    sections=(),
    base_model=(
        "Coulomb friction, the same in both directions, viscous friction in proportion to speed, and a "
        "constant torque of the payload."
    ),
    chain=chain,
    inputs=inputs,
    extra_calibration=extra_calibration,
    part_rigs=(NO_GEARS,),
    instrument_channels=(MOTOR_TORQUE,),
    fill_channels=fill_channels,
    direction=drive_speed,
    either=SPEEDS,
    standard=STANDARD,
)
