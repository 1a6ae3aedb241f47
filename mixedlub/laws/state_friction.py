"""Age of the contacts of a sliding pair whose speed is stepped."""

from __future__ import annotations

import numpy as np

LEAST_SPEED = 1e-9
"""Definition. Least speed over the first one: a contact that rolls without sliding."""
LEAST_FRICTION = 1e-3
"""Definition. Share of friction that is left at least: a logarithm of speed has no lower end."""


def held_weights(slip: np.ndarray, early: np.ndarray, slip_length: float, onset: float) -> np.ndarray:
    r"""Weights of the speeds held so far in the state of the contacts, which add up to one (-).

    .. math:: w_k = e^{-s_{k+1}/D_c} - e^{-s_k/D_c}

    The first speed was held for ever before, and the last one has not ended. ``onset``: place between the
    slips, 0 to 1. Solution of both laws of A. Ruina, J. Geophys. Res. 88 (1983) 10359, for speeds held in turn.

    >>> held_weights(np.array([[9.0, 2e-5]]), np.array([[9.0, 2e-5]]), 2e-5, 0.0).round(3).tolist()
    [[0.368, 0.632]]
    """
    part = min(max(onset, 0.0), 1.0)
    since = np.maximum((1.0 - part) * slip + part * early, 0.0)
    left = np.atleast_1d(np.exp(-since / slip_length))
    left = np.concatenate([np.zeros_like(left[..., :1]), left[..., 1:], np.ones_like(left[..., :1])], axis=-1)
    return np.diff(left, axis=-1)


def with_rate_and_state(
    friction: np.ndarray, speed_share: np.ndarray, direct: float, evolution: float, age: np.ndarray
) -> np.ndarray:
    r"""Friction coefficient with a direct effect of speed, and an effect of the age of contacts (-).

    .. math:: \mu \leftarrow \mu + a\ln(v/v_0) + b\ln(\theta v_0/D_c)

    Source: J. H. Dieterich, J. Geophys. Res. 84 (1979) 2161.

    >>> round(float(with_rate_and_state(0.55, np.array(10.0), 0.008, 0.013, np.array(0.0))), 4)
    0.5684
    """
    change = direct * np.log(np.maximum(speed_share, LEAST_SPEED)) + evolution * age
    least = LEAST_FRICTION * friction
    return np.where(change == 0.0, friction, np.maximum(friction + change, least))
