"""Contact-stage effects: skewed heights, plasticity, micro-EHL, running-in, surface defects."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
from scipy.special import ndtr

from mixedlub.validation.contact import Contact, overlap, summits
from mixedlub.validation.rig import Form, Knob, strength

HARDNESS = 7e9


def _shape_of(skewness: float) -> float:
    """Shape a of the skew-normal density with a given skewness (|skewness| < 0.995)."""
    grown = abs(skewness) ** (2 / 3)
    delta = np.sqrt(0.5 * np.pi * grown / (grown + (0.5 * (4 - np.pi)) ** (2 / 3)))
    return float(np.copysign(delta / np.sqrt(max(1 - delta**2, 1e-9)), skewness))


HEIGHTS = np.linspace(-8.0, 8.0, 1601)


@lru_cache(maxsize=4096)
def _overlap_table(skewness: float) -> np.ndarray:
    """F_1 of a standardised skew-normal density at HEIGHTS: twice cumulated by the trapezoid from the top."""
    shape = _shape_of(skewness)
    delta = shape / np.sqrt(1 + shape**2)
    mean, spread = delta * np.sqrt(2 / np.pi), np.sqrt(1 - 2 * delta**2 / np.pi)
    raw = mean + spread * HEIGHTS
    density = 2 * spread * np.exp(-0.5 * raw**2) / np.sqrt(2 * np.pi) * ndtr(shape * raw)
    return _from_the_top(_from_the_top(density))


def _from_the_top(values: np.ndarray) -> np.ndarray:
    """Integral from each height up to the highest."""
    steps = 0.5 * (HEIGHTS[1] - HEIGHTS[0]) * (values[1:] + values[:-1])
    return np.append(np.cumsum(steps[::-1])[::-1], 0.0)


def skewed_heights(c: Contact, strength: float) -> Contact:
    """Plateau-like summits: the Gaussian heights become skew-normal with skewness minus the strength."""
    s = summits(c)
    t = (c.film - s.offset) / s.spread
    skewness = -round(float(np.clip(strength, -0.95, 0.95)), 9)
    change = np.interp(t, HEIGHTS, _overlap_table(skewness) - _overlap_table(0.0))
    share = np.pi * s.density * s.radius * s.spread * (overlap(t) + change)
    return replace(c, area=np.clip(share, 0.0, 1.0))


def asperity_plasticity(c: Contact, strength: float) -> Contact:
    """Summits past first yield spread at constant volume (Chang-Etsion-Bogy): F_1(t) + F_1(t + w_c/sigma).

    w_c = (pi K H/(2 E*))^2 R with K = 0.577, H = 7 GPa over the strength: a soft surface yields at once.
    """
    if strength <= 0:
        return c
    s = summits(c)
    t = (c.film - s.offset) / s.spread
    yielding = (np.pi * 0.577 * HARDNESS / strength / c.rig.solid.reduced) ** 2 * s.radius
    extra = np.pi * s.density * s.radius * s.spread * overlap(t + yielding / s.spread)
    return replace(c, area=np.clip(c.area + extra, 0.0, 1.0))


NODES, WEIGHTS = np.polynomial.legendre.leggauss(48)
HIGHEST = 8.0


def asperity_elastoplasticity(c: Contact, strength: float) -> Contact:
    """Between first yield and full flow the area rises smoothly from once to twice that of elastic summits.

    Zhao, Maietta and Chang: pi R w [1 + 3 x^2 - 2 x^3], x = (w - w_1)/(w_2 - w_1) from 0 to 1, w_2 = 54 w_1 and
    w_1 = (3 pi k H/(4 E*))^2 R with k = 0.4, H = 7 GPa over the strength. Summits up to 8 spreads high.
    """
    if strength <= 0:
        return c
    s = summits(c)
    t = (c.film - s.offset) / s.spread
    first = (0.6 * np.pi * HARDNESS / strength / c.rig.solid.reduced) ** 2 * s.radius / s.spread
    low = np.minimum(np.maximum(t + first, -HIGHEST), HIGHEST)
    half = 0.5 * (HIGHEST - low)[..., None]
    height = low[..., None] + half * (1 + NODES)
    pressed = height - t[..., None]
    flown = np.minimum((pressed / first[..., None] - 1) / 53, 1.0)
    more = pressed * flown**2 * (3 - 2 * flown) * np.exp(-0.5 * height**2) / np.sqrt(2 * np.pi)
    extra = np.pi * s.density * s.radius * s.spread * ((half * more) @ WEIGHTS)
    return replace(c, area=np.clip(c.area + extra, 0.0, 1.0))


def micro_ehl(c: Contact, strength: float) -> Contact:
    """Waves of each surface are pressed flat as Venner and Lubrecht computed for a line contact.

    Amplitude 1/(1 + 0.17 q + 0.03 q^2) with q = (wave/b) M^(3/4)/L^(1/2); the wave of a surface is ``strength`` times
    2 pi Rq/Rdq. Slopes keep half of the change in logarithm, curvatures none, since short waves stay.
    """
    size = c.rig.solid.reduced * c.rig.radius
    speed = 2 * c.viscosity * c.entrainment / size
    load, material = c.line_load / size / np.sqrt(speed), c.pressure_viscosity * c.rig.solid.reduced * speed**0.25
    heights, slopes = 0.0, 0.0
    for share in np.moveaxis(c.rig.shares, 1, 0):
        own_heights, own_slopes = share[:, 0:1], share[:, 1:2]
        wave = strength * 2 * np.pi * np.sqrt(own_heights * c.m0 / (own_slopes * c.m2))
        group = wave / c.half_width * load**0.75 / np.sqrt(material)
        amplitude = 1 / (1 + 0.17 * group + 0.03 * group**2)
        heights, slopes = heights + own_heights * amplitude**2, slopes + own_slopes * amplitude
    return replace(c, m0=c.m0 * heights, m2=c.m2 * slopes)


def running_in(c: Contact, strength: float, pace: float) -> Contact:
    """Heights wear off with the logarithm of time: Rq (1 - 0.2 strength ln(1 + s/pace)/ln(1 + 1/pace)).

    Slopes fall with the square, curvatures with the 2.5th power of the same factor (m2 ~ f^4, m4 ~ f^5).
    """
    worn = np.log1p(c.rig.sequence / pace) / np.log1p(1 / pace)
    left = np.clip(1 - 0.2 * strength * worn, 0.2, None)[:, None]
    return replace(c, m0=c.m0 * left**2, m2=c.m2 * left**4, m4=c.m4 * left**5)


def surface_defects(c: Contact, strength: float) -> Contact:
    """Raised scratches touch whatever the film: P_B becomes a + (1 - a) P_B with a = 0.01 strength."""
    always = 0.01 * strength
    return replace(c, area=always + (1 - always) * c.area)


def surface_burrs(c: Contact, strength: float, height: float) -> Contact:
    """Burrs of exponentially distributed heights: P_B becomes a + (1 - a) P_B, a = 0.02 strength exp(-h/height).

    The contact of exponential heights of Greenwood and Williamson; mean height in micrometres.
    """
    touching = np.minimum(0.02 * strength * np.exp(-c.film / (1e-6 * height)), 1.0)
    return replace(c, area=touching + (1 - touching) * c.area)


def surface_ridges(c: Contact, strength: float, height: float) -> Contact:
    """Ridges that one tool left: P_B becomes a + (1 - a) P_B, a = 0.02 strength of those above the film.

    Their heights, in micrometres, are normal about the mean with a scatter of 40 %, unlike exponential ones.
    """
    touching = np.minimum(0.02 * strength * ndtr((1 - c.film / (1e-6 * height)) / 0.4), 1.0)
    return replace(c, area=touching + (1 - touching) * c.area)


EFFECTS = (
    Form(
        "skewed_heights",
        "contact",
        skewed_heights,
        (strength(-0.9, 0.94, (0.5, 0.9)),),
        "skew-normal heights (Azzalini 1985)",
    ),
    Form(
        "asperity_plasticity",
        "contact",
        asperity_plasticity,
        (strength(0.0, 12.0, (0.6, 1.6)),),
        "Chang, Etsion and Bogy 1987",
        within=True,
    ),
    Form(
        "asperity_plasticity",
        "contact",
        asperity_elastoplasticity,
        (strength(0.0, 20.0, (1.5, 4.0)),),
        "Zhao, Maietta and Chang 2000",
    ),
    Form(
        "micro_ehl",
        "surface",
        micro_ehl,
        (strength(0.0, 12.0, (0.8, 3.0)),),
        "amplitude reduction of Venner and Lubrecht 1994, slopes apart",
    ),
    Form(
        "running_in",
        "surface",
        running_in,
        (strength(0.0, 3.0, (0.6, 1.3)), Knob("pace", 0.02, 1.0, (0.03, 0.3))),
        "logarithmic wear-in",
    ),
    Form(
        "surface_defects",
        "contact",
        surface_defects,
        (strength(0.0, 20.0, (0.8, 2.5)),),
        "constant raised area",
        rarity=0.6,
        within=True,
    ),
    Form(
        "surface_defects",
        "contact",
        surface_burrs,
        (strength(0.0, 20.0, (0.8, 2.5)), Knob("height", 0.3, 10.0, (0.6, 3.0))),
        "exponential heights of Greenwood and Williamson 1966",
        rarity=0.6,
    ),
    Form(
        "surface_defects",
        "contact",
        surface_ridges,
        (strength(0.0, 20.0, (0.8, 2.5)), Knob("height", 0.3, 10.0, (0.6, 3.0))),
        "ridges of normal heights",
        rarity=0.6,
    ),
)
