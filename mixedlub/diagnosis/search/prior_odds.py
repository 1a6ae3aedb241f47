"""Prior odds of explanations: nothing missing, up to three effects, and other laws of the base model."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.diagnosis.problem import effects_of
from mixedlub.diagnosis.settings.search import (
    EXPECTED_CHANCE,
    FULL_PAIR_PRIOR,
    FURTHER_LAW_ODDS,
    LAW_ODDS,
    LEAST_NOTHING_ODDS,
    PRIOR,
)


def priors(effects: int) -> tuple[float, ...]:
    """Prior weights of nothing missing, one effect, two and three, for a number of effects.

    Among few effects the prior of nothing is raised, and the priors of pairs and triples are lowered.

    >>> priors(30), [round(p, 3) for p in priors(6)]
    ((0.42, 0.38, 0.08, 0.02), [0.887, 0.38, 0.019, 0.001])
    """
    if effects == 0:
        return PRIOR["nothing"], 0.0, 0.0, 0.0
    nothing = min(max(PRIOR["nothing"], LEAST_NOTHING_ODDS * PRIOR["single"] / effects), 1.0)
    many = min(1.0, effects / FULL_PAIR_PRIOR)
    return nothing, PRIOR["single"], PRIOR["pair"] * many, PRIOR["triple"] * many**2


def log_odds_of_laws(count: int) -> float:
    """Log prior odds of ``count`` given other laws of the base model against none.

    >>> [round(float(np.exp(log_odds_of_laws(n))), 4) for n in range(4)]
    [1.0, 0.02, 0.002, 0.0002]
    """
    return float(np.log(LAW_ODDS) + (count - 1) * np.log(FURTHER_LAW_ODDS)) if count else 0.0


@dataclass(frozen=True)
class PriorOdds:
    """Prior weights of all explanations formed from given effects and laws."""

    ids: tuple[str, ...]

    @classmethod
    def of(cls, ids: Iterable[str]) -> PriorOdds:
        """Prior odds for effects and laws by id."""
        return cls(tuple(ids))

    @cached_property
    def _odds(self) -> dict[str, float]:
        """Odds of each effect relative to others; 1 of a law of the user."""
        known = {e.id: e for e in effects_of(self.ids)}
        odds = {name: known[name].prior_odds if name in known else 1.0 for name in self.ids}
        others = {name for name, one in known.items() if one.replaces or one.expected}
        return {name: own for name, own in odds.items() if name not in others}

    @cached_property
    def laws(self) -> tuple[str, ...]:
        """Laws that replace a step of the base model."""
        return tuple(name for name in self.ids if name not in self._odds and name not in self.expected)

    @cached_property
    def expected(self) -> tuple[str, ...]:
        """Effects that act by mechanics, so that they need no explanation."""
        return tuple(e.id for e in effects_of(self.ids) if e.expected)

    def log_expected(self, explanation: Explanation) -> float:
        """Log prior probability of the expected effects that an explanation has and lacks.

        >>> odds = PriorOdds.of(["inertia"])
        >>> [round(float(np.exp(odds.log_expected(Explanation.of(*e)))), 2) for e in ((), ("inertia",))]
        [0.1, 0.9]
        """
        has = sum(name in explanation.effects for name in self.expected)
        return float(has * np.log(EXPECTED_CHANCE) + (len(self.expected) - has) * np.log1p(-EXPECTED_CHANCE))

    def log_given(self, explanation: Explanation) -> float:
        """Log prior odds of the other laws and the expected effects of an explanation, the base of a discrepancy."""
        laws = sum(name in self.laws for name in explanation.effects)
        return log_odds_of_laws(laws) + self.log_expected(explanation)

    @cached_property
    def _sizes(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Prior weight of each number of effects, and the sum of the products of odds that share it."""
        weights = priors(len(self._odds))
        sums = np.zeros(len(weights))
        sums[0] = 1.0
        for odds in self._odds.values():
            sums[1:] += odds * sums[:-1]
        return weights, tuple(sums)

    def log(self, explanation: Explanation) -> float:
        """Log prior weight of an explanation."""
        if explanation.is_discrepancy:
            return float(np.log(PRIOR["discrepancy"]))
        effects = self.effects_among(explanation)
        weight, total = (sizes[len(effects)] for sizes in self._sizes)
        odds = sum(np.log(self._odds[n]) for n in effects)
        return float(np.log(weight / total) + odds) + self.log_given(explanation)

    def effects_among(self, explanation: Explanation) -> list[str]:
        """Effects of an explanation, without other laws of the base model."""
        return [name for name in explanation.effects if name in self._odds]

    @property
    def total(self) -> float:
        """Sum of the weights of all explanations."""
        return (sum(self._sizes[0]) + PRIOR["discrepancy"]) * self._of_laws

    @property
    def _of_laws(self) -> float:
        """Weight of all sets of other laws, the empty set included, over the weight of the empty set."""
        return 1.0 + LAW_ODDS / FURTHER_LAW_ODDS * ((1.0 + FURTHER_LAW_ODDS) ** len(self.laws) - 1.0)

    @property
    def of_nothing(self) -> float:
        """Prior weight of nothing missing."""
        return self._sizes[0][0] * float(np.exp(self.log_expected(NOTHING)))

    def chance(self, name: str) -> float:
        """Prior probability of a single effect alone, or of a law."""
        if name in self.laws:
            return LAW_ODDS * (1.0 + FURTHER_LAW_ODDS) ** (len(self.laws) - 1) / self._of_laws
        if name in self.expected:
            return EXPECTED_CHANCE
        return float(np.exp(self.log(Explanation.of(name)))) / (sum(self._sizes[0]) + PRIOR["discrepancy"])
