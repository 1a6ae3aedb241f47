"""Faults of the instrument: the recorded value is not what the rig did."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.proof.concealed.kinds import GEAR, Concealed, Knob, strength
from mixedlub.proof.rig import Contact


def _scale(c: Contact) -> float:
    """A usual size of the quantity: 5 W of power loss or 0.002 of friction."""
    return 5.0 if c.rig.kind == "gear_pair" else 0.002


def heat_leak(c: Contact, strength: float, conductance: float) -> Contact:
    """Heat that a calorimeter misses: P (1 - 0.05 strength) - strength G (T_oil - ambient), G in W/K."""
    over = c.temperature[:, 0] - c.rig.extras["ambient"]
    return replace(c, recorded=c.recorded * (1 - 0.05 * strength) - strength * conductance * over)


def sensor_offset(c: Contact, strength: float) -> Contact:
    return replace(c, recorded=c.recorded + strength * _scale(c))


def sensor_gain(c: Contact, strength: float) -> Contact:
    return replace(c, recorded=c.recorded * (1 + 0.1 * strength))


def sensor_drift(c: Contact, strength: float) -> Contact:
    return replace(c, recorded=c.recorded * (1 + 0.1 * strength * c.rig.sequence))


def torque_offset(c: Contact, strength: float) -> Contact:
    """Zero of a torque meter: 0.05 Nm times strength and the pinion's angular speed."""
    speed = c.rig.conditions["speed_rpm"].astype(float) * np.pi / 30
    return replace(c, recorded=c.recorded + 0.05 * strength * speed)


EFFECTS = (
    Concealed(
        "heat_leak",
        "measurement",
        "sensor",
        heat_leak,
        (strength(0.0, 8.0), Knob("conductance", 0.0, 0.6, (0.02, 0.15))),
        "calorimetric balance",
        -1,
        GEAR,
    ),
    Concealed(
        "sensor_offset",
        "measurement",
        "sensor",
        sensor_offset,
        (strength(-8.0, 8.0),),
        "instrument zero",
        0,
    ),
    Concealed("sensor_gain", "measurement", "sensor", sensor_gain, (strength(-4.0, 6.0),), "instrument span", 0),
    Concealed("sensor_drift", "measurement", "sensor", sensor_drift, (strength(-6.0, 8.0),), "instrument drift", 0),
    Concealed(
        "torque_offset",
        "measurement",
        "sensor",
        torque_offset,
        (strength(-8.0, 8.0),),
        "torque meter zero",
        0,
        GEAR,
        0.7,
    ),
)
