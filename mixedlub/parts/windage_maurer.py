"""Windage of a wheel after Maurer."""

import numpy as np

from mixedlub.chain.part_law import part_law


@part_law("windage", "maurer", "Maurer", sources=1, status="constants as one public program has them")
def windage_maurer(
    wheel_radius: np.ndarray, shaft_speed: np.ndarray, face_width: np.ndarray, gear_module: np.ndarray
) -> np.ndarray:
    r"""Power of a wheel against air (W).

    .. math:: P = 1.37\times10^{-9} v^{1.9} d^{1.6} b^{0.52} m^{0.69}\,\omega

    with the pitch line speed v in m/s and pitch diameter d, face width b and module m in mm.

    Source: J. Maurer, thesis, University of Stuttgart, 1994.

    >>> round(float(windage_maurer(0.050, 10_000 * np.pi / 30, 0.020, 4e-3)))
    52
    """
    speed = shaft_speed * wheel_radius
    torque = (
        1.37e-9 * speed**1.9 * (2e3 * wheel_radius) ** 1.6 * (1e3 * face_width) ** 0.52 * (1e3 * gear_module) ** 0.69
    )
    return torque * shaft_speed
