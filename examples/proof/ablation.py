"""Ablation of the diagnosis: what each of its mechanisms adds to the answers on a battery of blind cases.

    mixedlub prove --rigs --seed 981202 --cases 100 --out out/fresh
    python examples/proof/ablation.py out/fresh

One search a case is made. Each mechanism is then switched off in turn, the search weighed again, and the answer
compared with the full one: verdicts that change, and the mean difference of the log score with its 90 % bootstrap
interval.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.diagnosis.assessment import mismatch_test, verdict
from mixedlub.diagnosis.assessment.cross_validation import LevelsOut
from mixedlub.diagnosis.discrepancy import model
from mixedlub.diagnosis.search import law_error, noise_selection, search
from mixedlub.effects import catalogue
from mixedlub.recording.readings import rows_of
from mixedlub.validation.answers import Answer, Truth, read_truth
from mixedlub.validation.measures import log_score, right, tied

IDS = [*sorted(catalogue()), "none", "unknown"]
EMPTY = np.zeros(0)
FORMS = ("box", "wave", "peak", "step", "delay")
Switch = tuple[Any, str, Any]
WEIGHED_AGAIN: dict[str, Switch] = {
    "published laws within an effect": (search, "PUBLISHED_WITHIN", -1.0),
    "errors of laws": (search, "law_error_evidence", lambda problem, stiff, fit, *a: fit.evidence),
    "errors of the base laws": (law_error, "BASE_ERRORS", ((0.0, 1.0),)),
}
JUDGED_AGAIN: dict[str, Switch] = {
    "effects that earn their place": (verdict, "_unearned", lambda *a: 0.0),
    "Bayes factor bounds p": (mismatch_test, "BAYES_FACTOR_MARGIN", 1e300),
    "scatter beyond any noise": (mismatch_test, "beyond_noise", lambda found, times, test: test),
    "any unstated noise in the test": (mismatch_test, "UNSTATED_NOISE_SCALES", (1.0,)),
    "least odds of nothing": (search, "LEAST_NOTHING_ODDS", 0.0),
}
"""By name of a mechanism: the module or class, its attribute, and what stands there without the mechanism."""


def answered(truth: Truth, noise: Any, found: Any) -> Answer:
    """The answer that a search leads to."""
    chosen, test = mismatch_test.mismatch_against_null(replace(noise, search=found), 0.01)
    judged, _ = verdict.judge(chosen, test, LevelsOut.of(chosen))
    names = [frozenset(key.ids) for key in (judged.verdict, *judged.tied)]
    return Answer(
        case=truth.case,
        verdict=names[0],
        tied=tuple(names[1:]),
        probabilities=judged.inclusion(chosen),
        detected=test.detected,
        outliers=frozenset(),
        location={},
        calibration={},
        run=EMPTY,
        calibrated=EMPTY,
        predicted=EMPTY,
        low=EMPTY,
        high=EMPTY,
    )


def without_form(form: str, found: Any) -> Any:
    """The search whose discrepancy lacks a kind of form."""
    every = model.candidate_forms

    def fewer(*arguments: Any) -> list[list[Any]]:
        families = [[one for one in family if one.form != form] for family in every(*arguments)]
        return [family for family in families if family]

    with ExitStack() as switches:
        switches.enter_context(patch.object(model, "candidate_forms", fewer))
        if form == "box":
            switches.enter_context(patch.object(model, "_boxes", lambda *a: iter(())))
        names = {s.id for s in found.draws}
        anew = search.fit_discrepancy(found.problem, found.null_fit, found.space, found.values, names)
    return replace(found, discrepancy=anew)


def variants(truth: Truth, case_folder: Path) -> Iterator[tuple[str, Answer]]:
    """The full answer to a case, then the answer without each mechanism."""
    case = read_case(case_folder)
    noise = noise_selection.search_under_noise(case, Forward(case, rows_of(case)), (), lambda text: None)
    found = noise.search
    yield "", answered(truth, noise, found)
    for form in FORMS:
        yield f"form: {form}", answered(truth, noise, without_form(form, found))
    for name, (home, attribute, instead) in WEIGHED_AGAIN.items():
        with patch.object(home, attribute, instead):
            scores = search._scores(found.problem, found.fits, found.space, found.values)
        yield name, answered(truth, noise, replace(found, scores=scores))
    for name, (home, attribute, instead) in JUDGED_AGAIN.items():
        with patch.object(home, attribute, instead):
            yield name, answered(truth, noise, found)


def main(folder: Path) -> None:
    """Print the table of a battery."""
    gains: dict[str, list[list[float]]] = {}
    cases = sorted(one for one in (folder / "cases").iterdir() if one.is_dir() and one.name[0] != ".")
    for case in cases:
        truth = read_truth(folder / "sealed" / case.name)
        full: Answer | None = None
        for name, answer in variants(truth, case):
            full = full or answer
            both = [(right(truth, a), tied(truth, a), log_score(truth, a, IDS)) for a in (full, answer)]
            gains.setdefault(name, []).append([float(one - other) for one, other in zip(*both, strict=True)])
        print(f"\r{case.name}", end="", file=sys.stderr, flush=True)
    rng = np.random.default_rng(1)
    print(
        f"\n{len(cases)} cases: what each mechanism adds\n{'mechanism':34s} {'right':>9s} {'tied':>9s}  log score, 90 %"
    )
    for name, each in gains.items():
        if not name:
            continue
        gain = np.array(each)
        means = gain[rng.integers(0, len(gain), (2000, len(gain))), 2].mean(axis=1)
        low, high = np.quantile(means, (0.05, 0.95))
        counts = [f"+{int((gain[:, k] > 0).sum())} -{int((gain[:, k] < 0).sum())}" for k in (0, 1)]
        print(f"{name:34s} {counts[0]:>9s} {counts[1]:>9s}  {gain[:, 2].mean():+.3f} [{low:+.3f}, {high:+.3f}]")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
