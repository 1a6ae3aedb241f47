"""Torque that accelerates the moving parts."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal


@effect(
    stage="measurement",
    acts_on="friction_torque",
    parameters=(
        Parameter(
            "moment_of_inertia",
            "-",
            LogNormal(0.3, 1.5),
            "moment of inertia of all that turns, relative to the typical torque over the largest acceleration",
            null=0.0,
            symbol="j",
            relative_to="inertia_scale",
        ),
    ),
    equation=r"T_f \leftarrow T_f + j\,J_0\,\alpha_\omega",
    source="Newton's second law for a turning body, as in the retardation method of IEC 60034-2-2 (from memory)",
    fingerprint={"load": "0", "oil_temperature": "0"},
    separated_by="a coast-down beside the run-up, or readings at steady speed: inertia changes sign with the "
    "acceleration and vanishes at steady speed, friction does neither",
    kinds=("friction_map",),
    exact_form=True,
    expected=True,
)
def inertia(
    friction_torque: np.ndarray,
    inertia_scale: np.ndarray,
    drive_acceleration: np.ndarray,
    *,
    moment_of_inertia: float,
) -> np.ndarray:
    """The torque of a machine that changes speed accelerates its moving parts beside overcoming friction.

    >>> inertia(0.2, 0.02, np.array([10.0, 0.0, -10.0]), moment_of_inertia=0.6).round(3).tolist()   # 0.012 kg m2
    [0.32, 0.2, 0.08]
    """
    return friction_torque + moment_of_inertia * inertia_scale * drive_acceleration
