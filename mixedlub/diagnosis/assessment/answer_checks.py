"""Doubts about an answer as a whole, and findings on the noise of the readings."""

from __future__ import annotations

from math import comb

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.diagnosis.assessment.cross_validation import HeldOut
from mixedlub.diagnosis.assessment.mismatch_test import noise_share
from mixedlub.diagnosis.assessment.posterior import Posterior
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.labels import amount, effect_words, words_of
from mixedlub.diagnosis.search.noise_inflation import NoiseInflation, best_inflation, noise_overstated
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import (
    LARGE_NOISE,
    LARGEST_SCATTER,
    LEAST_STREAK,
    MANY_OUTLIERS,
    MOST_OF_LEVEL,
    OPPOSITE_WITHIN,
    POOR_PREDICTION,
    RARE,
)
from mixedlub.diagnosis.settings.search import INFLATION_GAIN, MOST_INFLATION
from mixedlub.recording.conditions import PASSING, clock_of
from mixedlub.recording.noise import setups_differ
from mixedlub.recording.set_points import set_points
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.table import Table
from mixedlub.schema.units import unit_of


def noise_notes(search: Search, stated: bool, inflation: NoiseInflation) -> list[Finding]:
    """Findings on the noise of the readings, if it differs from the stated noise."""
    n_per_effective = search.problem.n_per_effective
    text = (
        f"residuals are autocorrelated: about {n_per_effective:.2g} consecutive readings carry the information of one"
    )
    series = [finding("residuals_autocorrelated", text)] if n_per_effective > 1.0 else []
    return [*series, *_drift_notes(search), *_size_notes(search, stated, inflation)]


def setup_notes(given: Case, search: Search) -> list[Finding]:
    """Finding on the error of set-ups, if it was estimated."""
    noise = search.problem.case.system.recording.noise
    if setups_differ(given) or noise is None or not noise.of_setups:
        return []
    size = (
        f"{100.0 * noise.setup_relative:.2g} % of it"
        if noise.setup_relative
        else f"{noise.setup_absolute:.2g} {unit_of(given.quantity)}".rstrip()
    )
    text = f"set-ups differ: the error that readings of one set-up share was estimated as about {size}"
    return [finding("setup_error_estimated", text)]


def _drift_notes(search: Search) -> list[Finding]:
    correlated_error, rows = search.problem.correlated_error, search.problem.rows
    if not correlated_error.size:
        return []
    length = correlated_error.correlation_time
    over = (
        f"{100.0 * length:.2g} % of the programme" if "sequence" in rows else amount(float(f"{length:.2g}"), "time_s")
    )
    text = (
        f"residuals drift slowly ({correlated_error.size:.2g} times the noise of a reading, correlation time about "
        f"{over}); the drift is treated as noise, and events of that size cannot be distinguished from it"
    )
    return [finding("residuals_drift", text)]


def _size_notes(search: Search, stated: bool, inflation: NoiseInflation) -> list[Finding]:
    times = inflation.factor
    total = times * search.problem.correlated_error.total_sd
    if inflation.extra_relative:
        text = (
            f"readings scatter {100.0 * inflation.extra_relative:.2g} % more than the stated standard deviations, "
            "which may be repeatability only; the noise was taken as that much larger"
        )
        return [finding("scatter_above_stated", text)]
    scatter = "with every explanation tried, readings scatter about {:.2g} times as much as stated"
    if stated and total > MOST_INFLATION:
        text = (
            f"{scatter.format(total)}, which is too much for a wrongly stated noise: either an effect of another form "
            "is present, or what is stated is not the noise of a reading; the answer was found under noise that large"
        )
        return [finding("scatter_unexplained", text)]
    if times > 1.0:
        return [finding("scatter_above_stated", f"{scatter.format(times)}: the noise was taken as that much larger")]
    noise = search.problem.case.system.recording.noise
    if not stated and noise is not None:
        unit = unit_of(search.problem.case.quantity)
        parts = [f"{100.0 * noise.relative:.2g} % of it"] if noise.relative else []
        parts += [f"{noise.absolute:.2g} {unit}".rstrip()] if noise.absolute else []
        estimate = f"the noise of a reading was estimated as {' and '.join(parts)}"
        share = noise_share(search.problem)
        if share <= LARGE_NOISE:
            return [finding("noise_value_estimated", estimate)]
        if share > LARGEST_SCATTER:
            text = (
                f"{estimate}, which no instrument has: something that differs between the readings is not recorded, "
                "such as a specimen, a mixture or a condition"
            )
            return [finding("scatter_unexplained", text)]
        text = f"{estimate}, more than rigs have: rows may differ in kind, or the noise contains what is missing"
        return [finding("noise_estimate_large", text)]
    if stated and best_inflation(search)[0] > INFLATION_GAIN:
        text = (
            "for every explanation tried, the residuals exceed the repeatability of the readings: an effect of another "
            "form is present"
        )
        return [finding("form_not_found", text)]
    text = (
        "readings scatter by less than half of the stated noise: with a noise nearer to theirs the test could show more"
    )
    return [finding("scatter_below_stated", text)] if noise_overstated(search) else []


