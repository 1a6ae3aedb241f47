"""Windage of a wheel after Dawson."""

import numpy as np

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law


@part_law(
    "windage",
    "dawson",
    "Dawson",
    sources=0,
    status="constants as quoted in reviews, not confirmed by the paper; within a factor 1.6 of the other laws",
    coefficients=(
        Coefficient("oil_mist", "-", "Phi, factor of oil in the air; 1 in clean air", 1.0),
        Coefficient("space", "-", "lambda, factor of the space around the wheel; 1 of a free wheel", 1.0),
    ),
)
def windage_dawson(
    root_diameter: np.ndarray,
    shaft_speed: np.ndarray,
    face_width: np.ndarray,
    gear_module: np.ndarray,
    *,
    oil_mist: float,
    space: float,
) -> np.ndarray:
    r"""Power of a wheel against air (W), with the cube of speed nearly.

    .. math:: P = 10^{-17} n^{2.9}\left(0.16 D^{3.9} + D^{2.9} b^{0.75} m^{1.15}\right)\Phi\lambda

    with n in rpm and root diameter D, face width b and module m in mm; not for D below about 100 mm.

    Source: P. H. Dawson, Proc. IMechE A 198 (1984) 51.

    >>> round(float(windage_dawson(0.090, 10_000 * np.pi / 30, 0.020, 4e-3, oil_mist=1.0, space=1.0)))
    113
    """
    speed, root, face, size = shaft_speed * 30.0 / np.pi, root_diameter * 1e3, face_width * 1e3, gear_module * 1e3
    shape = 0.16 * root**3.9 + root**2.9 * face**0.75 * size**1.15
    return 1e-17 * speed**2.9 * shape * oil_mist * space
