"""Plastic asperities."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal
from mixedlub.laws.yielding import yielded_area


@effect(
    stage="contact",
    acts_on="area_ratio",
    parameters=(
        Parameter(
            "strength", "-", LogNormal(1.0, 0.5), "factor on the contact area added by yielding", null=0.0, symbol="c"
        ),
        Parameter("hardness", "Pa", LogNormal(6e9, 0.6), "indentation hardness of the softer flank", symbol="H"),
    ),
    equation=r"P_B \leftarrow \min\left[1,\ P_B + c\,\pi D R_s\sigma_s F_1(t + w_c)\right],\quad "
    r"w_c = \left(\frac{\pi K H}{E'}\right)^2\frac{R_s}{\sigma_s},\ K = 0.577,\quad "
    r"F_1(t) = \int_t^\infty (z - t)\,\frac{e^{-z^2/2}}{\sqrt{2\pi}}\,dz",
    source="W. R. Chang, I. Etsion, D. B. Bogy, J. Tribol. 109 (1987) 257: A = pi R w (2 - w_c/w) above onset",
    fingerprint={"load": "-", "speed": "-", "oil_temperature": "+", "roughness": "+", "slide_roll_ratio": "-"},
    separated_by="profile and hardness before and after: yielding is not undone when the load goes; loss alone cannot "
    "tell it from an error of slope or curvature of the roughness or of the boundary friction",
    valid={"area_ratio": (0.0, 0.3)},
    applied_after=("skewed_heights",),
)
def asperity_plasticity(
    area_ratio: np.ndarray,
    separation: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    reduced_modulus: np.ndarray,
    *,
    strength: float,
    hardness: float,
) -> np.ndarray:
    """Asperities loaded beyond yield deform plastically; their contact area is up to twice the elastic one.

    K = 0.454 + 0.41 nu at nu = 0.3. With E* = E'/2, onset is at the plasticity index
    (E*/H) sqrt(sigma_s/R_s) = (pi K/2) w_c^(-1/2); below 0.6 contacts are elastic, far above 1 plastic.

    >>> elastic = np.pi * 1e-2 * 0.08331547   # F_1(1)
    >>> rough = asperity_plasticity(elastic, 1.0, 1e10, 1e-5, 1e-7, 226e9, strength=1.0, hardness=0.6e9)
    >>> round(float(rough / elastic), 2)   # plasticity index 19
    2.0
    >>> smooth = asperity_plasticity(elastic, 1.0, 1e10, 1e-5, 1e-7, 226e9, strength=1.0, hardness=19e9)
    >>> round(float(smooth / elastic), 2)   # plasticity index 0.6
    1.0
    """
    summits = (summit_density, summit_radius, summit_sigma)
    added = yielded_area(separation, *summits, reduced_modulus, hardness)
    return np.minimum(area_ratio + strength * added, 1.0)
