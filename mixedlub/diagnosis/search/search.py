"""Search over explanations: none, each effect, pairs of effects, and the unnamed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from mixedlub.diagnosis.discrepancy.model import Unknown, unknown_fit
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.inference.change_points import placed
from mixedlub.diagnosis.inference.initial_guesses import Sampled, fit_single, sample
from mixedlub.diagnosis.inference.map_fit import OUTLIER_SHARE, Fit, Linear, linear_fit, log_likelihood, map_fit
from mixedlub.diagnosis.inference.nested_laws import published_gain
from mixedlub.diagnosis.inference.pairs import ROUNDS, exchanged, promising_pairs
from mixedlub.diagnosis.problem import Problem, effects_of
from mixedlub.recording.conditions import Coordinates

PRIOR = {"nothing": 0.42, "single": 0.38, "pair": 0.08, "discrepancy": 0.12}
"""Before any reading: a campaign with nothing missing is as usual as one with one effect, two are rare."""
LEAST_NONE = 14.0
"""How many times as probable nothing is than one effect: one that readings neither ask for nor exclude is no tie."""
WHOLE = 25
"""Effects from which pairs have all of their prior: beside a first effect each other one is as rare among few."""
KEPT = 8
"""Explanations of a share of the rows that are weighed again on all of them."""
CLOCKS = {"time", "sequence", "ageing"}
"""Quantities that pass by themselves while a test runs."""
MOVED = 0.1
"""Share of what an explanation moves a reading by at most, from which it moves another one too."""
NEAR = 12.0
"""Log evidence behind the best within which the published laws that an explanation contains are weighed too."""
FAR = 60.0
"""Log evidence behind the best from which a fit is not made again under a new noise, before or with it."""
MANY, SPREAD = 1200, 600
"""Readings beyond which a spread of so many stands for all while explanations are sought."""
SEED = 1
ELASTIC = ((0.0, 0.30), (0.08, 0.30), (0.25, 0.25), (0.6, 0.15))
"""Relative error of an effect's literature form: its rms and the weight given to it."""
BEND_LIMIT = 4.0
BEND_SHARE = 0.01
BEND_MOST = 30.0
"""What bending may add to the log evidence, shared by the effects of an explanation.

A form wrong by 14 % costs a hundredth of the squares of what it adds. No less than BEND_LIMIT is allowed and no more
than BEND_MOST: a form a little wrong is not another effect, and another effect not a form a little wrong.
"""

Progress = Callable[[str], None]


@dataclass(frozen=True, eq=False)
class Search:
    """Everything the search found; ``untestable`` effects move no reading and so are no explanation."""

    problem: Problem
    space: Coordinates
    values: list[np.ndarray]
    none: Fit
    fits: dict[Explanation, Fit]
    scores: dict[Explanation, float]
    unknown: Unknown
    sampled: tuple[Sampled, ...]
    untestable: tuple[Sampled, ...] = ()
    screen: Search | None = None

    @property
    def screened(self) -> Search:
        """The search that looked at every explanation: on a share of the rows where there are very many."""
        return self if self.screen is None else self.screen

    @property
    def likely(self) -> Fit:
        """The fit of the most probable explanation that the catalogue has, nothing missing among them."""
        return self.fits[max(self.fits, key=self.log_weights.__getitem__)]

    def fit_of(self, explanation: Explanation) -> Fit | Linear:
        """The fit of any explanation, the discrepancy among them."""
        return self.unknown.fit if explanation.discrepancy else self.fits[explanation]

    @property
    def log_weights(self) -> dict[Explanation, float]:
        """Log prior plus log evidence of every explanation."""
        odds = {e.id: self.problem.forward.odds(e) for s in self.sampled for e in effects_of((s.id,))}
        each = list(odds.values())
        pairs = sum(a * b for a, b in combinations(each, 2))
        total = (1.0, sum(each), pairs)
        prior = priors(len(each))
        found: dict[Explanation, float] = {}
        for explanation, score in self.scores.items():
            size = len(explanation.effects)
            product = np.prod([odds[name] for name in explanation.effects])
            found[explanation] = score + float(np.log(prior[size] * product / total[size]))
        found[DISCREPANCY] = self.unknown.evidence + np.log(PRIOR["discrepancy"])
        return found

    @property
    def log_bayes_factor(self) -> float:
        """Log Bayes factor of all explanations together, in their literature forms, against nothing missing."""
        logs = [
            w if m.discrepancy else w - self.scores[m] + self.fits[m].evidence
            for m, w in self.log_weights.items()
            if m != NOTHING
        ]
        nothing, single, pair = priors(len(self.sampled))
        odds = float(np.logaddexp.reduce(logs)) - self.log_weights[NOTHING]
        return odds + float(np.log(nothing / (single + pair + PRIOR["discrepancy"])))

    @property
    def log_probability(self) -> float:
        """Log probability density of the readings under all explanations together, up to a constant."""
        total = float(np.logaddexp.reduce(list(self.log_weights.values())))
        return total - float(
            np.log(sum(priors(len(self.sampled))) + PRIOR["discrepancy"]) + np.log(self.problem.sd).sum()
        )


