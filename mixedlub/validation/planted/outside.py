"""Physics outside every catalogue: the right answer is "unknown"."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.validation.contact import Contact
from mixedlub.validation.rig import Form, Knob, strength

SPEED, LOAD = ("speed_rpm", "entrainment_speed_m_s"), ("torque_Nm", "load_N")
"""Conditions of gears, and of other contacts."""


def _place(c: Contact, names: tuple[str, str]) -> np.ndarray:
    """Place of each reading between the smallest (0) and the largest (1) value of a condition, on a log scale."""
    values = np.log(c.rig.conditions[names[not c.rig.is_mesh]].astype(float))
    return np.asarray((values - values.min()) / max(values.max() - values.min(), 1e-9))


def _multiplied(c: Contact, factor: np.ndarray) -> Contact:
    return replace(c, friction=c.friction * factor)


def speed_band(c: Contact, strength: float, centre: float, width: float) -> Contact:
    """Friction rises by 20 % strength in one band of speed, as at a resonance of the rig."""
    bump = np.exp(-0.5 * ((_place(c, SPEED) - centre) / width) ** 2)
    return _multiplied(c, (1 + 0.2 * strength * bump)[:, None])


def pair_chemistry(c: Contact, strength: float, place: float) -> Contact:
    """One pairing of surfaces reacts: its boundary friction is 40 % strength higher, the others stay."""
    roughnesses = np.unique(np.round(c.rig.moments[:, 0] * 1e12, 9))
    chosen = roughnesses[min(int(place * len(roughnesses)), len(roughnesses) - 1)]
    hit = np.round(c.rig.moments[:, 0] * 1e12, 9) == chosen
    return replace(c, boundary_friction=c.boundary_friction * (1 + 0.4 * strength * hit)[:, None])


def load_threshold(c: Contact, strength: float, centre: float) -> Contact:
    """Friction grows by 25 % strength above a sharp load threshold."""
    over = 1 / (1 + np.exp(-(_place(c, LOAD) - centre) / 0.03))
    return _multiplied(c, (1 + 0.25 * strength * over)[:, None])


def hot_cavitation(c: Contact, strength: float, onset: float) -> Contact:
    """Gas comes out of hot oil at speed and the film loses up to 60 %: both heat and speed are needed."""
    hot = 1 / (1 + np.exp(-(c.temperature - onset) / 4.0))
    fast = _place(c, SPEED)[:, None] ** 3
    return replace(c, film=c.film * (1 - np.clip(0.6 * strength * hot * fast, 0.0, 0.9)))


def odd_slip_power(c: Contact, strength: float, exponent: float) -> Contact:
    """An odd power of the slide-roll ratio adds to friction: 0.02 strength |slip|^exponent."""
    slip = c.sliding / c.entrainment
    return replace(c, friction=c.friction + 0.02 * strength * slip**exponent)


def speed_ripple(c: Contact, strength: float, waves: float) -> Contact:
    """Friction swings with the logarithm of speed, 12 % strength up and down."""
    return _multiplied(c, (1 + 0.12 * strength * np.sin(2 * np.pi * waves * _place(c, SPEED)))[:, None])


def cold_light_drag(c: Contact, strength: float) -> Contact:
    """Mimic of film effects: friction rises at light load and cold oil only."""
    light = np.clip(1 - _place(c, LOAD), 0.0, None) ** 2
    cold = np.exp(-(c.temperature[:, 0] - 40.0) / 15.0)
    return _multiplied(c, (1 + 0.5 * strength * light * cold)[:, None])


def slow_excess(c: Contact, strength: float) -> Contact:
    """Mimic of boundary effects: friction rises at the slowest speeds for any surface."""
    slow = np.clip(1 - _place(c, SPEED), 0.0, None) ** 4
    return _multiplied(c, (1 + 0.3 * strength * slow)[:, None])


def square_law_brake(c: Contact, strength: float) -> Contact:
    """An eddy-current-like drag: power proportional to the torque squared and inversely to the speed."""
    torque = c.rig.conditions["torque_Nm"].astype(float) / 100
    speed = c.rig.conditions["speed_rpm"].astype(float) / 1500
    return replace(c, recorded=c.recorded + 8 * strength * torque**2 / speed)


def _outside(name: str, hook: str, law: Any, *knobs: Knob, rarity: float = 1.0) -> Form:
    return Form(name, hook, law, (strength(-4.0, 8.0), *knobs), "constructed", rarity=rarity)


EFFECTS = (
    _outside("speed_band", "friction", speed_band, Knob("centre", 0.2, 0.9, (0.35, 0.8)),
             Knob("width", 0.05, 0.2, (0.06, 0.15))),
    _outside("pair_chemistry", "boundary", pair_chemistry, Knob("place", 0.0, 1.0, (0.5, 1.0))),
    _outside("load_threshold", "friction", load_threshold, Knob("centre", 0.3, 0.9, (0.5, 0.85))),
    _outside("hot_cavitation", "film", hot_cavitation, Knob("onset", 50.0, 100.0, (65.0, 85.0))),
    _outside("odd_slip_power", "friction", odd_slip_power, Knob("exponent", 1.5, 3.5, (2.0, 3.0))),
    _outside("speed_ripple", "friction", speed_ripple, Knob("waves", 0.8, 2.0, (1.0, 1.6))),
    _outside("square_law_brake", "loss", square_law_brake),
    _outside("cold_light_drag", "friction", cold_light_drag, rarity=0.7),
    _outside("slow_excess", "friction", slow_excess, rarity=0.7),
)  # fmt: skip
MIMICS = frozenset({"cold_light_drag", "slow_excess"})
