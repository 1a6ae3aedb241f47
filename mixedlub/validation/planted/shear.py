"""Shear-stage effects: film heating, limiting stress, coating insulation, contact creep."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from mixedlub.validation.contact import KELVIN, ROELANDS_PRESSURE, Contact, film_stress
from mixedlub.validation.rig import Form, Knob, strength

SWEEPS = 9
WARMEST, HALVINGS = 250.0, 28


def flash(c: Contact, friction: np.ndarray | float) -> np.ndarray:
    """Average flash rise (K), semi-elliptic source: 0.542 mu w v_s/[B (sqrt u1 + sqrt u2) sqrt b]."""
    solid = c.rig.solid
    effusivity = np.sqrt(solid.conductivity * solid.density * solid.specific_heat)
    spread = np.sqrt(np.abs(c.rig.speed_1)) + np.sqrt(np.abs(c.rig.speed_2))
    heat = 0.542 * friction * c.line_load * c.sliding
    return np.asarray(heat / (effusivity * spread * np.sqrt(c.half_width)))


def _bisected(c: Contact, at_rest: np.ndarray | float, per_stress: np.ndarray) -> np.ndarray:
    """Stress by any law in balance with the rise it causes, 250 K at most: the stress falls as the rise grows."""
    low, high = np.zeros_like(c.stress), np.full_like(c.stress, WARMEST)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        below = at_rest + per_stress * film_stress(c, middle) > middle
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return film_stress(c, 0.5 * (low + high))


def _heated(c: Contact, at_rest: np.ndarray | float, per_stress: np.ndarray) -> Contact:
    """Contact with the Eyring stress in balance with its rise, at_rest + per_stress tau, by Newton from below.

    The stress falls with the rise along a convex curve, so the steps never overshoot. If the rig follows other laws of
    viscosity or shear, the stress is balanced by bisection.
    """
    if c.rig.laws.keys() & {"thick", "shear"}:
        return replace(c, stress=_bisected(c, at_rest, per_stress))
    level = np.log(c.viscosity) + 9.67
    absolute = c.temperature + KELVIN - 138.0
    slope = c.rig.oil.thinning_at(c.temperature) * absolute / level
    pressed = (1 + c.pressure / ROELANDS_PRESSURE) ** (c.pressure_viscosity * ROELANDS_PRESSURE / level)
    rate = c.viscosity * c.sliding / (c.film * c.eyring_stress)
    warmer = np.zeros_like(c.stress)
    for _ in range(SWEEPS):
        eased = level * pressed * (1 + warmer / absolute) ** (-slope)
        driven = rate * np.exp(eased - level)
        stress = c.eyring_stress * np.arcsinh(driven)
        fall = c.eyring_stress * driven / np.sqrt(1 + driven**2) * eased * slope / (absolute + warmer)
        warmer = warmer + (at_rest + per_stress * stress - warmer) / (1 + per_stress * fall)
    return replace(c, stress=stress)


def film_heating(c: Contact, strength: float) -> Contact:
    """Crook-Archard mean rise: flash of the walls by the whole friction plus q h/(12 k) across the film."""
    walls = flash(c, 1.0)
    inside = c.sliding * c.film / (12 * c.rig.oil.conductivity)
    dry = strength * walls * c.boundary_friction * c.area
    return _heated(c, dry, strength * (walls * (1 - c.area) / c.pressure + inside))


def film_heated_alone(c: Contact, strength: float) -> Contact:
    """Crook-Archard across the film alone: mean rise strength q h/(12 k) between cold walls, q = tau v_s."""
    return _heated(c, 0.0, strength * c.sliding * c.film / (12 * c.rig.oil.conductivity))


def walls_heated_alone(c: Contact, strength: float) -> Contact:
    """Blok: the walls' mean flash 0.542 strength mu w v_s/[B (sqrt u1 + sqrt u2) sqrt b] by the whole friction."""
    walls = strength * flash(c, 1.0)
    return _heated(c, walls * c.boundary_friction * c.area, walls * (1 - c.area) / c.pressure)


def film_heated_in_layers(c: Contact, strength: float) -> Contact:
    """Nahme: tau asinh(sqrt N)/sqrt(N (1 + N)), N = strength beta tau v_s h/(8 k), the film thinnest in its hot middle.

    Exact for stress proportional to viscosity exp(-beta T) between cold walls; beta of the oil at rest, tau if cold.
    """
    heat = strength * c.rig.oil.thinning_at(c.temperature) * c.stress * c.sliding * c.film
    number = np.maximum(heat / (8 * c.rig.oil.conductivity), 1e-12)
    return replace(c, stress=c.stress * np.arcsinh(np.sqrt(number)) / np.sqrt(number * (1 + number)))


def limiting_shear_stress(c: Contact, strength: float) -> Contact:
    """Bair-Winer ceiling: tau_L [1 - exp(-tau/tau_L)], tau_L = 0.045/strength of the mean Hertz pressure."""
    if strength <= 0:
        return c
    ceiling = 0.045 / strength * 0.25 * np.pi * c.pressure
    return replace(c, stress=ceiling * -np.expm1(-c.stress / ceiling))


