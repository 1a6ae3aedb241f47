"""Figures of the battery on real recordings: measures of an answer, and their goals."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mixedlub.validation.answers import Answer, read_answer
from mixedlub.validation.measures import ANSWERS_WITHOUT_EFFECT
from mixedlub.validation.planted import MEASUREMENT
from mixedlub.validation.real.deal import HIDDEN, PAIRED, PLANTED, UNTOUCHED
from mixedlub.validation.rig import NAMES
from mixedlub.validation.score import Figure, any_case, at_least, at_most, share

CLAIM = 0.9
"""Least probability of a confident claim."""
PLACES = 2
"""First places of an answer's location among which the concealed channel must be."""
FAULT_FOUND = 0.8
"""Share of the faulty readings to be flagged as outliers."""


@dataclass(frozen=True)
class Truth:
    """Truth of a case: ids that are right, ids that act beside, columns at which the mismatch sits."""

    case: str
    recording: str
    source: str
    split: str
    kind: str
    label: str
    right: frozenset[str]
    also: frozenset[str]
    unknown_right: bool
    where: frozenset[str]
    identifiable: bool
    lost: bool
    named: bool
    fault: bool
    faults: frozenset[int]
    run: np.ndarray
    withheld: np.ndarray
    reading: np.ndarray


@dataclass(frozen=True)
class Located:
    """An answer with the columns at which it places the mismatch, in order."""

    answer: Answer
    places: tuple[str, ...]


Pair = tuple[Truth, Located]
STATES = frozenset({"friction_run_in", "two_time_scales", "wandering_surface_state"})
ALSO_CALLED = {"running_in": STATES, "tribofilm_growth": STATES, "fringe_order": frozenset({"fringe_step"})}
"""Definition. Further ids of a documented cause: states of a surface that evolve, orders that are misread."""


def read_truth(folder: Path) -> Truth:
    """Truth of a case folder."""
    record = json.loads((folder / "truth.json").read_text(encoding="utf-8"))
    rows = {name: np.array(values) for name, values in record["rows"].items()}
    return Truth(
        case=folder.name,
        recording=record["recording"],
        source=record["source"],
        split=record["split"],
        kind=record["kind"],
        label=record["class"],
        right=frozenset(record["right"]) if record["class"] == PLANTED else _called(record["right"]),
        also=_called(record["also"]),
        unknown_right=record["unknown_right"],
        where=frozenset(record["where"]),
        identifiable=record["identifiable"],
        lost=record["lost"],
        named=record.get("named", True),
        fault=record.get("fault", False),
        faults=frozenset(record["faults"]),
        run=rows["run"],
        withheld=rows["withheld"].astype(bool),
        reading=rows["reading"],
    )


def _called(ids: Iterable[str]) -> frozenset[str]:
    """Ids with the further ids of the same causes."""
    return frozenset().union(*({name} | ALSO_CALLED.get(name, frozenset()) for name in ids))


def read_located(folder: Path) -> Located:
    """Answer of a folder."""
    record = json.loads((folder / "diagnosis.json").read_text(encoding="utf-8"))
    places = tuple(dict.fromkeys(str(one["column"]) for one in record.get("location", {}).get("where", [])))
    return Located(read_answer(folder), places)


def fits(truth: Truth, explanation: frozenset[str]) -> bool:
    """Whether an explanation is right: it names a right cause and nothing that does not act."""
    if explanation == {"unknown"}:
        return truth.unknown_right
    named = explanation - ANSWERS_WITHOUT_EFFECT - NAMES
    if not truth.right:
        return not named and not truth.unknown_right
    return bool(explanation & truth.right) and named <= truth.right | truth.also


def right(truth: Truth, found: Located) -> bool:
    """Whether the verdict, or an explanation tied with it, is right."""
    return any(fits(truth, one) for one in (found.answer.verdict, *found.answer.tied))


def named(truth: Truth, found: Located) -> bool:
    """Whether the verdict or a tied explanation names a right cause, whatever stands beside."""
    return any(one & truth.right for one in (found.answer.verdict, *found.answer.tied))


def falsely_claimed(truth: Truth, found: Located) -> bool:
    """Whether an id that does not act has a probability of 0.9 or more."""
    so = truth.right | truth.also | NAMES | ANSWERS_WITHOUT_EFFECT
    return any(p >= CLAIM for name, p in found.answer.probabilities.items() if name not in so)


