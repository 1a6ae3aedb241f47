"""Normal probability plot of the heights: the range in which they are Gaussian, and their shape elsewhere."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from profiles import InputError, Profile
from profiles.profile import of_profile
from roughness.clipping import clipping
from roughness.integrals import area_integral
from roughness.spectrum import autocorrelation

TOLERANCE = 0.1
"""Deviation from the line, over the line's sigma, that is negligible for Greenwood-Williamson."""

BULK = 80.0
"""Least percentage of the heights, 20 to 80 % included, on the straight part called the bulk."""

_CONTACT = 2.0  # times more or less contact than that of Gaussian heights, from which it is said
_REACH = 3.0902323061678132  # normal quantile of 99.9 %
_LEAST_REACH = 1.6448536269514722  # normal quantile of 95 %
_FEWEST = 30.0  # independent heights below which the band would forgive any shape
_LEVELS = 121
_DRAWS = 2000
_KNEES = np.linspace(-2.0, 1.0, 61)
_WIDTHS = np.array([0.05, 0.15, 0.3, 0.5, 0.8, 1.2])


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
    """The plot and its verdict; percentages are cumulative from the deepest valley up.

    ``heights`` (m) at normal ``quantiles``; the straight line ``mean + sigma q`` is fitted between ``from_percent`` and
    ``to_percent``, the widest range that it describes; ``band`` (m) is the deviation from the line within which a
    Gaussian profile with the same autocorrelation stays at all points in 99 of 100 cases; ``p_value`` is the share of
    such profiles with a larger deviation. ``lines`` are the two asymptotes fitted to any profile, ``plateau`` the same
    if they are convincing; ``contact_ratio`` is the mean overlap with a plane at 1, 2 and 3 sigma relative to Gaussian
    heights.
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
    lines: Plateau
    plateau: Plateau | None
    words: str

    @property
    def percent(self) -> np.ndarray:
        """Cumulative percentages of the plotted heights."""
        from scipy.special import ndtr

        return 100.0 * ndtr(self.quantiles)

    @property
    def misleads(self) -> bool:
        """Whether heights called Gaussian make far more or less contact than Gaussian ones, by their tails."""
        return self.verdict == "gaussian" and not 1.0 / _CONTACT <= self.contact_ratio[1] <= _CONTACT


@of_profile
def normal_probability(profile: Profile, *, tolerance: float = TOLERANCE) -> NormalProbability:
    """Judge whether the heights of a filtered profile are Gaussian, and between which percentages.

    ``gaussian``: the line holds over the whole range of the plot (at most 0.1 to 99.9 %) with deviations within chance
    or the tolerance, and no height lies beyond :func:`extreme_limit`; ``gaussian_bulk``: over at least 80 % of the
    heights; ``plateau``: two lines, the lower one steeper, describe it; ``not_gaussian``: none of these. The line holds
    where the heights stay within ``tolerance`` sigma of it or within the band, whichever is wider; with fewer than 30
    independent heights the band is not used, for it would forgive any shape. Valleys below 5 % do not make a plateau of
    a bulk that is straight. A trace that is clipped at the end of the range is ``not_gaussian``: the heights beyond are
    unknown.
    """
    from scipy.special import ndtr

    quantiles, heights, sums = _plotted(profile)
    count = int(np.count_nonzero(profile.valid))
    independent = count / sums[1]
    p_value, relative_band = _gaussian_band(quantiles, heights, sums, count)
    if independent < _FEWEST:
        relative_band = np.zeros_like(relative_band)
    first, last, mean, sigma = _widest_line(quantiles, heights, relative_band, tolerance)
    low, high = (float(100 * ndtr(quantiles[i])) for i in (first, last))
    lines, residual = _hyperbola(quantiles, heights)
    plateau = lines if _convincing(lines, residual, quantiles, heights, tolerance) else None
    extreme = np.abs(profile.heights[profile.valid] - mean).max() / sigma
    whole = first == 0 and last == _LEVELS - 1 and extreme <= extreme_limit(count)
    deviation = np.abs(heights - mean - sigma * quantiles).max() / sigma
    cut = clipping(profile)
    if cut:
        verdict = "not_gaussian"
    elif whole and (p_value >= 0.01 or deviation <= tolerance):
        verdict = "gaussian"
    elif plateau is not None and plateau.material_percent <= 95.0:
        verdict = "plateau"
    elif high - low >= BULK and low <= 20.0 and high >= 80.0:
        verdict = "gaussian_bulk"
    elif plateau is not None:
        verdict = "plateau"
    else:
        verdict = "not_gaussian"
    ratio = _contact_ratio(profile.heights[profile.valid])
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
        lines=lines,
        plateau=plateau if verdict == "plateau" else None,
        words=f"{cut}; whether they are Gaussian is unknown."
        if cut
        else _words(verdict, low, high, independent, ratio, plateau),
    )


def extreme_limit(count: int, chance: float = 1e-3) -> float:
    """Sigmas within which all of ``count`` Gaussian values stay but for a chance, however they correlate.

    .. math:: 2 n [1 - \\Phi(t)] = p

    Boole's bound: as many independent values would just exceed it in p of all cases, fewer in less.

    >>> round(extreme_limit(9600), 2)
    5.32
    """
    from scipy.special import ndtri

    return float(-ndtri(chance / (2.0 * count)))


def correlation_sums(correlation: np.ndarray, orders: int = 60) -> np.ndarray:
    """Sums over all lags, both ways, of the autocorrelation to the powers 1 to ``orders``.

    The k-th Hermite component of n correlated Gaussian heights scatters as the sum over n: the second is
    n over the number of independent heights (Rq), the third and fourth rule Rsk and Rku.

    >>> correlation_sums(np.array([1.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]), orders=2)
    array([2. , 1.5])
    """
    # a tenth of the length: a periodic profile never forgets, yet each period shows all its heights
    rho = correlation[: max(correlation.size // 10, 2)]
    rho = rho[np.abs(rho) > 1e-3]
    power = rho.copy()
    sums = np.empty(orders)
    for k in range(orders):
        sums[k] = 2.0 * power.sum() - 1.0
        power *= rho
    return np.maximum(sums, 1.0)


def _reach(independent: float) -> float:
    """Normal quantile beyond which fewer than three independent heights lie."""
    from scipy.special import ndtri

    return float(min(_REACH, max(ndtri(1.0 - 3.0 / max(independent, 6.1)), _LEAST_REACH)))


def _line_weights(quantiles: np.ndarray) -> np.ndarray:
    """Rows that give mean and slope of the least-squares line through the bulk."""
    bulk = np.abs(quantiles) <= 1.2815515655446004  # 10 to 90 %
    return np.linalg.pinv(np.column_stack((np.ones(quantiles.size), quantiles)) * bulk[:, None])


def _gaussian_band(
    quantiles: np.ndarray, heights: np.ndarray, sums: np.ndarray, count: int
) -> tuple[float, np.ndarray]:
    """p-value of the largest deviation from the line of the bulk, and the 99 % band over the sigma of the line.

    The covariance of the empirical quantiles of a correlated Gaussian process is expanded in Hermite polynomials
    (Mehler); the part without correlation is exact, the rest converges with the lag-1 power.
    """
    from scipy.special import ndtr

    below = ndtr(quantiles)
    density = np.exp(-0.5 * quantiles**2) / np.sqrt(2 * np.pi)
    covariance = np.minimum.outer(below, below) - np.outer(below, below)
    covariance /= np.outer(density, density)
    before, hermite = np.zeros_like(quantiles), np.ones_like(quantiles)
    for order, total in enumerate(sums, start=1):
        covariance += (total - 1.0) / order * np.outer(hermite, hermite)
        before, hermite = hermite, (quantiles * hermite - np.sqrt(order - 1) * before) / np.sqrt(order)
    fit = _line_weights(quantiles)
    residual = np.eye(quantiles.size) - np.column_stack((np.ones(quantiles.size), quantiles)) @ fit
    covariance = residual @ covariance @ residual.T / count
    spread = np.sqrt(np.maximum(np.diag(covariance), 1e-12))
    # taking the line off leaves two directions without scatter; the small diagonal keeps Cholesky going
    factor = np.linalg.cholesky(covariance + 1e-9 * np.diag(covariance).max() * np.eye(quantiles.size))
    draws = np.random.default_rng(1).standard_normal((_DRAWS, quantiles.size)) @ factor.T
    largest = np.abs(draws / spread).max(axis=1)
    slope = fit[1] @ heights
    observed = np.abs((residual @ heights) / slope / spread).max()
    p_value = (1.0 + np.count_nonzero(largest >= observed)) / (largest.size + 1.0)
    return float(p_value), spread * np.quantile(largest, 0.99)


def _widest_line(
    quantiles: np.ndarray, heights: np.ndarray, band: np.ndarray, tolerance: float
) -> tuple[int, int, float, float]:
    """The range of levels, widest in percent, over which one straight line stays within its tolerance."""
    from scipy.special import ndtr

    below = ndtr(quantiles)
    density = np.exp(-0.5 * quantiles**2)
    # a stretch of equal heights is a flat, not a Gaussian of sigma nought
    least = 0.02 * heights.std()
    first, last = np.triu_indices(quantiles.size, k=8)
    for pick in np.lexsort((first - last, -np.round(below[last] - below[first], 3))):
        part = slice(first[pick], last[pick] + 1)
        q, z, weight = quantiles[part], heights[part], density[part]
        centre = weight @ q / weight.sum()
        sigma = (weight * (q - centre)) @ z / (weight @ (q - centre) ** 2)
        mean = weight @ z / weight.sum() - sigma * centre
        if sigma > least and np.all(np.abs(z - mean - sigma * q) <= sigma * np.maximum(tolerance, band[part])):
            return int(first[pick]), int(last[pick]), float(mean), float(sigma)
    middle = quantiles.size // 2
    mean, sigma = _line_weights(quantiles) @ heights
    return middle, middle, float(mean), float(sigma)


def two_lines(profile: Profile) -> Plateau:
    """Rpq, Rvq and Rmq of ISO 13565-3: the lines of plateau and valleys on the probability plot. A fit for every
    profile; on a single Gaussian process the two lines are nearly one."""
    quantiles, heights, _ = _plotted(profile)
    return _hyperbola(quantiles, heights)[0]


def _hyperbola(quantiles: np.ndarray, heights: np.ndarray) -> tuple[Plateau, np.ndarray]:
    """Hyperbola through the plot within 2.5 sigma, with the two lines as asymptotes, and its residuals. After ISO
    13565-3, annex A, which also takes the asymptotes of a conic."""
    from scipy.special import ndtr

    inner = np.abs(quantiles) <= 2.5
    q, z = quantiles[inner], heights[inner]
    knees, widths = (grid.reshape(-1, 1) for grid in np.meshgrid(_KNEES, _WIDTHS))
    bends = 0.5 * (q - knees - np.sqrt((q - knees) ** 2 + widths**2))
    straight = np.linalg.qr(np.column_stack((np.ones_like(q), q)))[0]
    left = z - straight @ (straight.T @ z)
    bent = bends - (bends @ straight) @ straight.T
    squares = np.einsum("ij,ij->i", bent, bent)
    best = int(np.argmax((bent @ left) ** 2 / squares))
    extra = float(bent[best] @ left / squares[best])
    residual = left - extra * bent[best]
    knee = float(knees[best, 0])
    mean, plateau = np.polynomial.polynomial.polyfit(q, z - extra * bends[best], 1)
    found = Plateau(
        plateau_sigma=float(plateau),
        valley_sigma=float(plateau + extra),
        material_percent=float(100 * ndtr(-knee)),
        knee_height=float(mean + plateau * knee),
        plateau_mean=float(mean),
    )
    return found, residual


def _convincing(
    lines: Plateau, residual: np.ndarray, quantiles: np.ndarray, heights: np.ndarray, tolerance: float
) -> bool:
    """Whether the valleys are at least twice as steep, fill 2 to 80 %, and the curve fits to 2.5 times the
    tolerance where one line leaves four times the squares."""
    inner = np.abs(quantiles) <= 2.5
    q, z = quantiles[inner], heights[inner]
    one = z - np.polynomial.polynomial.polyval(q, np.polynomial.polynomial.polyfit(q, z, 1))
    return bool(
        lines.plateau_sigma > 0
        and lines.valley_sigma >= 2.0 * lines.plateau_sigma
        and 20.0 <= lines.material_percent <= 98.0
        and residual @ residual <= 0.25 * (one @ one)
        and np.abs(residual).max() <= 2.5 * tolerance * z.std()
    )


def _plotted(profile: Profile) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Normal quantiles, the heights at them, and the sums over the autocorrelation."""
    from scipy.special import ndtr

    ordered = profile.heights[profile.valid]
    if ordered.size < 50 or np.ptp(ordered) == 0:
        raise InputError("a probability plot needs fifty heights that differ", where=f"profile {profile.name!r}")
    sums = correlation_sums(autocorrelation(_within_limits(profile)))
    quantiles = np.linspace(-1.0, 1.0, _LEVELS) * _reach(ordered.size / sums[1])
    return quantiles, np.quantile(ordered, ndtr(quantiles), method="median_unbiased"), sums


