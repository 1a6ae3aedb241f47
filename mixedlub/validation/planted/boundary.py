"""Boundary-stage effects: films that form with temperature, speed or time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.validation.contact import Contact
from mixedlub.validation.planted.shear import flash
from mixedlub.validation.rig import Form, Knob, strength


def boundary_film_temperature(c: Contact, strength: float, activation: float, flash_share: float) -> Contact:
    """A film grows in heat: mu_B (1 - 0.5 strength Phi((T - T_a)/12 K)), T with a share of the flash."""
    from scipy.special import ndtr

    friction = c.stress / c.pressure * (1 - c.area) + c.boundary_friction * c.area
    contact = c.temperature + flash_share * flash(c, friction)
    formed = ndtr((contact - activation) / 12.0)
    return replace(c, boundary_friction=c.boundary_friction * (1 - 0.5 * strength * formed))


def boundary_speed_dependence(c: Contact, strength: float) -> Contact:
    """Boundary friction is a power of the sliding speed: mu_B (v_s/1 m/s)^(0.1 strength), from 1 mm/s on."""
    ratio = np.maximum(c.sliding, 1e-3)
    return replace(c, boundary_friction=c.boundary_friction * ratio ** (0.1 * strength))


def boundary_speed_logarithm(c: Contact, strength: float) -> Contact:
    """Layers shear at a stress linear in the logarithm of speed: mu_B (1 + 0.05 strength ln(v_s/1 m/s)), 0.1 at least.

    From 1 mm/s on.
    """
    grown = 1 + 0.05 * strength * np.log(np.maximum(c.sliding, 1e-3))
    return replace(c, boundary_friction=c.boundary_friction * np.maximum(grown, 0.1))


def tribofilm_growth(c: Contact, strength: float, pace: float) -> Contact:
    """A reaction film grows with the root of the time run: mu_B (1 + 0.3 strength sqrt(s)/sqrt(s + pace))."""
    grown = np.sqrt(c.rig.sequence / (c.rig.sequence + pace))[:, None]
    return replace(c, boundary_friction=c.boundary_friction * (1 + 0.3 * strength * grown))


EFFECTS = (
    Form(
        "boundary_film_temperature",
        "boundary",
        boundary_film_temperature,
        (
            strength(0.0, 1.8, (0.6, 1.3)),
            Knob("activation", 40.0, 130.0, (65.0, 95.0)),
            Knob("flash_share", 0.0, 1.0, (0.0, 0.5)),
        ),
        "normal-cumulative activation on contact temperature",
    ),
    Form(
        "boundary_speed_dependence",
        "boundary",
        boundary_speed_dependence,
        (strength(-4.0, 4.0, (0.8, 1.8)),),
        "power law in sliding speed",
        within=True,
    ),
    Form(
        "boundary_speed_dependence",
        "boundary",
        boundary_speed_logarithm,
        (strength(-4.0, 4.0, (0.8, 1.8)),),
        "Briscoe and Evans 1982",
    ),
    Form(
        "tribofilm_growth",
        "boundary",
        tribofilm_growth,
        (strength(-2.5, 4.0, (0.6, 1.5)), Knob("pace", 0.05, 2.0, (0.1, 0.6))),
        "diffusion-limited (parabolic) growth",
        rarity=0.6,
    ),
)
