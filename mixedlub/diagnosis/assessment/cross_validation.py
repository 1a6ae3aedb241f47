"""Does the verdict predict conditions it was not fitted to: whole levels left out, its parameters refitted.

Which effect it names, which readings are outliers, how much readings scatter and the form of an unnamed mismatch stay
as all readings chose them; laws are held against the levels as published, without the bending that predictions have.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.inference.change_points import elsewhere, places, without
from mixedlub.diagnosis.inference.map_fit import covariance, linear_fit, log_likelihood, map_fit
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.search import Search
from mixedlub.recording.conditions import is_constant
from mixedlub.recording.set_points import set_points

MOST_FOLDS = 8
"""Levels left out in turn, at most; more are joined."""
WIDE_SPAN = 0.2
"""Span of a condition, as a share of its size, from which leaving out its levels is a test of prediction; judgement.

It only ranks conditions that were varied: levels that lie close together predict one another whatever the law.
"""
TOLERATED = 0.3
"""Share of the mismatch on levels left out that the right law, in another literature form, may leave."""
DEMERIT = 20.0
"""Most that failing on levels left out costs in log odds: no doubt is left then."""
LEAST = 0.3
"""Smallest mismatch, in squared sigmas, of which a share left over is told."""
CHANCE = 5.0
"""How much better than the unnamed mismatch a name may predict levels left out by chance, in log probability."""
FORETOLD, NOISY = 0.8, 2.0
"""Share of the mismatch on inner levels that a name foretells so that no unnamed form may rule it out; and how many
times their variance readings may lie off there."""
LESS = 0.5
"""Share of what an unnamed form leaves there, above noise, from which down a name clearly leaves less."""


@dataclass(frozen=True)
class HeldOut:
    """Rms of (recorded - predicted)/sd on levels left out, calibration only and with the verdict; sd as of the problem.

    ``surprise`` is that of the verdict over noise and what the other levels leave open of its parameters together,
    ``score`` the log probability of the readings under both, ``score_before`` that with calibration only.
    """

    before: float
    after: float
    split: str
    folds: int
    readings: int
    surprise: float
    score: float
    score_before: float

    def of_one(self, together: float) -> HeldOut:
        """The same in sigmas of a single reading, where so many tell as much as one."""
        times = float(np.sqrt(together))
        return replace(self, before=times * self.before, after=times * self.after)

    @property
    def inflation(self) -> float:
        r"""How many times their variance readings left out lie off, :math:`\hat c = s^2/(1 + 2\sqrt{2/n})`; 1 or more.

        Noise and what other levels leave open are known; what is beyond them, and beyond two standard errors of
        chance, makes every log probability of the readings too steep by as much: J.-D. Lebreton, K. P. Burnham,
        J. Clobert, D. R. Anderson, Ecol. Monogr. 62 (1992) 67.

        >>> [round(HeldOut(9.0, s, "", 5, 200, s, 0.0, 0.0).inflation, 1) for s in (1.0, 2.0)]
        [1.0, 3.3]
        """
        return float(max(self.surprise**2 / (1.0 + 2.0 * np.sqrt(2.0 / self.readings)), 1.0))

    def demerit(self, rms: float) -> float:
        """What a named law loses in log odds if it leaves much of the mismatch unexplained on levels left out.

        A law that is a little wrong still explains most of it there; what fits all readings but fails there is
        another law in disguise. ``rms`` is that of the residual with all readings fitted; two standard errors of its
        square are allowed for chance, and what the other levels cannot tell of the parameters is no failure.

        >>> well, badly = (HeldOut(3.0, rms, "", 5, 200, rms, 0.0, 0.0) for rms in (1.1, 2.6))
        >>> well.demerit(1.0), badly.demerit(1.0) > 5.0
        (0.0, True)
        """
        noise = max(rms, 1.0) ** 2
        missing = max(self.before**2 - noise, LEAST)
        left = max(self.surprise**2 - noise * (1.0 + 2.0 * np.sqrt(2.0 / self.readings)), 0.0)
        return float(min(DEMERIT * max(left / missing - TOLERATED, 0.0), DEMERIT))

    def behind(self, name: HeldOut) -> float:
        """What the unnamed mismatch loses in log odds if a name predicts levels left out better than it does.

        It follows any readings, and where it does not carry over to others and a law does, the law has seen more. A
        law that tells no more there than calibration alone has seen nothing.
        """
        told = min(name.score - self.score, name.score - name.score_before)
        return float(np.clip(told - CHANCE, 0.0, DEMERIT))

    def outdone(self, name: HeldOut) -> bool:
        """Whether a name foretells nearly all of the mismatch on levels left out and this, the unnamed, clearly less.

        What follows the readings that closely that it foretells no others cannot rule a name out. Both are told on
        inner levels: beyond the others any law goes on and any free form ends.

        >>> ripple, stribeck = (HeldOut(3.9, left, "", 8, 144, s, 0.0, 0.0) for left, s in ((3.7, 1.0), (1.6, 1.4)))
        >>> ripple.outdone(stribeck), stribeck.outdone(ripple)
        (True, False)
        """
        missing, left = name.before**2 - 1.0, name.after**2 - 1.0
        near = left < (1.0 - FORETOLD) * missing and name.inflation < NOISY
        return missing > LEAST and near and left < LESS * (self.after**2 - 1.0)


@dataclass(frozen=True, eq=False)
class _Fold:
    """One level left out: its rows, the problem of the others and its own, and what its readings scatter by."""

    out: np.ndarray
    train: Problem
    test: Problem
    wide: np.ndarray


@dataclass(frozen=True, eq=False)
class LevelsOut:
    """The levels of one condition left out in turn, and how calibration alone predicts them."""

    found: Search
    used: np.ndarray
    name: str
    folds: tuple[_Fold, ...]
    before: np.ndarray
    inner: np.ndarray
    left: dict[Explanation, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)
    """What verdicts that were tried leave, each refitted once."""

    @classmethod
    def of(cls, whole: Search) -> LevelsOut:
        """Leave out each level of the condition with the most levels (up to 8)."""
        found = whole.screened
        name, label, ordered = _folds(found)
        folds, before = [], np.zeros(found.problem.y.size)
        for k in range(int(label.max()) + 1):
            out = label == k
            train, test = found.problem.take(~out), found.problem.take(out)
            # A set-up's own error is part of what a left-out reading scatters by.
            wide = test.sd * np.sqrt(1.0 + np.sum(test.shared**2, axis=1))
            none = map_fit(train, NOTHING, found.none.z)
            before[out] = (test.y - test.predict(NOTHING, none.z)) / wide
            folds.append(_Fold(out, train, test, wide))
        used = np.isin(whole.problem.rows["run"], found.problem.rows["run"])
        inner = (label > label.min()) & (label < label.max()) if ordered else np.ones(label.size, bool)
        return cls(found, used, name, tuple(folds), before, inner)

    def held(self, verdict: Explanation, outliers: np.ndarray, inner: bool = False) -> HeldOut:
        """How a verdict predicts each level without it; ``inner``: of levels between others."""
        outliers = outliers[self.used]
        if verdict not in self.left:
            self.left[verdict] = self._left_by(verdict)
        after, open_variance = self.left[verdict]
        kept = ~outliers if not outliers.all() else np.ones(outliers.size, bool)
        kept = kept & self.inner if inner and (kept & self.inner).any() else kept
        spread = np.sqrt(1.0 + open_variance)
        return HeldOut(
            float(np.sqrt(np.mean(self.before[kept] ** 2))),
            float(np.sqrt(np.mean(after[kept] ** 2))),
            f"leave one level of {self.name} out" if self.name else "leave every fifth reading out",
            len(self.folds),
            int(kept.sum()),
            float(np.sqrt(np.mean((after / spread)[kept] ** 2))),
            float((log_likelihood(after / spread)[0] - np.log(spread)).sum()),
            float(log_likelihood(self.before)[0].sum()),
        )

    def _left_by(self, verdict: Explanation) -> tuple[np.ndarray, np.ndarray]:
        """Residual of every reading and its open variance, the parameters of a verdict refitted without its level."""
        after, open_variance = np.zeros((2, self.before.size))
        forms = _unnamed_columns(self.found) if verdict == DISCREPANCY else []
        for f in self.folds:
            if verdict == DISCREPANCY:
                left, variance = _unknown_left(self.found, forms, f.out)
                after[f.out] = left * f.test.sd / f.wide
                open_variance[f.out] = variance * (f.test.sd / f.wide) ** 2
            elif verdict == NOTHING:
                after[f.out] = self.before[f.out]
            else:
                fit = map_fit(f.train, verdict, self.found.fits[verdict].z, warm=True)
                run = f.test.run(fit.explanation, fit.z)
                # The level left out may be the one that showed where a sudden change stands.
                found = places(f.train, fit)
                gain, (variance, _, _) = elsewhere(
                    found, fit.z, partial(f.test.predict, fit.explanation), run.prediction
                )
                after[f.out] = (f.test.y - run.prediction - gain) / f.wide
                sudden = [p.index for p in found]
                slopes = without(f.test.jacobian(fit.explanation, fit.z, run), sudden) * (f.test.sd / f.wide)[:, None]
                columns = np.hstack([without(fit.slopes, sudden), f.train.shared])
                open_variance[f.out] = _open_variance(columns, fit.weight, slopes) + variance / f.wide**2
        return after, open_variance


def _open_variance(columns: np.ndarray, weight: np.ndarray, slopes: np.ndarray) -> np.ndarray:
    """Variance, in sigmas, of predictions with these slopes by what a fit to other readings leaves open.

    ``columns`` are the slopes of that fit; ``slopes`` has the first of them.
    """
    own = covariance(columns, weight)[: slopes.shape[1], : slopes.shape[1]]
    return np.asarray(np.einsum("ij,jk,ik->i", slopes, own, slopes))


def _unnamed_columns(found: Search) -> list[np.ndarray]:
    """Columns of the unnamed mismatch, of a peak or a step wherever it may stand."""
    shapes = found.unknown.best.elsewhere(found.space, found.values)
    return [shape.columns(found.space, found.values, found.unknown.carriers) for shape in shapes]


def _unknown_left(found: Search, forms: list[np.ndarray], out: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Residual of left-out readings under the unnamed mismatch fitted to the others (linearised), its open variance.

    Which of its ``forms`` it is, is for the other readings to say as well.
    """
    problem, none = found.problem, found.none
    log, left, variance = [], [], []
    for own in forms:
        columns = np.hstack([none.slopes, problem.shared, own])
        fit = linear_fit(none.anchor[~out], columns[~out])
        blind = np.hstack([none.slopes, np.zeros_like(problem.shared), own])[out]
        log.append(fit.evidence)
        left.append(none.anchor[out] - blind @ fit.coefficients)
        variance.append(_open_variance(columns[~out], fit.weight, blind))
    chance = np.exp(np.array(log) - max(log))
    chance = chance / chance.sum()
    mean = chance @ np.array(left)
    return mean, chance @ (np.array(variance) + (np.array(left) - mean) ** 2)


