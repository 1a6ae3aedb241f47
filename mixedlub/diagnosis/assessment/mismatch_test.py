"""Test of the hypothesis that nothing is missing, at a stated false-alarm rate."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.diagnosis.discrepancy.modulated import READING
from mixedlub.diagnosis.discrepancy.smooth import DiscrepancyForm
from mixedlub.diagnosis.inference.likelihood import outlier_chance
from mixedlub.diagnosis.inference.map_fit import log_volume, whitening
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.noise_selection import NoiseSearch
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import (
    ALTERNATIVE_SIZES,
    BAYES_FACTOR_MARGIN,
    DRAWS,
    LARGEST_SCATTER,
    SMALLEST_P,
    SMOOTH_ALTERNATIVES,
    STATED_NOISE_SCALES,
    TEST_SEED,
    UNSTATED_NOISE_SCALES,
    WEIGHT_OF_EFFECTS,
)
from mixedlub.diagnosis.settings.inference import LARGEST_EXPONENT, LIKELY
from mixedlub.diagnosis.settings.search import MOST_INFLATION


@dataclass(frozen=True)
class Mismatch:
    """Outcome of the test; ``statistic`` is the mean log Bayes factor of all alternatives against nothing missing.

    ``unexplained_scatter``: residuals exceed any plausible noise under every explanation. ``noise_adapted``: the null
    hypothesis had the noise that it needs.
    """

    detected: bool
    p_value: float
    level: float
    chi2_before: float
    rows: int
    statistic: float
    unexplained_scatter: bool = False
    noise_adapted: bool = False


def judged_weight(search: Search) -> np.ndarray:
    """Weights of the readings under the best explanation, because the base model would take a mismatch for outliers."""
    return search.fit_of(max(search.log_weights, key=search.log_weights.__getitem__)).weight


@dataclass(frozen=True, eq=False)
class _Alternatives:
    """Alternatives under the linearised base model: prior draws of effects, and smooth functions.

    The noise is ``scale`` times the noise of the search. ``covered`` multiplies by the inverse covariance of noise and
    calibration, and ``spread`` is the log determinant of the covariance. ``whitened_draws`` are the draws so
    multiplied, ``power`` their squared sizes; ``smooth`` has the squared sizes of each block of functions and their
    directions.
    """

    scale: float
    covered: Callable[[np.ndarray], np.ndarray]
    spread: float
    whitened_draws: np.ndarray
    power: np.ndarray
    smooth: tuple[tuple[np.ndarray, np.ndarray], ...]

    @classmethod
    def of(cls, search: Search, fixed: np.ndarray, weight: np.ndarray, scale: float) -> _Alternatives:
        """The alternatives of a search, given the columns of calibration and set-ups, and the weights."""
        fixed = fixed / scale
        whitened = whitening(fixed, weight)
        directions = [s.change[: s.n_prior] for s in search.draws]
        effects = np.vstack(directions) / scale if directions else np.zeros((0, weight.size))
        whitened_effects = whitened(effects)
        smooth = []
        for length, interactions in SMOOTH_ALTERNATIVES:
            shape = DiscrepancyForm((), length, 1.0, READING, interactions and len(search.space.axes) > 1)
            block = shape.columns(search.space, search.values, search.discrepancy.scalings)
            whitened_block = whitened(block.T)
            size, vectors = np.linalg.eigh(whitened_block @ block)
            smooth.append((np.maximum(size, 0.0), vectors.T @ whitened_block))
        spread = log_volume(fixed, weight) + 2.0 * weight.size * float(np.log(scale))
        return cls(
            scale, whitened, spread, whitened_effects, np.einsum("ij,ij->i", effects, whitened_effects), tuple(smooth)
        )

    def log_nothing(self, targets: np.ndarray) -> np.ndarray:
        """Log density of each row of targets if nothing is missing, up to a constant independent of the scale."""
        targets = targets / self.scale
        return np.asarray(-0.5 * (np.einsum("ij,ij->i", targets, self.covered(targets)) + self.spread))

    def log_bayes_factor(self, targets: np.ndarray) -> np.ndarray:
        """Log mean Bayes factor of each row of targets against nothing missing."""
        targets = targets / self.scale
        parts = []
        if len(self.whitened_draws):
            along = targets @ self.whitened_draws.T
            each = 0.5 * along**2 / (1.0 + self.power) - 0.5 * np.log1p(self.power)
            parts.append(np.logaddexp.reduce(each, axis=1) - np.log(each.shape[1]) + np.log(WEIGHT_OF_EFFECTS))
        for size, pull in self.smooth:
            along = (targets @ pull.T) ** 2
            for amplitude in ALTERNATIVE_SIZES:
                grown = 1.0 + amplitude**2 * size
                each = 0.5 * (amplitude**2 * along / grown - np.log(grown)).sum(axis=1)
                parts.append(each + np.log((1.0 - WEIGHT_OF_EFFECTS) / (len(self.smooth) * len(ALTERNATIVE_SIZES))))
        return np.logaddexp.reduce(np.array(parts), axis=0)


def _statistic(alternatives: Sequence[_Alternatives], targets: np.ndarray) -> np.ndarray:
    """Log mean Bayes factor of each row of targets, averaged over the noise scales under both hypotheses."""
    nothing = np.array([one.log_nothing(targets) for one in alternatives])
    missing = nothing + np.array([one.log_bayes_factor(targets) for one in alternatives])
    return np.asarray(np.logaddexp.reduce(missing, axis=0) - np.logaddexp.reduce(nothing, axis=0))


def mismatch_test(
    search: Search,
    level: float,
    seed: int = TEST_SEED,
    *,
    scales: Sequence[float] = STATED_NOISE_SCALES,
) -> Mismatch:
    """Compare the Bayes factor of the readings with its distribution when nothing is missing.

    Alternatives are prior draws of the effects with free amplitude, and smooth functions of the conditions. Unstated
    noise may have any of the ``scales`` under both hypotheses, as in Student's test. Readings have the weights of the
    best explanation.
    Readings without a mismatch are simulated from the linearised base model: calibration from its prior, noise from its
    distribution. Beyond the largest draw the bound P(B > b) <= 1/b of any Bayes factor gives the p-value. The Bayes
    factor of the search, which fits forms that no prior draw resembles, is used with a margin for its approximations.
    """
    full = search
    search = full.full_screen
    problem, null_fit = search.problem, search.null_fit
    fixed = np.hstack([null_fit.slopes, problem.shared])
    weight = judged_weight(search)
    alternatives = [_Alternatives.of(search, fixed, weight, scale) for scale in scales]
    rng = np.random.default_rng(seed)
    noise = rng.standard_normal((DRAWS, problem.y.size)) / np.sqrt(weight)
    simulated = _statistic(alternatives, noise + rng.standard_normal((DRAWS, fixed.shape[1])) @ fixed.T)
    observed = float(_statistic(alternatives, null_fit.anchor[None, :])[0])
    p = (1.0 + float((simulated >= observed).sum())) / (DRAWS + 1.0)
    if observed > simulated.max():
        p = min(p, float(np.exp(-min(observed, LARGEST_EXPONENT))))
    p = min(p, BAYES_FACTOR_MARGIN * float(np.exp(-min(full.log_bayes_factor, LARGEST_EXPONENT))))
    chi2 = float(
        (full.problem.single_reading_units(full.null_fit.residual) ** 2).sum() + full.null_fit.z @ full.null_fit.z
    )
    return Mismatch(bool(p <= level), p, level, chi2, int(full.problem.y.size), observed)


def mismatch_against_null(result: NoiseSearch, level: float) -> tuple[Search, Mismatch]:
    """Test against nothing missing, and the search that the answer uses.

    Unstated noise was estimated under the best explanation, which is unfair to the null hypothesis: any noise is then
    tried under both hypotheses. A detection at stated noise is tested again with the autocorrelation that residuals
    have under the null hypothesis, and that search is used if nothing is detected.
    """
    search = null_search = result.search
    test = mismatch_test(search, level)
    scales = UNSTATED_NOISE_SCALES
    if result.stated:
        test = beyond_noise(search, result.noise_factor / MOST_INFLATION, test)
        null_search = result.null_search() if test.detected else search
        if null_search is search:
            return search, test
        scales = STATED_NOISE_SCALES
    else:
        test = beyond_noise(search, noise_share(search.problem) / LARGEST_SCATTER, test)
        if test.unexplained_scatter:
            return search, test
    null_test = mismatch_test(null_search, level, scales=scales)
    if null_test.p_value <= test.p_value:
        return search, test
    if not null_test.detected:
        return null_search, null_test
    return search, replace(test, p_value=null_test.p_value, noise_adapted=True)


def beyond_noise(search: Search, excess: float, test: Mismatch) -> Mismatch:
    """Mismatch test that counts scatter beyond any plausible noise as a mismatch.

    ``excess`` is the noise of the search over the largest plausible noise.
    """
    from scipy.special import chdtrc

    if excess <= 1.0:
        return test
    counted = outlier_chance(search.null_fit.residual) <= LIKELY
    if not counted.any():
        return replace(test, p_value=SMALLEST_P, detected=True, unexplained_scatter=True)
    chi2 = float(np.sum(search.null_fit.residual[counted] ** 2)) * excess**2
    p = min(max(float(chdtrc(int(counted.sum()), chi2)), SMALLEST_P), test.p_value)
    return replace(test, p_value=p, detected=bool(p <= test.level), unexplained_scatter=True)


def noise_share(problem: Problem) -> float:
    """Typical noise of a reading over the typical reading."""
    sd = problem.single_sd * problem.d_inverse(problem.y)
    return float(np.median(sd) / np.median(np.abs(problem.inverse(problem.y))))
