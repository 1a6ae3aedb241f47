"""Drag of a fan against its speed."""

import numpy as np

from mixedlub.chain.effect import Parameter
from mixedlub.chain.priors import LogNormal
from mixedlub.kinds import columns
from mixedlub.kinds.calibration import Calibration
from mixedlub.kinds.kind import Kind, bookkeeping_inputs, column
from mixedlub.kinds.standard import StandardRig
from mixedlub.schema.table import Column

DRAG = Column("fan_drag_mNm", meaning="torque that the fan takes", words=("fan drag",))
NOMINAL = 0.05
"""Drag (N m) at 1000 rpm."""


def inputs(system, rig, table, recorded):
    return {
        **bookkeeping_inputs(system, table),
        "drive_speed": column(table["speed_rpm"]) * np.pi / 30.0,
        "viscous_torque": NOMINAL,
    }


def drag(drive_speed, viscous_torque):
    return viscous_torque * (drive_speed / (1000.0 * np.pi / 30.0)) ** 2


def reading(friction_torque):
    return friction_torque


def extra_calibration(system, recorded):
    size = Parameter("drag", "N m", LogNormal(NOMINAL, 0.3), "drag at 1000 rpm")
    return (Calibration(size, lambda given, value: {"viscous_torque": value}, NOMINAL, ("viscous_torque",)),)


KIND = Kind(
    name="fan_drag",
    subject="drive",
    readings=(DRAG,),
    scale=1e3,
    columns=(columns.SPEED,),
    sections=(),
    base_model="drag in proportion to the square of the speed.",
    chain=lambda system, table: (("friction_torque", drag), ("reading", reading)),
    inputs=inputs,
    extra_calibration=extra_calibration,
    standard=StandardRig(sections={}, noise=0.1, conditions={"speed": ("speed_rpm", (500.0, 1000.0, 2000.0))}),
)
