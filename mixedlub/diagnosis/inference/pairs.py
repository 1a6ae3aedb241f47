"""Which pairs of effects are fitted, and the starting values of these fits."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.initial_guesses import PriorDraws
from mixedlub.diagnosis.inference.map_fit import Fit, whitening
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.settings.inference import PAIR_LEADERS, PAIRS


def promising_pairs(
    problem: Problem, singles: dict[Explanation, Fit], draws: tuple[PriorDraws, ...]
) -> list[tuple[Explanation, np.ndarray]]:
    """Pairs that are most probable under the linearised model, the best first, each with a start.

    One of the leading effects is at its fit, and the other at a draw of its prior.
    """
    scored: dict[Explanation, tuple[float, np.ndarray]] = {}
    calibration = problem.calibration_size
    for fit in sorted(singles.values(), key=lambda f: -f.evidence)[:PAIR_LEADERS]:
        whitened = whitening(np.hstack([fit.slopes, problem.shared]), fit.weight)
        whitened_residual = whitened(fit.anchor[None, :])[0]
        for other in draws:
            if other.id in fit.explanation.effects:
                continue
            gain = other.change @ whitened_residual - 0.5 * np.einsum("ij,ij->i", other.change, whitened(other.change))
            gain -= 0.5 * np.einsum("ij,ij->i", other.z, other.z)
            k = int(np.argmax(gain))
            score = fit.evidence + float(gain[k])
            coordinates = {fit.explanation.effects[0]: fit.z[calibration:], other.id: other.z[k]}
            pair = Explanation.of(*coordinates)
            if pair not in scored or score > scored[pair][0]:
                start = np.concatenate([fit.z[:calibration], *(coordinates[name] for name in pair.effects)])
                scored[pair] = (score, start)
    ranked = sorted(scored, key=lambda pair: -scored[pair][0])[:PAIRS]
    return [(pair, scored[pair][1]) for pair in ranked]
