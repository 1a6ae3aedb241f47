"""Film-stage effects: inlet heat, starvation, inlet shear thinning, roughness lay."""

from __future__ import annotations

from dataclasses import replace

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
    """Loss that grows with pressure and slip: h/(1 + 0.0766 G^0.687 W^0.447 L^0.527 e^(0.875 S)), L as Murch-Wilson's.

    G = alpha E', W the load a width over E' R, S the slide-roll ratio, 2 at most; a fit to line contacts
    of oils at rolling speeds of m/s. The constants are from memory, not checked against the paper.
    """
    modulus = c.rig.solid.reduced
    load = c.line_load / (modulus * c.rig.radius)
    rate = c.rig.oil.thinning_at(c.temperature) * c.viscosity * c.entrainment**2 / c.rig.oil.conductivity
    loading = (c.pressure_viscosity * modulus) ** 0.687 * load**0.447 * (strength * rate) ** 0.527
    slip = np.minimum(c.sliding / c.entrainment, 2.0)
    return replace(c, film=c.film / (1 + 0.0766 * loading * np.exp(0.875 * slip)))


def starvation(c: Contact, strength: float, steepness: float) -> Contact:
    """Oil flows back too slowly above a limit of eta u: h (1 + r^4)^(-k/4), r = strength eta u/(0.05 Pa m).

    The replenishment group eta u of Cann, with a power-law fall beyond the limit and none below it.
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

    The inlet shear rate is u/h of the Newtonian film; 2e7 1/s is where strength 1 has half the fall.
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
    """1/(1 + 0.1 (1 + 14.8 V^0.83) L^0.64) with L of the sum of speeds, V = slide over that sum."""
    loading = strength * _heat(c, 2 * c.entrainment)
    return replace(c, film=c.film / (1 + 0.1 * (1 + 14.8 * (0.5 * _slip(c)) ** 0.83) * loading**0.64))


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


EFFECTS = (
    Form("inlet_shear_heating", "film", inlet_shear_heating, (strength(0.0, 12.0),), "Murch and Wilson 1975"),
    Form("inlet_shear_heating", "film", heated_by_hsu_lee, (strength(0.0, 12.0),), "Hsu and Lee 1994"),
    Form(
        "starvation",
        "film",
        starvation,
        (strength(0.0, 30.0, (0.7, 2.5)), Knob("steepness", 0.25, 0.9, (0.35, 0.8))),
        "Cann, Damiens and Lubrecht 2004, replenishment group",
        within=True,
    ),
    Form(
        "starvation",
        "film",
        starved_by_meniscus,
        (strength(0.0, 12.0, (0.8, 2.0)), Knob("distance", 0.05, 3.0, (0.3, 1.5))),
        "Hamrock and Dowson 1977",
    ),
    Form(
        "inlet_shear_thinning",
        "film",
        inlet_shear_thinning,
        (strength(0.0, 30.0, (0.7, 3.0)), Knob("plateau", 0.3, 0.85, (0.45, 0.75))),
        "Cross with a second Newtonian plateau",
    ),
    Form(
        "roughness_lay",
        "film",
        roughness_lay,
        (strength(-0.9, 3.0, (0.5, 1.5)),),
        "saturating lay factor after Zhu and Cheng 1988",
    ),
)

OF_LOCAL_CONTACTS = (
    *(form for form in EFFECTS if form.id != "roughness_lay"),
    Form("inlet_shear_heating", "film", heated_at_rolling_sum, (strength(0.0, 6.0, (0.2, 0.8)),), "rolling-sum form"),
    Form(
        "starvation",
        "film",
        starved_by_layer,
        (strength(0.0, 60.0, (0.7, 3.0)), Knob("sharpness", 1.5, 6.0, (2.0, 5.0))),
        "Chevalier et al. 1998",
    ),
    Form(
        "inlet_shear_thinning",
        "film",
        thinned_by_carreau,
        (strength(0.0, 60.0, (0.5, 3.0)), Knob("index", 0.4, 0.95, (0.6, 0.85))),
        "Carreau 1972",
        within=True,
    ),
    Form("inlet_shear_thinning", "film", thinned_by_eyring, (strength(0.0, 60.0, (0.5, 2.0)),), "Eyring 1936"),
)
"""Forms for films, friction histories and tooth contacts, which are read contact by contact."""
