"""Normal probability plot of the heights: where they are Gaussian, and what they are where they are not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from profiles import InputError, Profile
from roughness.spectrum import autocorrelation

TOLERANCE = 0.1
"""Deviation from the line, in its own sigma, that Greenwood-Williamson may be asked to overlook."""

BULK = (10.0, 90.0)
"""Cumulative percentages that the straight part must span to be called the bulk."""

_REACH = 3.0902323061678132  # normal quantile of 99.9 %
_LEVELS = 121


@dataclass(frozen=True)
class Plateau:
    """Two Gaussian processes on one surface: heights in m, ``material_percent`` above the knee."""

    plateau_sigma: float
    valley_sigma: float
    material_percent: float
    knee_height: float
    plateau_mean: float


@dataclass(frozen=True, eq=False)
class NormalProbability:
    """The plot and what it says; percentages are cumulative from the deepest valley up.

    ``heights`` (m) at normal ``quantiles``; the straight line ``mean + sigma q`` is fitted between
    ``from_percent`` and ``to_percent``, the widest range that it describes; ``band`` (m) is how far from it
    a Gaussian profile with the same autocorrelation stays at every point together in 99 of 100 cases;
    ``p_value`` is the share of such profiles that leave their line further than this one.
    ``contact_ratio`` is the mean overlap with a plane at 1, 2 and 3 sigma over that of Gaussian heights.
    """

    quantiles: np.ndarray
    heights: np.ndarray
    band: np.ndarray
    mean: float
    sigma: float
    from_percent: float
    to_percent: float
    verdict: str
    p_value: float
    independent_heights: float
    contact_ratio: tuple[float, float, float]
    plateau: Plateau | None
    words: str

    @property
    def percent(self) -> np.ndarray:
        """Cumulative percentages of the plotted heights."""
        from scipy.special import ndtr

        return 100.0 * ndtr(self.quantiles)


def normal_probability(profile: Profile, *, tolerance: float = TOLERANCE) -> NormalProbability:
    """Judge whether the heights of a filtered profile are Gaussian, and between which percentages.

    ``gaussian``: the line holds from end to end of what the profile can show (at most 0.1 to 99.9 %);
    ``gaussian_bulk``: at least from 10 to 90 %; ``plateau``: two lines, the lower one steeper, describe it;
    ``not_gaussian``: none of these. The line holds where the heights stay within ``tolerance`` sigma of it
    or within the band, whichever is wider.
    """
    from scipy.special import ndtr

    mask = np.asarray(profile.valid)
    ordered = np.sort(profile.heights[mask])
    if ordered.size < 50 or ordered[0] == ordered[-1]:
        raise InputError(
            "a probability plot needs fifty heights that differ", where=f"profile {profile.name!r}"
        )
    sums = correlation_sums(autocorrelation(profile))
    independent = ordered.size / sums[1]
    quantiles = np.linspace(-1.0, 1.0, _LEVELS) * _reach(independent)
    heights = np.quantile(ordered, ndtr(quantiles), method="median_unbiased")
    p_value, relative_band = _gaussian_band(quantiles, heights, sums, ordered.size)
    first, last, mean, sigma = _widest_line(quantiles, heights, relative_band, tolerance)
    low, high = (float(100 * ndtr(quantiles[i])) for i in (first, last))
    plateau = _two_lines(quantiles, heights, tolerance)
    if first == 0 and last == _LEVELS - 1:
        verdict = "gaussian"
    elif low <= BULK[0] and high >= BULK[1]:
        verdict = "gaussian_bulk"
    elif plateau is not None:
        verdict = "plateau"
    else:
        verdict = "not_gaussian"
    ratio = _contact_ratio(ordered)
    return NormalProbability(
        quantiles=quantiles,
        heights=heights,
        band=relative_band * sigma,
        mean=mean,
        sigma=sigma,
        from_percent=low,
        to_percent=high,
        verdict=verdict,
        p_value=p_value,
        independent_heights=independent,
        contact_ratio=ratio,
        plateau=plateau if verdict == "plateau" else None,
        words=_words(verdict, low, high, ratio, plateau),
    )


def correlation_sums(correlation: np.ndarray, orders: int = 60) -> np.ndarray:
    """Sums over all lags, both ways, of the autocorrelation to the powers 1 to ``orders``.

    The k-th Hermite component of n correlated Gaussian heights scatters as the sum over n: the second is
    n over the number of independent heights (Rq), the third and fourth rule Rsk and Rku.

    >>> correlation_sums(np.array([1.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]), orders=2)
    array([2. , 1.5])
    """
    # beyond a quarter of the length the estimate is mostly its own noise
    power = rho = correlation[: max(correlation.size // 4, 2)]
    strong = np.abs(rho) > 1e-3
    rho = rho[strong]
    power = rho.copy()
    sums = np.empty(orders)
    for k in range(orders):
        sums[k] = 2.0 * power.sum() - 1.0
        power *= rho
    return np.maximum(sums, 1.0)
