"""Contact-stage effects: skewed heights, plasticity, micro-EHL, running-in, surface defects."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache, partial

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
    """Integral from each height to the maximum height."""
    steps = 0.5 * (HEIGHTS[1] - HEIGHTS[0]) * (values[1:] + values[:-1])
    return np.append(np.cumsum(steps[::-1])[::-1], 0.0)


@lru_cache(maxsize=4096)
def _weibull_table(skewness: float) -> np.ndarray:
    """F_1 of standardised Weibull heights, (k/l) x^(k-1) e^(-x^k) with x from the lowest height, at HEIGHTS."""
    from scipy.optimize import brentq
    from scipy.special import gamma

    def moments(shape: float) -> tuple[float, float, float]:
        first, second, third = (float(gamma(1 + n / shape)) for n in (1, 2, 3))
        spread = np.sqrt(second - first**2)
        return first, spread, (third - 3 * first * spread**2 - first**3) / spread**3

    shape = brentq(lambda k: moments(k)[2] - skewness, 1.0, 60.0)
    mean, spread, _ = moments(shape)
    above = np.maximum(mean + spread * HEIGHTS, 0.0)
    return _from_the_top(np.exp(-(above**shape)))


@lru_cache(maxsize=4096)
def _two_process_table(strength: float) -> np.ndarray:
    """F_1 of the lower of plateau heights N(0, 1) and rough-cut heights N(2/strength, 3), standardised, at HEIGHTS."""
    fine = np.linspace(-24.0, 8.0, 6401)
    below = 1 - ndtr(-fine) * ndtr((2 / strength - fine) / 3)
    share = np.diff(below)
    middle = 0.5 * (fine[1:] + fine[:-1])
    mean = float(share @ middle / share.sum())
    spread = float(np.sqrt(share @ (middle - mean) ** 2 / share.sum()))
    raw = mean + spread * HEIGHTS
    return _from_the_top(ndtr(-raw) * ndtr((2 / strength - raw) / 3))


def _reshaped(c: Contact, overlap_of_heights: np.ndarray) -> Contact:
    """Contact with another distribution of summit heights, given by its F_1 at HEIGHTS."""
    s = summits(c)
    t = (c.film - s.offset) / s.spread
    change = np.interp(t, HEIGHTS, overlap_of_heights - _overlap_table(0.0))
    share = np.pi * s.density * s.radius * s.spread * (overlap(t) + change)
    return replace(c, area=np.clip(share, 0.0, 1.0))


def skewed_heights(c: Contact, strength: float) -> Contact:
    """Plateau-like summits: the Gaussian heights become skew-normal with skewness minus the strength."""
    return _reshaped(c, _overlap_table(-round(float(np.clip(strength, -0.95, 0.95)), 9)))


def skewed_as_weibull(c: Contact, strength: float) -> Contact:
    """Summit heights of Weibull's density (k/l) x^(k - 1) e^(-x^k) with skewness minus the strength.

    Mean and spread stay. Interpolated from the normal density, not a Weibull density, below a strength of 0.05.
    """
    skewness = round(float(np.clip(-strength, -0.95, 0.95)), 9)
    way = min(abs(strength) / 0.05, 1.0)
    return _reshaped(c, _overlap_table(0.0) + way * (_weibull_table(skewness) - _overlap_table(0.0)))


def skewed_by_two_processes(c: Contact, strength: float) -> Contact:
    """A plateau on a rough cut: heights are the lower of N(0, 1) and N(2/strength, 3), mean and spread kept.

    The material ratio on normal paper bends between two lines, as in ISO 13565-3.
    """
    return _reshaped(c, _two_process_table(round(float(min(strength, 0.95)), 9))) if strength > 0.02 else c


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
    """Between first yield and full flow the area rises smoothly from once to twice the area of elastic summits.

    Zhao, Maietta and Chang: pi R w [1 + 3 x^2 - 2 x^3], x = (w - w_1)/(w_2 - w_1) from 0 to 1, w_2 = 54 w_1 and w_1 =
    (3 pi k H/(4 E*))^2 R with k = 0.4, H = 7 GPa over the strength. Summits up to 8 spreads high.
    """
    if strength <= 0:
        return c

    def grown(over: np.ndarray) -> np.ndarray:
        flown = np.minimum((over - 1) / 53, 1.0)
        return flown**2 * (3 - 2 * flown)

    return _yielded(c, 0.6 * np.pi * HARDNESS / strength / c.rig.solid.reduced, grown)


FIRST_YIELD = 0.577 * np.pi * HARDNESS
"""First yield of a sphere below its surface: E' times the root of approach over radius, K = 0.454 + 0.41 nu."""


