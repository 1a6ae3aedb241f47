"""Film-stage effects: inlet heat, starvation, inlet shear thinning, roughness lay."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from mixedlub.validation.contact import Contact
from mixedlub.validation.rig import Form, Knob, strength

SUPPLY_LIMIT = 0.05
INLET_RATE = 2e7


def inlet_shear_heating(c: Contact, strength: float) -> Contact:
    """Inlet shear warms the oil (Murch-Wilson): h 3.94/(3.94 + L^0.62), L = strength beta eta0 u^2/k."""
    rate = c.rig.oil.thinning_at(c.temperature) * c.viscosity * c.entrainment**2 / c.rig.oil.conductivity
    return replace(c, film=c.film * 3.94 / (3.94 + (strength * rate) ** 0.62))


def heated_by_hsu_lee(c: Contact, strength: float) -> Contact:
    """Loss that grows with pressure and slip: h/(1 + 0.0766 G^0.687 W^0.447 L^0.527 e^(0.875 S)), L as in Murch-Wilson.

    G = alpha E', W the load a width over E' R, S the slide-roll ratio, 2 at most; a fit to line contacts of oils at
    rolling speeds of m/s. The constants are from memory, not checked against the paper.
    """
    modulus = c.rig.solid.reduced
    load = c.line_load / (modulus * c.rig.radius)
    rate = c.rig.oil.thinning_at(c.temperature) * c.viscosity * c.entrainment**2 / c.rig.oil.conductivity
    loading = (c.pressure_viscosity * modulus) ** 0.687 * load**0.447 * (strength * rate) ** 0.527
    slip = np.minimum(c.sliding / c.entrainment, 2.0)
    return replace(c, film=c.film / (1 + 0.0766 * loading * np.exp(0.875 * slip)))


def starvation(c: Contact, strength: float, steepness: float) -> Contact:
    """Oil flows back too slowly above a limit of eta u: h (1 + r^4)^(-k/4), r = strength eta u/(0.05 Pa m).

    Replenishment group eta u of Cann, with a power-law fall beyond the limit and no fall below it.
    """
    over = strength * c.viscosity * c.entrainment / SUPPLY_LIMIT
    return replace(c, film=c.film * (1 + over**4) ** (-0.25 * steepness))


def starved_by_meniscus(c: Contact, strength: float, distance: float) -> Contact:
    """Hamrock-Dowson meniscus: h (m/m*)^0.29 below m* = 3.06 [(R/b)^2 H]^0.58, m in contact half widths."""
    flooded = 3.06 * ((c.rig.radius / c.half_width) ** 2 * c.film / c.rig.radius) ** 0.58
    share = (1 + distance) / np.maximum(strength, 1e-6) / (1 + flooded)
    return replace(c, film=c.film * np.minimum(share, 1.0) ** 0.29)


def inlet_shear_thinning(c: Contact, strength: float, plateau: float) -> Contact:
    """Polymer-thickened oil in the inlet: Cross fall to a second plateau, h times (eta/eta0)^0.69.

    The inlet shear rate is u/h of the Newtonian film; at 2e7 1/s, strength 1 has half the fall.
    """
    rate = strength * c.entrainment / (c.film * INLET_RATE)
    effective = plateau + (1 - plateau) / (1 + rate**0.8)
    return replace(c, film=c.film * effective**0.69)


def roughness_lay(c: Contact, strength: float) -> Contact:
    """Lay across (+) or along (-) the flow: h (1 + s q/(1 + q)), q = 0.15 (sigma/h)^1.2.

    Saturating empirical form; the exponent lies between the first- and second-order roughness expansions.
    """
    close = 0.15 * (c.roughness / c.film) ** 1.2
    return replace(c, film=c.film * (1 + strength * close / (1 + close)))


def _heat(c: Contact, speed: np.ndarray) -> np.ndarray:
    """Thermal loading beta eta0 u^2/k."""
    return np.asarray(c.rig.oil.thinning_at(c.temperature) * c.viscosity * speed**2 / c.rig.oil.conductivity)


def _slip(c: Contact) -> np.ndarray:
    return np.asarray(c.sliding / c.entrainment)


def heated_at_rolling_sum(c: Contact, strength: float) -> Contact:
    """h/(1 + 0.1 (1 + 14.8 V^0.83) L^0.64), L = strength beta eta0 (u1 + u2)^2/k, V the slide over the sum of speeds.

    As in public programs; with the mean speed the constant is 0.24.
    """
    loading = strength * _heat(c, 2 * c.entrainment)
    return replace(c, film=c.film / (1 + 0.1 * (1 + 14.8 * (0.5 * _slip(c)) ** 0.83) * loading**0.64))


def heated_under_pressure(c: Contact, strength: float) -> Contact:
    """h (1 - 13.2 (p0/E') L^0.42)/(1 + 0.213 (1 + 2.23 S^0.83) L^0.64), L = strength beta eta0 u^2/k, a tenth at least.

    Zhu and Cheng, in Zhou and Hoeprich, J. Tribol. 113 (1991) 590, eq. 21, and Gupta et al. 1992; S: slide-roll ratio.
    """
    loading = strength * _heat(c, c.entrainment)
    rolling = np.maximum(1 - 13.2 * c.pressure / c.rig.solid.reduced * loading**0.42, 0.1)
    return replace(c, film=c.film * rolling / (1 + 0.213 * (1 + 2.23 * _slip(c) ** 0.83) * loading**0.64))


def starved_in_wide_contacts(c: Contact, strength: float, steepness: float) -> Contact:
    """h (1 + r^4)^(-k/4), r = strength (eta u/(0.05 Pa m)) (b/100 um), as the degree of starvation eta u b/(h sigma).

    A wide contact takes longer to refill; b is its half width, h the layer, sigma the surface tension.
    """
    over = strength * c.viscosity * c.entrainment / SUPPLY_LIMIT * c.half_width / 1e-4
    return replace(c, film=c.film * (1 + over**4) ** (-0.25 * steepness))


def starved_by_layer(c: Contact, strength: float, sharpness: float) -> Contact:
    """Chevalier: a layer of oil on the track feeds the contact, h = r h/(1 + r^g)^(1/g), r = layer over h."""
    if strength <= 0:
        return c
    ratio = 0.6e-6 / strength / c.film
    return replace(c, film=c.film * ratio / (1 + ratio**sharpness) ** (1 / sharpness))


def thinned_by_carreau(c: Contact, strength: float, index: float) -> Contact:
    """Carreau in the inlet: (1 + (rate/2e6 1/s)^2)^((n - 1)/2) to the power 0.67, rate = u/h."""
    rate = strength * c.entrainment / (c.film * 2e6)
    return replace(c, film=c.film * (1 + rate**2) ** (0.335 * (index - 1)))


def thinned_by_eyring(c: Contact, strength: float) -> Contact:
    """Eyring oil in the inlet: (asinh x/x)^0.67, x = eta0 u/(h tau), tau = 50 kPa over the strength."""
    rate = np.maximum(strength * c.viscosity * c.entrainment / (c.film * 5e4), 1e-9)
    return replace(c, film=c.film * (np.arcsinh(rate) / rate) ** 0.67)


def thinned_by_bair(c: Contact, strength: float, index: float) -> Contact:
    """h [1 + 0.79 ((1 + S) N)^(1/(1 + 0.2 S))]^(-3.6 (1 - n)^1.7), N = strength eta0 u/(h 50 kPa).

    S is the slide-roll ratio, n the power-law index of the oil.
    """
    slip = _slip(c)
    group = (1 + slip) * strength * c.viscosity * c.entrainment / (c.film * 5e4)
    return replace(c, film=c.film * (1 + 0.79 * group ** (1 / (1 + 0.2 * slip))) ** (-3.6 * (1 - index) ** 1.7))


FLOW_EXPONENT = 0.69
"""Exponent of viscosity in the film law: a flow factor acts in the inlet as a divisor of viscosity."""


def lay_of_flow_factors(c: Contact, strength: float) -> Contact:
    """h phi^-0.69, phi = 1 - 1.18 s e^(-0.42 H) across the flow, 1 + 0.225 |s| H^-1.5 along it (s < 0), H = h/sigma.

    Patir and Cheng's pressure flow factors of ridges three times as long as wide; constant below H = 1.
    """
    height = np.maximum(c.film / c.roughness, 1.0)
    across, along = 1 - 1.18 * max(strength, 0.0) * np.exp(-0.42 * height), 0.225 * max(-strength, 0.0) * height**-1.5
    return replace(c, film=c.film * (across + along) ** -FLOW_EXPONENT)


def lay_by_perturbation(c: Contact, strength: float) -> Contact:
    """h phi^-0.69, phi = 1/(1 + 6 s/H^2) of ridges across the flow, 1 + 3 |s|/H^2 along it (s < 0), H = h/sigma.

    Tripp's first order 1 - 3 ((2 - g)/(1 + g))/H^2 at ridges without end; the form across the flow is bounded.
    """
    close = (c.roughness / c.film) ** 2
    opened = 6 * max(strength, 0.0) * close - 3 * max(-strength, 0.0) * close
    return replace(c, film=c.film * np.where(opened < 0, 1 / (1 - opened), 1 + opened) ** FLOW_EXPONENT)


_LIMITED = strength(0.0, 60.0, (0.5, 3.0))
HEATED = partial(Form, "inlet_shear_heating", "film")
STARVED = partial(Form, "starvation", "film")
THINNED = partial(Form, "inlet_shear_thinning", "film")
LAY = partial(Form, "roughness_lay", "film")
EFFECTS = (
    HEATED(inlet_shear_heating, (strength(0.0, 12.0),), "Murch and Wilson 1975"),
    HEATED(heated_by_hsu_lee, (strength(0.0, 12.0),), "Hsu and Lee 1994"),
    HEATED(heated_under_pressure, (strength(0.0, 8.0),), "Zhu and Cheng 1989", holds="L up to 300"),
    HEATED(heated_at_rolling_sum, (strength(0.0, 6.0, (0.2, 0.8)),), "Wilson and Sheu 1983"),
    STARVED(starvation, (strength(0.0, 30.0, (0.7, 2.5)), Knob("steepness", 0.25, 0.9, (0.35, 0.8))),
            "Cann, Damiens and Lubrecht 2004, replenishment group", within=True),
    STARVED(starved_in_wide_contacts, (strength(0.0, 60.0, (0.7, 2.5)), Knob("steepness", 0.25, 0.9, (0.35, 0.8))),
            "Cann, Damiens and Lubrecht 2004, degree of starvation"),
    STARVED(starved_by_meniscus, (strength(0.0, 12.0, (0.8, 2.0)), Knob("distance", 0.05, 3.0, (0.3, 1.5))),
            "Hamrock and Dowson 1977", holds="meniscus nearer than m*"),
    STARVED(starved_by_layer, (strength(0.0, 60.0, (0.7, 3.0)), Knob("sharpness", 1.5, 6.0, (2.0, 5.0))),
            "Chevalier et al. 1998", holds="g 2 to 5"),
    THINNED(inlet_shear_thinning, (strength(0.0, 30.0, (0.7, 3.0)), Knob("plateau", 0.3, 0.85, (0.45, 0.75))),
            "Cross with a second Newtonian plateau"),
    THINNED(thinned_by_carreau, (_LIMITED, Knob("index", 0.4, 0.95, (0.6, 0.85))), "Carreau 1972"),
    THINNED(thinned_by_eyring, (strength(0.0, 60.0, (0.5, 2.0)),), "Eyring 1936"),
    THINNED(thinned_by_bair, (_LIMITED, Knob("index", 0.6, 0.95, (0.65, 0.9))), "Bair 2005", within=True,
            holds="n above 0.6, N up to 30"),
    LAY(roughness_lay, (strength(-0.9, 3.0, (0.5, 1.5)),), "saturating lay factor after Zhu and Cheng 1988"),
    LAY(lay_of_flow_factors, (strength(-4.0, 0.98, (0.3, 0.8)),), "Patir and Cheng 1978", holds="H above 1"),
    LAY(lay_by_perturbation, (strength(-2.0, 2.0, (0.1, 0.5)),), "Tripp 1983", within=True, holds="H above 3"),
)  # fmt: skip

OF_HISTORIES = tuple(form for form in EFFECTS if form.id != "roughness_lay")
"""Forms for friction histories."""

OF_LOCAL_CONTACTS = tuple(replace(form, within=form.within or form.law is thinned_by_carreau) for form in OF_HISTORIES)
"""Forms for films and tooth contacts, including thinning with an onset as sharp as Carreau's."""
