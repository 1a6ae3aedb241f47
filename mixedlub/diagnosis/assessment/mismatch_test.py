"""Is there anything to explain: a test of the calibrated base model at a stated false-alarm rate."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.diagnosis.discrepancy.modulated import READING
from mixedlub.diagnosis.discrepancy.smooth import Shape
from mixedlub.diagnosis.inference.map_fit import linear_fit, outlier_chance, whitening
from mixedlub.diagnosis.search.noise_inflation import MOST
from mixedlub.diagnosis.search.noise_selection import Weighed
from mixedlub.diagnosis.search.search import Search

DRAWS = 2000
"""Drawn recordings without a mismatch: a p-value of 0.01 is then known to a fifth of it."""
SHAPES = ((0.7, False), (0.25, True))
"""Smooth alternatives: how far they reach along a condition, and whether pairs of conditions act together."""
SIZES = (1.0, 4.0)
"""Sizes of the alternatives in sigmas: just visible, and plain."""
BY_EFFECTS = 0.6
"""Weight of the effects among the alternatives; the smooth functions share the rest."""
SMALLEST = 1e-304
"""Smallest p-value: what a number of the answer can still hold."""
OWN_ROUNDS = 30
"""Times that nothing missing judges anew which readings are outliers."""
UNSURE = 10.0
"""How far the search's Bayes factor may be off."""
KNOWN = (1.0,)
"""Noise that is stated, over that of the search."""
UNTOLD = tuple(np.geomspace(0.12, 2.0, 13))
"""Noise that nobody states, over what the calibrated base model would need: it could be any of these."""


@dataclass(frozen=True)
class Mismatch:
    """Outcome of the test; ``statistic`` is the mean log Bayes factor of all alternatives against none.

    ``unfollowed`` says that readings scatter more than noise can about whatever was tried, ``lenient`` that the
    p-value grants nothing missing the noise that it would need itself.
    """

    detected: bool
    p_value: float
    level: float
    chi2_before: float
    rows: int
    statistic: float
    unfollowed: bool = False
    lenient: bool = False


def judged_weight(found: Search) -> np.ndarray:
    """Which readings are outliers, as the best explanation judges: the base model may write off what it lacks."""
    return found.fit_of(max(found.log_weights, key=found.log_weights.__getitem__)).weight


@dataclass(frozen=True, eq=False)
class _Alternatives:
    """What may be missing, against recordings of the linearised base model: prior draws of effects, smooth functions.

    All under ``scale`` times the noise of the search. ``covered`` multiplies by the inverse covariance of noise and
    calibration, ``spread`` is the logarithm of its determinant; ``seen`` are the draws so multiplied, ``power``
    their squared size; ``smooth`` the squared sizes of each block of functions and their directions.
    """

    scale: float
    covered: Callable[[np.ndarray], np.ndarray]
    spread: float
    seen: np.ndarray
    power: np.ndarray
    smooth: tuple[tuple[np.ndarray, np.ndarray], ...]

    @classmethod
    def of(cls, found: Search, fixed: np.ndarray, weight: np.ndarray, scale: float) -> _Alternatives:
        """Those of a search, beside the columns of calibration and set-ups, at the weights of the readings."""
        fixed = fixed / scale
        whitened = whitening(fixed, weight)
        inner = np.eye(fixed.shape[1]) + fixed.T @ (fixed * weight[:, None])
        directions = [s.change[: s.blind] for s in found.sampled]
        effects = np.vstack(directions) / scale if directions else np.zeros((0, weight.size))
        seen = whitened(effects)
        smooth = []
        for length, interactions in SHAPES:
            shape = Shape((), length, 1.0, READING, interactions and len(found.space.axes) > 1)
            block = shape.columns(found.space, found.values, found.unknown.carriers)
            pulled = whitened(block.T)
            size, turn = np.linalg.eigh(pulled @ block)
            smooth.append((np.maximum(size, 0.0), turn.T @ pulled))
        spread = float(np.linalg.slogdet(inner)[1]) + 2.0 * weight.size * float(np.log(scale))
        return cls(scale, whitened, spread, seen, np.einsum("ij,ij->i", effects, seen), tuple(smooth))

    def log_nothing(self, targets: np.ndarray) -> np.ndarray:
        """Log density of each row of targets if nothing is missing, up to a constant that no scale changes."""
        targets = targets / self.scale
        return np.asarray(-0.5 * (np.einsum("ij,ij->i", targets, self.covered(targets)) + self.spread))

    def log_bayes_factor(self, targets: np.ndarray) -> np.ndarray:
        """Log mean Bayes factor against none of each row of targets."""
        targets = targets / self.scale
        parts = []
        if len(self.seen):
            along = targets @ self.seen.T
            each = 0.5 * along**2 / (1.0 + self.power) - 0.5 * np.log1p(self.power)
            parts.append(np.logaddexp.reduce(each, axis=1) - np.log(each.shape[1]) + np.log(BY_EFFECTS))
        for size, pull in self.smooth:
            along = (targets @ pull.T) ** 2
            for amplitude in SIZES:
                grown = 1.0 + amplitude**2 * size
                each = 0.5 * (amplitude**2 * along / grown - np.log(grown)).sum(axis=1)
                parts.append(each + np.log((1.0 - BY_EFFECTS) / (len(self.smooth) * len(SIZES))))
        return np.logaddexp.reduce(np.array(parts), axis=0)