def yielding_spheres(c: Contact, strength: float) -> Contact:
    """Kogut and Etsion: area over pi R w of 0.93 x^0.136 to x = 6, 0.94 x^0.146 to 110, then 2; x = w/w_c, 1 at least.

    w_c = (pi K H/(2 E*))^2 R with K = 0.577 and H = 7 GPa over the strength.
    """
    if strength <= 0:
        return c

    def grown(over: np.ndarray) -> np.ndarray:
        share = np.where(over < 6, 0.93 * over**0.136, np.where(over < 110, 0.94 * over**0.146, 2.0))
        return np.maximum(share, 1.0) - 1

    return _yielded(c, FIRST_YIELD / strength / c.rig.solid.reduced, grown)


def yielding_with_hardness(c: Contact, strength: float) -> Contact:
    """Jackson and Green: area over pi R w of (x/1.9)^B past x = w/w_c = 1.9, B = 0.14 e^(23 Y/E*), x 110 at most.

    w_c as in Kogut and Etsion; the yield strength Y is H/2.8, and H = 7 GPa over the strength. B is 1 at most.
    """
    if strength <= 0:
        return c
    yielding = HARDNESS / strength / 2.8 / (0.5 * c.rig.solid.reduced)
    steepness = 0.14 * np.exp(min(23 * yielding, 2.0))

    def grown(over: np.ndarray) -> np.ndarray:
        return np.maximum(np.minimum(over, 110.0) / 1.9, 1.0) ** steepness - 1

    return _yielded(c, FIRST_YIELD / strength / c.rig.solid.reduced, grown)


def _yielded(c: Contact, onset: float, grown: Callable[[np.ndarray], np.ndarray]) -> Contact:
    """Contact with summits (to 8 spreads) that spread past the approach ``onset``^2 R by ``grown`` of its multiples."""
    s = summits(c)
    t = (c.film - s.offset) / s.spread
    first = onset**2 * s.radius / s.spread
    low = np.minimum(np.maximum(t + first, -HIGHEST), HIGHEST)
    half = 0.5 * (HIGHEST - low)[..., None]
    height = low[..., None] + half * (1 + NODES)
    pressed = height - t[..., None]
    over = np.maximum(pressed / first[..., None], 1.0)
    more = pressed * grown(over) * np.exp(-0.5 * height**2) / np.sqrt(2 * np.pi)
    extra = np.pi * s.density * s.radius * s.spread * ((half * more) @ WEIGHTS)
    return replace(c, area=np.clip(c.area + extra, 0.0, 1.0))


def _amplitudes(c: Contact, strength: float) -> list[tuple[np.ndarray, np.ndarray]]:
    """Shares of each surface in the three moments, and q = (wave/b) M^(3/4)/L^(1/2) at ``strength`` times its wave."""
    size = c.rig.solid.reduced * c.rig.radius
    speed = 2 * c.viscosity * c.entrainment / size
    load, material = c.line_load / size / np.sqrt(speed), c.pressure_viscosity * c.rig.solid.reduced * speed**0.25
    found = []
    for share in np.moveaxis(c.rig.shares, 1, 0):
        wave = strength * 2 * np.pi * np.sqrt(share[:, 0:1] * c.m0 / (share[:, 1:2] * c.m2))
        found.append((share, wave / c.half_width * load**0.75 / np.sqrt(material)))
    return found


def _pressed(group: np.ndarray) -> np.ndarray:
    """Remaining amplitude of a wave in a line contact, 1/(1 + 0.17 q + 0.03 q^2) (Venner and Lubrecht)."""
    return np.asarray(1 / (1 + 0.17 * group + 0.03 * group**2))


