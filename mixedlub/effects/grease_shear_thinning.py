"""Viscous drag of a drive that grows less than linearly with speed."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, LogUniform


@effect(
    stage="shear",
    acts_on="viscous_torque",
    parameters=(
        Parameter(
            "deficit", "-", LogNormal(0.35, 0.35), "one minus the flow index of the grease", null=0.0, symbol="d"
        ),
        Parameter(
            "knee",
            "-",
            LogUniform(1e-3, 1.0),
            "speed at which thinning begins, as a share of the reference speed",
            symbol="k",
            relative_to="reference_speed",
        ),
    ),
    equation=r"T_v \leftarrow T_v\left[\frac{x^2 + k^2}{1 + k^2}\right]^{-d/2},\quad "
    r"x = \max(|\omega/\omega_0|,\ 10^{-6})",
    source="P. J. Carreau, Trans. Soc. Rheol. 16 (1972) 99, with one time constant; k = 0 is the power law of "
    "W. H. Herschel, R. Bulkley, Kolloid-Z. 39 (1926) 291",
    special_cases={"Herschel and Bulkley": {"knee": 0.0}},
    fingerprint={"speed": "-"},
    separated_by="speeds over two decades: the drag grows with a power below one and has no minimum as "
    "Stribeck friction",
    kinds=("friction_map",),
)
def grease_shear_thinning(
    viscous_torque: np.ndarray, drive_speed: np.ndarray, reference_speed: np.ndarray, *, deficit: float, knee: float
) -> np.ndarray:
    """Grease thins under shear; its drag grows with speed to an exponent below one.

    Below the knee its viscosity is constant, as for an Eyring fluid. A deficit near one means drag that hardly grows
    with speed, which is Coulomb friction and not grease.

    >>> round(float(grease_shear_thinning(1.0, 25.0, 100.0, deficit=0.5, knee=0.0)), 3)
    2.0
    >>> round(float(grease_shear_thinning(1.0, 0.0, 100.0, deficit=0.5, knee=0.25)), 3)   # (1 + 16)^(1/4)
    2.031
    """
    share = np.maximum(np.abs(drive_speed) / reference_speed, 1e-6)
    return viscous_torque * ((share**2 + knee**2) / (1.0 + knee**2)) ** (-0.5 * deficit)
