"""Whether what an explanation leaves over hangs together in time: readings then tell less than their number."""

from __future__ import annotations

import numpy as np

FEWEST = 16
"""Stretches of time from which their sums have a variance that can be told."""
WILD = 3.0
"""Sigmas to which a residual counts: wild readings do not hang together."""


def serial_inflation(left: np.ndarray, clock: np.ndarray | None) -> float:
    r"""How many times their variance sums of neighbours in time vary, :math:`\hat c`; 1 or more, 1 without a clock.

    ``left`` are residuals in sigmas. Independent ones make :math:`\sum_n z / \sqrt n` vary as one does, for stretches
    of any n; noise that lasts over several readings, and a law that is wrong a little for some time, make it vary
    more, and every log probability of the readings too steep by as much. The largest excess over two standard errors
    of chance counts: batch means, as G. S. Fishman, Principles of Discrete Event Simulation (1978), sec. 2.6.

    >>> clock, noise = np.arange(512.0), np.random.default_rng(1).standard_normal(512)
    >>> serial_inflation(noise, clock), serial_inflation(noise, None)
    (1.0, 1.0)
    >>> round(serial_inflation(np.repeat(noise, 8), np.arange(4096.0)))   # eight readings tell as much as one
    6
    """
    if clock is None:
        return 1.0
    ordered = np.clip(left, -WILD, WILD)[np.argsort(clock, kind="stable")]
    most, length = 1.0, 2
    while (count := ordered.size // length) >= FEWEST:
        sums = ordered[: count * length].reshape(count, length).sum(axis=1)
        most = max(most, float(np.mean(sums**2)) / length / (1.0 + 2.0 * np.sqrt(2.0 / count)))
        length *= 2
    return most
