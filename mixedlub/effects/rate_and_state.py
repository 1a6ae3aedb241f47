"""Friction that answers a step of speed at once, and then follows as contacts age."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform
from mixedlub.laws.state_friction import held_weights, with_rate_and_state

PARAMETERS = (
    Parameter("direct", "-", LogNormal(0.008, 0.8), "rise of friction per e-fold of speed, at once", 0.0, "a"),
    Parameter("evolution", "-", LogNormal(0.01, 0.8), "rise of friction per e-fold of the age", 0.0, "b"),
    Parameter("slip_length", "m", LogNormal(1.5e-5, 1.5), "slip that renews the contacts", None, "D_c", 24),
    Parameter(
        "onset",
        "-",
        Uniform(-0.2, 1.2),
        "instant of a step: 0 or less at the first reading after it, 1 or more at the reading before",
        symbol="o",
    ),
)
"""Parameters of both laws of state."""
STATES = (
    *("tribofilm_growth", "friction_run_in", "two_time_scales", "friction_event", "running_in"),
    *("boundary_film_temperature", "boundary_speed_dependence", "wandering_surface_state"),
)
"""Effects that change the friction on which both laws act."""


@effect(
    stage="boundary",
    acts_on="boundary_friction",
    parameters=PARAMETERS,
    equation=r"\mu_B \leftarrow \mu_B + a\ln\frac{v_s}{v_0} + b\ln\sum_{k=1} w_k\frac{v_0}{v_k},\quad "
    r"w_k = \Delta e^{-x_k/D_c},\quad x_k = (1 - o)s_k + o\,s_o",
    source="J. H. Dieterich, J. Geophys. Res. 84 (1979) 2161: a and b near 0.01, slip of micrometres; its law of "
    "ageing, solved for speeds v_k held one after the other",
    fingerprint={"speed": "+"},
    separated_by="steps of speed up and down and a hold: friction jumps the one way at once and relaxes the other way "
    "over the same slip; contacts age at rest too, so that friction after a hold grows with its logarithm",
    applied_after=STATES,
    kinds=("friction_history",),
    prior_odds=0.5,
)
def rate_and_state(
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
    """Contacts are stronger the faster they slide and the older they are; after a step of speed they are renewed.

    Long after a step friction has changed by a - b per e-fold of speed; just after it, by a.

    >>> law = dict(direct=0.008, evolution=0.013, slip_length=2e-5, onset=0.0)
    >>> held, v, long = np.array([[3e-6, 3e-5]]), np.array([[3e-5]]), np.array([[1.0, 1e-3]])
    >>> [float(rate_and_state(0.55, v, 3e-6, held, s, s, **law).round(4)[0, 0]) for s in (long * [1, 0], long)]
    [0.5684, 0.5385]
    """
    weight = held_weights(slip_since, slip_since_early, slip_length, onset)
    age = np.log(np.sum(weight * first_speed / held_speed, axis=-1, keepdims=True))
    return with_rate_and_state(boundary_friction, sliding_speed / first_speed, direct, evolution, age)