def search(
    problem: Problem,
    space: Coordinates,
    values: list[np.ndarray],
    exclude: Sequence[str] = (),
    progress: Progress = lambda text: None,
) -> Search:
    """Fit every explanation worth fitting and weigh them.

    Beyond MANY rows all explanations are tried on a spread of them, and the leaders are weighed on all.
    """
    if problem.y.size <= MANY:
        return _search(problem, space, values, exclude, progress)
    rows = spread_rows(values, problem.y.size)
    screen = _search(problem.spread(rows), space, [v[rows] for v in values], exclude, progress)
    progress(f"weighing the leaders on all {problem.y.size} readings")
    ranked = sorted(screen.scores, key=lambda m: -screen.log_weights[m])
    leaders = dict.fromkeys([NOTHING, *ranked[:KEPT]])
    best = map_fit(problem, ranked[0], screen.fits[ranked[0]].z, warm=True)
    problem = problem.with_sd(best.prediction, problem.predict(NOTHING, screen.none.z))
    fits = {m: placed(problem, map_fit(problem, m, screen.fits[m].z, warm=True)) for m in leaders}
    scores = _scores(problem, fits, space, values)
    names = {s.id for s in screen.sampled}
    unknown = unknown_fit(problem, fits[NOTHING], space, values, names)
    return Search(
        problem, space, values, fits[NOTHING], fits, scores, unknown, screen.sampled, screen.untestable, screen
    )


def reweighed(found: Search, problem: Problem) -> Search:
    """A search again under another noise: its fits climb on from where they stand, and no other is tried.

    Those far behind the best one under either noise, by what they leave over, stay where they are.
    """
    best = found.likely
    problem = problem.with_sd(best.prediction, found.none.prediction)
    scale = found.problem.sd / problem.sd
    moved = {m: f.in_sigmas(scale, f.evidence + _counted_anew(f.residual, scale)) for m, f in found.fits.items()}
    then, now = (max(f.evidence for f in fits.values()) - FAR for fits in (found.fits, moved))
    near = {m for m, f in moved.items() if m == NOTHING or found.fits[m].evidence > then or f.evidence > now}
    fits = {m: placed(problem, map_fit(problem, m, f.z, warm=True)) if m in near else f for m, f in moved.items()}
    none, scores = fits[NOTHING], _scores(problem, fits, found.space, found.values)
    unknown = unknown_fit(problem, none, found.space, found.values, {s.id for s in found.sampled})
    sampled = tuple(replace(s, change=s.change * scale) for s in found.sampled)
    return replace(found, problem=problem, none=none, fits=fits, scores=scores, unknown=unknown, sampled=sampled)


def _counted_anew(residual: np.ndarray, scale: np.ndarray) -> float:
    """What the log likelihood of residuals gains, up to what all share, by being counted in other sigmas."""
    return float(log_likelihood(residual * scale)[0].sum() - log_likelihood(residual)[0].sum())


def spread_rows(values: list[np.ndarray], count: int) -> np.ndarray:
    """A share of the rows that covers the conditions evenly."""
    order = np.lexsort(values[::-1]) if values else np.arange(count)
    edges = np.linspace(0, count, SPREAD + 1).astype(int)
    # One of each stretch at random: every so many would go round with the levels of a condition.
    at = np.random.default_rng(SEED).integers(edges[:-1], edges[1:])
    return np.sort(order[at])