def micro_ehl(c: Contact, strength: float) -> Contact:
    """Waves of each surface are flattened as computed by Venner and Lubrecht for a line contact.

    Amplitude 1/(1 + 0.17 q + 0.03 q^2) with q = (wave/b) M^(3/4)/L^(1/2); the wave of a surface is ``strength`` times 2
    pi Rq/Rdq. Slopes keep half of the change in logarithm, curvatures none, since short waves stay.
    """
    heights, slopes = 0.0, 0.0
    for share, group in _amplitudes(c, strength):
        amplitude = _pressed(group)
        heights, slopes = heights + share[:, 0:1] * amplitude**2, slopes + share[:, 1:2] * amplitude
    return replace(c, m0=c.m0 * heights, m2=c.m2 * slopes)


def micro_ehl_of_one_wave(c: Contact, strength: float) -> Contact:
    """1/(1 + 0.17 q + 0.03 q^2) on heights, slopes and curvatures: one wave a surface (Venner and Lubrecht)."""
    parts = [(share, _pressed(group) ** 2) for share, group in _amplitudes(c, strength)]
    m0, m2, m4 = (sum(share[:, i : i + 1] * left for share, left in parts) for i in range(3))
    return replace(c, m0=c.m0 * m0, m2=c.m2 * m2, m4=c.m4 * m4)


WAVES = np.geomspace(0.1, 10.0, 13)
"""Wave numbers of a self-affine profile over the dominant wave number."""
SELF_AFFINE = WAVES**-1.6
"""Height spectrum a logarithm of the wave number at a Hurst exponent of 0.8."""


def micro_ehl_of_spectrum(c: Contact, strength: float) -> Contact:
    """1/(1 + 0.17 q + 0.03 q^2) wave by wave: long waves of a self-affine profile are flattened, short waves stay.

    Waves from a tenth to ten times the dominant wave, their heights squared as the wave to the power 1.6.
    """
    left = np.zeros(3)
    for share, group in _amplitudes(c, strength):
        kept = _pressed(group[..., None] / WAVES) ** 2
        means = [kept @ weight / weight.sum() for weight in (SELF_AFFINE * WAVES**power for power in (0, 2, 4))]
        left = left + np.stack([share[:, i : i + 1] * mean for i, mean in enumerate(means)], axis=-1)
    return replace(c, m0=c.m0 * left[..., 0], m2=c.m2 * left[..., 1], m4=c.m4 * left[..., 2])


def running_in(c: Contact, strength: float, pace: float) -> Contact:
    """Heights wear off with the logarithm of time: Rq (1 - 0.2 strength ln(1 + s/pace)/ln(1 + 1/pace)).

    Slopes fall with the square, curvatures with the 2.5th power of the same factor (m2 ~ f^4, m4 ~ f^5).
    """
    return _worn(c, 1 - 0.2 * strength * np.log1p(c.rig.sequence / pace) / np.log1p(1 / pace))


def _worn(c: Contact, left: np.ndarray) -> Contact:
    """Heights times a factor of each reading; slopes fall with its square, curvatures with its 2.5th power."""
    left = np.clip(left, 0.2, None)[:, None]
    return replace(c, m0=c.m0 * left**2, m2=c.m2 * left**4, m4=c.m4 * left**5)


def running_in_exponentially(c: Contact, strength: float, pace: float) -> Contact:
    """Heights approach a limit: Rq (1 - 0.2 strength (1 - e^(-s/pace))), slopes as in other forms."""
    return _worn(c, 1 + 0.2 * strength * np.expm1(-c.rig.sequence / pace))


def running_in_and_wear(c: Contact, strength: float, pace: float, steady: float) -> Contact:
    """Rq (1 - 0.2 strength [(1 - k)(1 - e^(-s/pace)) + k s]): wear-in and a share k of ``steady`` wear."""
    worn = (1 - steady) * -np.expm1(-c.rig.sequence / pace) + steady * c.rig.sequence
    return _worn(c, 1 - 0.2 * strength * worn)


def surface_defects(c: Contact, strength: float) -> Contact:
    """Raised scratches touch at any film: P_B becomes a + (1 - a) P_B with a = 0.01 strength."""
    always = 0.01 * strength
    return replace(c, area=always + (1 - always) * c.area)


