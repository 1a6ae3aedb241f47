"""Boundary-stage effects: films that form with temperature, speed or time."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from mixedlub.validation.contact import KELVIN, Contact
from mixedlub.validation.planted.shear import flash
from mixedlub.validation.rig import Form, Knob, strength


def boundary_film_temperature(c: Contact, strength: float, activation: float, flash_share: float) -> Contact:
    """A film grows in heat: mu_B (1 - 0.5 strength Phi((T - T_a)/12 K)), T with a share of the flash."""
    from scipy.special import ndtr

    friction = c.stress / c.pressure * (1 - c.area) + c.boundary_friction * c.area
    contact = c.temperature + flash_share * flash(c, friction)
    formed = ndtr((contact - activation) / 12.0)
    return replace(c, boundary_friction=c.boundary_friction * (1 - 0.5 * strength * formed))


GAS = 8.314e-3
"""kJ/(mol K)."""


def _activated(c: Contact, energy: float, celsius: float) -> np.ndarray:
    """exp(-(E/R)(1/T - 1/T_a)): rate of a process relative to its rate at T_a (C), E in kJ/mol."""
    return np.exp(-energy / GAS * (1 / (c.temperature + KELVIN) - 1 / (celsius + KELVIN)))


def boundary_film_desorbed(c: Contact, strength: float, energy: float, half: float) -> Contact:
    """Langmuir: a film leaves hot surfaces, mu_B (1 + 0.5 strength/(1 + exp((E/R)(1/T - 1/T_a)))), half by T_a."""
    bare = 1 / (1 + 1 / _activated(c, energy, half))
    return replace(c, boundary_friction=c.boundary_friction * (1 + 0.5 * strength * bare))


def boundary_film_defect(c: Contact, strength: float, energy: float, balance: float) -> Contact:
    """Kingsbury: mu_B (1 + 0.5 strength [1 - exp(-(v_0/v_s) exp(-(E/R)(1/T - 1/T_a)))]), v_0 = 0.1 m/s at T_a.

    The residence time of a molecule falls with temperature; sites left in an encounter are bare. v_s from 1 mm/s on.
    """
    leaving = 0.1 / np.maximum(c.sliding, 1e-3) * _activated(c, energy, balance)
    return replace(c, boundary_friction=c.boundary_friction * (1 - 0.5 * strength * np.expm1(-leaving)))


def boundary_speed_dependence(c: Contact, strength: float) -> Contact:
    """Boundary friction is a power of the sliding speed: mu_B (v_s/1 m/s)^(0.1 strength), from 1 mm/s on."""
    ratio = np.maximum(c.sliding, 1e-3)
    return replace(c, boundary_friction=c.boundary_friction * ratio ** (0.1 * strength))


def boundary_speed_logarithm(c: Contact, strength: float) -> Contact:
    """Layer stress linear in log speed: mu_B (1 + 0.05 strength ln(v_s/1 m/s)), 0.1 at least, from 1 mm/s on."""
    grown = 1 + 0.05 * strength * np.log(np.maximum(c.sliding, 1e-3))
    return replace(c, boundary_friction=c.boundary_friction * np.maximum(grown, 0.1))


def boundary_speed_eyring(c: Contact, strength: float, speed: float) -> Contact:
    """Thermally activated shear: mu_B (1 + 0.2 strength [asinh(v_s/v_0)/asinh((1 m/s)/v_0) - 1]), 0.1 at least."""
    reached = np.arcsinh(c.sliding / speed) / np.arcsinh(1 / speed)
    grown = 1 + 0.2 * strength * (reached - 1)
    return replace(c, boundary_friction=c.boundary_friction * np.maximum(grown, 0.1))


def boundary_speed_exponential(c: Contact, strength: float, speed: float) -> Contact:
    """Bo and Pavelescu: from a static to a kinetic value, mu_B (1 + 0.2 strength e^(-v_s/v_0)), 0.1 at least."""
    grown = 1 + 0.2 * strength * np.exp(-c.sliding / speed)
    return replace(c, boundary_friction=c.boundary_friction * np.maximum(grown, 0.1))


def tribofilm_growth(c: Contact, strength: float, pace: float) -> Contact:
    """A reaction film grows with the root of the time run: mu_B (1 + 0.3 strength sqrt(s)/sqrt(s + pace))."""
    grown = np.sqrt(c.rig.sequence / (c.rig.sequence + pace))[:, None]
    return replace(c, boundary_friction=c.boundary_friction * (1 + 0.3 * strength * grown))


def tribofilm_of_first_order(c: Contact, strength: float, pace: float) -> Contact:
    """A film covers bare surface: mu_B (1 + 0.3 strength (1 - e^(-s/pace)))."""
    grown = -np.expm1(-c.rig.sequence / pace)[:, None]
    return replace(c, boundary_friction=c.boundary_friction * (1 + 0.3 * strength * grown))


ACTIVATION_VOLUME = 4e-29
"""Activation volume of an additive's reaction under stress (m3): some tens of cubic angstroms."""
BOLTZMANN = 1.380649e-23