def _within_limits(profile: Profile) -> Profile:
    """The profile with its extremes brought in: one spike would make all other heights look uncorrelated."""
    low, middle, high = np.quantile(profile.heights, (0.1, 0.5, 0.9))
    most = extreme_limit(profile.heights.size) * (high - low) / 2.563
    inside = np.clip(profile.heights, middle - most, middle + most)
    return profile if most == 0.0 else replace(profile, heights=inside)


def _contact_ratio(heights: np.ndarray) -> tuple[float, float, float]:
    """Mean overlap with a plane at 1, 2, 3 sigma above the mean, relative to Gaussian heights."""
    z = (heights - heights.mean()) / heights.std()
    first, second, third = (float(np.maximum(z - h, 0.0).mean() / area_integral(h)) for h in (1.0, 2.0, 3.0))
    return first, second, third


def _words(
    verdict: str,
    low: float,
    high: float,
    independent: float,
    ratio: tuple[float, float, float],
    plateau: Plateau | None,
) -> str:
    area = f"real contact at a gap of 2 sigma is {ratio[1]:.2f} times the Gaussian one"
    if verdict == "gaussian":
        return (
            f"Gaussian from {low:.1f} to {high:.1f} % of the heights, as far as {independent:.0f} "
            f"independent heights can tell; {area}."
        )
    if verdict == "gaussian_bulk":
        return f"Gaussian from {low:.1f} to {high:.1f} %; what lies beyond leaves the line; {area}."
    if verdict == "plateau" and plateau is not None:
        return (
            f"plateau of sigma {plateau.plateau_sigma * 1e6:.3g} um on {plateau.material_percent:.0f} % of "
            f"the surface above valleys of sigma {plateau.valley_sigma * 1e6:.3g} um; {area}."
        )
    return f"not Gaussian: one line holds only from {low:.1f} to {high:.1f} %; {area}."