def surface_burrs(c: Contact, strength: float, height: float) -> Contact:
    """Burrs of exponentially distributed heights: P_B becomes a + (1 - a) P_B, a = 0.02 strength exp(-h/height).

    The contact of exponential heights of Greenwood and Williamson; mean height in micrometres.
    """
    touching = np.minimum(0.02 * strength * np.exp(-c.film / (1e-6 * height)), 1.0)
    return replace(c, area=touching + (1 - touching) * c.area)


def surface_ridges(c: Contact, strength: float, height: float) -> Contact:
    """Ridges left by a tool: P_B becomes a + (1 - a) P_B, a = 0.02 strength times the share of ridges above the film.

    Their heights, in micrometres, are normal about the mean with a scatter of 40 %, unlike exponential heights.
    """
    touching = np.minimum(0.02 * strength * ndtr((1 - c.film / (1e-6 * height)) / 0.4), 1.0)
    return replace(c, area=touching + (1 - touching) * c.area)


SKEWED = partial(Form, "skewed_heights", "contact")
PLASTIC = partial(Form, "asperity_plasticity", "contact")
MICRO = partial(Form, "micro_ehl", "surface")
RUN_IN = partial(Form, "running_in", "surface")
DEFECTS = partial(Form, "surface_defects", "contact", rarity=0.6)
EFFECTS = (
    SKEWED(skewed_heights, (strength(-0.9, 0.94, (0.5, 0.9)),), "skew-normal heights (Azzalini 1985)"),
    SKEWED(skewed_as_weibull, (strength(-0.9, 0.9, (0.5, 0.9)),), "Weibull heights (McCool 2000)"),
    SKEWED(skewed_by_two_processes, (strength(0.0, 0.95, (0.5, 0.9)),),
           "plateau on a rough cut (Leefe 1998, ISO 13565-3)"),
    PLASTIC(asperity_plasticity, (strength(0.0, 12.0, (0.6, 1.6)),), "Chang, Etsion and Bogy 1987", within=True),
    PLASTIC(asperity_elastoplasticity, (strength(0.0, 20.0, (1.5, 4.0)),), "Zhao, Maietta and Chang 2000"),
    PLASTIC(yielding_spheres, (strength(0.0, 20.0, (1.0, 4.0)),), "Kogut and Etsion 2002"),
    PLASTIC(yielding_with_hardness, (strength(0.0, 20.0, (1.0, 4.0)),), "Jackson and Green 2005", holds="x up to 110"),
    MICRO(micro_ehl, (strength(0.0, 12.0, (0.8, 3.0)),),
          "amplitude reduction of Venner and Lubrecht 1994, slopes apart", holds="waves up to half b"),
    MICRO(micro_ehl_of_one_wave, (strength(0.0, 12.0, (0.8, 3.0)),), "Venner and Lubrecht 1994, one wave", within=True,
          holds="waves up to half b"),
    MICRO(micro_ehl_of_spectrum, (strength(0.0, 12.0, (0.8, 3.0)),), "Venner and Lubrecht 1994, wave by wave"),
    RUN_IN(running_in, (strength(0.0, 3.0, (0.6, 1.3)), Knob("pace", 0.02, 1.0, (0.03, 0.3))), "logarithmic wear-in"),
    RUN_IN(running_in_exponentially, (strength(0.0, 3.0, (0.6, 1.3)), Knob("pace", 0.02, 1.0, (0.03, 0.3))),
           "exponential approach, Kragelsky 1982"),
    RUN_IN(running_in_and_wear,
           (strength(0.0, 3.0, (0.6, 1.3)), Knob("pace", 0.02, 0.5, (0.03, 0.2)), Knob("steady", 0.0, 1.0, (0.2, 0.6))),
           "Queener, Smith and Mitchell 1965"),
    DEFECTS(surface_defects, (strength(0.0, 20.0, (0.8, 2.5)),), "constant raised area", within=True),
    DEFECTS(surface_burrs, (strength(0.0, 20.0, (0.8, 2.5)), Knob("height", 0.3, 10.0, (0.6, 3.0))),
            "exponential heights of Greenwood and Williamson 1966"),
    DEFECTS(surface_ridges, (strength(0.0, 20.0, (0.8, 2.5)), Knob("height", 0.3, 10.0, (0.6, 3.0))),
            "ridges of normal heights"),
)  # fmt: skip
