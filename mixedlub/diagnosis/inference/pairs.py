"""Which pairs of effects are worth a fit, and where those fits start."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.initial_guesses import Sampled
from mixedlub.diagnosis.inference.map_fit import Fit, bounded, covariance, whitening
from mixedlub.diagnosis.problem import Problem

LEADERS = 8
"""Effects that pairs are formed with: a pair of which neither leads alone is found by drawing both together."""
PAIRS, BOUNDED_PAIRS, JOINT_PAIRS = 30, 8, 10
EXCHANGED, ROUNDS = 6, 3
"""Pairs that are tried in exchange for the best one at a time, and how often at most."""


def promising_pairs(
    problem: Problem, none: Fit, singles: dict[Explanation, Fit], sampled: tuple[Sampled, ...]
) -> list[tuple[Explanation, np.ndarray]]:
    """Pairs that the linearised model likes best, each with a start, or two.

    A first effect alone may have taken for outliers the few readings that show the second: some pairs are those liked
    best where no reading is written off, but bounded. And it may stand where no second one helps it: others are
    those whose draws are best together.
    """
    found: dict[Explanation, np.ndarray] = {}
    leaders = sorted(singles.values(), key=lambda f: -f.evidence)[:LEADERS]
    for write_off, most in ((True, PAIRS), (False, BOUNDED_PAIRS)):
        weight = [f.weight if write_off else bounded(f.residual)(f.residual)[1] for f in leaders]
        ranked = _ranked(_beside(problem, leaders, weight, sampled, write_off))
        found.update([item for item in ranked if item[0] not in found][:most])
    return [*found.items(), *_ranked(_drawn_together(problem, none, sampled))[:JOINT_PAIRS]]


def exchanged(problem: Problem, best: Fit, sampled: tuple[Sampled, ...]) -> list[tuple[Explanation, np.ndarray]]:
    """Pairs in which one of the ``best`` two effects stays as it stands, and a third takes the place of the other.

    Where one effect leads by far, pairs with it fill the list, and two that are right together may not be on it.
    """
    calibration = problem.calibration_size
    first, second = (Explanation.of(name) for name in best.explanation.effects)
    middle = problem.size(first)
    parts = (best.z[:middle], np.concatenate([best.z[:calibration], best.z[middle:]]))
    kept = [best.at(problem, alone, z) for alone, z in zip((first, second), parts, strict=True)]
    others = tuple(s for s in sampled if s.id not in best.explanation.effects)
    ranked = _ranked(_beside(problem, kept, [best.weight] * len(kept), others, False))
    return ranked[:EXCHANGED]


def _ranked(scores: dict[Explanation, tuple[float, np.ndarray]]) -> list[tuple[Explanation, np.ndarray]]:
    return [(pair, start) for pair, (_, start) in sorted(scores.items(), key=lambda item: -item[1][0])]


def _drawn_together(
    problem: Problem, none: Fit, sampled: tuple[Sampled, ...]
) -> dict[Explanation, tuple[float, np.ndarray]]:
    """Score of the best two draws of each pair of effects, their changes added, and where they are."""
    if not sampled:
        return {}
    columns = np.hstack([none.slopes, problem.shared])
    every = np.ones(len(columns))
    inner = covariance(columns, every)
    changes = np.vstack([s.change for s in sampled])
    whitened = whitening(columns, every)(changes)
    gain = whitened @ none.anchor - 0.5 * np.einsum("ij,ij->i", changes, whitened)
    gain -= 0.5 * np.concatenate([np.einsum("ij,ij->i", s.z, s.z) for s in sampled])
    ends = np.cumsum([len(s.z) for s in sampled])
    found: dict[Explanation, tuple[float, np.ndarray]] = {}
    for one, other in combinations(range(len(sampled)), 2):
        a, b = (slice(ends[k] - len(sampled[k].z), ends[k]) for k in (one, other))
        score = gain[a][:, None] + gain[b][None, :] - whitened[a] @ changes[b].T
        i, j = np.unravel_index(int(np.argmax(score)), score.shape)
        own = {sampled[one].id: sampled[one].z[i], sampled[other].id: sampled[other].z[j]}
        left = none.anchor - sampled[one].change[i] - sampled[other].change[j]
        calibrated = (inner @ (columns.T @ left))[: none.z.size]
        pair = Explanation.of(*own)
        start = np.concatenate([calibrated, *(own[name] for name in pair.effects)])
        found[pair] = (float(score[i, j]), start)
    return found


def _beside(
    problem: Problem, leaders: Sequence[Fit], weights: Sequence[np.ndarray], sampled: tuple[Sampled, ...], whole: bool
) -> dict[Explanation, tuple[float, np.ndarray]]:
    """Score of each pair of a leading effect, as it stands, and another one, and where it is best.

    What the leader alone has is its ``whole`` evidence, or what its readings leave over at these weights.
    """
    found: dict[Explanation, tuple[float, np.ndarray]] = {}
    calibration = problem.calibration_size
    for fit, weight in zip(leaders, weights, strict=True):
        whitened = whitening(np.hstack([fit.slopes, problem.shared]), weight)
        left = whitened(fit.anchor[None, :])[0]
        level = fit.evidence if whole else -0.5 * float(left @ fit.anchor)
        for other in sampled:
            if other.id in fit.explanation.effects:
                continue
            gain = other.change @ left - 0.5 * np.einsum("ij,ij->i", other.change, whitened(other.change))
            gain -= 0.5 * np.einsum("ij,ij->i", other.z, other.z)
            k = int(np.argmax(gain))
            score = level + float(gain[k])
            own = {fit.explanation.effects[0]: fit.z[calibration:], other.id: other.z[k]}
            pair = Explanation.of(*own)
            start = np.concatenate([fit.z[:calibration], *(own[name] for name in pair.effects)])
            if pair not in found or score > found[pair][0]:
                found[pair] = (score, start)
    return found
