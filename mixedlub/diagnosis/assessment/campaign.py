"""Campaign of tests: the answer before and after added readings, with expected and realised information."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mixedlub.diagnosis.assessment.experiment_design import Batch
from mixedlub.diagnosis.assessment.posterior import Posterior
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import FLOOR

Ids = tuple[str, ...]


@dataclass(frozen=True)
class Standing:
    """An answer in short: verdict, ties, probabilities by id, and the probability of competing explanations."""

    verdict: Ids
    tied: tuple[Ids, ...]
    probabilities: Mapping[str, float]
    explanations: Mapping[Ids, float]

    @classmethod
    def of(cls, search: Search, judged: Posterior, batch: Batch, also: Sequence[Ids] = ()) -> Standing:
        """Standing of an answer, with the probability of its rivals and of the explanations ``also``."""
        keys = [*(key.ids for key, _ in batch.rivals), *(key.ids for key in judged.tied), *also]
        shares = {ids: judged.weights.get(explanation_of(ids), 0.0) for ids in dict.fromkeys(keys)}
        return cls(judged.verdict.ids, tuple(k.ids for k in judged.tied), judged.inclusion(search), shares)

    @classmethod
    def read(cls, record: Mapping[str, Any]) -> Standing:
        """Standing in a `diagnosis.json`."""
        rivals = record["next_batch"]["rivals"]
        return cls(
            tuple(record["verdict"]),
            tuple(map(tuple, record["tied"])),
            record["probabilities"],
            {tuple(one["explanation"]): float(one["probability"]) for one in rivals},
        )


@dataclass(frozen=True)
class Campaign:
    """Added runs, the standing before and after, and information about the explanation in bits."""

    runs: tuple[int, ...]
    before: Standing
    after: Standing
    expected_bits: float
    realised_bits: float


def explanation_of(ids: Ids) -> Explanation:
    """Explanation of the ids in a file."""
    fixed = {NOTHING.ids: NOTHING, DISCREPANCY.ids: DISCREPANCY}
    return fixed.get(ids) or Explanation.of(*ids)


def realised_bits(before: Mapping[Ids, float], after: Mapping[Ids, float]) -> float:
    """Information of the change from one set of probabilities to another; all other explanations count as one.

    Its expectation under the first set is the expected information.

    >>> round(realised_bits({("a",): 0.5, ("b",): 0.5}, {("a",): 1.0, ("b",): 0.0}), 3)
    1.0
    """
    then, now = ([probabilities.get(key, 0.0) for key in before] for probabilities in (before, after))
    p = np.maximum([*then, 1.0 - sum(then)], FLOOR)
    q = np.maximum([*now, 1.0 - sum(now)], FLOOR)
    p, q = p / p.sum(), q / q.sum()
    return float(q @ np.log2(q / p))
