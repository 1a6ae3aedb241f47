"""Friction after Xu and Kahraman: a regression of EHL solutions."""

import math

import numpy as np

from mixedlub.chain.friction_law import friction_law
from mixedlub.chain.powers import power

B = (-8.916465, 1.03303, 1.036077, -0.354068, 2.812084, -0.100601, 0.752755, -0.390958, 0.620305)


@friction_law(
    "Xu and Kahraman",
    "contact",
    sources=3,
    status="three sources with equal digits; the range of the EHL solutions behind the fit is not verified; oil 75W90",
)
def xu_kahraman(
    hertz_pressure: np.ndarray,
    slide_roll_ratio: np.ndarray,
    entrainment_speed: np.ndarray,
    viscosity: np.ndarray,
    radius: np.ndarray,
    composite_roughness: np.ndarray,
) -> np.ndarray:
    r"""Friction coefficient of a mixed line contact (-), a regression of thermal EHL solutions for a 75W90 oil.

    .. math:: \mu = e^f p_0^{b_2} S^{b_3} u^{b_6} \eta^{b_7} R^{b_8},\quad
              f = b_1 + b_4 x + b_5 e^{-x} + b_9 e^{\sigma},\quad x = S p_0\log_{10}\eta

    p_0 in GPa, S the slide-to-roll ratio, u in m/s, eta in mPa s, R in m, sigma in um rms of both surfaces together;
    b_1 to b_9 are -8.916465, 1.03303, 1.036077, -0.354068, 2.812084, -0.100601, 0.752755, -0.390958, 0.620305.

    Source: H. Xu, A. Kahraman, N. E. Anderson, D. G. Maddock, J. Mech. Des. 129 (2007) 58.

    >>> round(float(xu_kahraman(2e9, 0.5, 5.0, 0.010, 5e-3, 0.07e-6)), 4)
    0.0196
    """
    pressure, eta = hertz_pressure * 1e-9, viscosity * 1e3
    x = slide_roll_ratio * pressure * np.log10(eta)
    f = B[0] + B[3] * x + B[4] * np.exp(-x) + B[8] * np.exp(composite_roughness * 1e6)
    factors = zip((pressure, slide_roll_ratio, entrainment_speed, eta, radius), (1, 2, 5, 6, 7), strict=True)
    return np.exp(f) * math.prod(power(quantity, B[number]) for quantity, number in factors)
