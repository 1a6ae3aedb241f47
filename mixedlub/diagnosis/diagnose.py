"""Diagnosis of a case, from folder to answer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from numbers import Real
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from mixedlub.case.folder import (
    Case,
    at_programme_end,
    read_case,
    read_conditions,
    refuse_used_runs,
    unpredicted_runs,
)
from mixedlub.case.forward import Forward
from mixedlub.case.validity import judge_rows
from mixedlub.data_checks.audit import audit
from mixedlub.data_checks.faulty_stretches import set_aside
from mixedlub.diagnosis.assessment.answer_checks import (
    answer_warnings,
    failed_warning,
    noise_notes,
    setup_notes,
)
from mixedlub.diagnosis.assessment.campaign import Campaign
from mixedlub.diagnosis.assessment.check_channel import Check, check_channel
from mixedlub.diagnosis.assessment.cross_validation import HeldOut, LevelsOut
from mixedlub.diagnosis.assessment.experiment_design import Batch, next_batch
from mixedlub.diagnosis.assessment.extrapolation import beyond_recorded
from mixedlub.diagnosis.assessment.hypotheses import Hypothesis, weigh
from mixedlub.diagnosis.assessment.location import Region, region, time_columns
from mixedlub.diagnosis.assessment.mismatch_test import Mismatch, mismatch_against_null
from mixedlub.diagnosis.assessment.model_averaging import (
    Predicted,
    averaged,
    by_calibration,
    leaders,
    outlier_chances,
)
from mixedlub.diagnosis.assessment.posterior import Posterior
from mixedlub.diagnosis.assessment.prediction import Refined
from mixedlub.diagnosis.assessment.published_laws import Contained, contained
from mixedlub.diagnosis.assessment.step_evidence import mismatch_at_steps
from mixedlub.diagnosis.assessment.tabulated import Tabulated, tabulated
from mixedlub.diagnosis.assessment.validity import beyond_range, unpublished
from mixedlub.diagnosis.assessment.verdict import judge
from mixedlub.diagnosis.discovery.laws import FoundLaw, find_law
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.labels import effect_words
from mixedlub.diagnosis.search.noise_selection import search_under_noise
from mixedlub.diagnosis.search.search import Progress, Search
from mixedlub.diagnosis.settings.assessment import FALSE_ALARM_RATE, LEVELS
from mixedlub.diagnosis.settings.discovery import EQUIVALENT_WITHIN
from mixedlub.diagnosis.settings.inference import LIKELY
from mixedlub.effects import find
from mixedlub.own_laws import pasts_read
from mixedlub.recording.readings import readings_of, rows_of
from mixedlub.schema.findings import Finding, collected, finding
from mixedlub.schema.table import Table
from mixedlub.schema.units import stated_units
from profiles.errors import InputError

CALIBRATION, EFFECTS, LAW, TABLE = "calibration", "effects", "law", "table"
"""Models that an answer hands on."""


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """Contents of the answer and their inputs; ``case`` is the ``given`` case with the selected noise.

    ``campaign``: the answer before the last added readings, if any.
    ``faulty``: predictions of the readings that a fault of the instrument leaves out.
    """

    given: Case
    case: Case
    search: Search
    test: Mismatch
    posterior: Posterior
    refined: dict[Explanation, Refined]
    recorded: Predicted
    wanted: Predicted | None
    outlier_chance: np.ndarray
    region: Region
    heldout: HeldOut
    contained: tuple[Contained, ...]
    batch: Batch
    warnings: tuple[Finding, ...]
    excluded: tuple[str, ...] = ()
    noise_stated: bool = True
    hypotheses: tuple[Hypothesis, ...] = ()
    campaign: Campaign | None = None
    faulty: Predicted | None = None
    law: FoundLaw | None = None

    @property
    def readings(self) -> np.ndarray:
        """The recorded numbers in the unit of their column."""
        return self.search.problem.inverse(self.search.problem.y)

    @property
    def check(self) -> Check | None:
        """Correlation of the recording's second channel with the predicted readings; None without such a channel."""
        name, table = self.case.system.recording.check, self.recorded.table
        return None if name is None or name not in table else check_channel(name, table[name], self.recorded.predicted)

    @property
    def counted(self) -> np.ndarray:
        """Whether each reading is more probably good than an outlier; all readings if none is good."""
        right = self.outlier_chance <= LIKELY
        return right if right.any() else ~right

    @property
    def transformed_sd(self) -> np.ndarray:
        """Standard deviation of the transformed readings."""
        p = self.recorded
        return p.sd / np.abs(p.predicted) if self.case.kind.logarithmic else p.sd

    @property
    def residuals(self) -> tuple[np.ndarray, np.ndarray]:
        """(recorded - simulated)/sd of the transformed readings, with the calibrated base model and with the answer."""
        problem, p, sd = self.search.problem, self.recorded, self.transformed_sd
        return (problem.y - problem.transform(p.calibrated)) / sd, (problem.y - problem.transform(p.predicted)) / sd

    @property
    def missing(self) -> tuple[np.ndarray, np.ndarray]:
        """Missing part of the base model at the answer's calibration, in the reading's unit: recorded and explained."""
        problem, p = self.search.problem, self.recorded
        base = problem.inverse(problem.transform(p.predicted) - p.mismatch_z * self.transformed_sd)
        return self.readings - base, p.predicted - base

    @property
    def handed_on(self) -> str:
        """The model in `improved` and in the predictions: the answer, or calibration alone where it predicts left-out
        levels better.

        A discrepancy is handed on as a law, or as a table without a law or where it predicts left-out levels clearly
        better: a law can be run anywhere.
        """
        verdict = self.posterior.verdict
        errors = {CALIBRATION: self.heldout.before}
        if verdict.is_discrepancy:
            smooth = self.heldout.after
            if self.law is not None and self.law.heldout.after <= (1.0 + EQUIVALENT_WITHIN) * smooth:
                return LAW
            errors |= {TABLE: smooth} if self.law is None else {LAW: self.law.heldout.after, TABLE: smooth}
        elif verdict != NOTHING:
            errors |= {EFFECTS: self.heldout.after}
        return min(errors, key=errors.__getitem__)

    @property
    def handed_on_error(self) -> float:
        """Error on left-out levels of the model that is handed on."""
        if self.handed_on == LAW and self.law is not None:
            return self.law.heldout.after
        return self.heldout.before if self.handed_on == CALIBRATION else self.heldout.after

    def handed(self, p: Predicted) -> Predicted:
        """Predictions by the model that is handed on; the mismatch remains as answered."""
        if self.handed_on == LAW and self.law is not None:
            law, refined, inside = self.law, dict(self.law.refined), self.law.holds(p.table)
            with threadpool_limits(limits=1, user_api="blas"):
                own = averaged(law.search, law.alone, refined, p.table)
                # Laws that agree within the readings may differ beyond them.
                several = own if inside.all() else averaged(law.search, law.one_of_several, refined, p.table)
            names = ("predicted", "low90", "high90")
            return replace(p, **{n: np.where(inside, getattr(own, n), getattr(several, n)) for n in names})
        if self.handed_on == CALIBRATION and self.posterior.verdict != NOTHING:
            return by_calibration(self.search, p, self.heldout.before)
        return p

    @cached_property
    def tabulated(self) -> Tabulated:
        """The missing part as a table over the recorded conditions."""
        predict = partial(averaged, self.search, self.posterior, self.refined)
        with threadpool_limits(limits=1, user_api="blas"):
            return tabulated(self.search, self.recorded, predict)

    @property
    def outlier_runs(self) -> list[int]:
        """Runs that are more probably outliers than not, with the runs of a faulty channel."""
        wrong = self.search.problem.rows["run"][self.outlier_chance > LIKELY].tolist()
        faulty = [] if self.faulty is None else self.faulty.table["run"].tolist()
        return sorted(int(r) for r in (*wrong, *faulty))