def answer_warnings(
    verdict: Explanation,
    heldout: HeldOut,
    rows: Table,
    y: np.ndarray,
    predicted: np.ndarray,
    wrong: np.ndarray,
    at_one_place: bool = False,
) -> list[Finding]:
    """Doubts about the answer: many outliers, or poorly predicted levels unless the mismatch is ``at_one_place``."""
    warnings = []
    if wrong.mean() > MANY_OUTLIERS:
        text = (
            f"{wrong.sum()} of {wrong.size} readings are outliers: the noise may be taken too small, or the answer "
            "covers only a part of the recording"
        )
        warnings.append(finding("outliers_many", text))
        turned = np.abs(y[wrong] + predicted[wrong]) < OPPOSITE_WITHIN * np.abs(y[wrong])
        if turned.mean() > 0.5:
            text = f"{turned.sum()} of {wrong.sum()} outliers have the expected size with the opposite sign"
            warnings.append(finding("outliers_opposite_sign", text))
    streak = outlier_streak(rows, wrong, y - predicted)
    if streak:
        text = (
            f"the {len(streak)} readings are consecutive outliers on one side; this is not chance, and the answer does "
            "not explain it"
        )
        warnings.append(finding("outliers_consecutive", text, f"run {streak[0]} to run {streak[-1]}"))
    warnings += [
        finding(
            "outliers_at_level",
            f"{share} readings are outliers on one side; this is not chance, and the answer does not explain it",
            level,
        )
        for level, share in outlier_levels(rows, wrong, y - predicted)
    ]
    if verdict != NOTHING and heldout.after > heldout.before:
        text = (
            f"calibration alone predicts left-out levels better than the answer ({heldout.before:.2f} against "
            f"{heldout.after:.2f} sigma), so predictions and the improved model are of calibration alone"
        )
        warnings.append(finding("answer_not_handed_on", text))
    not_predictive = heldout.score < heldout.score_before
    if verdict != NOTHING and not at_one_place and not_predictive and heldout.after <= heldout.before:
        answer = "the unnamed mismatch" if verdict == DISCREPANCY else "the answer"
        text = (
            f"{answer} predicts left-out levels no better than calibration alone: outside the recorded conditions rely "
            "on neither"
        )
        warnings.append(finding("answer_not_predictive", text))
    elif verdict != NOTHING and not at_one_place and not not_predictive and heldout.after > POOR_PREDICTION:
        error = f"rms {heldout.after:.3g} sigma, 1 expected"
        text = f"the answer predicts left-out levels poorly ({error}): do not extrapolate"
        warnings.append(finding("answer_predicts_poorly", text))
    return warnings


def failed_warning(judged: Posterior, count: int) -> list[Finding]:
    """Doubt about an answer without a name because the best one fails by its outliers."""
    if judged.failed is None:
        return []
    key, wrong = judged.failed
    text = (
        f"the best law found, {' and '.join(map(effect_words, key.effects))}, takes {wrong} of {count} readings for "
        "outliers, in a share or after steps of a condition as no instrument has them: it fails, and no name is claimed"
    )
    return [finding("model_failed", text)]


def outlier_streak(rows: Table, wrong: np.ndarray, residual: np.ndarray) -> list[int]:
    """Runs of the longest streak in time of wrong readings on one side, if improbable by chance.

    >>> table = Table({"run": np.arange(1, 41), "time_s": np.arange(40.0)})
    >>> wrong = np.isin(np.arange(40), [0, 1, 2, 17])
    >>> outlier_streak(table, wrong, np.ones(40)), outlier_streak(table, wrong, (-1.0) ** np.arange(40))
    ([1, 2, 3], [])
    """
    clock = clock_of(rows)
    if clock is None or not wrong.any():
        return []
    order = np.argsort(clock, kind="stable")
    side = (np.sign(residual) * wrong)[order]
    starts = np.flatnonzero(np.diff(side, prepend=np.nan) != 0.0)
    lengths = np.diff(np.append(starts, side.size)) * (side[starts] != 0.0)
    longest = int(np.argmax(lengths))
    count = int(lengths[longest])
    by_chance = 2.0 * wrong.size * (0.5 * wrong.mean()) ** count
    if count < LEAST_STREAK or by_chance > RARE:
        return []
    streak = order[starts[longest] : starts[longest] + count]
    return [] if _one_level(rows, streak) else [int(run) for run in rows["run"][streak]]


def outlier_levels(rows: Table, wrong: np.ndarray, residual: np.ndarray) -> list[tuple[str, str]]:
    """Levels mostly wrong on one side, if improbable by chance, with shares; empty if most readings are wrong."""
    if wrong.mean() >= MOST_OF_LEVEL:
        return []
    levels = []
    for name, values in _conditions(rows):
        points, label = np.unique(set_points(values), return_inverse=True)
        size = np.bincount(label)
        for side in (residual > 0.0, residual < 0.0):
            n_wrong = np.bincount(label, weights=wrong & side).astype(int)
            for i in np.flatnonzero((size >= LEAST_STREAK) & (n_wrong >= MOST_OF_LEVEL * size) & (size < label.size)):
                by_chance = 2.0 * points.size * comb(int(size[i]), int(n_wrong[i])) * (0.5 * wrong.mean()) ** n_wrong[i]
                if by_chance <= RARE:
                    share = f"all {size[i]}" if n_wrong[i] == size[i] else f"{n_wrong[i]} of the {size[i]}"
                    at = points[i] if points.dtype.kind in "US" else amount(float(points[i]), name)
                    levels.append((f"{words_of(name)} {at}", share))
    return levels


def _conditions(rows: Table) -> list[tuple[str, np.ndarray]]:
    """Conditions that were set, without passing quantities such as time."""
    return [(name, values) for name, values in rows.columns.items() if name not in (*PASSING, "run")]


def _one_level(rows: Table, streak: np.ndarray) -> bool:
    """Whether a streak is a level of a condition run in one go, so that time is not the cause."""
    for _, values in _conditions(rows):
        at_level = values == values[streak[0]]
        if at_level[streak].all() and not at_level.all() and streak.size >= MOST_OF_LEVEL * at_level.sum():
            return True
    return False
