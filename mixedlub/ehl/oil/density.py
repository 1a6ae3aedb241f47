"""Density over that at ambient pressure and the known temperature, with its slopes in pressure and temperature."""

from __future__ import annotations

import numpy as np

from mixedlub.ehl.oil.oil import Slopes

COMPRESSION, STIFFENING = 0.6e-9, 1.7e-9
"""Constants of Dowson and Higginson for mineral oil (1/Pa)."""


def dowson_higginson(
    pressure: np.ndarray, temperature: np.ndarray, known_temperature: float, expansion: float
) -> Slopes:
    r"""Relative density by Dowson and Higginson, with thermal expansion.

    .. math:: \bar\rho = \left(1 + \frac{0.6\,p}{1 + 1.7\,p}\right)[1 - \beta_\rho (T - T_0)],\quad p\ \text{in GPa}

    Source: D. Dowson, G. R. Higginson, Elastohydrodynamic Lubrication (1966).

    >>> round(float(dowson_higginson(1e9, 313.15, 313.15, 6.5e-4)[0]), 4)
    1.2222
    """
    stiff = 1.0 + STIFFENING * pressure
    squeezed, warm = 1.0 + COMPRESSION * pressure / stiff, 1.0 - expansion * (temperature - known_temperature)
    return squeezed * warm, COMPRESSION / stiff**2 * warm, -expansion * squeezed


def incompressible(pressure: np.ndarray, temperature: np.ndarray) -> Slopes:
    """Relative density of an incompressible oil: one. Source: definition.

    >>> float(incompressible(1e9, 313.15)[0])
    1.0
    """
    one = np.ones(np.broadcast_shapes(np.shape(pressure), np.shape(temperature)))
    return one, 0.0 * one, 0.0 * one