def tribofilm_under_stress(c: Contact, strength: float, pace: float, energy: float) -> Contact:
    """Stress and heat speed up the reaction: mu_B (1 + 0.3 strength (1 - e^(-X/pace))), X the sum of the rates so far.

    Rate: mean of exp(-(E - tau dV)/(k T)) over a reading's contacts, over the mean of all; tau = mu_B pi p0/4.
    """
    kelvin = c.temperature + KELVIN
    pushed = 0.25 * np.pi * c.boundary_friction * c.pressure * ACTIVATION_VOLUME / (BOLTZMANN * kelvin)
    rate = np.mean(_activated(c, energy, 80.0) * np.exp(pushed), axis=1)
    order = np.argsort(c.rig.sequence, kind="stable")
    steps = np.diff(c.rig.sequence[order], prepend=0.0)
    run = np.empty(len(rate))
    run[order] = np.cumsum(rate[order] * steps) / np.mean(rate)
    grown = -np.expm1(-run / pace)[:, None]
    return replace(c, boundary_friction=c.boundary_friction * (1 + 0.3 * strength * grown))


LAYER = partial(Form, "boundary_film_temperature", "boundary")
SPEED = partial(Form, "boundary_speed_dependence", "boundary")
GROWTH = partial(Form, "tribofilm_growth", "boundary", rarity=0.6)
EFFECTS = (
    LAYER(boundary_film_temperature,
          (strength(0.0, 1.8, (0.6, 1.3)), Knob("activation", 40.0, 130.0, (65.0, 95.0)),
           Knob("flash_share", 0.0, 1.0, (0.0, 0.5))),
          "normal-cumulative activation on contact temperature"),
    LAYER(boundary_film_desorbed,
          (strength(-1.8, 4.0, (0.6, 1.3)), Knob("energy", 20.0, 150.0, (40.0, 100.0)),
           Knob("half", 40.0, 130.0, (65.0, 95.0))),
          "Langmuir 1918, desorption in heat", within=True,
          holds="unlike a logistic curve at four temperatures or more"),
    LAYER(boundary_film_defect,
          (strength(0.0, 4.0, (0.6, 1.3)), Knob("energy", 15.0, 100.0, (25.0, 50.0)),
           Knob("balance", 30.0, 150.0, (50.0, 100.0))),
          "Kingsbury 1958, fractional film defect"),
    SPEED(boundary_speed_dependence, (strength(-4.0, 4.0, (0.8, 1.8)),), "power law in sliding speed", within=True),
    SPEED(boundary_speed_logarithm, (strength(-4.0, 4.0, (0.8, 1.8)),), "Briscoe and Evans 1982"),
    SPEED(boundary_speed_eyring, (strength(-4.0, 4.0, (0.8, 1.8)), Knob("speed", 0.01, 2.0, (0.03, 0.5))),
          "Eyring 1936, asinh of speed"),
    SPEED(boundary_speed_exponential, (strength(-4.0, 4.0, (0.8, 1.8)), Knob("speed", 0.03, 3.0, (0.1, 1.0))),
          "Bo and Pavelescu 1982"),
    GROWTH(tribofilm_growth, (strength(-2.5, 4.0, (0.6, 1.5)), Knob("pace", 0.05, 2.0, (0.1, 0.6))),
           "diffusion-limited (parabolic) growth"),
    GROWTH(tribofilm_of_first_order, (strength(-2.5, 4.0, (0.6, 1.5)), Knob("pace", 0.05, 2.0, (0.1, 0.6))),
           "coverage of first order, Fujita and Spikes 2005", within=True),
    GROWTH(tribofilm_under_stress,
           (strength(-2.5, 4.0, (0.6, 1.5)), Knob("pace", 0.05, 2.0, (0.1, 0.6)),
            Knob("energy", 10.0, 120.0, (30.0, 80.0))),
           "stress-promoted Arrhenius growth, Gosvami 2015, Zhang and Spikes 2016"),
)  # fmt: skip
