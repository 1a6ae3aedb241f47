"""Film thickness of smooth, isothermal, fully flooded contacts."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mixedlub.chain.powers import power
from mixedlub.chain.ranges import holds_within
from mixedlub.chain.slots import FILM


class Regression(NamedTuple):
    """A film of line contacts over the radius: a constant times powers of the groups U, G and W."""

    constant: float
    speed: float
    material: float
    load: float


DOWSON_TOYODA = Regression(3.06, 0.69, 0.56, -0.10)
DOWSON_HIGGINSON = Regression(2.65, 0.70, 0.54, -0.13)
RIVALS = {
    "Dowson and Higginson": DOWSON_HIGGINSON,
    "Pan and Hamrock": Regression(2.922, 0.692, 0.470, -0.166),
    "Grubin": Regression(1.95, 8.0 / 11.0, 8.0 / 11.0, -1.0 / 11.0),
}
"""Published regressions of line contacts other than the base law: D. Dowson, Proc. IMechE 182 Pt 3A (1968) 151; P. Pan,
B. J. Hamrock, J. Tribol. 111 (1989) 246, central film; A. N. Grubin (1949), central film."""
POINT_EXPONENT = 0.67
"""Of speed in the regression of Hamrock and Dowson."""
ELLIPTICITY = (1.0, 8.0)
"""For which that regression holds."""
ELASTIC = {"moes_load": (2.0, np.inf)}
"""Range of the films of flattened line contacts. Full solutions are within 13 % of Dowson and Toyoda's incompressible
film there (U 3e-13 to 1e-9, W 3e-5 to 2e-4); below, the law is up to 40 % too thick."""
PIEZOVISCOUS = {"isoviscous_ratio": (0.0, 1.0)}
"""Range of the films of contacts whose pressure thickens the oil: a soft contact has the thicker isoviscous film."""


def _line_groups(
    radius: np.ndarray,
    entrainment_speed: np.ndarray,
    line_load: np.ndarray,
    viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Speed and load parameter of a line contact, U and W."""
    size = reduced_modulus * radius
    return viscosity * entrainment_speed / size, line_load / size


def _film(law: Regression, radius: np.ndarray, material: np.ndarray, speed: np.ndarray, load: np.ndarray) -> np.ndarray:
    """Film thickness by a regression (m)."""
    modulus = power(material, law.material)
    film: np.ndarray = law.constant * modulus * radius * power(speed, law.speed) * power(load, law.load)
    return film


