"""Fit of one law: most probable parameters, their intervals, and the evidence by Laplace's approximation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import least_squares, minimize
from scipy.special import gammaln
from scipy.stats import norm, qmc
from scipy.stats import t as student

from mixedlub.fit.candidates import Candidate
from mixedlub.fit.readings import Readings

STARTS_LOG2 = 7
"""Cost limit. Starting points that are tried, as a power of two."""
DESCENTS = 5
"""Cost limit. Best starting points from which the fit descends."""
ROUNDS = 12
"""Cost limit. Turns of fitting parameters and unknown noise."""
SETTLED = 1e-3
"""Judgement. Relative change of the unknown noise at which these turns end; the evidence changes by its square."""
POLISH = 40
"""Cost limit. Last steps of parameters and unknown noise together."""
STEP = 1e-6
"""Judgement. Relative change of coordinates and squares at which a descent ends."""
AGREED = 1e-2
"""Judgement. Difference in log probability of two descents that found the same answer."""
EXACT = 1e-6
"""Judgement. Least standard deviation of a reading over its size: readings are written with few digits."""
UNDETERMINED = 0.95
"""Judgement. Share of the prior's standard deviation from which readings leave a parameter undetermined."""
REACH = 8.0
"""Judgement. Largest distance from the middle of a prior, in standard deviations."""
FAR = 30.0
"""Judgement. Residual that stands for a law without a finite value."""
TINY = 1e-300


@dataclass(frozen=True, eq=False)
class Fit:
    """A fitted law.

    ``parameters``: most probable values by name; ``low90``, ``high90``: their 90 % intervals; ``undetermined``:
    parameters that the readings leave at their prior. ``fitted``: values of the law; ``sd``: standard deviation of
    each reading, as stated or estimated; ``evidence``: logarithm of the probability of the readings.
    """

    law: Candidate
    parameters: Mapping[str, float]
    low90: Mapping[str, float]
    high90: Mapping[str, float]
    undetermined: tuple[str, ...]
    fitted: np.ndarray
    sd: np.ndarray
    residuals: np.ndarray
    evidence: float
    log_likelihood: float
    coordinates: np.ndarray

    @property
    def free(self) -> int:
        """Number of parameters that the readings determine."""
        return len(self.parameters) - len(self.undetermined)


class Problem:
    """Residuals of a law on readings, over standard-normal coordinates of its parameters."""

    def __init__(self, law: Candidate, readings: Readings) -> None:
        self.law, self.readings = law, readings
        self.state = {name: readings.get(name) for name in law.reads}
        self.logarithmic = readings.is_logarithmic
        size = np.abs(readings.values)
        self.target = np.log(readings.values) if self.logarithmic else readings.values
        # Without a stated noise it is one share of the reading, or one size where readings have either sign.
        self.unit = np.ones(len(readings)) if self.logarithmic else np.full(len(readings), readings.median_size)
        self.known = readings.sd is not None
        if readings.sd is not None:
            least = np.maximum(readings.sd, EXACT * size)
            self.unit = least / size if self.logarithmic else least

    def values(self, z: np.ndarray) -> dict[str, float]:
        """Parameters at coordinates."""
        within = np.clip(z, -REACH, REACH)
        return {p.name: p.prior.value(float(x)) for p, x in zip(self.law.parameters, within, strict=True)}

    def predicted(self, z: np.ndarray) -> np.ndarray:
        """Values of the law."""
        with np.errstate(all="ignore"):
            found: Any = self.law.law(self.state, self.values(z))  # type: ignore[arg-type]
        return np.broadcast_to(np.asarray(found, dtype=float), (len(self.readings),))

    def residuals(self, z: np.ndarray) -> np.ndarray:
        """Predicted minus measured, in units of the stated noise or of the reading."""
        found = self.predicted(z)
        if self.logarithmic:
            with np.errstate(all="ignore"):
                found = np.log(np.maximum(found, TINY))
        with np.errstate(all="ignore"):
            off = (found - self.target) / self.unit
        most = FAR if not self.known else FAR / float(np.median(self.unit))
        return np.where(np.isfinite(off), np.clip(off, -1e6, 1e6), most)

    def scale(self, z: np.ndarray) -> float:
        """Factor on the unit of the noise: 1 if it is stated, else estimated."""
        if self.known:
            return 1.0
        return max(float(np.sqrt(np.mean(self.residuals(z) ** 2))), EXACT)


def fit(law: Candidate, readings: Readings, start: np.ndarray | None = None) -> Fit:
    """Fit of a law to readings; ``start``: coordinates near the answer, which save the search."""
    problem = Problem(law, readings)
    starts = [start] if start is not None else _starts(problem)
    return _answer(problem, _best(problem, starts))


