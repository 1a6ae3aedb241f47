"""Which pairs of effects are fitted, and the starting values of these fits."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.initial_guesses import PriorDraws
from mixedlub.diagnosis.inference.map_fit import Fit, bounded, covariance, whitening
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.settings.inference import BOUNDED_PAIRS, JOINT_PAIRS, PAIR_LEADERS, PAIRS


def promising_pairs(
    problem: Problem, null_fit: Fit, singles: dict[Explanation, Fit], draws: tuple[PriorDraws, ...]
) -> list[tuple[Explanation, np.ndarray]]:
    """Pairs that are most probable under the linearised model, each with a start or two.

    A first effect alone may have taken the few readings that show the second for outliers, so some pairs are ranked
    with bounded weights instead. Its fit may also be far from that of the pair, so others are ranked by joint draws.
    """
    starts: dict[Explanation, np.ndarray] = {}
    leaders = sorted(singles.values(), key=lambda f: -f.evidence)[:PAIR_LEADERS]
    for write_off, count in ((True, PAIRS), (False, BOUNDED_PAIRS)):
        weight = [f.weight if write_off else bounded(f.residual)(f.residual)[1] for f in leaders]
        ranked = _ranked(_added_to(problem, leaders, weight, draws, write_off))
        starts.update([item for item in ranked if item[0] not in starts][:count])
    return [*starts.items(), *_ranked(_drawn_together(problem, null_fit, draws))[:JOINT_PAIRS]]


def _ranked(scores: dict[Explanation, tuple[float, np.ndarray]]) -> list[tuple[Explanation, np.ndarray]]:
    return [(pair, start) for pair, (_, start) in sorted(scores.items(), key=lambda item: -item[1][0])]


def _drawn_together(
    problem: Problem, null_fit: Fit, draws: tuple[PriorDraws, ...]
) -> dict[Explanation, tuple[float, np.ndarray]]:
    """Score and start of the best two draws of each pair of effects, their changes added."""
    if not draws:
        return {}
    columns = np.hstack([null_fit.slopes, problem.shared])
    weight = np.ones(len(columns))
    inner = covariance(columns, weight)
    changes = np.vstack([s.change for s in draws])
    whitened = whitening(columns, weight)(changes)
    gain = whitened @ null_fit.anchor - 0.5 * np.einsum("ij,ij->i", changes, whitened)
    gain -= 0.5 * np.concatenate([np.einsum("ij,ij->i", s.z, s.z) for s in draws])
    ends = np.cumsum([len(s.z) for s in draws])
    scored: dict[Explanation, tuple[float, np.ndarray]] = {}
    for one, other in combinations(range(len(draws)), 2):
        a, b = (slice(ends[k] - len(draws[k].z), ends[k]) for k in (one, other))
        score = gain[a][:, None] + gain[b][None, :] - whitened[a] @ changes[b].T
        i, j = np.unravel_index(int(np.argmax(score)), score.shape)
        coordinates = {draws[one].id: draws[one].z[i], draws[other].id: draws[other].z[j]}
        residual = null_fit.anchor - draws[one].change[i] - draws[other].change[j]
        calibrated = (inner @ (columns.T @ residual))[: null_fit.z.size]
        pair = Explanation.of(*coordinates)
        start = np.concatenate([calibrated, *(coordinates[name] for name in pair.effects)])
        scored[pair] = (float(score[i, j]), start)
    return scored


def _added_to(
    problem: Problem,
    leaders: Sequence[Fit],
    weights: Sequence[np.ndarray],
    draws: tuple[PriorDraws, ...],
    full_evidence: bool,
) -> dict[Explanation, tuple[float, np.ndarray]]:
    """Score and start of each pair of a leading effect, at its fit, and a draw of another effect.

    The leader counts with its ``full_evidence``, or with its residuals at these weights.
    """
    scored: dict[Explanation, tuple[float, np.ndarray]] = {}
    calibration = problem.calibration_size
    for fit, weight in zip(leaders, weights, strict=True):
        whitened = whitening(np.hstack([fit.slopes, problem.shared]), weight)
        whitened_residual = whitened(fit.anchor[None, :])[0]
        level = fit.evidence if full_evidence else -0.5 * float(whitened_residual @ fit.anchor)
        for other in draws:
            if other.id in fit.explanation.effects:
                continue
            gain = other.change @ whitened_residual - 0.5 * np.einsum("ij,ij->i", other.change, whitened(other.change))
            gain -= 0.5 * np.einsum("ij,ij->i", other.z, other.z)
            k = int(np.argmax(gain))
            score = level + float(gain[k])
            coordinates = {fit.explanation.effects[0]: fit.z[calibration:], other.id: other.z[k]}
            pair = Explanation.of(*coordinates)
            start = np.concatenate([fit.z[:calibration], *(coordinates[name] for name in pair.effects)])
            if pair not in scored or score > scored[pair][0]:
                scored[pair] = (score, start)
    return scored
