"""The diagnosis of a case, from folder to answer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.case import Case, hidden, read_case, read_conditions
from mixedlub.diagnosis.fitting.fit import NINETY, outlier_chance
from mixedlub.diagnosis.fitting.problem import Problem
from mixedlub.diagnosis.fitting.scatter import Raised, beyond_noise, repeats_allow, shown, stated_or_more, under_its_own
from mixedlub.diagnosis.fitting.search import MANY, Progress, Search, search, spread_rows
from mixedlub.diagnosis.fitting.serial import lasting
from mixedlub.diagnosis.fitting.sudden import sudden_places
from mixedlub.diagnosis.judging.doubts import against, scatter_notes, unsure_odds
from mixedlub.diagnosis.judging.heldout import HeldOut, LevelsOut
from mixedlub.diagnosis.judging.location import Region, region
from mixedlub.diagnosis.judging.mismatch import Mismatch, mismatch_test
from mixedlub.diagnosis.judging.nexttest import NextTest, candidates, expected_bits
from mixedlub.diagnosis.judging.posterior import Key, Posterior, names_effects, posterior
from mixedlub.diagnosis.judging.predict import Prediction, Refined, Rows, refine
from mixedlub.diagnosis.judging.published import Contained, contained
from mixedlub.diagnosis.judging.validity import beyond_range, unpublished
from mixedlub.diagnosis.recording.audit import audit
from mixedlub.diagnosis.recording.features import coordinates
from mixedlub.diagnosis.recording.noise import estimated, is_stated, repeated
from mixedlub.effect import find
from mixedlub.forward import Forward
from mixedlub.table import Column, Table
from profiles.errors import InputError

AVERAGED = 6
"""Explanations whose predictions are averaged, at most."""
SMALL = 2e-3
"""Probability below which an explanation adds nothing to a prediction that could be seen."""
CANDIDATES = 6
"""Names held against levels left out, at most: each costs as many fits as there are levels."""


@dataclass(frozen=True, eq=False)
class Predicted:
    """Predictions of one table: nominal base, calibrated base, the answer, its 90 % interval, mismatch in sigmas."""

    table: Table
    base: np.ndarray
    calibrated: np.ndarray
    predicted: np.ndarray
    low90: np.ndarray
    high90: np.ndarray
    mismatch_z: np.ndarray
    sd: np.ndarray


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """Everything the answer says, and what it was computed from."""

    case: Case
    found: Search
    test: Mismatch
    posterior: Posterior
    refined: dict[Key, Refined]
    recorded: Predicted
    wanted: Predicted | None
    outlier_chance: np.ndarray
    region: Region
    heldout: HeldOut
    contained: tuple[Contained, ...]
    next_tests: tuple[NextTest, ...]
    warnings: tuple[str, ...]

    @property
    def readings(self) -> np.ndarray:
        """The recorded numbers in the unit of their column."""
        return self.found.problem.level(self.found.problem.y)

    @property
    def outlier_runs(self) -> list[int]:
        """Runs that are more probably outliers than not."""
        return [int(r) for r in self.found.problem.rows["run"][self.outlier_chance > 0.5]]


def diagnose_case(
    folder: Path,
    predict: Path | None = None,
    exclude: Sequence[str] = (),
    level: float = 0.01,
    progress: Progress = lambda text: None,
) -> Diagnosis:
    """Read the case and work out what its simulation lacks."""
    find(list(exclude))
    case = read_case(folder)
    assert case.recordings is not None
    rows = case.recordings
    wanted, assumed = _completed(read_conditions(case, predict) if predict is not None else case.conditions, rows)
    forward = Forward(case, rows)
    y = np.asarray(rows[case.quantity], dtype=float)
    warnings = [*case.notes, *assumed, *hidden(case, wanted), *forward.notes, *audit(case, rows, y, forward)]
    if wanted is not None:
        there = Forward(case, wanted)
        there.nominal()
        warnings += [note for note in there.notes if note not in forward.notes]
    stated = is_stated(case, rows)
    found, raised, test = _search(case, rows, forward, y, exclude, level, progress)
    case, rows = found.problem.case, found.problem.rows
    warnings += scatter_notes(found, stated, raised)
    progress("leaving levels out")
    judged, kept = _judged(found, test)
    kept = kept.of_one(found.screened.problem.together)
    refined = _refine_leaders(found, judged)
    progress("predicting")
    recorded = _predict(found, judged, refined, rows)
    other = None if wanted is None else _predict(found, judged, refined, wanted)
    chance = _outliers(found, judged, refined)
    columns = [c for c in case.kind.columns if c.name in rows]
    swept = {axis.name for axis in found.space.axes}
    varied = [c.name for c in columns if c.form == "name" or c.name in swept] or [c.name for c in columns]
    place = region(rows, varied, np.where(chance > 0.5, 0.0, recorded.mismatch_z))
    laws = contained(found, judged.verdict)
    tests = _next_tests(found, judged, refined, columns, varied)
    at_one_place = judged.verdict == "unknown" and found.unknown.best.at is not None
    warnings += unsure_odds(judged)
    taken_at = Table({n: v for n, v in rows.columns.items() if not n.startswith(case.quantity)}, rows.source)
    warnings += against(judged.verdict, kept, taken_at, y, recorded.predicted, chance > 0.5, at_one_place)
    if not isinstance(judged.verdict, str):
        named = refined[judged.verdict]
        warnings += beyond_range(found.problem, judged.verdict, named.z)
        own = slice(found.problem.calibration_size, None)
        warnings += unpublished(found.problem.effects(judged.verdict), named.z[own], named.spread[own])
    return Diagnosis(
        case, found, test, judged, refined, recorded, other, chance, place, kept, laws, tests, tuple(warnings)
    )


def _completed(wanted: Table | None, rows: Table) -> tuple[Table | None, list[str]]:
    """Conditions to predict with the place in the programme that recordings have: its end where none is given."""
    if wanted is None or "sequence" in wanted or "sequence" not in rows:
        return wanted, []
    columns = {**wanted.columns, "sequence": np.ones(len(wanted))}
    return Table(columns, wanted.source), [f"{wanted.source} has no sequence: predicted for the end of the programme"]


def _search(
    case: Case,
    rows: Table,
    forward: Forward,
    y: np.ndarray,
    exclude: Sequence[str],
    level: float,
    progress: Progress,
) -> tuple[Search, Raised, Mismatch]:
    """Every explanation weighed, how much more than the stated noise that took, and whether anything is missing.

    Where no noise is stated, nothing missing is tested under the noise that it would need itself as well, and where
    that is the answer it has that noise: what suits an explanation best is no fair one for its rival. Where noise
    lasts over several readings, so many count as one, and everything is weighed again.
    """
    space = coordinates(case, rows, forward)
    if not space.axes:
        raise InputError("all readings were taken at the same conditions; vary at least one", where="recordings.csv")
    values = space.values(case, rows, forward)

    together = 1.0

    def trial(case: Case, rows: Table) -> Search:
        return search(Problem.of(case, rows, forward, y, together), space, values, exclude, progress)

    def glance(case: Case, rows: Table) -> Search:
        few = spread_rows(values, y.size)
        return search(Problem.of(case, rows, forward, y).take(few), space, [v[few] for v in values], exclude, progress)

    seek = trial if y.size <= MANY else glance
    if is_stated(case, rows):
        group, most = repeated(case, rows), np.inf
        if group is not None:
            whole = Problem.of(case, rows, forward, y)
            most = repeats_allow(whole.y, whole.sd, group)
        found, raised = stated_or_more(case, rows, seek, most)
        if seek is glance:
            found = trial(*raised.of(case, rows))
        if (together := lasting(found)) > 1.0:
            found = trial(*raised.of(case, rows))
        progress("testing against nothing missing")
        return found, raised, beyond_noise(found, raised.times, mismatch_test(found, level))
    found = shown(estimated(case, rows, y, forward.predict(), space, values), rows, seek)
    if seek is glance:
        found = trial(found.problem.case, rows)
    if (together := lasting(found)) > 1.0:
        found = trial(found.problem.case, rows)
    progress("testing against nothing missing")
    own, test = under_its_own(found, trial), mismatch_test(found, level)
    other = test if own is found else mismatch_test(own, level)
    if other.p_value <= test.p_value:
        return found, Raised(), test
    if not other.detected:
        return own, Raised(), other
    return found, Raised(), replace(test, p_value=other.p_value, lenient=True)


def _judged(found: Search, test: Mismatch) -> tuple[Posterior, HeldOut]:
    """Probabilities, with the verdict and what ties with it first held against levels left out.

    When CANDIDATES names were tried, the others are taken to fail like the best of those that did. The unnamed
    mismatch is held against the first name. Where even the best of those
    tried leaves more there than noise, the odds between names are less sure.
    """
    levels = LevelsOut.of(found)
    names = sorted(filter(names_effects, found.log_weights), key=lambda key: -found.log_weights[key])
    tried: dict[Key, tuple[HeldOut, float]] = {}
    unnamed: dict[Key, float] = {}
    while True:
        demerits = {key: demerit for key, (_, demerit) in tried.items()}
        if len(tried) >= CANDIDATES and all(demerits.values()):
            rest = min(demerits.values())
            demerits = {key: demerits.get(key, rest) for key in names}
        judged = posterior(found, test, demerits | unnamed)
        first = judged.verdict
        # What stands at one place is not for other levels to foretell.
        if first in tried and not isinstance(first, str) and not sudden_places(found.problem, first):
            inflation = min(kept.inflation for kept, _ in tried.values())
            judged = posterior(found, test, demerits | unnamed, inflation)
        if names and "unknown" in judged.tied and not unnamed:
            if names[0] not in tried:
                tried[names[0]] = _held_against(levels, found, names[0])
            unnamed = {"unknown": _held_against(levels, found, "unknown")[0].behind(tried[names[0]][0])}
            continue
        fresh = [key for key in judged.tied if key not in tried and names_effects(key)]
        if not fresh or len(tried) >= CANDIDATES:
            key = judged.verdict
            return judged, (tried.get(key) or _held_against(levels, found, key))[0]
        tried[fresh[0]] = _held_against(levels, found, fresh[0])


def _held_against(levels: LevelsOut, found: Search, key: Key) -> tuple[HeldOut, float]:
    """How an explanation predicts levels left out, and what a name loses by it."""
    residual = found.unknown.fit.residual if isinstance(key, str) else found.fits[key].residual
    outliers = outlier_chance(residual) > 0.5
    kept = levels.held(key, outliers)
    if not names_effects(key):
        return kept, 0.0
    good = residual[~outliers]
    return kept, kept.demerit(float(np.sqrt(np.mean(good**2))) if good.size else 1.0)


def _refine_leaders(found: Search, judged: Posterior) -> dict[Key, Refined]:
    """The explanations that carry the answer, refined; none always among them."""
    leaders = [k for k, w in judged.weights.items() if w >= SMALL and not isinstance(k, str)][:AVERAGED]
    if () not in leaders:
        leaders.append(())
    return {k: refine(found, found.fits[k]) for k in leaders}


def _predict(found: Search, judged: Posterior, refined: dict[Key, Refined], table: Table) -> Predicted:
    problem = found.problem
    own = table is problem.rows
    rows = Rows(found, table, found.none.prediction if own else None)
    calibrated = rows.problem.predict((), found.none.z)
    each: dict[Key, Prediction] = {k: rows.of_fit(r) for k, r in refined.items() if judged.weights[k] >= SMALL}
    if judged.weights["unknown"] >= SMALL:
        each["unknown"] = rows.of_unknown()
    means = np.array([p.mean for p in each.values()])
    variances = np.array([p.ends for p in each.values()])
    # An explanation with no finite answer at a row does not speak there; the verdict always does.
    speaks = np.isfinite(means + variances.sum(axis=1)) | np.array([k == judged.verdict for k in each])[:, None]
    share = np.array([judged.weights[k] for k in each])[:, None] * speaks
    share = share / share.sum(axis=0)
    means, variances = np.where(speaks, means, 0.0), np.where(speaks[:, None], variances, 0.0)
    mean = each[()].mean if judged.verdict == () else (share * means).sum(axis=0)
    between = (share * (means - mean) ** 2).sum(axis=0)
    within = (share[:, None] * variances).sum(axis=0)
    sd, shared_variance = rows.noise_at(mean)
    below, above = NINETY * np.sqrt(sd**2 + shared_variance + within + between)
    at_verdict = each[judged.verdict].base
    mismatch = np.zeros(mean.size) if judged.verdict == () else (mean - at_verdict) / sd
    nominal = rows.forward.predict()
    ends = problem.level(mean - below), problem.level(mean + above)
    size = np.abs(problem.level(mean)) if problem.case.kind.logarithmic else 1.0
    return Predicted(
        table, nominal, problem.level(calibrated), problem.level(mean), *ends, mismatch, np.asarray(sd * size)
    )


def _outliers(found: Search, judged: Posterior, refined: dict[Key, Refined]) -> np.ndarray:
    """Chance that each reading is an outlier, averaged over the explanations that carry the answer."""
    chance = np.zeros(found.problem.y.size)
    total = 0.0
    for key, weight in judged.weights.items():
        if key == "unknown":
            residual = found.unknown.fit.residual
        elif key in refined:
            residual = refined[key].residual
        else:
            continue
        chance += weight * outlier_chance(found.problem.of_one(residual))
        total += weight
    return chance / max(total, 1e-300)


def _next_tests(
    found: Search, judged: Posterior, refined: dict[Key, Refined], columns: list[Column], varied: list[str]
) -> tuple[NextTest, ...]:
    keys = [k for k in refined if judged.weights[k] > 0.01]
    if len(keys) < 2:
        runner = next((k for k in judged.weights if not isinstance(k, str) and k not in keys and k in found.fits), None)
        if runner is None:
            return ()
        refined = {**refined, runner: refine(found, found.fits[runner])}
        keys = [*keys, runner]
    keys = keys[:5]
    case = found.problem.case
    table = candidates(found.problem.rows, columns, case.kind.limits(case.system), varied)
    rows = Rows(found, table)
    predictions = [rows.of_fit(refined[k]) for k in keys]
    weights = np.array([judged.weights[k] for k in keys])
    finite = np.isfinite(np.array([p.mean + p.variance for p in predictions])).all(axis=0)
    # Improbable rivals count for the choice, not for what it is said to tell.
    worth = np.where(finite, expected_bits(np.maximum(weights, 0.05), predictions, rows.sd), 0.0)
    bits = np.where(finite, expected_bits(weights, predictions, rows.sd), 0.0)
    chosen: list[NextTest] = []
    for i in np.argsort(worth)[::-1]:
        values = {c.name: table[c.name][i] for c in columns}
        conditions: dict[str, float | str] = {
            name: str(x) if isinstance(x, str) else float(f"{x:.6g}") for name, x in values.items()
        }
        if all(_apart(conditions, t.conditions) for t in chosen):
            names = tuple("+".join(judged.names(k)) for k in keys)
            chosen.append(NextTest(conditions, names, float(bits[i])))
        if len(chosen) == 3:
            break
    return tuple(chosen)


def _apart(a: dict[str, Any], b: dict[str, Any]) -> bool:
    """Whether two tests differ in at least two conditions."""
    return sum(a[name] != b[name] for name in a) >= 2
