"""Flow of a film between sliding surfaces under a pressure gradient, for any law of shear."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.validation.solved.fluid import Fluid
from mixedlub.validation.solved.heat import HEIGHTS, LAYERS, PLACES, SQUARES, Warmth

LEAST_STRESS = 1e3
"""Stress of a pressure gradient (Pa) below which flow is linear in the gradient."""
MOST = 1e12
"""Largest mobility over the Newtonian one."""
FASTEST = 1e150
"""Largest viscosity times shear rate (Pa) of an iteration."""
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(6)
WEIGHTS = 0.5 * WEIGHTS
STEP = 0.001
"""Relative step of derivatives."""


@dataclass(frozen=True)
class Flow:
    """Flow at some places of a film.

    ``stress``: shear stress of the slip (Pa), and ``softness``, its derivative by the logarithm of viscosity.
    ``middle``: shear stress in the middle of the film, the mean of both surfaces.
    ``mobility``: flow against the gradient over it (m4/(N s)), with its exponents in viscosity, film and gradient.
    ``lost``: flow lost to unequal fluidity across the film, over it (m/s). ``rates``: shares of layers in the slip.
    """

    stress: np.ndarray
    softness: np.ndarray
    middle: np.ndarray
    mobility: np.ndarray
    by_viscosity: np.ndarray
    by_film: np.ndarray
    by_gradient: np.ndarray
    lost: np.ndarray
    rates: np.ndarray


def flow(
    fluid: Fluid, pressure: np.ndarray, film: np.ndarray, gradient: np.ndarray, warmth: Warmth, slip: float
) -> Flow:
    """Flow with fluidities averaged across the film, which is exact for a stress that is constant across it.

    The gradient's stress enters by the mean of the rate over the thickness, as in Conry, Wang, Cusano and Vicente,
    J. Tribol. 109 (1987) 648, for Eyring's law.
    """
    thin = np.exp(-fluid.log_viscosity(pressure[:, None], warmth.layers))
    mean, tilt = thin.mean(axis=1), (thin @ HEIGHTS) / LAYERS
    spread = (thin @ SQUARES) / LAYERS - tilt**2 / mean
    push = np.maximum(0.5 * film * np.abs(gradient), LEAST_STRESS)
    newton = abs(slip) / (film * mean)
    stress, more = _sheared(fluid, pressure, newton, push)
    thicker, more_thick = _sheared(fluid, pressure, newton * (1 + STEP), push)
    _, more_pushed = _sheared(fluid, pressure, newton, push * (1 + STEP))
    by_newton, by_push = (np.log(other / more) / np.log1p(STEP) for other in (more_thick, more_pushed))
    stress, thicker = (fluid.law.limited(one, pressure) for one in (stress, thicker))
    slipping = np.sign(slip) * stress
    return Flow(
        slipping,
        (thicker - stress) / STEP,
        slipping - film * gradient * tilt / mean,
        film**3 * spread * more,
        by_newton - 1,
        3 - by_newton + by_push,
        by_push,
        slip * tilt / mean,
        thin / (LAYERS * mean[:, None]),
    )


def heat_shares(fluid: Fluid, pressure: np.ndarray, film: np.ndarray, gradient: np.ndarray, moved: Flow) -> np.ndarray:
    """Shares of the layers in the heat of shear: stress of slip and gradient together, times its rate.

    Where both slip and gradient act, the heat is made on the side where their stresses add.
    """
    stress = moved.middle[:, None, None] + (film * gradient)[:, None, None] * PLACES
    rate = np.clip(fluid.law.rate(stress, pressure[:, None, None]), -FASTEST, FASTEST)
    heat = moved.rates * (stress * rate).mean(axis=-1)
    whole = heat.sum(axis=1, keepdims=True)
    return np.asarray(np.where(whole > 0, heat / np.where(whole > 0, whole, 1.0), moved.rates))


def _sheared(fluid: Fluid, pressure: np.ndarray, newton: np.ndarray, push: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Stress of the slip, and mobility over the Newtonian one, at a wall stress of the gradient."""
    law, across = fluid.law, push[:, None] * POINTS
    stress = law.stress(newton, pressure)
    for _ in range(2):
        rate = law.rate(stress[:, None] + across, pressure[:, None]) @ WEIGHTS
        stress = law.stress(law.rate(stress, pressure) * newton / np.where(rate > 0, rate, 1.0), pressure)
    rates = law.rate(stress[:, None] + across, pressure[:, None])
    return stress, np.minimum(3 * (rates @ (WEIGHTS * POINTS)) / push, MOST)