def located(truth: Truth, found: Located) -> bool:
    """Whether a column at which the mismatch sits is among the first places."""
    return bool(truth.where & set(found.places[:PLACES]))


def faults_found(truth: Truth, found: Located) -> bool:
    """Whether the faulty readings are flagged, or a fault of the instrument is named."""
    flagged = len(truth.faults & found.answer.outliers) / len(truth.faults)
    return flagged >= FAULT_FOUND or bool(found.answer.verdict & MEASUREMENT)


def _withheld(truth: Truth, found: Located, column: str) -> np.ndarray:
    index = {int(run): i for i, run in enumerate(found.answer.run)}
    place = [index[int(run)] for run in truth.run[truth.withheld]]
    return np.asarray(getattr(found.answer, column)[place])


def coverage(truth: Truth, found: Located) -> float:
    """Share of the withheld readings inside their 90 % predictive intervals."""
    readings = truth.reading[truth.withheld]
    inside = (readings >= _withheld(truth, found, "low")) & (readings <= _withheld(truth, found, "high"))
    return float(np.mean(inside))


def helps(truth: Truth, found: Located) -> bool:
    """Whether the verdict predicts the withheld readings no worse than calibration alone."""
    readings = truth.reading[truth.withheld]
    after, before = (np.mean((_withheld(truth, found, c) - readings) ** 2) for c in ("predicted", "calibrated"))
    return bool(after <= before * 1.02)


def _none_or_tied(truth: Truth, found: Located) -> bool:
    return any(one == {"none"} or one <= NAMES for one in (found.answer.verdict, *found.answer.tied))


def _of(label: str, **wanted: object) -> Callable[[Truth, Located], bool]:
    return lambda t, a: t.label == label and all(getattr(t, name) == value for name, value in wanted.items())


def _nothing_acts(truth: Truth, found: Located) -> bool:
    return truth.label == UNTOUCHED and not truth.right and not truth.unknown_right


def _something_acts(truth: Truth, found: Located) -> bool:
    return truth.label == UNTOUCHED and bool(truth.right)


def _nothing_lost(truth: Truth, found: Located) -> bool:
    return truth.label in (HIDDEN, PAIRED) and not truth.lost


def _has_effect(truth: Truth, found: Located) -> bool:
    return bool(found.answer.verdict - ANSWERS_WITHOUT_EFFECT)


FIGURES: tuple[Figure[Truth, Located], ...] = (
    share("planted", "planted effects named or tied, if identifiable", _of(PLANTED, identifiable=True, named=True),
          named, at_least(0.85)),
    share("planted_all", "  of all planted effects of the catalogue", _of(PLANTED, named=True), named),
    share("planted_clean", "  and nothing else invented", _of(PLANTED, identifiable=True, named=True), right),
    share("outside", "planted outside the catalogue: unknown", _of(PLANTED, named=False), right),
    share("hidden_located", "hidden channels located", lambda t, a: t.label == HIDDEN and bool(t.where), located,
          at_least(0.8)),
    share("hidden_right", "hidden channels named or unknown", _of(HIDDEN, lost=True), right),
    share("nothing_lost", "hidden or paired with nothing lost: as before", _nothing_lost, right),
    share("hidden_false", "hidden channels with a false claim at 0.9", _of(HIDDEN), falsely_claimed, at_most(0.04)),
    share("paired", "known differences named or tied", _of(PAIRED, lost=True), right, at_least(0.75)),
    share("untouched", "nothing missing: none or tied with none", _nothing_acts, _none_or_tied, at_least(0.9)),
    share("documented", "documented causes named or tied", _something_acts, named),
    share("claims_false", "any case with a false claim at 0.9", any_case, falsely_claimed),
    share("faults", "documented faults found as faults", lambda t, a: bool(t.faults), faults_found, at_least(0.85)),
    share("helps", "named effects that predict withheld readings", _has_effect, helps, at_least(1.0)),
    Figure("coverage", "coverage of the 90 % intervals, withheld readings", any_case, coverage, (0.85, 0.95), "mean"),
    Figure("seconds", "seconds a case, median", any_case, lambda t, a: a.answer.seconds, at_most(10.0), "median"),
    Figure("slowest", "seconds a case, worst", any_case, lambda t, a: a.answer.seconds, at_most(60.0), "max"),
)  # fmt: skip
