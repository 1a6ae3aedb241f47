"""Several traces of one surface: mean moments across and along its lay, their scatter, and the Peklenik number."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from profiles import InputError, Profile
from roughness.moments import Moments
from roughness.spectrum import correlation_length

FALL = 0.5
"""Value of the autocorrelation at the correlation lengths of Peklenik's number."""


def mean_moments(found: Sequence[Moments]) -> Moments:
    """Mean of the moments of several traces, with their spacing and cut-offs if equal.

    >>> mean_moments([Moments(1e-14, 1e-3, 1e9, cutoff=8e-4), Moments(3e-14, 3e-3, 2e9, cutoff=8e-4)]).m4
    1500000000.0
    """
    first = found[0]
    if len(found) == 1:
        return first
    whole = first
    for other in found[1:]:
        whole = whole + other
    m0, m2, m4 = (value / len(found) for value in (whole.m0, whole.m2, whole.m4))
    return Moments(m0, m2, m4, whole.spacing, whole.short_cutoff, whole.cutoff, whole.estimator)


def peklenik_number(across: Sequence[Profile], along: Sequence[Profile]) -> float:
    """Correlation length across the lay over that along it, each where the autocorrelation falls to a half (-).

    Means over the traces. Below 1, as the correlation falls sooner across the lay; 1 without a lay. The filter limits
    lengths along the lay to its cut-off.
    Source: N. Patir, H. S. Cheng, J. Lubr. Technol. 100 (1978) 12, after J. Peklenik, Proc. IMechE 182 (1967-68) 108.

    >>> ridge = Profile(np.cos(np.arange(4000) / 20.0), 1e-6)
    >>> round(peklenik_number([ridge], [Profile(ridge.heights, 4e-6)]), 3)
    0.25
    """
    lengths = [np.mean([correlation_length(p, fall_to=FALL) for p in traces]) for traces in (across, along)]
    if not np.isfinite(lengths).all():
        raise InputError("never fall to a half", where="autocorrelations of the traces across and along the lay")
    return float(lengths[0] / lengths[1])


def mean_axes(samples: np.ndarray, level: float = 0.9, least: np.ndarray | float = 0.0) -> np.ndarray:
    r"""Independent changes of the logarithms of means at the ends of an interval, one a row.

    ``samples`` has a row for each of n traces (or sampling lengths) and a column for each moment. The covariance of the
    means over their products, :math:`C = \mathrm{cov}(x/\bar x)/n`, is written as :math:`\sum_j v_j v_j^T`; rows are
    :math:`t\,v_j` with Student's t of n - 1 degrees of freedom. For a quantity linear in the logarithms, the root of
    the summed squares of its changes along the rows is the t interval of its n values. ``least``: lower bounds on the
    relative standard deviations of the means, one a column.

    >>> rows = mean_axes(np.array([[0.9, 1.0], [1.0, 1.0], [1.1, 1.0]]))
    >>> np.sqrt((rows**2).sum(axis=0)).round(4).tolist()   # t = 2.92 times 0.1 / sqrt(3)
    [0.1686, 0.0]
    """
    from scipy.special import stdtrit

    count = len(samples)
    if count < 3:
        raise InputError("their scatter needs at least three", where="traces or sampling lengths", value=count)
    covariance = np.atleast_2d(np.cov(samples / samples.mean(axis=0), rowvar=False)) / count
    own = np.sqrt(np.diag(covariance))
    wider = np.divide(np.maximum(own, least), own, out=np.ones_like(own), where=own > 0.0)
    covariance *= np.outer(wider, wider)
    square, directions = np.linalg.eigh(covariance)
    reach = stdtrit(count - 1, (1.0 + level) / 2.0) * np.sqrt(np.maximum(square, 0.0))
    return np.asarray((directions * reach).T)
