"""Correlation of the predictions with an unfitted second channel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.diagnosis.settings.assessment import CHANNEL_READINGS


@dataclass(frozen=True)
class Check:
    """Correlation of the predicted readings with channel ``column`` over ``n`` readings; None if constant or short."""

    column: str
    correlation: float | None
    n: int


def check_channel(column: str, channel: np.ndarray, predicted: np.ndarray) -> Check:
    """Pearson's correlation of predictions with an unfitted channel.

    A constant channel, or fewer than five readings, has no correlation: the channel may be out of use.

    >>> check_channel("coverage", np.array([0.0, 1.0, 2.0, 3.0, 5.0]), np.array([1.0, 2.0, 3.0, 4.0, 6.0])).correlation
    1.0
    >>> check_channel("resistance", np.zeros(6), np.arange(6.0)).correlation is None
    True
    """
    used = np.isfinite(channel) & np.isfinite(predicted)
    a, b = np.asarray(channel, dtype=float)[used], np.asarray(predicted, dtype=float)[used]
    if a.size < CHANNEL_READINGS or np.ptp(a) == 0.0 or np.ptp(b) == 0.0:
        return Check(column, None, int(a.size))
    return Check(column, round(float(np.corrcoef(a, b)[0, 1]), 12), int(a.size))
