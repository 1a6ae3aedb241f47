"""Friction that answers a step of speed at once, and then follows with slip alone."""

import numpy as np

from mixedlub.chain.effect import effect
from mixedlub.effects.rate_and_state import PARAMETERS, STATES
from mixedlub.laws.state_friction import held_weights, with_rate_and_state


@effect(
    stage="boundary",
    acts_on="boundary_friction",
    parameters=PARAMETERS,
    equation=r"\mu_B \leftarrow \mu_B + a\ln\frac{v_s}{v_0} + b\sum_{k=1} w_k\ln\frac{v_0}{v_k},\quad "
    r"w_k = \Delta e^{-x_k/D_c},\quad x_k = (1 - o)s_k + o\,s_o",
    source="A. Ruina, J. Geophys. Res. 88 (1983) 10359, its law of slip, solved for speeds v_k held one after the "
    "other; numbers of J. H. Dieterich, J. Geophys. Res. 84 (1979) 2161",
    fingerprint={"speed": "+"},
    separated_by="steps of speed up and down and a hold: friction jumps the one way at once and relaxes the other way "
    "over the same slip; contacts do not change at rest, and steps up and down relax over the same slip",
    applied_after=(*STATES, "rate_and_state"),
    kinds=("friction_history",),
    prior_odds=0.5,
)
def rate_and_state_slip(
    boundary_friction: np.ndarray,
    sliding_speed: np.ndarray,
    first_speed: np.ndarray,
    held_speed: np.ndarray,
    slip_since: np.ndarray,
    slip_since_early: np.ndarray,
    *,
    direct: float,
    evolution: float,
    slip_length: float,
    onset: float,
) -> np.ndarray:
    """Contacts are stronger the faster they slide; their state follows the logarithm of speed over a length of slip.

    Long after a step friction has changed by a - b per e-fold of speed; just after it, by a.

    >>> law = dict(direct=0.008, evolution=0.013, slip_length=2e-5, onset=0.0)
    >>> held, v, long = np.array([[3e-6, 3e-5]]), np.array([[3e-5]]), np.array([[1.0, 1e-3]])
    >>> [float(rate_and_state_slip(0.55, v, 3e-6, held, s, s, **law).round(4)[0, 0]) for s in (long * [1, 0], long)]
    [0.5684, 0.5385]
    """
    weight = held_weights(slip_since, slip_since_early, slip_length, onset)
    age = -np.sum(weight * np.log(held_speed / first_speed), axis=-1, keepdims=True)
    return with_rate_and_state(boundary_friction, sliding_speed / first_speed, direct, evolution, age)
