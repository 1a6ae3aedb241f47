"""Selection of explanations with one more effect, and starting values of their fits."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.initial_guesses import PriorDraws
from mixedlub.diagnosis.inference.map_fit import Fit, whitening
from mixedlub.diagnosis.problem import Problem


def promising_additions(
    problem: Problem, leaders: Sequence[Fit], draws: Sequence[PriorDraws], most: int
) -> list[tuple[Explanation, np.ndarray]]:
    """Leading explanations with one more effect that are most probable under the linearised model, the best first.

    Each has a start: the leading explanation is at its fit, and the other effect at a draw of its prior.
    """
    scored: dict[Explanation, tuple[float, np.ndarray]] = {}
    calibration = problem.calibration_size
    for fit in leaders:
        whitened = whitening(np.hstack([fit.slopes, problem.shared]), fit.weight)
        whitened_residual = whitened(fit.anchor[None, :])[0]
        for other in draws:
            if other.id in fit.explanation.effects:
                continue
            gain = other.change @ whitened_residual - 0.5 * np.einsum("ij,ij->i", other.change, whitened(other.change))
            gain -= 0.5 * np.einsum("ij,ij->i", other.z, other.z)
            k = int(np.argmax(gain))
            score = fit.evidence + float(gain[k])
            coordinates = {**problem.own_coordinates(fit.explanation, fit.z), other.id: other.z[k]}
            larger = Explanation.of(*coordinates)
            if larger not in scored or score > scored[larger][0]:
                start = np.concatenate([fit.z[:calibration], *(coordinates[name] for name in larger.effects)])
                scored[larger] = (score, start)
    ranked = sorted(scored, key=lambda one: -scored[one][0])[:most]
    return [(one, scored[one][1]) for one in ranked]