def _best(problem: Problem, starts: list[np.ndarray]) -> np.ndarray:
    """Best answer of the descents, which end once two agree on it."""
    answers: list[tuple[float, np.ndarray]] = []
    for z in starts:
        found = _descended(problem, z)
        answers.append((_objective(problem, found), found))
        answers.sort(key=lambda one: one[0])
        if len(answers) > 1 and answers[1][0] - answers[0][0] < AGREED:
            break
    best = answers[0][1]
    if problem.known or not best.size:
        return best
    # Turns of parameters and noise creep where prior and readings disagree.
    polished = minimize(lambda z: _objective(problem, z), best, method="BFGS", options={"maxiter": POLISH})
    return np.asarray(polished.x if polished.fun < answers[0][0] else best)


def _objective(problem: Problem, z: np.ndarray) -> float:
    """Negative logarithm of the posterior, up to a constant."""
    square = float(np.sum(problem.residuals(z) ** 2))
    n = len(problem.readings)
    misfit = 0.5 * square if problem.known else 0.5 * n * np.log(max(square, n * EXACT**2))
    return float(misfit + 0.5 * z @ z)


def _starts(problem: Problem) -> list[np.ndarray]:
    """Best points of a net over the priors, and their middle."""
    k = len(problem.law.parameters)
    net = qmc.Sobol(k, scramble=True, rng=np.random.default_rng(0)).random_base2(STARTS_LOG2)
    points = [np.zeros(k), *norm.ppf(np.clip(net, 1e-4, 1.0 - 1e-4))]
    points.sort(key=lambda z: _objective(problem, z))
    return points[:DESCENTS]


def _descended(problem: Problem, z: np.ndarray) -> np.ndarray:
    scale = problem.scale(z)
    for _ in range(1 if problem.known else ROUNDS):

        def together(x: np.ndarray, scale: float = scale) -> np.ndarray:
            return np.concatenate([problem.residuals(x) / scale, x])

        z = least_squares(together, z, method="lm", xtol=STEP, ftol=STEP, max_nfev=60 * (z.size + 1)).x
        before, scale = scale, problem.scale(z)
        if abs(scale - before) < SETTLED * before:
            break
    return z


def _answer(problem: Problem, z: np.ndarray) -> Fit:
    n, k = len(problem.readings), z.size
    residuals, scale = problem.residuals(z), problem.scale(z)
    jacobian = _jacobian(problem, z) / scale
    precision = jacobian.T @ jacobian + np.eye(k)
    # An estimated noise is too small by the parameters that were fitted with it.
    share = 1.0 if problem.known else max(n - k, 1) / n
    spread = np.sqrt(np.diag(np.linalg.inv(share * (jacobian.T @ jacobian) + np.eye(k))))
    square = max(float(residuals @ residuals), n * EXACT**2)
    unit = problem.unit * np.abs(problem.readings.values) if problem.logarithmic else problem.unit
    sizes = float(np.sum(np.log(unit)))
    if problem.known:
        likelihood = -0.5 * square - sizes - 0.5 * n * np.log(2.0 * np.pi)
        most = likelihood
    else:
        likelihood = float(gammaln(0.5 * n)) - 0.5 * n * np.log(np.pi * square) - sizes
        most = -0.5 * n * (np.log(2.0 * np.pi * square / n) + 1.0) - sizes
    evidence = likelihood - 0.5 * z @ z - 0.5 * np.linalg.slogdet(precision)[1]
    wide = norm.isf(0.05) if problem.known else student.isf(0.05, max(n - k, 1))
    names = [p.name for p in problem.law.parameters]
    loose = tuple(name for name, own in zip(names, spread, strict=True) if own > UNDETERMINED)
    # Readings never leave a parameter less known than its prior.
    half = np.minimum(wide * spread, norm.isf(0.05))
    ends = [problem.values(z - half), problem.values(z + half)]
    low = {name: min(end[name] for end in ends) for name in names}
    high = {name: max(end[name] for end in ends) for name in names}
    fitted = problem.predicted(z)
    return Fit(
        problem.law,
        problem.values(z),
        low,
        high,
        loose,
        fitted,
        unit * scale,
        residuals / scale,
        float(evidence),
        float(most),
        z,
    )


def _jacobian(problem: Problem, z: np.ndarray) -> np.ndarray:
    step = 1e-5
    columns = []
    for place in range(z.size):
        moved = np.zeros_like(z)
        moved[place] = step
        columns.append((problem.residuals(z + moved) - problem.residuals(z - moved)) / (2.0 * step))
    return np.stack(columns, axis=1) if columns else np.zeros((len(problem.readings), 0))


def predicted_from(found: Fit, readings: Readings) -> np.ndarray:
    """Values of a fitted law at the conditions of other readings."""
    return Problem(found.law, readings).predicted(found.coordinates)
