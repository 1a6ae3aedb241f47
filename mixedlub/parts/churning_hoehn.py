"""Churning of a wheel in oil after Höhn, Michaelis and Vollmer."""

import numpy as np

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law

_PIVOT = 10.0


@part_law(
    "churning",
    "hoehn",
    "Höhn, Michaelis and Vollmer",
    sources=0,
    status="the form is that of ISO/TR 14179-2; its constants are not confirmed, so that they are yours",
    coefficients=(
        Coefficient("torque_at_rest", "N m", "C_sp C_1, the torque that low speeds tend to"),
        Coefficient("growth", "-", "C_2, exponent of the pitch line speed over 10 m/s"),
    ),
)
def churning_hoehn(
    wheel_radius: np.ndarray, shaft_speed: np.ndarray, *, torque_at_rest: float, growth: float
) -> np.ndarray:
    r"""Power of a wheel that dips into oil (W) by a torque that grows with its pitch line speed.

    .. math:: P = C_{sp} C_1 \exp\left(C_2\,\frac{v_t}{10\,\text{m/s}}\right)\omega

    Source: B.-R. Hoehn, K. Michaelis, T. Vollmer, AGMA 96FTM8, 1996; ISO/TR 14179-2.

    >>> round(float(churning_hoehn(0.1, 100.0, torque_at_rest=0.3, growth=0.4)), 2)   # 0.3 exp(0.4) x 100
    44.75
    """
    return torque_at_rest * np.exp(growth * shaft_speed * wheel_radius / _PIVOT) * shaft_speed