def priors(effects: int) -> tuple[float, float, float]:
    """Priors of nothing, of one effect and of two, beside that of the unnamed, by how many effects there are.

    That of nothing is higher where few effects share that of a single one, that of pairs lower.

    >>> priors(30), [round(p, 2) for p in priors(6)]
    ((0.42, 0.38, 0.08), [0.89, 0.38, 0.02])
    """
    if effects == 0:
        return PRIOR["nothing"], 0.0, 0.0
    nothing = min(max(PRIOR["nothing"], LEAST_NONE * PRIOR["single"] / effects), 1.0)
    return nothing, PRIOR["single"], PRIOR["pair"] * min(1.0, effects / WHOLE)


def _search(
    problem: Problem, space: Coordinates, values: list[np.ndarray], exclude: Sequence[str], progress: Progress
) -> Search:
    progress("calibrating the base model")
    none = map_fit(problem, NOTHING, np.zeros(problem.size(NOTHING)))
    # Readings do not tell their own noise: those that happen to be low would count for more.
    problem = problem.with_sd(none.prediction, none.prediction)
    none = map_fit(problem, NOTHING, none.z)
    effects = problem.forward.effects(exclude)
    progress(f"trying {len(effects)} effects")
    drawn = [s for s in (sample(problem, e.id, none) for e in effects) if len(s.z)]
    sampled = tuple(s for s in drawn if s.testable)
    untestable = tuple(s for s in drawn if not s.testable)
    singles: dict[Explanation, Fit] = {Explanation.of(s.id): fit_single(problem, none, s) for s in sampled}
    if singles:
        best = max(singles.values(), key=lambda f: f.evidence)
        if best.evidence > none.evidence + 3.0:
            old = problem.sd
            problem = problem.with_sd(best.prediction, none.prediction)
            none = map_fit(problem, NOTHING, none.z)
            singles = _again(problem, singles, best, old / problem.sd)
            sampled = tuple(replace(s, change=s.change * (old / problem.sd)) for s in sampled)
    fits: dict[Explanation, Fit] = {NOTHING: none, **singles}
    progress("trying pairs of effects")
    for pair, start in promising_pairs(problem, none, singles, sampled):
        if one_in_time(pair, problem, none):
            continue
        fit = map_fit(problem, pair, start)
        if pair not in fits or fit.evidence > fits[pair].evidence:
            fits[pair] = fit
    _exchange(problem, none, fits, sampled)
    fits = {m: placed(problem, f) for m, f in fits.items() if shows(problem, f, fits)}
    scores = _scores(problem, fits, space, values)
    progress("weighing an unnamed mismatch")
    unknown = unknown_fit(problem, none, space, values, {s.id for s in sampled})
    return Search(problem, space, values, none, fits, scores, unknown, sampled, untestable)


def _scores(
    problem: Problem, fits: Mapping[Explanation, Fit], space: Coordinates, values: list[np.ndarray]
) -> dict[Explanation, float]:
    """Evidence of every explanation with forms a little wrong, and with published laws where it is near the best."""
    scores = {
        m: min(elastic_evidence(problem, stiff, f, space, values) for stiff in unbending(fits, m))
        for m, f in fits.items()
    }
    best = max(scores.values())
    return {m: s + (published_gain(problem, fits[m]) if s > best - NEAR else 0.0) for m, s in scores.items()}


def _exchange(problem: Problem, none: Fit, fits: dict[Explanation, Fit], sampled: tuple[Sampled, ...]) -> None:
    """Put other effects in the place of either of the best two, until no pair is better; adds to the fits."""
    for _ in range(ROUNDS):
        best = max((f for m, f in fits.items() if len(m.effects) == 2), key=lambda f: f.evidence, default=None)
        if best is None:
            return
        for pair, start in exchanged(problem, best, sampled):
            if pair not in fits and not one_in_time(pair, problem, none):
                fits[pair] = map_fit(problem, pair, start)
        if best.evidence >= max(f.evidence for m, f in fits.items() if len(m.effects) == 2):
            return


def one_in_time(pair: Explanation, problem: Problem, none: Fit) -> bool:
    """Whether two effects are no two here: one is a fault of the channel, and nothing but time moves either.

    What changes and what reads it are then one function of time between them, however good the fit. A condition that
    wanders by the way, and that neither effect nor, beyond noise, the base model asks for, moves nothing.
    """
    effects, inputs = effects_of(pair.effects), problem.forward.inputs
    asked = {name for e in effects for name in e.reads if name in inputs and np.ptp(inputs[name]) > 0.0}
    still = np.ptp(none.prediction) <= np.median(problem.sd)
    return any(e.stage == "measurement" for e in effects) and bool(still) and asked <= CLOCKS