def diagnose_case(
    folder: Path,
    predict: Path | None = None,
    exclude: Sequence[str] = (),
    level: float = FALSE_ALARM_RATE,
    progress: Progress = lambda text: None,
) -> Diagnosis:
    """Diagnose the case in a folder; conditions to ``predict`` replace the conditions of the case."""
    case = read_case(folder)
    if predict is None:
        return diagnosis_of(case, case.conditions, exclude, level, progress)
    requested = read_conditions(case, predict)
    refuse_used_runs(case, requested, predict)
    return diagnosis_of(case, requested, exclude, level, progress)


def _refuse_level(level: object) -> None:
    """Raise an error if the level of the mismatch test is not a number within LEVELS."""
    low, high = LEVELS
    if not isinstance(level, Real) or isinstance(level, bool) or not low <= float(level) <= high:
        raise InputError(f"must be a number from {low:g} to {high:g}", where="level", value=level)


def diagnosis_of(
    case: Case,
    requested: Table | None = None,
    exclude: Sequence[str] = (),
    level: float = FALSE_ALARM_RATE,
    progress: Progress = lambda text: None,
) -> Diagnosis:
    """Diagnose a case and predict the ``requested`` conditions."""
    with stated_units(case.kind.units):
        return _diagnosis_of(case, requested, exclude, level, progress)