def _folds(found: Search) -> tuple[str, np.ndarray, bool]:
    """The condition with the most levels, the level of every reading, and whether levels have an order.

    One that spans little of its size comes behind all others, and of as many levels the one that spans most goes:
    what jitters about a set-point has levels too.
    """
    best: tuple[bool, int, float, str, np.ndarray, bool] | None = None
    for axis, values in zip(found.space.axes, found.values, strict=True):
        if axis.name in ("sequence", "composite_roughness_um"):
            continue
        values = set_points(values)
        levels, label = np.unique(values, return_inverse=True)
        if levels.size > MOST_FOLDS and not axis.named:
            edges = np.unique(np.quantile(values, np.linspace(0, 1, MOST_FOLDS + 1)[1:-1]))
            label = np.searchsorted(edges, values, side="right")
        if levels.size > MOST_FOLDS and axis.named:
            label = label % MOST_FOLDS
        count = int(np.unique(label).size)
        span = 1.0 if axis.named else float(np.ptp(values) / np.max(np.abs(values)))
        warm = axis.name.endswith("temperature_C")
        wide = not is_constant(axis.name, values) if warm else span > WIDE_SPAN
        rank = bool(wide), count, span
        if count >= 3 and (best is None or rank > best[:3]):
            best = (*rank, axis.name, np.unique(label, return_inverse=True)[1], not axis.named)
    if best is None:
        return "", np.arange(found.problem.y.size) % min(5, found.problem.y.size), False
    return best[3:]
