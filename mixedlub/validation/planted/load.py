"""Load-stage effects on gears: dynamic load, misalignment, tip relief."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from mixedlub.validation.contact import Contact
from mixedlub.validation.rig import Form, Knob, strength


def _torque_ratio(c: Contact) -> np.ndarray:
    """Torque of each reading over 150 Nm (readings by 1)."""
    torque = c.rig.conditions["torque_Nm"].astype(float)[:, None]
    return np.asarray(torque / 150.0)


def _forced(c: Contact, force: np.ndarray) -> Contact:
    return replace(c, force=force, line_load=c.line_load * force / c.force)


def dynamic_load(c: Contact, strength: float, resonance_rpm: float) -> Contact:
    """Mesh vibration: force times 1 + 0.15 strength D cos(2 pi x/p_b), D = q^2/sqrt((1-q^2)^2 + (0.2 q)^2).

    q is the speed over the resonance speed; the mean force over a base pitch stays.
    """
    q = c.rig.conditions["speed_rpm"].astype(float)[:, None] / resonance_rpm
    gain = q**2 / np.sqrt((1 - q**2) ** 2 + (0.2 * q) ** 2)
    waved = 1 + 0.15 * strength * gain * np.cos(2 * np.pi * c.rig.phase)
    return _forced(c, c.force * np.clip(waved, 0.05, None))


def dynamic_load_of_two_orders(c: Contact, strength: float, resonance_rpm: float, second: float) -> Contact:
    """A transmission error of two mesh orders shakes one mass on the mesh spring (Ozguven and Houser 1988).

    Order n adds 0.15 strength (1, ``second``) D cos(2 pi n x/p_b - a), D exp(-i a) = r^2/(1 - r^2 + 0.14 i r) with r =
    n q: the second order resonates at half the speed. D grows as q^2 at low speed; the mean force stays. Cited from
    memory; amplitudes and the damping of 7 % were not checked against the paper.
    """
    q = c.rig.conditions["speed_rpm"].astype(float)[:, None] / resonance_rpm
    waved = np.ones(1)
    for order, size in ((1, 1.0), (2, second)):
        r = order * q
        answer = r**2 / (1 - r**2 + 0.14j * r)
        waved = waved + 0.15 * strength * size * (answer * np.exp(2j * np.pi * order * c.rig.phase)).real
    return _forced(c, c.force * np.clip(waved, 0.05, None))


def _speed(c: Contact) -> np.ndarray:
    """Speed of the pinion over 1500 rpm (readings by 1)."""
    return np.asarray(c.rig.conditions["speed_rpm"].astype(float)[:, None] / 1500.0)


def dynamic_load_of_quality(c: Contact, strength: float, quality: float) -> Contact:
    """AGMA 2001: force (1 + strength (K_v - 1)), K_v = ((A + (200 v)^0.5)/A)^B, v the pitch-line speed in m/s.

    A = 50 + 56 (1 - B), B = 0.25 (12 - Q)^(2/3), Q the quality number.
    """
    power = 0.25 * (12 - quality) ** (2 / 3)
    pitch = 50 + 56 * (1 - power)
    speed = _speed(c) * 1500 * np.pi / 60 * c.rig.extras["pitch_diameter"]
    factor = ((pitch + np.sqrt(200 * speed)) / pitch) ** power
    return _forced(c, c.force * (1 + strength * (factor - 1)))


def dynamic_load_of_errors(c: Contact, strength: float, fixed: float) -> Contact:
    """ISO 6336-1 below resonance: force (1 + 0.1 strength (n/1500 rpm) [1 - f + f (150 Nm/T)]), ``fixed`` = f.

    The added force grows with speed; the share of pitch errors is independent of load, of deflection proportional.
    """
    return _forced(c, c.force * (1 + 0.1 * strength * _speed(c) * (1 - fixed + fixed / _torque_ratio(c))))


def misalignment(c: Contact, strength: float) -> Contact:
    """Load on part of the face, less so when torque closes the gap: line load (1 + 0.3 s (150 Nm/T)^0.5)."""
    return replace(c, line_load=c.line_load * (1 + 0.3 * strength / np.sqrt(_torque_ratio(c))))


def tip_relief(c: Contact, strength: float) -> Contact:
    """Parabolic relief hands the tips' load to the other pair: a share 0.5 s (150 Nm/T)^0.5, 0.95 at most."""
    return _relieved(c, strength, 2.0)


def tip_relief_of_straight_flanks(c: Contact, strength: float) -> Contact:
    """Linear relief hands the tips' load to the other pair: a share 0.5 s (150 Nm/T)^0.5 that falls evenly inwards."""
    return _relieved(c, strength, 1.0)


def _relieved(c: Contact, strength: float, power: float) -> Contact:
    """Load moved to the other pair by relief that grows with a power of the distance from its start."""
    ratio = c.rig.extras["contact_ratio"] - 1
    whole = c.rig.conditions["torque_Nm"].astype(float)[:, None] / c.rig.extras["base_radius"]
    share = c.force / whole
    taken = np.clip(0.5 * strength / np.sqrt(_torque_ratio(c)), 0.0, 0.95)
    early, late = c.rig.phase / ratio, (c.rig.phase - 1) / ratio
    first = share * (1 - taken * (1 - early) ** power) + (1 - share) * taken * early**power
    last = share * (1 - taken * late**power) + (1 - share) * taken * (1 - late) ** power
    moved = np.where(early <= 1, first, np.where(late >= 0, last, share))
    return _forced(c, whole * moved)


DYNAMIC = partial(Form, "dynamic_load", "load", rarity=0.5)
RELIEF = partial(Form, "tip_relief", "load", rarity=0.5)
EFFECTS = (
    DYNAMIC(dynamic_load, (strength(0.0, 5.0, (0.7, 1.6)), Knob("resonance_rpm", 600.0, 6000.0, (1200.0, 3000.0))),
            "one-degree-of-freedom mesh resonance", within=True),
    DYNAMIC(dynamic_load_of_two_orders,
            (strength(0.0, 5.0, (0.7, 1.6)), Knob("resonance_rpm", 600.0, 6000.0, (1200.0, 4000.0)),
             Knob("second", 0.0, 1.0, (0.3, 0.7))),
            "two orders of the transmission error, Ozguven and Houser 1988", within=True),
    DYNAMIC(dynamic_load_of_quality, (strength(0.0, 5.0, (0.5, 1.5)), Knob("quality", 5.0, 11.0, (6.0, 10.0))),
            "dynamic factor of AGMA 2001", holds="v up to (A + Q - 3)^2/200"),
    DYNAMIC(dynamic_load_of_errors, (strength(0.0, 10.0, (0.7, 1.6)), Knob("fixed", 0.0, 1.0, (0.3, 0.8))),
            "dynamic factor of ISO 6336-1, method C", holds="below resonance"),
    Form("misalignment", "load", misalignment, (strength(0.0, 8.0, (0.7, 2.0)),),
         "partial face contact closing with torque", rarity=0.5),
    RELIEF(tip_relief, (strength(0.0, 3.0, (0.4, 1.2)),), "parabolic relief, load handed to the neighbour pair"),
    RELIEF(tip_relief_of_straight_flanks, (strength(0.0, 3.0, (0.4, 1.2)),),
           "linear relief, load handed to the neighbour pair"),
)  # fmt: skip
