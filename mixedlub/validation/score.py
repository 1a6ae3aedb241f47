"""Scores of a tool's answers to a battery: all reported figures with their goals."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import Generic, TypeVar

import numpy as np

from mixedlub.validation.answers import Answer, Truth
from mixedlub.validation.intervals import interval, reduced
from mixedlub.validation.measures import (
    ANSWERS_WITHOUT_EFFECT,
    Pair,
    calibration_covers,
    clean,
    coverage,
    crossed,
    held_ratio,
    location_auroc,
    log_score,
    outliers_false,
    outliers_found,
    physics,
    right,
    spoiled,
    tied,
)
from mixedlub.validation.planted import NAMED
from profiles.errors import InputError

BINS = (0.0, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98, 1.0)
VISIBILITIES = (0.0, 5.0, 8.0, 11.0, 15.0, 20.0, 25.0, np.inf)


INF = float("inf")


def at_least(value: float) -> tuple[float, float]:
    return (value, INF)


def at_most(value: float) -> tuple[float, float]:
    return (-INF, value)


@dataclass(frozen=True)
class Row:
    """A figure: its value, number of counts, 90 % interval, and goal."""

    key: str
    text: str
    value: float
    count: int
    low: float
    high: float
    goal: tuple[float, float] | None

    @property
    def met(self) -> bool | None:
        """Whether the value lies inside the goal; None without a goal or without anything counted."""
        if self.goal is None or not np.isfinite(self.value):
            return None
        return bool(self.goal[0] <= self.value <= self.goal[1])

    @property
    def aim(self) -> str:
        """The goal in words, empty without a goal."""
        if self.goal is None:
            return ""
        low, high = self.goal
        if not np.isfinite(high):
            return f">= {low:.3g}"
        return f"{low:g} to {high:g}" if np.isfinite(low) else f"<= {high:.3g}"


@dataclass(frozen=True)
class Score:
    """All figures of one tool on one battery, with the data of its diagrams."""

    tool: str
    rows: tuple[Row, ...]
    reliability: tuple[tuple[float, float, float, int], ...]
    identification: tuple[tuple[float, float, float, int], ...]
    confusion: dict[str, dict[str, int]]

    def __getitem__(self, key: str) -> Row:
        return next(row for row in self.rows if row.key == key)

    def above(self, rivals: Sequence[Score]) -> Score:
        """The same score with the best rival log score as the goal of its log score."""
        best = max(rival["log_score"].value for rival in rivals)
        rows = [replace(row, goal=at_least(best)) if row.key == "log_score" else row for row in self.rows]
        return replace(self, rows=tuple(rows))

    def text(self) -> str:
        """The table as plain text, one figure a line."""
        lines = [f"{self.tool}", f"{'figure':58s} {'value':>8s} {'90 %':>17s} {'n':>5s}  goal"]
        for row in self.rows:
            mark = {True: "met", False: "NOT met", None: ""}[row.met]
            span = f"[{row.low:.3g}, {row.high:.3g}]" if np.isfinite(row.low) else ""
            value = f"{row.value:.3g}" if np.isfinite(row.value) else "-"
            lines.append(f"{row.text:58s} {value:>8s} {span:>17s} {row.count:5d}  {row.aim:12s} {mark}")
        return "\n".join(line.rstrip() for line in lines) + "\n"

    def save(self, file: Path) -> None:
        rows = [{**asdict(row), "met": row.met} for row in self.rows]
        data = {**asdict(self), "rows": rows}
        file.write_text(json.dumps(finite(data), indent=1, allow_nan=False), encoding="utf-8")


def finite(value: object) -> object:
    """The same data with null for numbers outside JSON (nan, infinity)."""
    if isinstance(value, dict):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(item) for item in value]
    if isinstance(value, float) and not np.isfinite(value):
        return None
    return value


def _claims(pairs: Sequence[Pair]) -> list[tuple[float, bool]]:
    """All probabilities, with the truth of the claim: a planted effect, or a law followed by the rig."""
    return [
        (p, name in truth.label | truth.laws) for truth, answer in pairs for name, p in answer.probabilities.items()
    ]


def _ratio(hits: Sequence[float]) -> float:
    return float(np.mean(hits)) if len(hits) else float("nan")


T = TypeVar("T")
A = TypeVar("A")
"""Truth (T) and answer (A) of the cases of a battery."""


@dataclass(frozen=True)
class Figure(Generic[T, A]):
    """Definition of a row: counted cases, measure of a case, reduction over cases.

    A ``share`` counts yes-or-no outcomes: one a case, or ``weight`` of them.
    """

    key: str
    text: str
    counts: Callable[[T, A], bool]
    measure: Callable[[T, A], float]
    goal: tuple[float, float] | None = None
    reduction: str = "mean"
    weight: Callable[[T], int] | None = None

    def row(self, pairs: Sequence[tuple[T, A]]) -> Row:
        """The row of answered cases."""
        counted = [pair for pair in pairs if self.counts(*pair)]
        values = np.array([float(self.measure(*pair)) for pair in counted])
        weights = np.array([1.0 if self.weight is None else float(self.weight(truth)) for truth, _ in counted])
        finite = np.isfinite(values)
        values, weights = values[finite], weights[finite]
        value, span = reduced(values, weights, self.reduction), interval(values, weights, self.reduction)
        return Row(self.key, self.text, value, int(weights.sum()), *span, self.goal)


Measured = Figure[Truth, Answer]
"""Figure of a battery of simulated rigs."""


def any_case(truth: object, answer: object) -> bool:
    return True


def share(
    key: str,
    text: str,
    counts: Callable[[T, A], bool],
    measure: Callable[[T, A], float],
    goal: tuple[float, float] | None = None,
    weight: Callable[[T], int] | None = None,
) -> Figure[T, A]:
    """Figure of a yes-or-no measure."""
    return Figure(key, text, counts, measure, goal, "share", weight)


def _spoiled(truth: Truth, answer: Answer) -> bool:
    return bool(truth.outliers)


def of_class(*groups: str) -> Callable[[Truth, Answer], bool]:
    return lambda truth, answer: truth.group in groups


def clear(*groups: str) -> Callable[[Truth, Answer], bool]:
    return lambda truth, answer: truth.group in groups and truth.identifiable


def _formed(within: bool, clear: bool) -> Callable[[Truth, Answer], bool]:
    """Filter of single physical effects by whether the catalogue's laws can become the planted laws."""
    return lambda truth, answer: (
        truth.group == "single" and truth.within is within and (truth.identifiable or not clear)
    )


