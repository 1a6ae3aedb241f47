"""Instrument faults: deviations of the recorded from the actual value."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from mixedlub.validation.contact import Contact
from mixedlub.validation.rig import Form, Knob, strength


def _scale(c: Contact) -> float:
    """A common size of the quantity: 5 W of power loss or 0.002 of friction."""
    return 5.0 if c.rig.is_mesh else 0.002


def heat_leak(c: Contact, strength: float, conductance: float) -> Contact:
    """Heat missed by a calorimeter: P (1 - 0.05 strength) - strength G (T_oil - ambient), G in W/K."""
    over = c.rig.temperature - c.rig.extras["ambient"]
    return replace(c, recorded=c.recorded * (1 - 0.05 * strength) - strength * conductance * over)


def heat_leak_by_convection(c: Contact, strength: float, conductance: float) -> Contact:
    """Walls cooled by free convection, film coefficient of the 0.25th power: G 40 K (T/40 K)^1.25."""
    over = np.clip(c.rig.temperature - c.rig.extras["ambient"], 0.0, None) / 40.0
    return replace(c, recorded=c.recorded * (1 - 0.05 * strength) - strength * conductance * 40.0 * over**1.25)


def sensor_offset(c: Contact, strength: float) -> Contact:
    """y + strength times 5 W or a friction coefficient of 0.002."""
    return replace(c, recorded=c.recorded + strength * _scale(c))


def sensor_gain(c: Contact, strength: float) -> Contact:
    """y (1 + 0.1 strength)."""
    return replace(c, recorded=c.recorded * (1 + 0.1 * strength))


def sensor_drift(c: Contact, strength: float) -> Contact:
    """y (1 + 0.1 strength s), s from 0 to 1 over the programme."""
    return replace(c, recorded=c.recorded * (1 + 0.1 * strength * c.rig.sequence))


def warmed_up(sequence: np.ndarray, pace: float) -> np.ndarray:
    """Warming of an amplifier, from 0 to 1 over the programme: most of the change comes early."""
    return np.asarray(np.expm1(-sequence / pace) / np.expm1(-1 / pace))


def crept(sequence: np.ndarray, onset: float) -> np.ndarray:
    """Creep with the logarithm of time, from 0 to 1 over the programme: ln(1 + q/onset)/ln(1 + 1/onset).

    Phillips, Phil. Mag. 9 (1905) 513, and Cottrell 1953 for metals under constant load, cold (below some 0.3 of their
    melting point) and little strained; load cells and bonded strain gauges creep alike within a test. Cited from
    memory; the ``onset``, a share of the programme, is a common size.

    >>> [round(float(done), 3) for done in crept(np.array([0.0, 0.1, 1.0]), 0.01)]
    [0.0, 0.52, 1.0]
    """
    return np.asarray(np.log1p(sequence / onset) / np.log1p(1 / onset))


def diffused(sequence: np.ndarray) -> np.ndarray:
    """Amount diffused into a half-space by a moment of the programme, over the amount at its end: q^0.5.

    Surface warming under constant heat flux (Carslaw and Jaeger 1959), and moisture uptake of a sensor (Crank 1975) up
    to half of saturation, before its far side is reached. Cited from memory; no constants are taken.

    >>> [round(float(done), 3) for done in diffused(np.array([0.0, 0.25, 1.0]))]
    [0.0, 0.5, 1.0]
    """
    return np.sqrt(sequence)


def sensor_warming(c: Contact, strength: float, pace: float) -> Contact:
    """y (1 + 0.1 strength (1 - e^(-s/pace))/(1 - e^(-1/pace)))."""
    return replace(c, recorded=c.recorded * (1 + 0.1 * strength * warmed_up(c.rig.sequence, pace)))


def sensor_creep(c: Contact, strength: float, onset: float) -> Contact:
    """y (1 + 0.1 strength ln(1 + s/onset)/ln(1 + 1/onset))."""
    return replace(c, recorded=c.recorded * (1 + 0.1 * strength * crept(c.rig.sequence, onset)))


def sensor_soaking(c: Contact, strength: float) -> Contact:
    """y (1 + 0.1 strength s^0.5)."""
    return replace(c, recorded=c.recorded * (1 + 0.1 * strength * diffused(c.rig.sequence)))


def torque_offset(c: Contact, strength: float) -> Contact:
    """Zero of a torque meter: 0.05 Nm times strength and the pinion's angular speed."""
    speed = c.rig.conditions["speed_rpm"].astype(float) * np.pi / 30
    return replace(c, recorded=c.recorded + 0.05 * strength * speed)


