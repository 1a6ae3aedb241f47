"""Misalignment."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform

_STIFFNESS = 2e10
_REFERENCE = 1e5
QUADRATIC_BELOW = 1e-2
"""Slope of the load below which only its quadratic term counts."""
LEAST_POWER = 1e-5
"""Exponent of load that is treated as zero."""


@effect(
    stage="load",
    acts_on="line_load",
    parameters=(
        Parameter(
            "misalignment", "m", LogNormal(10e-6, 1.0), "gap across the face width without load", null=0.0, symbol="f"
        ),
        Parameter(
            "relief",
            "-",
            Uniform(0.0, 1.0),
            "exponent of load in the tooth deflection: 1 elastic teeth, 0 none",
            symbol="q",
        ),
        Parameter("loss_power", "-", Uniform(0.05, 0.6), "exponent of load in the friction coefficient", symbol="m"),
    ),
    equation=r"w \leftarrow w\left[\frac{(1+x')^{2+m} - (1-x')^{2+m}}{2x'(2+m)}\right]^{1/m}\sqrt{\max(x, 1)},\quad "
    r"x' = \min(x, 1),\quad "
    r"x = \frac{f\,c_\gamma}{2 w_r}\left(\frac{w_r b_w}{F_t}\right)^{q},\quad "
    r"c_\gamma = 20\,\text{GPa},\ w_r = 100\,\text{N/mm}",
    source="ISO 6336-1, face load factor: w(1 +- x) at the ends of the face in full contact, b_cal/b = "
    "[2 F/(b f c_gamma)]^(1/2) in partial, c_gamma = 20 N/(mm um), w_r = 100 N/mm; w^(1+m) averaged over the face",
    fingerprint={"load": "-", "roughness": "-"},
    separated_by="the contact pattern, strain along the face, and a shim that reverses it; it fades with load",
    prior_odds=0.5,
)
def misalignment(
    line_load: np.ndarray,
    transmitted_force: np.ndarray,
    face_width: np.ndarray,
    *,
    misalignment: float,
    relief: float,
    loss_power: float,
) -> np.ndarray:
    """Misaligned flanks touch over part of the face width only, so the load per length is higher.

    The result is the even line load with the same power loss. Teeth modelled as a uniform elastic foundation carry a
    load that is linear along the face. Friction power per length is proportional to w^(1+m): m is 0.17 for the loss of
    the standard gear, less for a friction coefficient independent of load, more where asperity contact begins. The load
    share of a gear program often includes misalignment already. Stiffness and w_r make the form belong to Pa and N/m. A
    relief of 1 holds for elastic teeth; at 0 the contact width is independent of load.

    >>> load = misalignment(2e5, 2000.0, 0.02, misalignment=10e-6, relief=1.0, loss_power=0.5)   # x = 1: 8/2.5^2
    >>> round(float(load) / 2e5, 3)
    1.28
    """
    half_gap_load = 0.5 * misalignment * _STIFFNESS / _REFERENCE
    partial = half_gap_load * (_REFERENCE * face_width / transmitted_force) ** relief
    whole = np.clip(partial, QUADRATIC_BELOW, 1.0)
    given = max(loss_power, LEAST_POWER)
    power = 2.0 + given
    uneven = ((1.0 + whole) ** power - (1.0 - whole) ** power) / (2.0 * power * whole)
    near = (1.0 + given) * partial**2 / 6.0
    rise = np.where(partial < QUADRATIC_BELOW, near, np.log(uneven) / given)
    return line_load * np.exp(rise) * np.sqrt(np.maximum(partial, 1.0))