def _named_unknown(truth: Truth, answer: Answer) -> float:
    return float("unknown" in answer.verdict)


def _both(truth: Truth, answer: Answer) -> float:
    return float(truth.label <= answer.verdict)


def _detected(truth: Truth, answer: Answer) -> float:
    return float(answer.detected)


def _seconds(truth: Truth, answer: Answer) -> float:
    return answer.seconds


def _explanations(truth: Truth, answer: Answer) -> float:
    return float(len(answer.tied))


def _distinct(truth: Truth, answer: Answer) -> bool:
    return truth.group == "unknown" and truth.identifiable and not truth.mimic


def _glaring(truth: Truth, answer: Answer) -> bool:
    return truth.group == "unknown" and truth.identifiable and truth.visibility >= 12


ONE, SOME = ("single", "measurement"), ("single", "measurement", "pair")
HIDDEN = (*SOME, "unknown")
FIGURES: tuple[Measured, ...] = (
    share("right", "right verdict, one effect, identifiable", clear(*ONE), right, at_least(0.95)),
    share("right_physics", "  of these physics", clear("single"), right),
    share("right_within", "    their law one that the catalogue can become", _formed(True, True), right),
    share("right_beyond", "    their law another", _formed(False, True), right),
    share("right_fault", "  of these instrument faults", clear("measurement"), right),
    share("tied", "right or honestly tied, one effect, all", of_class(*ONE), tied, at_least(0.98)),
    share("tied_within", "  physics, their law one that the catalogue can become", _formed(True, False), tied),
    share("tied_beyond", "  physics, their law another", _formed(False, False), tied),
    Figure("ties", "explanations named where one effect is hidden", of_class(*ONE), _explanations),
    share("pair_both", "both effects of a pair named", of_class("pair"), _both, at_least(0.85)),
    share("pair_exact", "pair named exactly", of_class("pair"), right),
    share("none", "none where nothing is missing", of_class("none"), right, at_least(0.98)),
    share("false_alarm", "mismatch detected where nothing is missing", of_class("none"), _detected),
    share("power", "mismatch detected where one effect is hidden", of_class(*ONE), _detected),
    share("unknown", "unknown where so and identifiable", clear("unknown"), _named_unknown, at_least(0.90)),
    share("unknown_distinct", "  of these, not made to mimic", _distinct, _named_unknown),
    share("unknown_clear", "  of these, clearly visible (12 or more)", _glaring, _named_unknown),
    share("outliers_found", "outlier readings found", _spoiled, outliers_found, at_least(0.95), weight=spoiled),
    share("outliers_false", "good readings flagged as outliers", any_case, outliers_false, at_most(0.005),
          weight=clean),
    share("crossed", "fault called physics or physics fault", clear(*ONE), crossed, at_most(0.02)),
    Figure("held_out", "withheld: error of predicted over calibrated", of_class(*SOME), held_ratio, at_most(0.25),
           "median"),
    Figure("held_out_unknown", "  outside the catalogue", of_class("unknown"), held_ratio, reduction="median"),
    Figure("held_out_none", "  where nothing is missing", of_class("none"), held_ratio, reduction="median"),
    Figure("coverage", "90 % predictive intervals cover", any_case, coverage, (0.85, 0.95)),
    Figure("coverage_hidden", "  where something is hidden", of_class(*HIDDEN), coverage),
    Figure("calibration", "90 % intervals of the calibration cover", any_case, calibration_covers),
    Figure("location", "location AUROC", of_class(*HIDDEN), location_auroc, at_least(0.85)),
    Figure("seconds", "seconds a case, median", any_case, _seconds, at_most(10.0), "median"),
    Figure("slowest", "seconds a case, worst", any_case, _seconds, at_most(30.0), "max"),
)  # fmt: skip
HALVES = (("right_within", "right_beyond"), ("tied_within", "tied_beyond"))
"""Figures shown only if both halves have counts."""


