"""Ranking of laws on readings by evidence, with misfit, left-out error and range of each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.stats import chi2
from scipy.stats import f as fisher

from mixedlub.chain.ranges import Limit, beyond, findings, of_law
from mixedlub.fit.candidates import Unjudged, candidates
from mixedlub.fit.inference import Fit, fit
from mixedlub.fit.misfit import Trend, left_out_error, shares, trend
from mixedlub.fit.readings import Readings
from mixedlub.schema.findings import Finding
from profiles.errors import InputError

TIED = 0.1
"""Definition. Ratio of probabilities from which a law is tied with the best law, as in a diagnosis."""
JUDGED_FURTHER = 6
"""Cost limit. Best laws with an error at left-out levels."""
SAME = 0.02
"""Judgement. Difference of two laws, in standard deviations of a reading, up to which they give the same values."""
UNFIT = 0.01
"""Judgement. Chance of the misfit, given a law, below which the law does not fit to the noise."""
SPARE = 2
"""Judgement. Readings that a law needs beyond its parameters if the noise is estimated too."""


@dataclass(frozen=True, eq=False)
class Ranking:
    """Laws on readings, best first; ``unjudged``: other laws of the quantity, each with the reason."""

    readings: Readings
    fits: Sequence[Fit]
    unjudged: Sequence[Unjudged]

    @property
    def best(self) -> Fit:
        """The most probable law."""
        return self.fits[0]

    @cached_property
    def weights(self) -> np.ndarray:
        """Probability of each law if one of them is true and all were equally probable before."""
        logs = np.array([one.evidence for one in self.fits])
        odds = np.exp(logs - logs.max())
        return np.asarray(odds / odds.sum())

    @property
    def tied(self) -> tuple[str, ...]:
        """Names of the laws that the readings do not tell from the best, the best first."""
        return tuple(
            one.law.name for one, w in zip(self.fits, self.weights, strict=True) if w >= TIED * self.weights[0]
        )

    @cached_property
    def trends(self) -> Mapping[str, Trend | None]:
        """Clearest trend of the residuals of each law."""
        return {one.law.name: trend(one, self.readings) for one in self.fits}

    @cached_property
    def left_out(self) -> Mapping[str, float]:
        """Error at left-out levels of the best laws and of the tied, as a share of the reading."""
        further = max(JUDGED_FURTHER, len(self.tied))
        return {one.law.name: left_out_error(one, self.readings) for one in self.fits[:further]}

    def rms(self, found: Fit) -> float:
        """Root mean square error of a law, as a share of the reading (its logarithm)."""
        return float(np.sqrt(np.mean(shares(found.fitted, self.readings) ** 2)))

    def criteria(self, found: Fit) -> tuple[float, float]:
        """Corrected information criterion of Akaike, and the Bayesian one; an estimated noise counts as a parameter."""
        n, k = len(self.readings), len(found.parameters) + (self.readings.sd is None)
        twice = -2.0 * found.log_likelihood
        spare = n - k - 1
        corrected = twice + 2.0 * k + 2.0 * k * (k + 1) / spare if spare > 0 else float("nan")
        return corrected, twice + k * float(np.log(n))

    def misfit_probability(self, found: Fit) -> float:
        """Chance of at least this misfit if the law is true; NaN if nothing but the law tells the noise.

        Against a stated noise the sum of squares is compared, else the scatter of repeated readings.
        """
        n, k = len(self.readings), found.free
        if self.readings.sd is not None:
            return float(chi2.sf(float(found.residuals @ found.residuals), max(n - k, 1)))
        group = _repeats(self.readings)
        within = sum(
            float(np.sum((found.residuals[group == g] - found.residuals[group == g].mean()) ** 2))
            for g in np.unique(group)
        )
        free, between = n - np.unique(group).size, np.unique(group).size - k
        if free < 2 or between < 1 or within == 0.0:
            return float("nan")
        lack = (float(found.residuals @ found.residuals) - within) / between
        return float(fisher.sf(max(lack, 0.0) / (within / free), between, free))

    def outside(self, found: Fit) -> float:
        """Share of the readings outside the range of the source."""
        known = {name: ends for name, ends in found.law.valid.items() if self._state(found, name) is not None}
        if not known:
            return 0.0
        state = {name: self._state(found, name) for name in known}
        mask = np.broadcast_to(beyond(state, known), (len(self.readings),))
        return float(np.mean(mask))

    def range_findings(self, found: Fit) -> tuple[Finding, ...]:
        """Findings on readings outside the range of the source of a law."""
        reached: list[tuple[Limit, np.ndarray]] = [
            (limit, np.asarray(values))
            for limit in of_law(found.law.name, found.law.valid)
            if (values := self._state(found, limit.quantity)) is not None
        ]
        return findings(reached, (len(self.readings),), "readings", self.readings.source)

    def _state(self, found: Fit, quantity: str) -> np.ndarray | None:
        if quantity == self.readings.quantity:
            return found.fitted
        return self.readings.get(quantity)


def _repeats(readings: Readings) -> np.ndarray:
    """Number of the group of each reading with equal conditions."""
    rows = np.stack(list(readings.columns.values()), axis=1)
    return np.asarray(np.unique(rows, axis=0, return_inverse=True)[1]).reshape(-1)


def ranking(readings: Readings, own: tuple[Path, ...] = ()) -> Ranking:
    """Fit every law of the measured quantity and rank the laws by evidence; ``own``: law files that compete too."""
    laws, unjudged = candidates(readings, own)
    if not laws:
        first = min((one for one in unjudged if one.lacking), key=lambda one: one.lacking)
        rule = f"no law can be judged; the nearest, {first.name}, {first.reason}; a value of all rows goes by --set"
        raise InputError(rule, where=f"{readings.source}: header")
    spare = SPARE if readings.sd is None else 0
    fitted = []
    for law in laws:
        needed = len(law.parameters) + spare
        if needed > len(readings):
            reason = f"{len(law.parameters)} parameters need {needed} readings"
            unjudged.append(Unjudged(law.name, reason))
        else:
            fitted.append(fit(law, readings))
    if not fitted:
        least = min(len(law.parameters) for law in laws) + spare
        rule = f"{len(readings)} readings are fewer than the parameters of any law need; {least} are the least"
        raise InputError(rule, where=readings.source)
    fitted.sort(key=lambda one: -one.evidence)
    kept = _distinct(fitted, unjudged)
    return Ranking(readings, kept, unjudged)


def _distinct(fitted: Sequence[Fit], unjudged: list[Unjudged]) -> list[Fit]:
    """Laws that equal no law of fewer parameters on these readings."""
    kept = []
    for one in fitted:
        twin = next((other for other in fitted if _is_twin(one, other)), None)
        if twin is None:
            kept.append(one)
        else:
            names = ", ".join(one.undetermined)
            reason = f"equals {twin.law.name} on these readings, which do not tell its {names}"
            unjudged.append(Unjudged(one.law.name, reason))
    return kept


def _is_twin(one: Fit, other: Fit) -> bool:
    """Whether a law has undetermined parameters and gives the values of a law with fewer parameters."""
    fewer = bool(one.undetermined) and len(other.parameters) < len(one.parameters)
    return fewer and bool(np.all(np.abs(one.fitted - other.fitted) < SAME * other.sd))
