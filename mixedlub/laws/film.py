"""Film thickness of smooth, isothermal, fully flooded contacts."""

from __future__ import annotations

import numpy as np

LINE_EXPONENT, POINT_EXPONENT = 0.69, 0.67
LINE_LOAD_EXPONENT, POINT_LOAD_EXPONENT = -0.10, -0.067
"""Of speed and of load in the regressions of Dowson and Toyoda, and of Hamrock and Dowson."""


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
    Source: D. Dowson, A. Toyoda, Proc. 5th Leeds-Lyon Symposium, 1979, the central-film formula.

    >>> h = dowson_toyoda(8.3262e-3, 2.1630, 214.86e3, 0.01489, 14.81e-9, 226.374e9)
    >>> round(float(h) * 1e6, 4)
    0.2214
    """
    speed, load = _line_groups(radius, entrainment_speed, line_load, viscosity, reduced_modulus)
    modulus = (pressure_viscosity * reduced_modulus) ** 0.56
    return 3.06 * modulus * radius * speed**LINE_EXPONENT * load**LINE_LOAD_EXPONENT


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
    speed, load = _line_groups(radius, entrainment_speed, line_load, viscosity, reduced_modulus)
    return 2.65 * (pressure_viscosity * reduced_modulus) ** 0.54 * radius * speed**0.70 * load**-0.13


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
    ellipticity = 1.03 * (transverse_radius / radius) ** 0.64
    shape = 1.0 - 0.61 * np.exp(-0.73 * ellipticity)
    modulus = (pressure_viscosity * reduced_modulus) ** 0.53
    return 2.69 * radius * speed**POINT_EXPONENT * modulus * group**POINT_LOAD_EXPONENT * shape


def with_other_exponents(
    regression_film: np.ndarray,
    viscosity: np.ndarray,
    entrainment_speed: np.ndarray,
    load: np.ndarray,
    speed_exponent_change: np.ndarray,
    load_exponent_change: np.ndarray,
    exponents_cross: np.ndarray,
    middle_flow: np.ndarray,
    middle_load: np.ndarray,
) -> np.ndarray:
    r"""Central film thickness where the exponents of speed and load are not quite those of the regression (m).

    .. math:: h = h_r\,x^{\delta_u + \kappa\ln y}\,y^{\delta_F},\quad
              x = \frac{\eta_0 u}{(\eta_0 u)_m},\ y = \frac{F}{F_m}

    turned about the middle of the readings, so that their level stays. A regression gives one exponent to all
    contacts. Solutions go with speed from 0.6 (soft, isoviscous) to 0.75 (stiff, piezoviscous) by way of M and L of
    Moes, and kappa is 0.011 to 0.014 there; a film that is compressed falls faster with load. Other regressions have
    others: 0.68 and -0.073 in R. J. Chittenden, D. Dowson, J. F. Dunn, C. M. Taylor, Proc. R. Soc. A 397 (1985) 271.
    Source: G. Nijenbanning, C. H. Venner, H. Moes, Wear 176 (1994) 217.

    >>> h = with_other_exponents(200e-9, 0.02, 1.0, 20.0, 0.02, 0.0, 0.0, 0.002, 20.0)
    >>> round(float(h) * 1e9)   # ten times the middle
    209
    """
    flow, loaded = np.log(viscosity * entrainment_speed / middle_flow), np.log(load / middle_load)
    change = (speed_exponent_change + exponents_cross * loaded) * flow + load_exponent_change * loaded
    return regression_film * np.exp(change)
