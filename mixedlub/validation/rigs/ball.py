"""A ball on a flat disc: contact at each reading, pressure, and film by two laws."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.validation.contact import Contact, Inputs, followed, friction_chain, oil_of, solid_of
from mixedlub.validation.rig import Chain

CIRCULAR, SPEED_EXPONENT = 1.03, 0.67
"""Ellipticity parameter of a circle and exponent of speed in the film law of Hamrock and Dowson."""


def inputs_of(settings: Mapping[str, Any], columns: Mapping[str, np.ndarray], moments: np.ndarray) -> Inputs:
    """Contact at each reading; ``moments``: composite moments of both surfaces, in SI units."""
    contact = settings["contact"]
    speed = columns["entrainment_speed_m_s"].astype(float)[:, None]
    half = 0.5 * columns["slide_roll_ratio"].astype(float)[:, None] * speed
    return Inputs(
        oil=oil_of(settings),
        solid=solid_of(contact),
        radius=np.array([[1e-3 * contact["radius_mm"][0]]]),
        speed_1=speed + half,
        speed_2=speed - half,
        share_force=columns["load_N"].astype(float)[:, None],
        width=1.0,
        temperature=columns["oil_temperature_C"].astype(float),
        moments=np.broadcast_to(moments, (len(speed), 3)),
        sequence=columns["sequence"].astype(float),
        conditions=dict(columns),
        is_point=True,
    )


def press_ball(c: Contact) -> Contact:
    """Hertz circle: a = (3 F R/(2 E'))^(1/3), p0 = 3 F/(2 pi a^2); the line load is the mean F/(2 a)."""
    size = np.cbrt(1.5 * c.force * c.rig.radius / c.rig.solid.reduced)
    pressure = 1.5 * c.force / (np.pi * size**2)
    return replace(c, pressure=pressure, half_width=size, line_load=c.force / (2 * size))


def hamrock_dowson(c: Contact) -> Contact:
    """Hamrock-Dowson central film of a circle: 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k)) R."""
    modulus, radius = c.rig.solid.reduced, c.rig.radius
    speed = c.viscosity * c.entrainment / (modulus * radius)
    load = c.force / (modulus * radius**2)
    shape = 2.69 * (1 - 0.61 * np.exp(-0.73 * CIRCULAR))
    coefficient = (c.pressure_viscosity * modulus) ** 0.53
    return replace(c, film=radius * shape * speed**SPEED_EXPONENT * coefficient * load**-0.067)


def ball_film_between(c: Contact, way: float, change: float, middle: float) -> Contact:
    """Film between both laws, with another exponent of speed about a viscosity times speed (Pa m)."""
    regression, regimes = hamrock_dowson(c).film, lubricate_ball_in_any_regime(c).film
    turned = (c.viscosity * c.entrainment / middle) ** change
    return replace(c, film=regression ** (1 - way) * regimes**way * turned)


def lubricate_ball_in_any_regime(c: Contact) -> Contact:
    """Central film of a circle, stiff or soft, isoviscous or not.

    Nijenbanning, Venner and Moes, Wear 176 (1994) 217: the asymptotes rigid-isoviscous, elastic-isoviscous,
    rigid-piezoviscous and elastic-piezoviscous in the groups of Moes (sum of both speeds), joined by powers.
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


def film_chain(law: Callable[[Contact], Contact]) -> Chain:
    """Chain of an interferometer with the film law."""
    return (
        ("oil", None),
        ("surface", press_ball),
        ("film", followed("film", law)),
        ("boundary", None),
        ("loss", _film_nm),
        ("sensor", None),
    )


FRICTION = friction_chain(press_ball, followed("film", hamrock_dowson))