def moes_load(
    radius: np.ndarray,
    entrainment_speed: np.ndarray,
    line_load: np.ndarray,
    viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    r"""Load parameter of Moes for a line contact (-), :math:`M = W (2U)^{-1/2}`; small where film flattens nothing.

    Groups as in `dowson_toyoda`. Source: H. Moes, Wear 159 (1992) 57.

    >>> round(float(moes_load(8.3262e-3, 2.1630, 214.86e3, 0.01489, 226.374e9)), 1)
    19.5
    """
    speed, load = _line_groups(radius, entrainment_speed, line_load, viscosity, reduced_modulus)
    return load / np.sqrt(2.0 * speed)


def isoviscous_ratio(
    radius: np.ndarray,
    entrainment_speed: np.ndarray,
    line_load: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    r"""Film of a soft line contact, whose oil stays thin, over that of a hard one (-).

    .. math:: \frac{2.05\,M^{-1/5}}{1.65\,M^{-1/8} L^{3/4}},\quad M = W(2U)^{-1/2},\ L = G(2U)^{1/4}

    of Moes' groups, here as in `dowson_toyoda`. Above 1 pressure hardly thickens the oil.
    Source: H. Moes, Wear 159 (1992) 57, the elastic asymptotes.

    >>> round(float(isoviscous_ratio(8.3262e-3, 2.1630, 214.86e3, 0.01489, 14.81e-9, 226.374e9)), 3)
    0.207
    """
    speed, load = _line_groups(radius, entrainment_speed, line_load, viscosity, reduced_modulus)
    double = np.sqrt(2.0 * speed)
    thick = power(pressure_viscosity * reduced_modulus * np.sqrt(double), 0.75)
    return 2.05 / 1.65 * power(load / double, -0.075) / thick


@FILM.offers(
    "dowson_toyoda_central", "central film of Dowson and Toyoda (which the paper calls minimum)", ELASTIC | PIEZOVISCOUS
)
def dowson_toyoda(
    radius: np.ndarray,
    entrainment_speed: np.ndarray,
    line_load: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    r"""Central film thickness of a line contact (m).

    .. math:: h = 3.06\, R\, G^{0.56} U^{0.69} W^{-0.10},\quad
              G = \alpha E',\ U = \frac{\eta_0 u}{E' R},\ W = \frac{w}{E' R}

    with the mean speed u and E' = 2/[(1-nu1^2)/E1 + (1-nu2^2)/E2]. Against numerical solutions: within 20 %
    for an incompressible film at U 1e-12 to 1e-10; 9 to 29 % above a compressible one at gear conditions.
    Source: D. Dowson, S. Toyoda, Proc. 5th Leeds-Lyon Symposium, 1979, the central-film formula.

    >>> h = dowson_toyoda(8.3262e-3, 2.1630, 214.86e3, 0.01489, 14.81e-9, 226.374e9)
    >>> round(float(h) * 1e6, 4)
    0.2214
    """
    groups = _line_groups(radius, entrainment_speed, line_load, viscosity, reduced_modulus)
    return _film(DOWSON_TOYODA, radius, pressure_viscosity * reduced_modulus, *groups)


@FILM.offers("dowson_higginson_minimum", "minimum film of Dowson and Higginson", ELASTIC | PIEZOVISCOUS)
def dowson_higginson(
    radius: np.ndarray,
    entrainment_speed: np.ndarray,
    line_load: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    r"""Minimum film thickness of a line contact (m), :math:`2.65\, R\, G^{0.54} U^{0.70} W^{-0.13}`.

    Groups as in `dowson_toyoda`. Within 7 % of numerical solutions (Barus fluid, U 1e-12 to 1e-10).
    Source: D. Dowson, Proc. IMechE 182 Pt 3A (1968) 151.

    >>> h = dowson_higginson(8.3262e-3, 2.1630, 214.86e3, 0.01489, 14.81e-9, 226.374e9)
    >>> round(float(h) * 1e6, 4)
    0.1671
    """
    groups = _line_groups(radius, entrainment_speed, line_load, viscosity, reduced_modulus)
    return _film(DOWSON_HIGGINSON, radius, pressure_viscosity * reduced_modulus, *groups)


@FILM.offers("moes", "film of Moes, for rigid to elastic bodies and constant to rising viscosity")
def moes(
    radius: np.ndarray,
    entrainment_speed: np.ndarray,
    line_load: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    r"""Film of a line contact in all regimes (m): that which carries the flow of an incompressible oil.

    .. math:: h = R\sqrt{2U}\,H(M, L),\quad M = W(2U)^{-1/2},\ L = G(2U)^{1/4}

    Groups as in `dowson_toyoda`, H by `moes_line`. Full solutions give 4.09 at M = 10, L = 6.
    Source: H. Moes, Wear 159 (1992) 57.

    >>> h = moes(1.0, 1e-11, 10.0 * 2e-11**0.5, 1.0, 6.0 * 2e-11**-0.25, 1.0)   # M = 10, L = 6
    >>> round(float(h / 2e-11**0.5), 2)
    4.13
    """
    speed, load = _line_groups(radius, entrainment_speed, line_load, viscosity, reduced_modulus)
    double = np.sqrt(2.0 * speed)
    return radius * double * moes_line(load / double, pressure_viscosity * reduced_modulus * np.sqrt(double))


def ellipticity(radius: np.ndarray | float, transverse_radius: np.ndarray | float) -> np.ndarray:
    r"""Ellipticity of a point contact as the film regressions take it (-), :math:`k = 1.03\,(R_y/R_x)^{0.64}`.

    Source: D. E. Brewe, B. J. Hamrock, J. Lubr. Technol. 99 (1977) 485.

    >>> round(float(ellipticity(0.02, 0.02)), 9)
    1.03
    """
    return np.asarray(1.03 * power(transverse_radius / radius, 0.64))


def point_isoviscous_ratio(
    radius: np.ndarray,
    transverse_radius: np.ndarray,
    entrainment_speed: np.ndarray,
    load: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    """Film of a soft point contact, whose oil stays thin, over that of a hard one (-): H_EI/H_EP of `nijenbanning`.

    Source: G. Nijenbanning, C. H. Venner, H. Moes, Wear 176 (1994) 217, the elastic asymptotes.

    >>> ball = (9.5e-3, 9.5e-3, 0.1, 5.0, 0.28, 18e-9)
    >>> [round(float(point_isoviscous_ratio(*ball, modulus)), 2) for modulus in (226e9, 0.267e9)]   # steel, rubber
    [0.32, 12.85]
    """
    group = 2.0 * viscosity * entrainment_speed / (reduced_modulus * radius)
    soft, thick = _elastic(radius, transverse_radius, group, load, pressure_viscosity, reduced_modulus)
    return soft / thick


def _elastic(
    radius: np.ndarray,
    transverse_radius: np.ndarray,
    group: np.ndarray,
    load: np.ndarray,
    pressure_viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Both elastic asymptotes of `nijenbanning`, isoviscous and piezoviscous, by its speed group."""
    m = load / (reduced_modulus * radius**2) * power(group, -0.75)
    ell = pressure_viscosity * reduced_modulus * power(group, 0.25)
    d = np.asarray(radius / transverse_radius)
    k = 1.0 + 0.006 * np.log(d) + 0.63 * d ** (4 / 7)
    soft = 3.18 * k ** (-14 / 25) * d ** (-1 / 15) * m ** (-2 / 15)
    return soft, 1.48 * k ** (-7 / 20) * d ** (-1 / 24) * m ** (-1 / 12) * power(ell, 0.75)


@holds_within(PIEZOVISCOUS)
def hamrock_dowson(
    radius: np.ndarray,
    transverse_radius: np.ndarray,
    entrainment_speed: np.ndarray,
    load: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    r"""Central film thickness of a point contact (m), entrainment along the direction of ``radius``.

    .. math:: h = 2.69\, R_x\, U^{0.67} G^{0.53} W^{-0.067} (1 - 0.61 e^{-0.73 k}),\quad
              W = \frac{F}{E' R_x^2},\ k = 1.03\,(R_y/R_x)^{0.64}

    Valid for 1 <= k <= 8. Source: B. J. Hamrock, D. Dowson, J. Lubr. Technol. 99 (1977) 264.

    >>> h = hamrock_dowson(9.525e-3, 9.525e-3, 1.0, 20.0, 0.08, 20e-9, 1.17e11)
    >>> round(float(h) * 1e9)
    431
    """
    speed = viscosity * entrainment_speed / (reduced_modulus * radius)
    group = load / (reduced_modulus * radius**2)
    shape = 1.0 - 0.61 * np.exp(-0.73 * ellipticity(radius, transverse_radius))
    modulus = power(pressure_viscosity * reduced_modulus, 0.53)
    return 2.69 * radius * power(speed, POINT_EXPONENT) * modulus * power(group, -0.067) * shape


def hamrock_dowson_soft(
    radius: np.ndarray,
    transverse_radius: np.ndarray,
    entrainment_speed: np.ndarray,
    load: np.ndarray,
    viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    r"""Central film thickness of a soft point contact, whose oil stays thin (m).

    .. math:: h = 7.32\, R_x\, U^{0.64} W^{-0.22} (1 - 0.72 e^{-0.28 k})

    Groups and k as in `hamrock_dowson`. Source: B. J. Hamrock, D. Dowson, J. Lubr. Technol. 100 (1978) 236.

    >>> h = hamrock_dowson_soft(9.5e-3, 9.5e-3, 0.01, 1.0, 0.28938, 2.667e8)
    >>> round(float(h) * 1e9)
    557
    """
    speed = viscosity * entrainment_speed / (reduced_modulus * radius)
    group = load / (reduced_modulus * radius**2)
    shape = 1.0 - 0.72 * np.exp(-0.28 * ellipticity(radius, transverse_radius))
    return 7.32 * radius * power(speed, 0.64) * power(group, -0.22) * shape


def nijenbanning(
    radius: np.ndarray,
    transverse_radius: np.ndarray,
    entrainment_speed: np.ndarray,
    load: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    r"""Central film thickness of a point contact from rigid to soft and from isoviscous to piezoviscous (m).

    .. math:: h = R_x\sqrt{U}\left\{\left[H_{RI}^{3/2} + (H_{EI}^{-4} + H_{00}^{-4})^{-3/8}\right]^{2s/3} +
              (H_{RP}^{-8} + H_{EP}^{-8})^{-s/8}\right\}^{1/s},\quad U = \frac{2\eta_0 u}{E'R_x}

    of Moes' load M = F U^{-3/4}/(E' R_x^2) and L = alpha E' U^{1/4}, with D = R_x/R_y and k = 1 + 0.006 ln D +
    0.63 D^{4/7}: H_RI = 145 (1 + 0.796 D^{14/15})^{-15/7}/(D M^2), H_EI = 3.18 k^{-14/25} D^{-1/15} M^{-2/15},
    H_RP = 1.29 (1 + 0.691 D)^{-2/3} L^{2/3}, H_EP = 1.48 k^{-7/20} D^{-1/24} M^{-1/12} L^{3/4}, H_00 = 1.8/D and
    s = 1.5 [1 + exp(-1.2 H_EI/H_EP)]. Valid for D up to 1. Source: G. Nijenbanning, C. H. Venner, H. Moes, Wear 176
    (1994) 217.

    >>> h = nijenbanning(9.525e-3, 9.525e-3, 1.0, 20.0, 0.08, 20e-9, 1.17e11)
    >>> round(float(h) * 1e9)   # Hamrock and Dowson: 431
    420
    """
    group = 2.0 * viscosity * entrainment_speed / (reduced_modulus * radius)
    m = load / (reduced_modulus * radius**2) * power(group, -0.75)
    ell = pressure_viscosity * reduced_modulus * power(group, 0.25)
    d = np.asarray(radius / transverse_radius)
    rigid = 145.0 * (1.0 + 0.796 * d ** (14 / 15)) ** (-15 / 7) / (d * m**2)
    soft, soft_thick = _elastic(radius, transverse_radius, group, load, pressure_viscosity, reduced_modulus)
    rigid_thick = 1.29 * (1.0 + 0.691 * d) ** (-2 / 3) * power(ell, 2 / 3)
    s = 1.5 * (1.0 + np.exp(-1.2 * soft / soft_thick))
    isoviscous = (rigid**1.5 + (soft**-4 + (1.8 / d) ** -4) ** (-3 / 8)) ** (2 * s / 3)
    return radius * np.sqrt(group) * (isoviscous + (rigid_thick**-8 + soft_thick**-8) ** (-s / 8)) ** (1 / s)


def moes_line(moes_load: np.ndarray, moes_material: np.ndarray) -> np.ndarray:
    r"""Film of a line contact in all regimes, over R sqrt(2U) (-).

    .. math:: H = \left[\left(H_{RI}^{7/3} + H_{EI}^{7/3}\right)^{3s/7} +
              \left(H_{RP}^{-7/2} + H_{EP}^{-7/2}\right)^{-2s/7}\right]^{1/s},\quad
              s = \tfrac15\left(7 + 8 e^{-2 H_{EI}/H_{RI}}\right)

    with H_RI = 3/M, H_RP = 1.287 L^{2/3}, H_EI = 2.621 M^{-1/5} and H_EP = 1.311 M^{-1/8} L^{3/4}. It is the film that
    the volume flow of an incompressible oil has at the mean speed. Valid for M 0.3 to 300 and L 1 to 22 within 7 %.
    Source: H. Moes, Lubrication and Beyond, University of Twente (2000), the line contact.

    >>> round(float(moes_line(0.3, 1.0)), 2)
    10.36
    """
    rigid, viscous = 3.0 / moes_load, 1.287 * power(moes_material, 2.0 / 3.0)
    elastic, piezo = 2.621 * power(moes_load, -0.2), 1.311 * power(moes_load, -0.125) * power(moes_material, 0.75)
    s = (7.0 + 8.0 * np.exp(-2.0 * elastic / rigid)) / 5.0
    isoviscous = (power(rigid, 7.0 / 3.0) + elastic ** (7.0 / 3.0)) ** (3.0 * s / 7.0)
    return (isoviscous + (viscous**-3.5 + piezo**-3.5) ** (-2.0 * s / 7.0)) ** (1.0 / s)


def film_over_contact_width(film_thickness: np.ndarray, hertz_half_width: np.ndarray) -> np.ndarray:
    """Film over the width of its Hertz contact (-), which is for thin and even films.

    >>> round(film_over_contact_width(1e-6, 0.25e-3), 9)
    0.002
    """
    return film_thickness / (2.0 * hertz_half_width)


def between_laws(regression_film: np.ndarray, regime_film: np.ndarray, film_regime: np.ndarray) -> np.ndarray:
    r"""Central film thickness between two laws, :math:`h_r (h_m/h_r)^\kappa` (m).

    >>> round(float(between_laws(400e-9, 500e-9, 0.5)) * 1e9)
    447
    """
    return regression_film * power(regime_film / regression_film, film_regime)


def with_other_exponents(
    law_film: np.ndarray,
    viscosity: np.ndarray,
    entrainment_speed: np.ndarray,
    load: np.ndarray,
    speed_exponent_change: np.ndarray,
    load_exponent_change: np.ndarray,
    middle_flow: np.ndarray,
    middle_load: np.ndarray,
) -> np.ndarray:
    r"""Central film thickness where the exponents of speed and load are not quite those of a law (m).

    .. math:: h = h_l\left(\frac{\eta_0 u}{(\eta_0 u)_m}\right)^{\delta_u}\left(\frac{F}{F_m}\right)^{\delta_F}

    turned about the middle of the recording, with the oil as it is taken before calibration. Regressions differ so:
    for points 0.67 of B. J. Hamrock, D. Dowson (1977) and 0.68 of R. J. Chittenden, D. Dowson, J. F. Dunn, C. M.
    Taylor, Proc. R. Soc. A 397 (1985) 271; for lines -0.10 of Dowson and Toyoda and -0.13 of Dowson and Higginson.

    >>> h = with_other_exponents(200e-9, 0.02, 1.0, 20.0, 0.02, 0.0, 0.002, 20.0)
    >>> round(float(h) * 1e9)   # ten times the middle
    209
    """
    flow = power(viscosity * entrainment_speed / middle_flow, speed_exponent_change)
    return law_film * flow * power(load / middle_load, load_exponent_change)
