"""A part with a torque that its user knows: a pump, a clutch, a sensor, or what a housing adds."""

import numpy as np

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law


@part_law(
    "other",
    "own_torque",
    "Torque of your own",
    sources=0,
    status="no law: the coefficients are yours",
    coefficients=(
        Coefficient("constant", "N m", "torque at low speed", 0.0),
        Coefficient("per_speed", "N m s/rad", "what it grows by with angular speed", 0.0),
        Coefficient("per_speed_squared", "N m s²/rad²", "what it grows by with the square of angular speed", 0.0),
    ),
)
def own_torque(shaft_speed: np.ndarray, *, constant: float, per_speed: float, per_speed_squared: float) -> np.ndarray:
    r"""Torque (N m) as a polynomial of angular speed.

    .. math:: T = T_0 + c\,\omega + d\,\omega^2

    Source: the user.

    >>> round(float(own_torque(100.0, constant=0.5, per_speed=1e-3, per_speed_squared=1e-5)), 9)
    0.7
    """
    return constant + per_speed * shaft_speed + per_speed_squared * shaft_speed**2
