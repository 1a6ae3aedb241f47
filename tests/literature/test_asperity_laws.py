"""Laws of yielding asperities and of two rough surfaces against their published forms, integrated independently."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from scipy.integrate import dblquad, quad

from mixedlub.laws import two_rough, yielding
from roughness import single_asperity

pytestmark = pytest.mark.literature(
    "W. R. Chang, I. Etsion, D. B. Bogy, J. Tribol. 109 (1987) 257; Y. Zhao, D. M. Maietta, L. Chang, J. Tribol. 122 "
    "(2000) 86; L. Kogut, I. Etsion, J. Appl. Mech. 69 (2002) 657; R. L. Jackson, I. Green, J. Tribol. 127 (2005) 343; "
    "J. A. Greenwood, J. H. Tripp, Proc. IMechE 185 (1970) 625"
)

E_PRIME, HARDNESS, NU = 226.374e9, 6e9, 0.3
E_STAR = E_PRIME / 2.0
K = 0.454 + 0.41 * NU
C = 1.295 * np.exp(0.736 * NU)
SURFACES = [(4.4106e10, 7.8332e-6, 0.48970e-6), (1.2e10, 40e-6, 0.05e-6), (5e9, 15e-6, 1.5e-6)]
"""Density, radius and sigma of summits: plasticity indices 4.7, 0.7 and 6."""
GAPS = (-1.0, 0.1806, 2.0, 5.0)


def onset(radius: float, factor: float, hardness: float = HARDNESS) -> float:
    """Overlap (m) at which the largest pressure of Hertz is ``factor`` times hardness."""
    return (np.pi * factor * hardness / (2.0 * E_STAR)) ** 2 * radius


def hertz(w: float, radius: float) -> tuple[float, float]:
    return np.pi * radius * w, 4.0 / 3.0 * E_STAR * np.sqrt(radius) * w**1.5


def chang_etsion_bogy(w: float, radius: float) -> tuple[float, float]:
    """Source: Chang, Etsion, Bogy 1987, eq. 9 to 11."""
    first = onset(radius, K)
    if w < first:
        return hertz(w, radius)
    area = np.pi * radius * w * (2.0 - first / w)
    return area, K * HARDNESS * area


def zhao_maietta_chang(w: float, radius: float) -> tuple[float, float]:
    """Source: Zhao, Maietta, Chang 2000."""
    first = (3.0 * np.pi * 0.4 * HARDNESS / (4.0 * E_STAR)) ** 2 * radius
    last = 54.0 * first
    if w < first:
        return hertz(w, radius)
    if w > last:
        return 2.0 * np.pi * radius * w, 2.0 * np.pi * radius * w * HARDNESS
    s = (w - first) / (last - first)
    area = np.pi * radius * w * (1.0 - 2.0 * s**3 + 3.0 * s**2)
    mean = HARDNESS - HARDNESS * 0.6 * (np.log(last) - np.log(w)) / (np.log(last) - np.log(first))
    return area, area * mean


def kogut_etsion(w: float, radius: float) -> tuple[float, float]:
    """Source: Kogut, Etsion 2002, eq. 8 to 10."""
    first = onset(radius, K)
    load, area, xi = 2.0 / 3.0 * K * HARDNESS * np.pi * first * radius, np.pi * first * radius, w / first
    if xi < 1.0:
        return hertz(w, radius)
    if xi < 6.0:
        return 0.93 * xi**1.136 * area, 1.03 * xi**1.425 * load
    if xi < 110.0:
        return 0.94 * xi**1.146 * area, 1.40 * xi**1.263 * load
    return 2.0 * np.pi * radius * w, 2.0 * np.pi * radius * w * HARDNESS


def jackson_green(w: float, radius: float, strength: float = HARDNESS / 2.8) -> tuple[float, float]:
    """Source: Jackson, Green 2005, eq. 3, 9, 18, 19, 21."""
    first = onset(radius, C, strength)
    xi, strain = w / first, strength / E_STAR
    if xi < 1.9:
        return hertz(w, radius)
    area = np.pi * radius * w * (xi / 1.9) ** (0.14 * np.exp(23.0 * strain))
    critical = 4.0 / 3.0 * (radius / E_STAR) ** 2 * (0.5 * np.pi * C * strength) ** 3
    hardness = 2.84 * strength * (1.0 - np.exp(-0.82 * (np.sqrt(area / np.pi) / radius) ** -0.7))
    plastic = 4.0 * hardness / (C * strength) * (1.0 - np.exp(-(xi ** (5.0 / 9.0)) / 25.0)) * xi
    return area, critical * (np.exp(-0.25 * xi ** (5.0 / 12.0)) * xi**1.5 + plastic)


LAWS = {law.__name__: law for law in (chang_etsion_bogy, zhao_maietta_chang, kogut_etsion, jackson_green)}
each = pytest.mark.parametrize("name", LAWS)


def summed(law, which, density, radius, sigma, gap):
    """Area or load over nominal area: the published law of one asperity, in metres, over Gaussian summits."""
    d = gap * sigma

    def summand(w):
        return law(w, radius)[which] * np.exp(-0.5 * ((d + w) / sigma) ** 2) / (sigma * np.sqrt(2.0 * np.pi))

    far = sigma * np.sqrt(max(gap, 0.0) ** 2 + 80.0) - d
    limits = [onset(radius, K), onset(radius, C, HARDNESS / 2.8) * 1.9, onset(radius, 0.6)]  # 0.6: 3/2 of 0.4
    kinks = {first * xi for first in limits for xi in (1.0, 6.0, 54.0, 110.0)} | {far * 0.3**k for k in range(12)}
    places = [0.0, *sorted(x for x in kinks | {-d, 2 * sigma - d, -2 * sigma - d} if 0.0 < x < far), far]
    return density * sum(
        quad(summand, a, b, epsabs=0.0, epsrel=1e-10, limit=200)[0] for a, b in itertools.pairwise(places)
    )


@each
@pytest.mark.parametrize("summits", SURFACES, ids=["index 4.7", "index 0.7", "index 6"])
@pytest.mark.parametrize("gap", GAPS)
def test_rough_contact_is_the_published_asperity_over_gaussian_heights(name, summits, gap):
    area = getattr(yielding, f"{name}_area")(np.array(gap), *summits, E_PRIME, HARDNESS)
    pressure = getattr(yielding, f"{name}_pressure")(np.array(gap), *summits, E_PRIME, HARDNESS)
    assert area == pytest.approx(min(summed(LAWS[name], 0, *summits, gap), 1.0), rel=1e-6, abs=0.0)
    assert pressure == pytest.approx(summed(LAWS[name], 1, *summits, gap), rel=1e-6, abs=0.0)


@each
def test_one_asperity_is_the_published_one(name):
    radius = 7.8332e-6
    made = {"jackson_green": lambda: single_asperity.jackson_green(HARDNESS / 2.8 / E_STAR)}
    law = made.get(name, getattr(single_asperity, name))()
    first = {
        "zhao_maietta_chang": (3.0 * np.pi * 0.4 * HARDNESS / (4.0 * E_STAR)) ** 2 * radius,
        "jackson_green": onset(radius, C, HARDNESS / 2.8),
    }.get(name, onset(radius, K))
    for xi in (2.0, 5.0, 20.0, 100.0, 500.0):
        area, load = LAWS[name](xi * first, radius)
        of_hertz = hertz(xi * first, radius)
        assert law.area(np.asarray(xi)) * of_hertz[0] == pytest.approx(area, rel=1e-12)
        assert law.load(np.asarray(xi)) * of_hertz[1] == pytest.approx(load, rel=1e-12)


def test_pieces_of_kogut_and_etsion_miss_each_other_by_what_is_published():
    """The load by 3, 2 and 7 %, the area by 7, 3 and 7 % at 1, 6 and 110 times onset; dimensional form 1.37, 1.87."""
    law = single_asperity.kogut_etsion()
    below, above = (np.array([1.0, 6.0, 110.0]) * side for side in (1 - 1e-9, 1 + 1e-9))
    jumps = {which: 1.0 - getattr(law, which)(below) / getattr(law, which)(above) for which in ("load", "area")}
    assert law.load(above[0]) - 1.0 == pytest.approx(0.03, abs=0.005)
    assert law.area(above[0]) - 1.0 == pytest.approx(-0.07, abs=0.005)
    assert abs(jumps["load"][1:]) == pytest.approx([0.02, 0.07], abs=0.006)
    assert abs(jumps["area"][1:]) == pytest.approx([0.03, 0.07], abs=0.006)
    yielding_part = np.pi * K * HARDNESS / (2.0 * E_STAR)
    for xi, factor, strain, size, power in ((3.0, 1.37, 0.15, 0.575, 1.425), (30.0, 1.87, 0.474, 0.737, 1.263)):
        w, radius = xi * yielding_part**2 * 1e-5, 1e-5
        load = factor * yielding_part**strain * E_STAR * radius**size * w**power
        assert law.load(np.asarray(xi)) * hertz(w, radius)[1] == pytest.approx(load, rel=4e-3)


def test_asperity_of_zhao_maietta_and_chang_has_no_jump():
    law = single_asperity.zhao_maietta_chang()
    for edge in law.edges:
        for factor in (law.area, law.load):
            assert factor(np.asarray(edge * (1 + 1e-9))) == pytest.approx(
                factor(np.asarray(edge * (1 - 1e-9))), rel=1e-7
            )
    assert law.area(np.asarray(1.0)) == law.load(np.asarray(1.0)) == 1.0


def test_hardness_of_jackson_and_green_agrees_with_their_later_form():
    """H_G/S_y = 2.84 - 0.92 [1 - cos(pi a/R)], steel of 1 GPa: the load within 1 % up to 110 times onset."""
    strain = 1e9 / E_STAR
    law = single_asperity.jackson_green(strain)
    for xi in (10.0, 30.0, 110.0):
        radius = 0.5 * np.pi * C * strain * np.sqrt(xi * law.area(xi))
        later = 2.84 - 0.92 * (1.0 - np.cos(np.pi * radius))
        load = np.exp(-0.25 * xi ** (5 / 12)) + 4.0 * later / C * (1.0 - np.exp(-(xi ** (5 / 9)) / 25.0)) / np.sqrt(xi)
        assert law.load(np.asarray(xi)) == pytest.approx(load, rel=0.012)


def test_load_jumps_by_a_half_where_asperities_yield():
    """Mean pressure 2/3 K H before, K H after; the area goes on, to twice that of Hertz."""
    law = single_asperity.chang_etsion_bogy()
    assert law.load(np.asarray(1.0)) == 1.5
    assert law.area(np.array([1.0, 1e9])) == pytest.approx([1.0, 2.0])


PAIR = {"m0": 0.24292e-12, "m2": 0.005, "m4": 7.2e9}


def test_like_surfaces_have_the_published_form():
    """(16 sqrt2 pi/15) (eta beta sigma)^2 sqrt(sigma/beta) E* F_5/2 and pi^2 (eta beta sigma)^2 F_2, at t = 0."""
    one = [PAIR[m] / 2.0 for m in ("m0", "m2", "m4")]
    eta, beta = one[2] / (one[1] * 6.0 * np.pi * np.sqrt(3.0)), 0.375 * np.sqrt(np.pi / one[2])
    alpha = one[0] * one[2] / one[1] ** 2
    sigma = np.sqrt(2.0 * one[0] * (1.0 - 0.896806 / alpha))
    film = 2.0 * 4.0 * np.sqrt(one[0] / (np.pi * alpha))
    packing = (eta * beta * sigma) ** 2
    area = two_rough.two_rough_area_ratio(film, **PAIR, height_share=0.5, slope_share=0.5, curvature_share=0.5)
    assert area == pytest.approx(np.pi**2 * packing * 0.5, rel=1e-6, abs=0.0)
    load = two_rough.two_rough_pressure(
        film, **PAIR, height_share=0.5, slope_share=0.5, curvature_share=0.5, reduced_modulus=E_PRIME
    )
    published = 16.0 * np.sqrt(2.0) * np.pi / 15.0 * packing * np.sqrt(sigma / beta) * E_STAR * 0.6166342
    assert load == pytest.approx(published, rel=1e-6, abs=0.0)


def test_unlike_surfaces_are_the_integral_over_height_and_offset():
    """Spheres whose tops are r apart overlap by r^2/[2(R_1 + R_2)] less and touch as one of R_1 R_2/(R_1 + R_2)."""
    shares = {"height_share": 0.8, "slope_share": 0.6, "curvature_share": 0.3}
    found = two_rough.two_rough_area_ratio(0.3e-6, **PAIR, **shares)
    carried = two_rough.two_rough_pressure(0.3e-6, **PAIR, **shares, reduced_modulus=E_PRIME)
    sides = []
    for part in (lambda s: s, lambda s: 1.0 - s):
        m0, m2, m4 = (PAIR[m] * part(s) for m, s in zip(("m0", "m2", "m4"), shares.values()))
        alpha = m0 * m4 / m2**2
        sides.append(
            (
                m4 / (m2 * 6.0 * np.pi * np.sqrt(3.0)),
                0.375 * np.sqrt(np.pi / m4),
                m0 * (1.0 - 0.896806 / alpha),
                4.0 * np.sqrt(m0 / (np.pi * alpha)),
            )
        )
    (d1, r1, v1, z1), (d2, r2, v2, z2) = sides
    sigma, radius, both = np.sqrt(v1 + v2), r1 * r2 / (r1 + r2), 2.0 * (r1 + r2)
    gap = 0.3e-6 - z1 - z2

    def pairs(of):
        def summand(r, x):
            overlap = x - r**2 / both
            height = np.exp(-0.5 * ((gap + x) / sigma) ** 2) / (sigma * np.sqrt(2.0 * np.pi))
            return d1 * d2 * 2.0 * np.pi * r * of(max(overlap, 0.0)) * height

        far = 10.0 * sigma - gap
        return dblquad(summand, 0.0, far, 0.0, lambda x: np.sqrt(both * x), epsabs=0.0, epsrel=1e-8)[0]

    assert found == pytest.approx(pairs(lambda w: np.pi * radius * w), rel=1e-5)
    assert carried == pytest.approx(pairs(lambda w: 4.0 / 3.0 * E_STAR * np.sqrt(radius) * w**1.5), rel=1e-5)