def shows(problem: Problem, fit: Fit, fits: Mapping[Explanation, Fit]) -> bool:
    """Whether an explanation, beyond any part of it, moves more readings than outliers are usual.

    The seconds after a start could be any effect that passes quickly.
    """
    parts = (other for m, other in fits.items() if set(m.effects) < set(fit.explanation.effects))
    nets = (np.abs(fit.prediction - other.prediction) / problem.sd for other in parts)
    return all(np.count_nonzero(net >= MOVED * net.max()) >= OUTLIER_SHARE * net.size for net in nets)


def _again(problem: Problem, singles: dict[Explanation, Fit], best: Fit, scale: np.ndarray) -> dict[Explanation, Fit]:
    """The fits under a new noise level; those hopelessly behind the best only keep their distance to it.

    ``scale`` is the old noise over the new.
    """
    new = {m: map_fit(problem, m, f.z, warm=True) for m, f in singles.items() if f.evidence > best.evidence - FAR}
    shift = new[best.explanation].evidence - best.evidence
    return {m: new[m] if m in new else f.in_sigmas(scale, f.evidence + shift) for m, f in singles.items()}


def bendable(explanation: Explanation) -> int:
    """How many of its effects have a form that could be a little wrong: exact ones have not; none where one is free."""
    effects = effects_of(explanation.effects)
    return 0 if any(e.free_form for e in effects) else sum(not e.exact for e in effects)


def unbending(fits: Mapping[Explanation, Fit], explanation: Explanation) -> tuple[Fit, ...]:
    """The fits that an explanation bends against: the base model, and its exact effects alone.

    The second keeps an effect that does nothing beside an exact one from bending what that one does.
    """
    exact = Explanation(tuple(e.id for e in effects_of(explanation.effects) if e.exact))
    return (fits[NOTHING], *([fits[exact]] if exact != NOTHING and exact in fits else []))


def elastic_evidence(problem: Problem, stiff: Fit, fit: Fit, space: Coordinates, values: list[np.ndarray]) -> float:
    """Evidence with the effects' forms, what they add to a ``stiff`` fit, allowed to be a little wrong, smoothly."""
    count = bendable(fit.explanation)
    if not count:
        return fit.evidence
    base = np.hstack([fit.slopes, problem.shared])
    plain = linear_fit(fit.anchor, base, fit.weight).evidence
    net = (fit.prediction - stiff.prediction) / problem.sd
    bend = elastic_columns(net, typical_size(net), space, values)
    gains = []
    for size, weight in ELASTIC:
        if size == 0.0:
            gains.append(np.log(weight))
            continue
        bent = linear_fit(fit.anchor, np.hstack([base, size * bend]), fit.weight).evidence
        gains.append(np.log(weight) + bent - plain)
    most = float(np.clip(BEND_SHARE * net @ (net * fit.weight), BEND_LIMIT, BEND_MOST))
    return fit.evidence + min(float(np.logaddexp.reduce(gains)), most / count)


def typical_size(net: np.ndarray) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(net**2)))


def elastic_columns(net: np.ndarray, typical: float, space: Coordinates, values: list[np.ndarray]) -> np.ndarray:
    """What an explanation adds to the calibrated base, in sigmas, times smooth functions of the numeric conditions.

    Where it adds little a third of its ``typical`` size stands in: another form need not vanish there too.
    """
    smooth = [
        axis.functions(v, 0.35)[:, :8] if axis.folded else axis.functions(v, 0.7)[:, :4]
        for axis, v in zip(space.axes, values, strict=True)
        if not axis.named and axis.name != "sequence"
    ]
    if not smooth:
        return np.zeros((net.size, 0))
    pairs = [(a[:, :3, None] * b[:, None, :3]).reshape(a.shape[0], -1) for a, b in combinations(smooth, 2)]
    functions = np.hstack(smooth + pairs) / np.sqrt(len(smooth) + len(pairs))
    return np.hypot(net, 0.3 * typical)[:, None] * functions
