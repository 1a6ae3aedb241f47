"""Slow, trusted evidence to check the fast one against: importance sampling and nested sampling.

For recordings without errors shared within a set-up, which it does not count.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import gammaln, ndtri

from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.likelihood import log_likelihood
from mixedlub.diagnosis.inference.map_fit import Fit, covariance
from mixedlub.diagnosis.problem import Problem

PROPOSAL_FREEDOM = 6.0
"""Degrees of freedom of the Student law that draws are taken from: tails wider than those of the posterior."""
STOP = 0.1
"""Share of the evidence (log) left when nested sampling stops."""


@dataclass(frozen=True)
class Evidence:
    """Log marginal likelihood, its own error, and the share of draws that count."""

    value: float
    error: float
    effective_share: float


def importance_evidence(problem: Problem, fit: Fit, draws: int, seed: int = 1) -> Evidence:
    """Evidence by importance sampling from a Student law laid over the fit."""
    rng = np.random.default_rng(seed)
    root = np.linalg.cholesky(covariance(fit.slopes, fit.weight))
    size = fit.z.size
    normal = rng.standard_normal((draws, size))
    stretch = np.sqrt(PROPOSAL_FREEDOM / rng.chisquare(PROPOSAL_FREEDOM, draws))
    z = fit.z + (normal * stretch[:, None]) @ root.T
    distance = np.einsum("ij,ij->i", normal, normal) * stretch**2
    log_proposal = (
        gammaln(0.5 * (PROPOSAL_FREEDOM + size))
        - gammaln(0.5 * PROPOSAL_FREEDOM)
        - 0.5 * size * np.log(PROPOSAL_FREEDOM * np.pi)
        - np.log(np.diag(root)).sum()
        - 0.5 * (PROPOSAL_FREEDOM + size) * np.log1p(distance / PROPOSAL_FREEDOM)
    )
    log_prior = -0.5 * np.einsum("ij,ij->i", z, z) - 0.5 * size * np.log(2.0 * np.pi)
    likelihood = np.array([_log_likelihood(problem, fit.explanation, row) for row in z])
    weight = likelihood + log_prior - log_proposal
    top = weight.max()
    share = np.exp(weight - top)
    mean = share.mean()
    effective = float(share.sum() ** 2 / (share**2).sum())
    error = float(np.std(share) / (mean * np.sqrt(draws)))
    return Evidence(float(top + np.log(mean)), error, effective / draws)


def nested_evidence(problem: Problem, explanation: Explanation, points: int, seed: int = 1) -> Evidence:
    """Evidence by nested sampling over the prior."""
    import dynesty

    sampler = dynesty.NestedSampler(
        lambda z: _log_likelihood(problem, explanation, z),
        lambda unit: ndtri(np.clip(unit, 1e-9, 1.0 - 1e-9)),
        problem.size(explanation),
        nlive=points,
        sample="rwalk",
        bootstrap=0,
        rstate=np.random.default_rng(seed),
    )
    sampler.run_nested(print_progress=False, dlogz=STOP)
    result = sampler.results
    return Evidence(float(result.logz[-1]), float(result.logzerr[-1]), float("nan"))


def _log_likelihood(problem: Problem, explanation: Explanation, z: np.ndarray) -> float:
    """Log likelihood of all readings at coordinates z."""
    with np.errstate(all="ignore"):
        residual = (problem.y - problem.predict(explanation, z)) / problem.sd
    if not np.isfinite(residual).all():
        return -1e10
    value, _ = log_likelihood(residual)
    return float(value.sum())
