"""A ball on a disc, and film laws in other published forms: shared by films, histories and tooth contacts."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.validation.build import oil_of
from mixedlub.validation.planted import film as film_room
from mixedlub.validation.planted.kinds import Knob, strength
from mixedlub.validation.rig import Contact, Rig, Solid, lubricate, mix, press, shear, touch
from mixedlub.validation.rigs.stage import Chain, Form, borrowed

CIRCULAR, SPEED_EXPONENT = 1.03, 0.67


def ball_rig(settings: Mapping[str, Any], columns: Mapping[str, np.ndarray], moments: np.ndarray) -> Rig:
    """The rig of a ball on a flat disc; ``moments`` are those of both surfaces together, in SI."""
    contact = settings["contact"]
    count = len(columns["run"])
    speed = columns["entrainment_speed_m_s"].astype(float)[:, None]
    half = 0.5 * columns["slide_roll_ratio"].astype(float)[:, None] * speed
    return Rig(
        kind="disc",
        oil=oil_of(settings),
        solid=Solid(tuple(1e9 * e for e in contact["youngs_modulus_GPa"]), tuple(contact["poisson_ratio"])),
        radius=np.array([[1e-3 * contact["radius_mm"][0]]]),
        speed_1=speed + half,
        speed_2=speed - half,
        share_force=columns["load_N"].astype(float)[:, None],
        width=1.0,
        step=1.0,
        temperature=columns["oil_temperature_C"].astype(float),
        moments=np.broadcast_to(moments, (count, 3)),
        sequence=columns["sequence"].astype(float),
        conditions=dict(columns),
    )


def press_ball(c: Contact) -> Contact:
    """Hertz circle: a = (3 F R/(2 E'))^(1/3), p0 = 3 F/(2 pi a^2); the line load is the mean F/(2 a)."""
    size = np.cbrt(1.5 * c.force * c.rig.radius / c.rig.solid.reduced)
    pressure = 1.5 * c.force / (np.pi * size**2)
    return replace(c, pressure=pressure, half_width=size, line_load=c.force / (2 * size))


def lubricate_ball(c: Contact) -> Contact:
    """Hamrock-Dowson central film of a circle: 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k)) R."""
    modulus, radius = c.rig.solid.reduced, c.rig.radius
    speed = c.viscosity * c.entrainment / (modulus * radius)
    load = c.force / (modulus * radius**2)
    shape = 2.69 * (1 - 0.61 * np.exp(-0.73 * CIRCULAR))
    coefficient = (c.pressure_viscosity * modulus) ** 0.53
    return replace(c, film=radius * shape * speed**SPEED_EXPONENT * coefficient * load**-0.067)


def ball_film_between(c: Contact, way: float, change: float, middle: float) -> Contact:
    """On the way to the law of all regimes, with another exponent of speed about a viscosity times speed (Pa m)."""
    regression, regimes = lubricate_ball(c).film, lubricate_ball_in_any_regime(c).film
    turned = (c.viscosity * c.entrainment / middle) ** change
    return replace(c, film=regression ** (1 - way) * regimes**way * turned)


def lubricate_ball_in_any_regime(c: Contact) -> Contact:
    """Central film of a circle, stiff or soft, isoviscous or not.

    Nijenbanning, Venner and Moes, Wear 176 (1994) 217: the asymptotes rigid-isoviscous, elastic-isoviscous,
    rigid-piezoviscous and elastic-piezoviscous in the groups of Moes (speed as the sum of both), joined by powers.
    """
    modulus, radius = c.rig.solid.reduced, c.rig.radius
    speed = 2 * c.viscosity * c.entrainment / (modulus * radius)
    m = c.force / (modulus * radius**2) * speed**-0.75
    ell = c.pressure_viscosity * modulus * speed**0.25
    rigid = 145 * 1.796 ** (-15 / 7) * m**-2
    elastic = 3.18 * 1.63 ** (-14 / 25) * m ** (-2 / 15)
    rigid_thick = 1.29 * 1.691 ** (-2 / 3) * ell ** (2 / 3)
    elastic_thick = 1.48 * 1.63 ** (-7 / 20) * m ** (-1 / 12) * ell**0.75
    power = 1.5 * (1 + np.exp(-1.2 * elastic / elastic_thick))
    isoviscous = (rigid**1.5 + (elastic**-4 + 1.8**-4) ** -0.375) ** (2 / 3)
    thick = (rigid_thick**-8 + elastic_thick**-8) ** -0.125
    return replace(c, film=radius * np.sqrt(speed) * (isoviscous**power + thick**power) ** (1 / power))


def _film_nm(c: Contact) -> Contact:
    return replace(c, recorded=1e9 * c.film[:, 0])


def _coefficient(c: Contact) -> Contact:
    return replace(c, recorded=c.friction[:, 0])


def ball_film(law: Callable[[Contact], Contact]) -> Chain:
    """The chain of an interferometer whose films follow a law."""
    return (
        ("oil", None),
        ("surface", press_ball),
        ("film", law),
        ("boundary", None),
        ("loss", _film_nm),
        ("sensor", None),
    )


BALL_FRICTION: Chain = (
    ("oil", None),
    ("load", None),
    ("surface", press_ball),
    ("film", lubricate_ball),
    ("contact", touch),
    ("shear", shear),
    ("boundary", None),
    ("friction", mix),
    ("loss", _coefficient),
    ("sensor", None),
)
TOOTH_FRICTION: Chain = (
    ("oil", None),
    ("load", None),
    ("surface", press),
    ("film", lubricate),
    ("contact", touch),
    ("shear", shear),
    ("boundary", None),
    ("friction", mix),
    ("loss", _coefficient),
    ("sensor", None),
)


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


SHARED = ("inlet_shear_heating", "starvation", "inlet_shear_thinning")
FILM_FORMS = (
    *(borrowed(effect) for effect in film_room.EFFECTS if effect.id in SHARED),
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