def _diagnosis_of(
    case: Case, requested: Table | None, exclude: Sequence[str], level: float, progress: Progress
) -> Diagnosis:
    find(list(exclude), "exclude", case.laws)
    _refuse_level(level)
    given = case
    case, faulty, faults = set_aside(given)
    rows = rows_of(case)
    with collected() as assumed:
        new_rows = None if requested is None else at_programme_end(case, requested)
    forward = Forward(case, rows)
    checks = audit(case, rows, readings_of(case), forward)
    warnings = [*case.notes, *faults, *assumed, *unpredicted_runs(case, new_rows), *forward.notes, *checks]
    if forward.known.effects:
        named = ", ".join(effect_words(e.id) for e in forward.known.effects)
        warnings.append(finding("effects_known", f"part of the base model, so not looked for: {named}", "system.toml"))
    left_out = tuple(e.id for e in forward.effects() if e.id in exclude)
    if left_out:
        named = ", ".join(effect_words(name) for name in left_out)
        warnings.append(finding("effects_left_out", f"left out on request, so neither named nor excluded: {named}"))
    if new_rows is not None:
        new_model = Forward(case, new_rows)
        new_model.base_prediction()
        warnings += [note for note in new_model.notes if note not in forward.notes] + beyond_recorded(case, new_rows)
        warnings += judge_rows(new_model).findings
    # Matrices are small: a second thread of linear algebra costs more than it saves, and processes share the work.
    with threadpool_limits(limits=1, user_api="blas"):
        noise_search = search_under_noise(case, forward, exclude, progress)
        progress("testing against nothing missing")
        search, test = mismatch_against_null(noise_search, level)
    case, rows = search.problem.case, search.problem.rows
    warnings += [*noise_notes(search, noise_search.stated, noise_search.inflation), *setup_notes(given, search)]
    progress("leaving levels out")
    with threadpool_limits(limits=1, user_api="blas"):
        levels = LevelsOut.of(search)
        decided, heldout = judge(search, test, levels)
        hypotheses = weigh(search, decided, levels)
        law = find_law(search, levels) if decided.verdict.is_discrepancy else None
    heldout = heldout.single_reading_units(search.full_screen.problem.n_per_effective)
    refined = leaders(search, decided)
    progress("predicting")
    recorded = averaged(search, decided, refined, rows)
    predicted = None if new_rows is None else averaged(search, decided, refined, new_rows)
    left = None if faulty is None else averaged(search, decided, refined, faulty)
    outlier_chance = outlier_chances(search, decided, refined)
    columns = [c for c in case.kind.columns if c.name in rows]
    swept = {axis.name for axis in search.space.axes}
    varied = [c.name for c in columns if c.dtype == "name" or c.name in swept] or [c.name for c in columns]
    passing = [n for n in time_columns(search, decided.verdict) if n in rows and n not in varied]
    mismatch_region = region(rows, [*varied, *passing], np.where(outlier_chance > LIKELY, 0.0, recorded.mismatch_z))
    laws = contained(search, decided.verdict)
    batch = next_batch(search, decided, refined, columns, varied)
    shown = heldout if law is None or law.heldout.after > heldout.after else law.heldout
    warnings += _cautions(search, decided, shown, refined, recorded.predicted, outlier_chance > LIKELY)
    if test.detected:
        at_base = search.problem.single_reading_units(search.null_fit.residual)
        warnings += mismatch_at_steps(rows, [c.name for c in columns], at_base)
    warnings += _history_notes(search, decided, law, new_model) if new_rows is not None else []
    all_warnings = tuple(warnings)
    return Diagnosis(
        given,
        case,
        search,
        test,
        decided,
        refined,
        recorded,
        predicted,
        outlier_chance,
        mismatch_region,
        heldout,
        laws,
        batch,
        all_warnings,
        left_out,
        noise_search.stated,
        hypotheses,
        faulty=left,
        law=law,
    )


def _history_notes(search: Search, judged: Posterior, law: FoundLaw | None, new_model: Forward) -> list[Finding]:
    """Report the history that the rows to predict are given, where the answer depends on one."""
    if not judged.verdict.is_discrepancy:
        return []
    past = search.discrepancy.best.past
    read = [] if law is None else pasts_read([law.effect], new_model.case.kind.numbers)
    note = new_model.assumed_history([*read, *([] if past is None else [past.past])])
    return [] if note is None else [note]


def _cautions(
    search: Search,
    judged: Posterior,
    kept: HeldOut,
    refined: dict[Explanation, Refined],
    predicted: np.ndarray,
    wrong: np.ndarray,
) -> list[Finding]:
    """Doubts about the answer: its odds, outliers, ranges of laws and unpublished parameters."""
    problem = search.problem
    case, rows = problem.case, problem.rows
    read = (case.quantity, f"{case.quantity}_sd", case.system.recording.check)
    taken_at = Table({n: v for n, v in rows.columns.items() if n not in read}, rows.source)
    at_one_place = judged.verdict == DISCREPANCY and search.discrepancy.best.at is not None
    said = failed_warning(judged, problem.y.size)
    said += answer_warnings(judged.verdict, kept, taken_at, problem.inverse(problem.y), predicted, wrong, at_one_place)
    if judged.verdict.is_discrepancy:
        return said
    named, own = refined[judged.verdict], slice(problem.calibration_size, None)
    said += beyond_range(problem, judged.verdict, named.z)
    return said + unpublished(problem.effects(judged.verdict), named.z[own], named.spread[own])