def torque_gain(c: Contact, strength: float) -> Contact:
    """Spans of two torque meters: 0.1 % of the input power, times strength."""
    turning = c.rig.conditions["speed_rpm"].astype(float) * np.pi / 30
    return replace(c, recorded=c.recorded + 1e-3 * strength * c.rig.conditions["torque_Nm"].astype(float) * turning)


HEAT_LEAK = partial(Form, "heat_leak", "sensor")
DRIFT = partial(Form, "sensor_drift", "sensor")
EFFECTS = (
    HEAT_LEAK(heat_leak, (strength(0.0, 8.0), Knob("conductance", 0.0, 0.6, (0.02, 0.15))), "calorimetric balance",
              within=True),
    HEAT_LEAK(heat_leak_by_convection, (strength(0.0, 8.0), Knob("conductance", 0.0, 0.6, (0.02, 0.15))),
              "calorimetric balance, free convection after McAdams 1954"),
    Form("sensor_offset", "sensor", sensor_offset, (strength(-8.0, 8.0),), "instrument zero", within=True),
    Form("sensor_gain", "sensor", sensor_gain, (strength(-4.0, 6.0),), "instrument span", within=True),
    DRIFT(sensor_drift, (strength(-6.0, 8.0),), "instrument drift", within=True),
    DRIFT(sensor_warming, (strength(-6.0, 8.0), Knob("pace", 0.7, 5.0, (1.0, 3.0))), "warming amplifier", within=True),
    DRIFT(sensor_creep, (strength(-6.0, 8.0), Knob("onset", 0.001, 0.2, (0.003, 0.05))),
          "logarithmic creep of a load cell"),
    DRIFT(sensor_soaking, (strength(-6.0, 8.0),), "heat or moisture that diffuses in"),
    Form("torque_offset", "sensor", torque_offset, (strength(-8.0, 8.0),), "torque meter zero", rarity=0.7,
         within=True),
    Form("torque_gain", "sensor", torque_gain, (strength(-5.0, 5.0),), "torque meter spans", rarity=0.7, within=True),
)  # fmt: skip


def _usual(values: np.ndarray) -> float:
    return float(np.median(np.abs(values)))


