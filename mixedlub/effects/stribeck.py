"""Stribeck friction of a drive."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform


@effect(
    stage="boundary",
    acts_on="running_friction",
    parameters=(
        Parameter(
            "excess",
            "-",
            LogNormal(0.3, 0.8),
            "static over Coulomb friction, minus one",
            null=0.0,
            symbol="s",
            relative_to="coulomb_torque",
        ),
        Parameter(
            "speed_share",
            "-",
            LogNormal(0.1, 1.0),
            "Stribeck speed over the largest speed of the recording, at mean temperature and middle load",
            symbol="q",
            relative_to="reference_speed",
        ),
        Parameter(
            "exponent",
            "-",
            LogNormal(1.0, 0.4),
            "exponent of speed: 1 exponential (Tustin), 2 Gaussian, below 1 spread over decades of speed",
            symbol="n",
        ),
        Parameter(
            "thinning",
            "1/K",
            Uniform(0.0, 0.05),
            "relative fall of viscosity per kelvin, which shifts the curve; 0: not the contact's temperature",
            symbol="b",
        ),
        Parameter(
            "load_power",
            "-",
            Uniform(0.0, 1.0),
            "exponent of load in the Stribeck speed; 1: one curve against speed over load",
            symbol="k",
        ),
    ),
    equation=r"T_r \leftarrow T_r + s\,T_c\,e^{-[|\omega|/\omega_s]^n}\operatorname{sgn}\omega,\quad "
    r"\omega_s = q\,\omega_0\,e^{b\,\theta_d + k\,l_F}",
    source="B. Armstrong-Helouvry, P. Dupont, C. Canudas de Wit, Automatica 30 (1994) 1083, whose exponents are "
    "0.5 to 2; one as in A. Tustin, J. IEE 94 (1947) 143; film laws hold the product of viscosity and speed",
    fingerprint={"speed": "-"},
    separated_by="points below a tenth of the largest speed, in both directions: friction falls with speed before "
    "it rises; a payload or an offset does not change sign with the direction",
    kinds=("friction_map",),
    special_cases={
        "Tustin": {"exponent": 1.0, "thinning": 0.0, "load_power": 0.0},
        "Gauss": {"exponent": 2.0, "thinning": 0.0, "load_power": 0.0},
    },
)
def stribeck(
    running_friction: np.ndarray,
    coulomb_torque: np.ndarray,
    drive_speed: np.ndarray,
    reference_speed: np.ndarray,
    temperature_difference: np.ndarray,
    log_load: np.ndarray,
    *,
    excess: float,
    speed_share: float,
    exponent: float,
    thinning: float,
    load_power: float,
) -> np.ndarray:
    """At low speed the lubricant film collapses and friction rises above its Coulomb level.

    Half the viscosity at twice the speed gives the same film; viscosity falls by 2 to 5 % per kelvin. The Hersey number
    is viscosity times speed over load.

    >>> law = dict(excess=0.5, speed_share=0.1, thinning=0.03, load_power=1.0)
    >>> stribeck(2.0, 2.0, np.array([1e-9, 10.0, 100.0]), 100.0, 0.0, 0.0, exponent=1.0, **law).round(3).tolist()
    [3.0, 2.368, 2.0]
    >>> stribeck(2.0, 2.0, np.array([5.0, 20.0]), 100.0, 0.0, 0.0, exponent=2.0, **law).round(3).tolist()
    [2.779, 2.018]
    >>> warm = np.log(2.0) / 0.03
    >>> float(stribeck(2.0, 2.0, 20.0, 100.0, warm, 0.0, exponent=2.0, **law).round(3))   # as 10 rad/s at the mean
    2.368
    """
    turning = speed_share * reference_speed * np.exp(thinning * temperature_difference + load_power * log_load)
    share = (np.abs(drive_speed) / turning) ** exponent
    return running_friction + excess * coulomb_torque * np.exp(-share) * np.sign(drive_speed)
