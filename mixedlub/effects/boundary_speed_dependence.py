"""Boundary friction that depends on speed."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogUniform, Normal, Uniform


@effect(
    stage="boundary",
    acts_on="boundary_friction",
    parameters=(
        Parameter(
            "slope",
            "-",
            Normal(0.0, 0.12),
            "exponent of speed; positive with friction modifiers",
            null=0.0,
            symbol=r"\kappa",
        ),
        Parameter(
            "reference",
            "m/s",
            LogUniform(0.01, 10.0),
            "speed at which the stated boundary friction holds",
            symbol="v_r",
        ),
        Parameter(
            "rolling",
            "-",
            Uniform(0.0, 1.0),
            "weight of the rolling speed: 0 sliding speed, 1 rolling speed",
            symbol="a",
        ),
        Parameter(
            "slowest",
            "m/s",
            LogUniform(1e-3, 1.0),
            "speed below which friction no longer changes",
            null=1e-3,
            symbol="v_0",
            kinds=("disc", "mesh_friction", "friction_history"),
        ),
    ),
    equation=r"\mu_B \leftarrow \mu_B\,\left[(v^2 + v_0^2)/(v_r^2 + v_0^2)\right]^{\kappa/2},\quad "
    r"v = v_s^{1-a} u^a",
    source="H. Spikes, Tribol. Lett. 60 (2015) 5: friction grows with the logarithm of speed under adsorbed "
    "films and falls without; written as a small power, which is that logarithm to first order; constant below a speed "
    "as the asinh of H. Eyring, J. Chem. Phys. 4 (1936) 283, for thermally activated shear",
    fingerprint={"load": "-", "oil_temperature": "+", "roughness": "+"},
    separated_by="film ratios below 0.5 at small sliding: friction follows the logarithm of sliding speed where the "
    "film cannot matter; it vanishes at thick films",
)
def boundary_speed_dependence(
    boundary_friction: np.ndarray,
    sliding_speed: np.ndarray,
    entrainment_speed: np.ndarray,
    *,
    slope: float,
    reference: float,
    rolling: float,
    slowest: float,
) -> np.ndarray:
    """Boundary friction rises or falls with the logarithm of speed.

    Publications use the sliding speed or, at a fixed slide-roll ratio, the rolling speed. The speed at which the stated
    value holds is known only to lie within the tested range. Below a speed of at least 1 mm/s, at which thermal motion
    alone shears the layers, friction no longer changes.

    >>> power = dict(slope=0.1, reference=0.1, rolling=0.0)
    >>> grown = boundary_speed_dependence(0.1, 1.0, 2.0, **power, slowest=1e-3)
    >>> round(float(grown), 3)   # a decade above the reference
    0.126
    >>> slow = boundary_speed_dependence(0.1, np.array([1e-3, 1e-2]), 2.0, **power, slowest=0.1)
    >>> slow.round(4).tolist()   # both far below v_0
    [0.0966, 0.0966]
    """
    speed = sliding_speed ** (1.0 - rolling) * entrainment_speed**rolling
    return boundary_friction * ((speed**2 + slowest**2) / (reference**2 + slowest**2)) ** (0.5 * slope)
