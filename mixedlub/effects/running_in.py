"""Running-in."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform


@effect(
    stage="contact",
    acts_on=("m0", "m2", "m4"),
    parameters=(
        Parameter("strength", "-", LogNormal(0.45, 0.6), "final fall of ln m0", null=0.0, symbol="s"),
        Parameter(
            "rate", "-", LogNormal(3.0, 1.0), "duration of the programme over the time constant of the wear", symbol="k"
        ),
        Parameter("texture", "-", Uniform(0.3, 2.5), "fall of ln m2 and ln m4 relative to that of ln m0", symbol="r"),
    ),
    equation=r"m_0 \leftarrow m_0 e^{-s g},\quad m_{2,4} \leftarrow m_{2,4} e^{-s r g},\quad g = 1 - e^{-k q}",
    source="I. V. Kragelsky, M. N. Dobychin, V. S. Kombalov, Friction and Wear: Calculation Methods, 1982: exponential "
    "approach to a steady roughness",
    fingerprint={"sequence": "-"},
    separated_by="the first point repeated at the end: running-in does not come back, temperature drift does; the "
    "profile measured again settles it",
)
def running_in(
    m0: np.ndarray,
    m2: np.ndarray,
    m4: np.ndarray,
    sequence: np.ndarray,
    *,
    strength: float,
    rate: float,
    texture: float,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Surface roughness wears smoother during the programme, fast at first.

    >>> m0, m2, _ = running_in(1.0, 1.0, 1.0, 1.0, strength=0.45, rate=30.0, texture=1.6)
    >>> round(float(m0), 2), round(float(m2), 2)   # Rq x 0.8, slopes and curvatures x 0.7
    (0.64, 0.49)
    """
    settled = strength * -np.expm1(-rate * sequence)
    heights, texture_left = np.exp(-settled), np.exp(-texture * settled)
    return m0 * heights, m2 * texture_left, m4 * texture_left