def limiting_stress_in_hot_oil(c: Contact, strength: float, fall: float) -> Contact:
    """Gecim-Winer: tau_L tanh(tau/tau_L), tau_L = (0.045/strength) (1 - fall (T - 40 C)) of the mean Hertz pressure.

    Bair and Winer report limits that fall with temperature (1/K); at 40 C the coefficient is typical of mineral oil.
    For -20 to 150 C; at least a fifth of the limit is kept. From memory: 0.045 and the size of the fall are unchecked.
    """
    if strength <= 0:
        return c
    left = np.maximum(1 - fall * (c.temperature - 40.0), 0.2)
    ceiling = 0.045 / strength * left * 0.25 * np.pi * c.pressure
    return replace(c, stress=ceiling * np.tanh(c.stress / ceiling))


def limiting_stress_cut(c: Contact, strength: float) -> Contact:
    """min(tau, tau_L): a film that yields at once, tau_L = 0.045/strength of the mean Hertz pressure."""
    if strength <= 0:
        return c
    return replace(c, stress=np.minimum(c.stress, 0.045 / strength * 0.25 * np.pi * c.pressure))


def limiting_stress_with_offset(c: Contact, strength: float, offset: float) -> Contact:
    """tau_L [1 - exp(-tau/tau_L)], tau_L = tau_0 + gamma p: (0.045/strength) pi/4 ((1 - offset) p0 + offset 1 GPa).

    ``offset``: share of the limit at zero pressure, tau_0, in the limit at 1 GPa.
    """
    if strength <= 0:
        return c
    ceiling = 0.045 / strength * 0.25 * np.pi * ((1 - offset) * c.pressure + offset * 1e9)
    return replace(c, stress=ceiling * -np.expm1(-c.stress / ceiling))


def coating_insulation(c: Contact, strength: float) -> Contact:
    """A layer holds back its half of the heat: rise (q/2)(t/k) a coated flank, lagging in short contacts."""
    resistance = c.rig.coating_resistance
    layer_heat = 3e6
    coated = np.zeros_like(c.temperature) if c.rig.coated is None else c.rig.coated
    conductivity = 2.0
    lag = (resistance * conductivity) ** 2 * layer_heat / conductivity
    filled = -np.expm1(-2 * c.half_width / (c.entrainment * max(lag, 1e-12)))

    return _heated(c, 0.0, strength * 0.5 * c.sliding * resistance * coated * filled)


def contact_creep(c: Contact, strength: float) -> Contact:
    """Elastic compliance of the bodies takes up small slips: tau [1 - exp(-slip/(0.004 strength))]."""
    if strength <= 0:
        return c
    slip = c.sliding / c.entrainment
    return replace(c, stress=c.stress * -np.expm1(-slip / (0.004 * strength)))


def contact_creep_polach(c: Contact, strength: float) -> Contact:
    """Polach: tau (2/pi) [g/(1 + g^2) + arctan g], g = slip/(0.004 strength)."""
    if strength <= 0:
        return c
    grip = c.sliding / c.entrainment / (0.004 * strength)
    return replace(c, stress=c.stress * 2 / np.pi * (grip / (1 + grip**2) + np.arctan(grip)))


def contact_creep_carter(c: Contact, strength: float) -> Contact:
    """Carter, a line contact: tau [1 - (1 - slip/S)^2] below the slip S = 0.016 strength, tau beyond it."""
    if strength <= 0:
        return c
    sticking = np.maximum(1 - c.sliding / c.entrainment / (0.016 * strength), 0.0)
    return replace(c, stress=c.stress * (1 - sticking**2))


HEATING = partial(Form, "film_heating", "shear")
LIMIT = partial(Form, "limiting_shear_stress", "shear")
CREEP = partial(Form, "contact_creep", "shear", rarity=0.5)
EFFECTS = (
    HEATING(film_heating, (strength(0.0, 4.0, (0.5, 1.2)),), "Crook 1961, Archard 1959"),
    HEATING(film_heated_alone, (strength(0.0, 12.0, (0.5, 2.0)),), "Archard 1959, film alone"),
    HEATING(walls_heated_alone, (strength(0.0, 6.0, (0.5, 1.5)),), "Blok 1937, walls alone"),
    HEATING(film_heated_in_layers, (strength(0.0, 20.0, (0.7, 3.0)),), "Nahme 1940, Crook 1961"),
    LIMIT(limiting_shear_stress, (strength(0.0, 3.0, (0.6, 1.3)),), "Bair and Winer 1979"),
    LIMIT(limiting_stress_in_hot_oil, (strength(0.0, 3.0, (0.6, 1.3)), Knob("fall", 0.0, 0.006, (0.002, 0.006))),
          "Gecim and Winer 1980, falling with temperature", holds="-20 to 150 C"),
    LIMIT(limiting_stress_cut, (strength(0.0, 3.0, (1.6, 2.8)),), "cut off at the limit, Evans and Johnson 1986",
          within=True),
    LIMIT(limiting_stress_with_offset, (strength(0.0, 3.0, (0.6, 1.3)), Knob("offset", 0.0, 1.0, (0.1, 0.45))),
          "Johnson and Tevaarwerk 1977, tau_0 + gamma p"),
    Form("coating_insulation", "shear", coating_insulation, (strength(0.0, 6.0, (0.7, 1.5)),),
         "series resistance with thermal lag", rarity=0.6),
    CREEP(contact_creep, (strength(0.0, 12.0, (1.0, 4.0)),), "exponential creep law of rolling contact", within=True),
    CREEP(contact_creep_polach, (strength(0.0, 12.0, (1.0, 4.0)),), "Polach 2005"),
    CREEP(contact_creep_carter, (strength(0.0, 12.0, (1.0, 4.0)),), "Carter 1926", within=True),
)  # fmt: skip
