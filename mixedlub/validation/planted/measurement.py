"""Faults of the instrument: the recorded value is not what the rig did."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.validation.planted.kinds import GEAR, Concealed, Knob, strength
from mixedlub.validation.rig import Contact


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


def crept(sequence: np.ndarray, onset: float) -> np.ndarray:
    """Creep with the logarithm of time, from 0 to 1 over the programme: ln(1 + q/onset)/ln(1 + 1/onset).

    Phillips, Phil. Mag. 9 (1905) 513, and Cottrell 1953 for metals under an even load, cold (below some 0.3 of their
    melting point) and little strained; load cells and bonded strain gauges creep alike within a test. Cited from
    memory; the ``onset``, a share of the programme, is a usual size.

    >>> [round(float(done), 3) for done in crept(np.array([0.0, 0.1, 1.0]), 0.01)]
    [0.0, 0.52, 1.0]
    """
    return np.asarray(np.log1p(sequence / onset) / np.log1p(1 / onset))


def diffused(sequence: np.ndarray) -> np.ndarray:
    """What has diffused into a half-space by a moment of the programme, over all by its end: q^0.5.

    The surface warms so at an even flux of heat (Carslaw and Jaeger 1959), and a sensor takes up moisture so (Crank
    1975) while its far side feels nothing of it, up to half of saturation. Cited from memory; no constants are taken.

    >>> [round(float(done), 3) for done in diffused(np.array([0.0, 0.25, 1.0]))]
    [0.0, 0.5, 1.0]
    """
    return np.sqrt(sequence)


def sensor_warming(c: Contact, strength: float, pace: float) -> Contact:
    return replace(c, recorded=c.recorded * (1 + 0.1 * strength * warmed_up(c.rig.sequence, pace)))


def sensor_creep(c: Contact, strength: float, onset: float) -> Contact:
    return replace(c, recorded=c.recorded * (1 + 0.1 * strength * crept(c.rig.sequence, onset)))


def sensor_soaking(c: Contact, strength: float) -> Contact:
    return replace(c, recorded=c.recorded * (1 + 0.1 * strength * diffused(c.rig.sequence)))


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
        within=True,
    ),
    Concealed(
        "sensor_drift",
        "measurement",
        "sensor",
        sensor_creep,
        (strength(-6.0, 8.0), Knob("onset", 0.001, 0.2, (0.003, 0.05))),
        "logarithmic creep of a load cell",
        0,
    ),
    Concealed(
        "sensor_drift",
        "measurement",
        "sensor",
        sensor_soaking,
        (strength(-6.0, 8.0),),
        "heat or moisture that diffuses in",
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
