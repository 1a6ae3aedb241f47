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
    over = c.rig.temperature - c.rig.extras["ambient"]
    return replace(c, recorded=c.recorded * (1 - 0.05 * strength) - strength * conductance * over)


def heat_leak_by_convection(c: Contact, strength: float, conductance: float) -> Contact:
    """Walls cooled by free convection, whose film coefficient goes with the 0.25th power: G 40 K (T/40 K)^1.25."""
    over = np.clip(c.rig.temperature - c.rig.extras["ambient"], 0.0, None) / 40.0
    return replace(c, recorded=c.recorded * (1 - 0.05 * strength) - strength * conductance * 40.0 * over**1.25)


def sensor_offset(c: Contact, strength: float) -> Contact:
    return replace(c, recorded=c.recorded + strength * _scale(c))


def sensor_gain(c: Contact, strength: float) -> Contact:
    return replace(c, recorded=c.recorded * (1 + 0.1 * strength))


def sensor_drift(c: Contact, strength: float) -> Contact:
    return replace(c, recorded=c.recorded * (1 + 0.1 * strength * c.rig.sequence))


def warmed_up(sequence: np.ndarray, pace: float) -> np.ndarray:
    """An amplifier that warms up, from 0 to 1 over the programme: most of the change comes early."""
    return np.asarray(np.expm1(-sequence / pace) / np.expm1(-1 / pace))


def sensor_warming(c: Contact, strength: float, pace: float) -> Contact:
    return replace(c, recorded=c.recorded * (1 + 0.1 * strength * warmed_up(c.rig.sequence, pace)))


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
        within=True,
    ),
    Concealed(
        "heat_leak",
        "measurement",
        "sensor",
        heat_leak_by_convection,
        (strength(0.0, 8.0), Knob("conductance", 0.0, 0.6, (0.02, 0.15))),
        "calorimetric balance, free convection after McAdams 1954",
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
        within=True,
    ),
    Concealed(
        "sensor_gain", "measurement", "sensor", sensor_gain, (strength(-4.0, 6.0),), "instrument span", 0, within=True
    ),
    Concealed(
        "sensor_drift",
        "measurement",
        "sensor",
        sensor_drift,
        (strength(-6.0, 8.0),),
        "instrument drift",
        0,
        within=True,
    ),
    Concealed(
        "sensor_drift",
        "measurement",
        "sensor",
        sensor_warming,
        (strength(-6.0, 8.0), Knob("pace", 0.7, 5.0, (1.0, 3.0))),
        "warming amplifier",
        0,
    ),
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
        within=True,
    ),
)