def _statistic(alternatives: Sequence[_Alternatives], targets: np.ndarray) -> np.ndarray:
    """Log mean Bayes factor of each row of targets, whichever of the scales the noise has, for either side."""
    nothing = np.array([one.log_nothing(targets) for one in alternatives])
    missing = nothing + np.array([one.log_bayes_factor(targets) for one in alternatives])
    return np.asarray(np.logaddexp.reduce(missing, axis=0) - np.logaddexp.reduce(nothing, axis=0))


def _cost(found: Search, fixed: np.ndarray, weight: np.ndarray, scales: Sequence[float]) -> float:
    """Log probability that nothing missing loses where others judge which readings are outliers."""

    def log_nothing(weight: np.ndarray, rounds: int) -> float:
        each = [
            linear_fit(found.none.anchor / scale, fixed / scale, weight, rounds).evidence - weight.size * np.log(scale)
            for scale in scales
        ]
        return float(np.logaddexp.reduce(each))

    return max(0.0, log_nothing(found.none.weight, OWN_ROUNDS) - log_nothing(weight, 1)) if len(scales) > 1 else 0.0


def mismatch_test(
    found: Search,
    level: float,
    seed: int = 20240229,
    *,
    weight: np.ndarray | None = None,
    scales: Sequence[float] = KNOWN,
) -> Mismatch:
    """Compare the data's Bayes factor against none with its law when nothing is missing.

    Alternatives are the catalogue's prior draws with free amplitude and smooth functions of the conditions. Noise
    that nobody told could have any of the ``scales`` on either side, as in Student's test; ``weight`` says which
    readings are outliers, by default as the best explanation judges. What that costs nothing missing, which would
    write off others, is taken off.
    Data without mismatch are drawn from the linearised base model: calibration from its prior, noise from its
    law. Beyond the largest draw the bound P(B > b) <= 1/b of any Bayes factor gives the p-value; the bound of the
    search's own, which has fitted what no prior draw comes near, such as a ripple of any order, is taken with a
    margin for its approximations.
    """
    full = found
    found = full.screened
    problem, none = found.problem, found.none
    fixed = np.hstack([none.slopes, problem.shared])
    weight = judged_weight(found) if weight is None else weight
    alternatives = [_Alternatives.of(found, fixed, weight, scale) for scale in scales]
    rng = np.random.default_rng(seed)
    noise = rng.standard_normal((DRAWS, problem.y.size)) / np.sqrt(weight)
    drawn = _statistic(alternatives, noise + rng.standard_normal((DRAWS, fixed.shape[1])) @ fixed.T)
    observed = float(_statistic(alternatives, none.anchor[None, :])[0]) - _cost(found, fixed, weight, scales)
    p = (1.0 + float((drawn >= observed).sum())) / (DRAWS + 1.0)
    if observed > drawn.max():
        p = min(p, float(np.exp(-min(observed, 700.0))))
    p = min(p, UNSURE * float(np.exp(-min(full.log_bayes_factor, 700.0))))
    chi2 = float((full.problem.of_one(full.none.residual) ** 2).sum() + full.none.z @ full.none.z)
    return Mismatch(bool(p <= level), p, level, chi2, int(full.problem.y.size), observed)


def told_from_nothing(weighed: Weighed, level: float) -> tuple[Search, Mismatch]:
    """Whether anything is missing, and the search that the answer goes by.

    Where no noise is stated, what suits an explanation best is no fair one for its rival: nothing missing is tested
    under whatever noise it would need itself as well, and has that where it is the answer.
    """
    found = weighed.found
    test = mismatch_test(found, level)
    if weighed.stated:
        test = beyond_noise(found, weighed.times, test)
        if not test.detected:
            return found, test
    alone = weighed.alone()
    if weighed.stated:
        other = test if alone is found else mismatch_test(alone, level)
    else:
        other = mismatch_test(alone, level, weight=judged_weight(found.screened), scales=UNTOLD)
    if other.p_value <= test.p_value:
        return found, test
    if not other.detected:
        return alone, other
    return found, replace(test, p_value=other.p_value, lenient=True)


def beyond_noise(found: Search, times: float, test: Mismatch) -> Mismatch:
    """The test against nothing missing where readings scatter more than the stated noise can be meant to."""
    from scipy.special import chdtrc

    if times <= MOST:
        return test
    good = outlier_chance(found.none.residual) <= 0.5
    if not good.any():
        return replace(test, p_value=SMALLEST, detected=True, unfollowed=True)
    left = float(np.sum(found.none.residual[good] ** 2)) * (times / MOST) ** 2
    p = min(max(float(chdtrc(int(good.sum()), left)), SMALLEST), test.p_value)
    return replace(test, p_value=p, detected=bool(p <= test.level), unfollowed=True)