def channel(sequence: np.ndarray, zero: bool, gain: bool, drifting_zero: bool) -> tuple[Form, ...]:
    """Faults of any channel: wrong zero, wrong span, drifting span, and optionally a drifting zero."""

    def sensor_offset(state: Any, strength: float) -> Any:
        """y + 0.05 strength of the median reading."""
        return replace(state, recorded=state.recorded + 0.05 * strength * _usual(state.recorded))

    def sensor_gain(state: Any, strength: float) -> Any:
        """y (1 + 0.1 strength)."""
        return replace(state, recorded=state.recorded * (1 + 0.1 * strength))

    def steady(state: Any, strength: float) -> Any:
        """y (1 + 0.1 strength s), s from 0 to 1 over the programme."""
        return replace(state, recorded=state.recorded * (1 + 0.1 * strength * sequence))

    def settling(state: Any, strength: float, pace: float) -> Any:
        """y (1 + 0.1 strength (1 - e^(-s/pace))/(1 - e^(-1/pace)))."""
        return replace(state, recorded=state.recorded * (1 + 0.1 * strength * warmed_up(sequence, pace)))

    def logarithmic(state: Any, strength: float, onset: float) -> Any:
        """y (1 + 0.1 strength ln(1 + s/onset)/ln(1 + 1/onset))."""
        return replace(state, recorded=state.recorded * (1 + 0.1 * strength * crept(sequence, onset)))

    def soaking(state: Any, strength: float) -> Any:
        """y (1 + 0.1 strength s^0.5)."""
        return replace(state, recorded=state.recorded * (1 + 0.1 * strength * diffused(sequence)))

    def zero_drift(state: Any, strength: float) -> Any:
        """y + 0.1 strength s of the median reading."""
        return replace(state, recorded=state.recorded + 0.1 * strength * _usual(state.recorded) * sequence)

    def zero_settling(state: Any, strength: float, pace: float) -> Any:
        """y + 0.1 strength (1 - e^(-s/pace))/(1 - e^(-1/pace)) of the median reading."""
        more = 0.1 * strength * _usual(state.recorded) * warmed_up(sequence, pace)
        return replace(state, recorded=state.recorded + more)

    either, share = strength(-8.0, 8.0), strength(-4.0, 4.0)
    found = []
    if zero:
        found.append(Form("sensor_offset", "sensor", sensor_offset, (either,), "instrument zero", within=True))
    if gain:
        found.append(Form("sensor_gain", "sensor", sensor_gain, (share,), "instrument span", rarity=0.5, within=True))
    if len(np.unique(sequence)) > 1:
        slow, early = Knob("pace", 0.7, 5.0, (1.0, 3.0)), Knob("onset", 0.001, 0.2, (0.003, 0.05))
        found.append(Form("sensor_drift", "sensor", steady, (share,), "linear drift", within=True))
        found.append(Form("sensor_drift", "sensor", settling, (share, slow), "warming amplifier", within=True))
        found.append(Form("sensor_drift", "sensor", logarithmic, (share, early), "logarithmic creep of a load cell"))
        found.append(Form("sensor_drift", "sensor", soaking, (share,), "heat or moisture that diffuses in"))
        if drifting_zero:
            found.append(Form("zero_drift", "sensor", zero_drift, (share,), "linear drift of the zero", within=True))
            found.append(Form("zero_drift", "sensor", zero_settling, (share, slow), "warming amplifier"))
    return tuple(found)


def zero_of_force(recorded: np.ndarray, load: np.ndarray) -> np.ndarray:
    """Error of a friction coefficient due to a force error of 0.5 % of the largest friction force, over the load."""
    return np.asarray(0.005 * _usual(recorded) * np.max(np.abs(load)) / np.abs(load))


def force_cell(load: np.ndarray, sequence: np.ndarray) -> tuple[Form, ...]:
    """Faults of a force cell, for friction coefficients from a measured force over a load.

    A residual zero and a change of zero during the test are specified in ISO 376; a zero that follows the cell
    temperature, itself approaching the rig temperature, is in OIML R 60.
    """
    if np.ptp(load) == 0:
        return ()

    def off(state: Any, share: np.ndarray | float) -> Any:
        return replace(state, recorded=state.recorded + share * zero_of_force(state.recorded, load))

    def unzeroed(state: Any, strength: float) -> Any:
        """y + 0.005 strength w_max/w of the median reading, w the load."""
        return off(state, strength)

    def creeping(state: Any, strength: float) -> Any:
        """y + 0.01 strength s w_max/w of the median reading, w the load."""
        return off(state, 2 * strength * sequence)

    def warming(state: Any, strength: float, pace: float) -> Any:
        """y + 0.01 strength (1 - e^(-s/pace))/(1 - e^(-1/pace)) w_max/w of the median reading, w the load."""
        return off(state, 2 * strength * warmed_up(sequence, pace))

    either = strength(-8.0, 8.0)
    pace = Knob("pace", 0.1, 5.0, (0.15, 2.0))
    return (
        Form("force_offset", "sensor", unzeroed, (either,), "zero of a force cell, ISO 376", within=True),
        Form("force_drift", "sensor", creeping, (either,), "linear drift of a force cell, ISO 376", within=True),
        Form("force_drift", "sensor", warming, (either, pace), "warming force cell, OIML R 60"),
    )
