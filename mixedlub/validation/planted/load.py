"""Load-stage effects on gears: dynamic load, misalignment, tip relief."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.validation.contact import Contact
from mixedlub.validation.rig import Form, Knob, strength


def _torque_ratio(c: Contact) -> np.ndarray:
    """Torque of each reading over the largest of the programme (readings by 1)."""
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

    Order n adds 0.15 strength (1, ``second``) D cos(2 pi n x/p_b - a), D exp(-i a) = r^2/(1 - r^2 + 0.14 i r) with
    r = n q: the second order resonates at half the speed. D grows as q^2 at low speed; the mean force stays.
    Cited from memory; the error's size and the damping of 7 % were not checked against them.
    """
    q = c.rig.conditions["speed_rpm"].astype(float)[:, None] / resonance_rpm
    waved = np.ones(1)
    for order, size in ((1, 1.0), (2, second)):
        r = order * q
        answer = r**2 / (1 - r**2 + 0.14j * r)
        waved = waved + 0.15 * strength * size * (answer * np.exp(2j * np.pi * order * c.rig.phase)).real
    return _forced(c, c.force * np.clip(waved, 0.05, None))


def misalignment(c: Contact, strength: float) -> Contact:
    """Load on part of the face, less so when torque closes the gap: line load (1 + 0.3 s (150 Nm/T)^0.5)."""
    return replace(c, line_load=c.line_load * (1 + 0.3 * strength / np.sqrt(_torque_ratio(c))))


def tip_relief(c: Contact, strength: float) -> Contact:
    """Parabolic relief hands the tips' load to the other pair: a share 0.5 s (150 Nm/T)^0.5, 0.95 at most."""
    ratio = c.rig.extras["contact_ratio"] - 1
    whole = c.rig.conditions["torque_Nm"].astype(float)[:, None] / c.rig.extras["base_radius"]
    share = c.force / whole
    taken = np.clip(0.5 * strength / np.sqrt(_torque_ratio(c)), 0.0, 0.95)
    early, late = c.rig.phase / ratio, (c.rig.phase - 1) / ratio
    first = share * (1 - taken * (1 - early) ** 2) + (1 - share) * taken * early**2
    last = share * (1 - taken * late**2) + (1 - share) * taken * (1 - late) ** 2
    moved = np.where(early <= 1, first, np.where(late >= 0, last, share))
    return _forced(c, whole * moved)


EFFECTS = (
    Form(
        "dynamic_load",
        "load",
        dynamic_load,
        (strength(0.0, 5.0, (0.7, 1.6)), Knob("resonance_rpm", 600.0, 6000.0, (1200.0, 3000.0))),
        "one-degree-of-freedom mesh resonance",
        rarity=0.5,
    ),
    Form(
        "dynamic_load",
        "load",
        dynamic_load_of_two_orders,
        (
            strength(0.0, 5.0, (0.7, 1.6)),
            Knob("resonance_rpm", 600.0, 6000.0, (1200.0, 4000.0)),
            Knob("second", 0.0, 1.0, (0.3, 0.7)),
        ),
        "two orders of the transmission error, Ozguven and Houser 1988",
        rarity=0.5,
    ),
    Form(
        "misalignment",
        "load",
        misalignment,
        (strength(0.0, 8.0, (0.7, 2.0)),),
        "partial face contact closing with torque",
        rarity=0.5,
    ),
    Form(
        "tip_relief",
        "load",
        tip_relief,
        (strength(0.0, 3.0, (0.4, 1.2)),),
        "parabolic relief, load handed to the neighbour pair",
        rarity=0.5,
    ),
)
