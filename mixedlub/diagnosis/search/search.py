"""Search over explanations: nothing missing, each effect, several together, and the discrepancy."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mixedlub.diagnosis.discrepancy.model import Discrepancy
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.inference.additions import promising_additions
from mixedlub.diagnosis.inference.change_points import change_point_coordinates, integrate_change_points
from mixedlub.diagnosis.inference.initial_guesses import PriorDraws, fit_singles, sample
from mixedlub.diagnosis.inference.likelihood import log_likelihood
from mixedlub.diagnosis.inference.map_fit import Fit, Linear, map_fit
from mixedlub.diagnosis.inference.nested_laws import linearised_gain, published_gain
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.law_error import BaseError, law_error_evidence
from mixedlub.diagnosis.search.prior_odds import PriorOdds
from mixedlub.diagnosis.search.several import discrepancy_beside_laws, fit_from, one_in_time, with_additions
from mixedlub.diagnosis.settings.inference import (
    HOPELESS_BEHIND,
    OUTLIER_SHARE,
    PAIR_LEADERS,
    PAIRS,
    SEED,
    STRONG_EVIDENCE,
)
from mixedlub.diagnosis.settings.search import (
    AFFECTED,
    LAWS_REFITTED_WITHIN,
    MANY,
    PUBLISHED_WITHIN,
    REFITTED_ON_ALL,
    SUBSET,
)
from mixedlub.recording.conditions import Coordinates
from mixedlub.running.parallel import shared_out

Progress = Callable[[str], None]


@dataclass(frozen=True, eq=False)
class Search:
    """Result of a search; ``untestable`` effects change no reading, so they explain none."""

    problem: Problem
    space: Coordinates
    values: list[np.ndarray]
    null_fit: Fit
    fits: dict[Explanation, Fit]
    scores: dict[Explanation, float]
    discrepancy: Discrepancy
    draws: tuple[PriorDraws, ...]
    untestable: tuple[PriorDraws, ...] = ()
    screen: Search | None = None

    @cached_property
    def base_error(self) -> BaseError:
        """Error of the base model that the recording can show."""
        return BaseError.of(self.problem, self.null_fit, self.space, self.values)

    @property
    def full_screen(self) -> Search:
        """Search over every explanation, on a subset of the rows of a long recording."""
        return self if self.screen is None else self.screen

    @property
    def best_named(self) -> Fit:
        """Fit of the most probable explanation except the discrepancy."""
        return self.fits[max(self.fits, key=self.log_weights.__getitem__)]

    def fit_of(self, explanation: Explanation) -> Fit | Linear:
        """Fit of any explanation, including the discrepancy."""
        return self.discrepancy.fit if explanation.is_discrepancy else self.fits[explanation]

    @property
    def log_weights(self) -> dict[Explanation, float]:
        """Log prior plus log evidence of every explanation."""
        odds = self.prior_odds
        found = {explanation: score + odds.log(explanation) for explanation, score in self.scores.items()}
        found[DISCREPANCY] = self.discrepancy.evidence + odds.log(DISCREPANCY)
        return found

    @property
    def published_log_weights(self) -> dict[Explanation, float]:
        """Log prior plus log evidence of every explanation, with exact laws in their published forms."""
        scores, fits = self.scores, self.fits
        return {m: w if m.is_discrepancy else w - scores[m] + fits[m].evidence for m, w in self.log_weights.items()}

    @property
    def prior_odds(self) -> PriorOdds:
        """Prior odds of the explanations formed from the testable effects."""
        return PriorOdds.of(s.id for s in self.draws)

    @property
    def log_bayes_factor(self) -> float:
        """Log Bayes factor of all explanations together, in their published forms, against nothing missing."""
        logs, prior = self.published_log_weights, self.prior_odds
        nothing = logs.pop(NOTHING)
        odds = float(np.logaddexp.reduce(list(logs.values()))) - nothing
        return odds + float(np.log(prior.of_nothing / (prior.total - prior.of_nothing)))

    @property
    def log_probability(self) -> float:
        """Log probability density of the readings under all explanations together, up to a constant."""
        total = float(np.logaddexp.reduce(list(self.log_weights.values())))
        return total - float(np.log(self.prior_odds.total) + np.log(self.problem.sd).sum())


def search(
    problem: Problem,
    space: Coordinates,
    values: list[np.ndarray],
    exclude: Sequence[str] = (),
    progress: Progress = lambda text: None,
    near: Search | None = None,
) -> Search:
    """Fit and weigh all promising explanations; beyond MANY rows on a subset, and the leaders on all rows.

    A search of the same readings under a ``near`` noise is continued.
    """

    def every(problem: Problem, values: list[np.ndarray]) -> Search:
        if near is None:
            return _search(problem, space, values, exclude, progress)
        progress("weighing the explanations under another noise")
        return continued(near.full_screen, problem)

    if problem.y.size <= MANY:
        return every(problem, values)
    rows = spread_rows(values, problem.y.size, SUBSET)
    screen = every(problem.subset(rows), [v[rows] for v in values])
    progress(f"weighing the leaders on all {problem.y.size} readings")
    weights = screen.log_weights
    ranked = sorted(screen.scores, key=lambda m: -weights[m])
    leaders = dict.fromkeys([NOTHING, *ranked[:REFITTED_ON_ALL]])
    best = map_fit(problem, ranked[0], screen.fits[ranked[0]].z, warm=True)
    problem = problem.with_sd(best.prediction, problem.predict(NOTHING, screen.null_fit.z))
    fits = {m: integrate_change_points(problem, map_fit(problem, m, screen.fits[m].z, warm=True)) for m in leaders}
    scores = _scores(problem, fits, space, values, screen.draws)
    names = {s.id for s in screen.draws}
    discrepancy = discrepancy_beside_laws(problem, fits, space, values, names)
    return Search(
        problem, space, values, fits[NOTHING], fits, scores, discrepancy, screen.draws, screen.untestable, screen
    )


def continued(near: Search, problem: Problem, adding: bool = True) -> Search:
    """Search continued under another noise: near fits are fitted again, far fits rescaled.

    Unless ``adding`` is false, combinations that have become promising are added.
    """
    best, space, values = near.best_named, near.space, near.values
    problem = problem.with_sd(best.prediction, near.null_fit.prediction)
    scale = near.problem.sd / problem.sd
    moved = {m: f.in_sigmas(scale, f.evidence + _counted_anew(f.residual, scale)) for m, f in near.fits.items()}
    then, now = (max(f.evidence for f in fits.values()) - HOPELESS_BEHIND for fits in (near.fits, moved))
    fits = {
        m: map_fit(problem, m, f.z, warm=True, slopes=f.slopes)
        if (adding and len(m.effects) < 2) or near.fits[m].evidence > then or f.evidence > now
        else f
        for m, f in moved.items()
    }
    draws = tuple(replace(s, change=s.change * scale) for s in near.draws)
    if adding:
        singles = {m: f for m, f in fits.items() if len(m.effects) == 1}
        fits |= {f.explanation: f for f in _fit_pairs(problem, fits[NOTHING], singles, draws, known=fits)}
        fits = with_additions(problem, fits, draws)
    fits = {m: integrate_change_points(problem, f) for m, f in fits.items() if m in moved or shows(problem, f, fits)}
    scores = _scores(problem, fits, space, values, draws)
    discrepancy = discrepancy_beside_laws(problem, fits, space, values, {s.id for s in draws})
    return replace(
        near,
        problem=problem,
        null_fit=fits[NOTHING],
        fits=fits,
        scores=scores,
        discrepancy=discrepancy,
        draws=draws,
    )


def _counted_anew(residual: np.ndarray, scale: np.ndarray) -> float:
    """Change of the log likelihood of residuals by other standard deviations, up to a common constant."""
    return float(log_likelihood(residual * scale)[0].sum() - log_likelihood(residual)[0].sum())


def spread_rows(values: list[np.ndarray], count: int, most: int) -> np.ndarray:
    """Subset of up to ``most`` rows that covers the conditions evenly; all rows if they are fewer."""
    if count <= most:
        return np.arange(count)
    order = np.lexsort(values[::-1]) if values else np.arange(count)
    edges = np.linspace(0, count, most + 1).astype(int)
    # One of each stretch at random: every n-th row could coincide with the levels of a condition.
    at = np.random.default_rng(SEED).integers(edges[:-1], edges[1:])
    return np.sort(order[at])


def _search(
    problem: Problem, space: Coordinates, values: list[np.ndarray], exclude: Sequence[str], progress: Progress
) -> Search:
    progress("calibrating the base model")
    null_fit = map_fit(problem, NOTHING, np.zeros(problem.size(NOTHING)))
    # Noise in proportion to the readings themselves would give low readings more weight.
    problem = problem.with_sd(null_fit.prediction, null_fit.prediction)
    null_fit = map_fit(problem, NOTHING, null_fit.z)
    effects = problem.forward.effects(exclude)
    progress(f"trying {len(effects)} effects")
    drawn = [s for s in (sample(problem, e.id, null_fit) for e in effects) if len(s.z)]
    draws = tuple(s for s in drawn if s.testable)
    untestable = tuple(s for s in drawn if not s.testable)
    singles = fit_singles(problem, null_fit, draws)
    if singles:
        best = max(singles.values(), key=lambda f: f.evidence)
        if best.evidence > null_fit.evidence + STRONG_EVIDENCE:
            old = problem.sd
            problem = problem.with_sd(best.prediction, null_fit.prediction)
            null_fit = map_fit(problem, NOTHING, null_fit.z)
            singles = _again(problem, singles, best, old / problem.sd)
            draws = tuple(replace(s, change=s.change * (old / problem.sd)) for s in draws)
    fits: dict[Explanation, Fit] = {NOTHING: null_fit, **singles}
    progress("trying pairs of effects")
    fits |= {fit.explanation: fit for fit in _fit_pairs(problem, null_fit, singles, draws)}
    fits = with_additions(problem, fits, draws)
    fits = {m: integrate_change_points(problem, f) for m, f in fits.items() if shows(problem, f, fits)}
    scores = _scores(problem, fits, space, values, draws)
    progress("weighing a discrepancy")
    discrepancy = discrepancy_beside_laws(problem, fits, space, values, {s.id for s in draws})
    return Search(problem, space, values, null_fit, fits, scores, discrepancy, draws, untestable)


def _scores(
    problem: Problem,
    fits: Mapping[Explanation, Fit],
    space: Coordinates,
    values: list[np.ndarray],
    draws: Sequence[PriorDraws],
) -> dict[Explanation, float]:
    """Evidence of every explanation with errors of its laws, and with published laws if near the best."""
    base = BaseError.of(problem, fits[NOTHING], space, values).columns(problem, fits[NOTHING], space, values)
    scores = {m: law_error_evidence(problem, fits[NOTHING], f, space, values, base) for m, f in fits.items()}
    odds = PriorOdds.of(s.id for s in draws)
    weights = {m: score + odds.log(m) for m, score in scores.items()}
    best = max(weights.values())
    near = [m for m, weight in weights.items() if weight > best - PUBLISHED_WITHIN]
    linear = [m for m in near if not change_point_coordinates(problem, m)]
    gains = dict(zip(linear, shared_out(lambda m: linearised_gain(problem, fits[m]), linear), strict=True))
    leaders = [m for m in near if m not in gains]
    while True:
        gains |= zip(leaders, shared_out(lambda m: published_gain(problem, fits[m]), leaders), strict=True)
        linear = [m for m in linear if m not in leaders]
        # Fitted gains may lower the best, so that others come near it.
        best = max((weights[m] + gain for m, gain in gains.items()), default=0.0)
        leaders = [m for m in linear if weights[m] + gains[m] > best - LAWS_REFITTED_WITHIN]
        if not leaders:
            return {m: score + gains.get(m, 0.0) for m, score in scores.items()}


def _fit_pairs(
    problem: Problem,
    null_fit: Fit,
    singles: dict[Explanation, Fit],
    draws: tuple[PriorDraws, ...],
    known: Collection[Explanation] = (),
) -> list[Fit]:
    """Fits of the promising pairs of effects that are not ``known``, without pairs that are inseparable in time."""

    leaders = sorted(singles.values(), key=lambda f: -f.evidence)[:PAIR_LEADERS]
    added = promising_additions(problem, leaders, draws, PAIRS)
    pairs = [pair for pair in added if pair[0] not in known and not one_in_time(pair[0], problem, null_fit)]
    return fit_from(problem, pairs, max([null_fit.evidence, *(f.evidence for f in singles.values())]))


def shows(problem: Problem, fit: Fit, fits: Mapping[Explanation, Fit]) -> bool:
    """Whether an explanation changes more readings, relative to any part of it, than the prior share of outliers.

    A few seconds after a start could fit any effect that passes quickly.
    """
    parts = (other for m, other in fits.items() if set(m.effects) < set(fit.explanation.effects))
    nets = (np.abs(fit.prediction - other.prediction) / problem.sd for other in parts)
    return all(np.count_nonzero(net >= AFFECTED * net.max()) >= OUTLIER_SHARE * net.size for net in nets)


def _again(problem: Problem, singles: dict[Explanation, Fit], best: Fit, scale: np.ndarray) -> dict[Explanation, Fit]:
    """Fits under a new noise, ``scale`` the old over the new; fits far behind keep their distance to the best."""
    new = {
        m: map_fit(problem, m, f.z, warm=True, slopes=f.slopes * scale[:, None])
        for m, f in singles.items()
        if f.evidence > best.evidence - HOPELESS_BEHIND
    }
    shift = new[best.explanation].evidence - best.evidence
    return {m: new[m] if m in new else f.in_sigmas(scale, f.evidence + shift) for m, f in singles.items()}