def chosen(figures: Sequence[Measured], *keys: str) -> tuple[Measured, ...]:
    """Figures with the keys, in the order of the keys."""
    return tuple(figure for key in keys for figure in figures if figure.key == key)


def score(
    pairs: Sequence[Pair],
    tool: str = "mixedlub diagnose",
    ids: Sequence[str] = tuple(NAMED),
    figures: Sequence[Measured] = FIGURES,
) -> Score:
    """All figures of a battery answered by a tool, with the project's goals.

    ``ids``: effects in the sum of the log score, all that the battery can plant.
    """
    if not pairs:
        raise InputError("there is no answered case to score", where=tool)
    rows = [figure.row(pairs) for figure in figures]
    one_half_only = {name for halves in HALVES for name in halves if not all(r.count for r in rows if r.key in halves)}
    rows = [row for row in rows if row.key not in one_half_only]
    rows += _probability_rows(pairs, ids)
    return Score(tool, tuple(rows), _reliability(pairs), _identification(pairs), _confusion(pairs))


def _probability_rows(pairs: Sequence[Pair], ids: Sequence[str]) -> list[Row]:
    """Log score over all ids, claims above 0.9, and the calibration error of the probabilities."""
    # Where rigs follow other laws, an answer of laws alone and "none" are both right: neither is summed over.
    worlds = any(truth.laws for truth, _ in pairs)
    names = [*ids, *(["unknown"] if worlds else sorted(ANSWERS_WITHOUT_EFFECT))]
    logs = np.array([log_score(truth, answer, names) for truth, answer in pairs])
    bold = np.array([float(so) for p, so in _claims(pairs) if p > 0.9])
    some = [(p, so) for p, so in _claims(pairs) if p > 0.02]
    bins = np.digitize([p for p, _ in some], np.linspace(0, 1, 11)[1:-1])
    error = 0.0
    for index in np.unique(bins):
        inside = [some[i] for i in np.flatnonzero(bins == index)]
        gap = np.mean([p for p, _ in inside]) - np.mean([so for _, so in inside])
        error += len(inside) / len(some) * abs(float(gap))
    return [
        Row("log_score", "log score of the probabilities, a case", float(logs.mean()), len(logs),
            *interval(logs, np.ones_like(logs), "mean"), None),
        Row("claims", "claims above 0.9 that are right", _ratio(list(bold)), len(bold),
            *interval(bold, np.ones_like(bold), "share"), at_least(0.97 if worlds else 0.90)),
        Row("calibration_error", "expected calibration error, probabilities over 0.02", error, len(some),
            float("nan"), float("nan"), None),
    ]  # fmt: skip


def _reliability(pairs: Sequence[Pair]) -> tuple[tuple[float, float, float, int], ...]:
    """Bins of the probabilities: lower edge, mean probability, share of true claims, count."""
    claims = _claims(pairs)
    claimed = np.array([p for p, _ in claims])
    so = np.array([float(is_so) for _, is_so in claims])
    table = []
    for low, high in pairwise(BINS):
        inside = (claimed >= low) & ((claimed < high) | (high == 1.0))
        if inside.any():
            table.append((low, float(claimed[inside].mean()), float(so[inside].mean()), int(inside.sum())))
    return tuple(table)


def _identification(pairs: Sequence[Pair]) -> tuple[tuple[float, float, float, int], ...]:
    """Single effects by visibility: lower edge, mean visibility, share named correctly, count."""
    singles = [(truth.visibility, right(truth, answer)) for truth, answer in pairs if truth.group in ONE]
    table = []
    for low, high in pairwise(VISIBILITIES):
        inside = [(visibility, named) for visibility, named in singles if low <= visibility < high]
        if inside:
            visibility, named = (float(np.mean(column)) for column in zip(*inside))
            table.append((low, visibility, named, len(inside)))
    return tuple(table)


def _confusion(pairs: Sequence[Pair]) -> dict[str, dict[str, int]]:
    """True label by verdict, for none, unknown and single effects; verdicts of several effects are joined."""
    table: dict[str, dict[str, int]] = {}
    for truth, answer in pairs:
        if truth.group != "pair":
            row = table.setdefault("+".join(sorted(truth.label)), {})
            verdict = "+".join(sorted(physics(answer.verdict, truth)))
            row[verdict] = row.get(verdict, 0) + 1
    return table
