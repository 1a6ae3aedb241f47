"""Friction that pulsates with the mesh or rotation of a drive."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogUniform, Normal, Uniform


@effect(
    stage="load",
    acts_on="friction_torque",
    parameters=(
        Parameter(
            "cosine",
            "-",
            Normal(0.0, 0.3),
            "amplitude of the cosine of position, relative to T_c",
            null=0.0,
            symbol="a",
            relative_to="coulomb_torque",
        ),
        Parameter(
            "sine",
            "-",
            Normal(0.0, 0.3),
            "amplitude of the sine of position, relative to T_c",
            null=0.0,
            symbol="b",
            relative_to="coulomb_torque",
        ),
        Parameter(
            "turning",
            "-",
            Uniform(0.0, 1.0),
            "share that changes sign with direction: 0 position-dependent torque, 1 friction",
            symbol="r",
        ),
        Parameter("order", "-", LogUniform(0.8, 60.0), "pulsations per revolution", n_scan=400, symbol="N"),
    ),
    equation=r"T_f \leftarrow T_f + T_c\,(a\cos N\phi + b\sin N\phi)\,(1 - r + r\operatorname{sgn}\omega)",
    source="mesh-stiffness and eccentricity ripple, e.g. H. N. Ozguven, D. R. Houser, J. Sound Vib. 121 (1988) 383",
    fingerprint={"drive_angle": "0"},
    separated_by="readings against position at one speed: the ripple keeps its place on the wheel at any speed",
    kinds=("friction_map",),
    special_cases={"ripple of position": {"turning": 0.0}, "ripple of friction": {"turning": 1.0}},
)
def periodic_mesh(
    friction_torque: np.ndarray,
    coulomb_torque: np.ndarray,
    drive_angle: np.ndarray,
    drive_speed: np.ndarray,
    *,
    cosine: float,
    sine: float,
    turning: float,
    order: float,
) -> np.ndarray:
    """Tooth meshing and eccentric wheels make the torque pulsate with position.

    A position-dependent torque keeps its sign in both directions; pulsating friction changes it.

    >>> ripple, angle = dict(cosine=0.5, sine=0.0, order=4.0), np.array([0.0, np.pi / 4])
    >>> periodic_mesh(2.0, 1.0, angle, 10.0, **ripple, turning=1.0).round(3).tolist()
    [2.5, 1.5]
    >>> [periodic_mesh(-2.0, 1.0, angle, -10.0, **ripple, turning=r).round(3).tolist() for r in (0.0, 1.0)]
    [[-1.5, -2.5], [-2.5, -1.5]]
    """
    ripple = cosine * np.cos(order * drive_angle) + sine * np.sin(order * drive_angle)
    return friction_torque + coulomb_torque * ripple * (1.0 - turning + turning * np.sign(drive_speed))
