"""The answer in plain words, on one page: the same sentences in the text and on the page."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from mixedlub.diagnosis.advice import next_test
from mixedlub.diagnosis.answer import effect_records, interval, verdict_fit
from mixedlub.diagnosis.carriers import NOTHING, READING
from mixedlub.diagnosis.confusion import Confusion, confusion
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.empirical import Absorbed, Unnamed
from mixedlub.diagnosis.labels import (
    effect_words,
    explanation_words,
    number,
    range_text,
    words_of,
)
from mixedlub.diagnosis.maps import missing
from mixedlub.diagnosis.problem import effects_of
from mixedlub.diagnosis.readings import checked_channel, outliers, reading_conditions, steadied_noise
from mixedlub.effect import Effect
from mixedlub.report.plain import plain_equation, with_symbol

WIDTH = 88
REFITTED = "Parameters were refitted without each level; what the answer is was settled with all of them."
ANSWER = "Answer"
MISMATCH = "Is there a mismatch beyond noise and calibration?"
WHERE = "Where?"
LEFT_OUT = "What was left out?"
UNNAMED = "If it is something unknown"
ALIKE = "What else could it be?"
GAIN = "How much better is it on conditions it did not fit?"
CHECK = "Does a channel that was not fitted agree?"
OUTLIERS = "Outlier readings"
CALIBRATION = "What calibration was moved to"
NEXT = "Next test"
STRAINED = 2.0
MOST_TIED = 5
STAGE_WORDS = {
    "film": "the oil film",
    "shear": "shear of the film",
    "contact": "asperity contact",
    "boundary": "boundary friction",
    "load": "load and its sharing",
    "loss": "losses beside the sliding contact",
    "property": "properties of the oil",
    "measurement": "the instrument",
}


@dataclass(frozen=True)
class Section:
    """A question, the sentences that answer it, and a table (first row its head) where numbers are asked for."""

    title: str
    sentences: tuple[str, ...]
    table: tuple[tuple[str, ...], ...] = ()


def chance(p: float) -> str:
    """A probability as it is said.

    >>> chance(0.853), chance(0.9999), chance(0.001)
    ('0.85', 'above 0.99', 'below 0.01')
    """
    if p > 0.994:
        return "above 0.99"
    return "below 0.01" if p < 0.006 else f"{p:.2f}"


def sections(d: Diagnosis, unnamed: Unnamed | None = None) -> list[Section]:
    """The whole answer, question by question."""
    alike = confusion(d.found)
    found = [
        Section(ANSWER, (headline(d), *_standing(d))),
        Section(MISMATCH, (*_mismatch(d), *steadied_noise(d))),
        Section(WHERE, _where(d)),
        Section(LEFT_OUT, *_left_out(d)),
        *([_unnamed(d, unnamed)] if unnamed is not None else []),
        Section(ALIKE, _ties(d, alike)),
        Section(GAIN, _gain(d)),
        Section(CHECK, checked_channel(d)),
        Section(OUTLIERS, *outliers(d)),
        Section(CALIBRATION, *_calibration(d)),
        Section(NEXT, next_test(d)),
        Section("Warnings", d.warnings),
    ]
    return [s for s in found if s.sentences or s.table]


def as_text(title: str, parts: Iterable[Section]) -> str:
    """Sections as plain text, wrapped."""
    lines = [title, "=" * len(title)]
    for part in parts:
        lines += ["", part.title.upper()]
        for sentence in part.sentences:
            lines += textwrap.wrap(
                sentence, WIDTH, initial_indent="  ", subsequent_indent="  ", break_long_words=False
            ) or [""]
        if part.table:
            widths = [max(len(row[i]) for row in part.table) for i in range(len(part.table[0]))]
            lines += [
                "    " + "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
                for row in part.table
            ]
    return "\n".join(lines) + "\n"


def headline(d: Diagnosis) -> str:
    """The verdict in one sentence."""
    judged = d.posterior
    if len(judged.tied) > 1:
        named = [f"{explanation_words(judged.names(k))} ({chance(judged.weights[k])})" for k in judged.tied[:MOST_TIED]]
        more = len(judged.tied) - MOST_TIED
        rest = [f"{more} less probable one{'s' if more > 1 else ''}"] if more > 0 else []
        if judged.verdict == ():
            return (
                f"No mismatch beyond noise: nothing needs to be missing ({chance(judged.weights[()])}). A tie all the "
                f"same, for these readings are too few or too coarse to exclude {_listed([*named[1:], *rest], 'or')}."
            )
        return f"A tie: the readings cannot decide between {_listed([*named, *rest], 'and')}."
    p = chance(judged.weights[judged.verdict])
    if judged.verdict == ():
        return f"Nothing is missing that these readings could show: the calibrated model explains them ({p})."
    if judged.verdict == "unknown":
        return f"Something is missing that the catalogue does not have (probability {p})."
    assert not isinstance(judged.verdict, str)
    effects = effects_of(judged.verdict)
    free = [effect_words(e.id) for e in effects if is_free(e)]
    physics = [effect_words(e.id) for e in effects if e.stage != "measurement" and not is_free(e)]
    faults = [effect_words(e.id) for e in effects if e.stage == "measurement"]
    if not physics and not free:
        return f"No physics is missing; the instrument is at fault: {' and '.join(faults)} (probability {p})."
    parts = [f"Missing physics: {' and '.join(physics)}"] if physics else []
    if free:
        parts.append(f"{'a' if parts else 'A'} change of free form, its cause not named: {' and '.join(free)}")
    if faults:
        parts.append(f"a fault of the instrument: {' and '.join(faults)}")
    return f"{'; and '.join(parts)} (probability {p})."


def is_free(e: Effect) -> bool:
    """Whether an effect describes a history in a form that fits any, so that it names no cause."""
    return e.source.startswith("empirical")


def _listed(items: list[str], last: str) -> str:
    """Items with semicolons, the last one joined by a word.

    >>> _listed(["a", "b and c", "d"], "or")
    'a; b and c; or d'
    """
    return items[0] if len(items) == 1 else f"{'; '.join(items[:-1])}; {last} {items[-1]}"


def _standing(d: Diagnosis) -> list[str]:
    """What all tied explanations share, and whether physics or instrument."""
    judged = d.posterior
    said = []
    named = [set(k) for k in judged.tied if not isinstance(k, str)]
    common = set.intersection(*named) if len(named) == len(judged.tied) > 1 else set()
    inclusion = judged.inclusion(d.found)
    if common:
        every = " and ".join(f"{effect_words(n)} ({chance(inclusion[n])})" for n in sorted(common))
        said.append(f"In every one of them: {every}.")
    stages = {name: p for name, p in judged.stages().items() if p >= 0.05}
    if judged.verdict != () and stages:
        ranked = sorted(stages.items(), key=lambda item: -item[1])
        said.append("Where in the chain: " + ", ".join(f"{STAGE_WORDS[s]} {chance(p)}" for s, p in ranked) + ".")
    return said


def _mismatch(d: Diagnosis) -> tuple[str, ...]:
    test = d.test
    alarm = f"This test is wrong in {100 * test.level:g} % of the cases in which nothing is missing."
    kept = d.outlier_chance <= 0.5
    left = float((d.found.none.residual[kept] ** 2).sum() + d.found.none.z @ d.found.none.z)
    without = "" if kept.all() else ", outliers left out"
    chi2 = f"chi-square {number(left)} for {int(kept.sum())} readings after calibration{without}"
    size = f"{test.p_value:.2g}" if test.p_value > 1e-300 else "below 1e-300"
    if test.detected:
        return (f"Yes (p = {size}; {chi2}).", alarm)
    return (f"None that can be told from noise (p = {size}; {chi2}).", alarm)


def _where(d: Diagnosis) -> tuple[str, ...]:
    if d.posterior.verdict == ():
        return ()
    z = np.where(d.outlier_chance > 0.5, 0.0, d.recorded.mismatch_z)
    inside = np.ones(z.size, bool)
    for cut in d.region.where:
        column = d.recorded.table[cut["column"]]
        inside &= (
            np.isin(column, cut["values"]) if "values" in cut else (column >= cut["low"]) & (column <= cut["high"])
        )
    place = ", ".join(range_text(cut) for cut in d.region.where) or "everywhere"
    part = missing(d)[1] / np.maximum(np.abs(d.recorded.predicted), 1e-300)
    share = float(np.median(np.abs(part[inside])))
    sign = "more" if np.sum(z[inside]) > 0 else "less"
    said = [
        f"Above all at {place}: there the rig reads {sign} than the model without it, by {_rms(z[inside]):.1f} sigma "
        f"(rms), {number(100 * share)} % of the reading in the median."
        if d.region.where
        else f"Everywhere: the rig reads {sign} than the model without it, by {_rms(z):.1f} sigma (rms), "
        f"{number(100 * share)} % of the reading in the median."
    ]
    if (~inside).any():
        said.append(f"Elsewhere {_rms(z[~inside]):.1f} sigma.")
    most = int(np.argmax(np.abs(z)))
    said.append(
        f"Largest at run {int(d.recorded.table['run'][most])} ({reading_conditions(d, most)}): {z[most]:+.1f} sigma."
    )
    return tuple(said)


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0


def _left_out(d: Diagnosis) -> tuple[tuple[str, ...], tuple[tuple[str, ...], ...]]:
    if isinstance(d.posterior.verdict, str) or d.posterior.verdict == ():
        return (), ()
    inclusion = d.posterior.inclusion(d.found)
    sentences: list[str] = []
    table = [("effect", "parameter", "value", "90 % interval", "unit", "meaning")]
    for e, record in zip(effects_of(d.posterior.verdict), effect_records(d), strict=True):
        sentences += [
            f"{effect_words(e.id).capitalize()}, probability {chance(inclusion[e.id])}, in {STAGE_WORDS[e.stage]}: "
            f"{e.summary}",
            equation_sentence(e),
            f"Source: {e.source}",
            f"To make sure: {e.separated_by}.",
        ]
        if is_free(e):
            continue
        for p, fitted in zip(e.parameters, record["parameters"], strict=True):
            span = f"{number(fitted['low90'])} to {number(fitted['high90'])}"
            name = with_symbol(p.name, plain_equation(p.symbol))
            table.append((effect_words(e.id), name, number(fitted["value"]), span, p.unit, p.meaning))
    return tuple(sentences), tuple(table) if len(table) > 1 else ()


def equation_sentence(e: Effect) -> str:
    """The equation of an effect as a sentence of the text."""
    return f"Equation: {plain_equation(e.equation)}"


def _unnamed(d: Diagnosis, unnamed: Unnamed) -> Section:
    law = unnamed.law
    shape = d.found.unknown.best
    along = " and ".join(words_of(name) for name in shape.axes) or "all conditions together"
    said = [f"It varies smoothly with {along}, as {_carried(shape.carrier)}."]
    if unnamed.stages:
        best, *others = unnamed.stages
        said.append(
            f"A smooth free factor on {words_of(best.quantity)}{_stage(best)} absorbs it best"
            + "".join(f"; on {words_of(o.quantity)} {best.evidence - o.evidence:.1f} nats worse" for o in others[:3])
            + "."
        )
    if law is None:
        said.append(
            "No simple law: no power law of conditions or film quantities predicts levels it was not fitted to."
        )
    else:
        said.append(
            f"Shortest form found, empirical (a description, not physics): {law.text}. On whole levels left out "
            f"the error falls from {law.heldout_before:.2f} to {law.heldout_after:.2f} sigma."
        )
    return Section(UNNAMED, tuple(said))


def _carried(carrier: str) -> str:
    outside = {READING: "a share of the reading", NOTHING: "an addition to it"}
    return outside.get(carrier, f"a factor on {words_of(carrier)}")


def _stage(found: Absorbed) -> str:
    stage = STAGE_WORDS[found.stage]
    return "" if stage == words_of(found.quantity) else f" ({stage})"


def _ties(d: Diagnosis, alike: Confusion) -> tuple[str, ...]:
    judged = d.posterior
    said = []
    if len(judged.tied) > 1:
        names = tuple(dict.fromkeys(name for k in judged.tied if not isinstance(k, str) for name in k))
        tests = [f"{effect_words(e.id)}: {e.separated_by}" for e in effects_of(names)]
        if tests:
            said.append(f"To separate them: {'; '.join(tests)}.")
    if not isinstance(judged.verdict, str):
        for name in judged.verdict:
            i = alike.ids.index(name)
            near = [
                f"{effect_words(other)} ({alike.cosine[i, j]:.2f})"
                for j, other in sorted(enumerate(alike.ids), key=lambda item: -alike.cosine[i, item[0]])
                if other not in judged.verdict and alike.cosine[i, j] > 0.8
            ]
            if near:
                said.append(
                    f"Its signature at these conditions is nearest to that of {', '.join(near[:3])} "
                    f"(1 would be the same; {effect_words(name)})."
                )
    unseen = unshown(d, alike)
    rejected = [name for name in _rejected(d) if name not in unseen]
    if rejected:
        said.append(
            f"Weighed and rejected (probability below 0.01 each): {', '.join(effect_words(name) for name in rejected)}."
        )
    if unseen:
        said.append(
            "Not testable here (below 3 sigma at usual strength once calibration adapts), so neither named nor "
            f"excluded: {', '.join(effect_words(name) for name in unseen)}."
        )
    return tuple(said)


def unshown(d: Diagnosis, alike: Confusion) -> list[str]:
    """Effects outside the tied explanations that these readings would not show at usual strength."""
    told = {name for key in d.posterior.tied if not isinstance(key, str) for name in key}
    return [name for name in alike.unseen() if name not in told]


def _rejected(d: Diagnosis) -> list[str]:
    """Improbable effects on the very quantities that the answer changes."""
    if isinstance(d.posterior.verdict, str):
        return []
    changed = {quantity for e in effects_of(d.posterior.verdict) for quantity in e.acts_on} - {"reading"}
    weighed = {name: p for name, p in d.posterior.inclusion(d.found).items() if name not in ("none", "unknown")}
    return [e.id for e in effects_of(tuple(weighed)) if weighed[e.id] < 0.01 and changed & set(e.acts_on)]


def _gain(d: Diagnosis) -> tuple[str, ...]:
    kept = d.heldout
    split = kept.split
    for axis in d.found.space.axes:
        split = split.replace(axis.name, words_of(axis.name))
    how = f"({split}, {kept.folds} folds; 1 is noise)"
    if d.posterior.verdict == ():
        return (f"Calibration alone predicts left-out levels to {kept.before:.2f} sigma {how}.",)
    change = f"from {kept.before:.2f} sigma with calibration alone to {kept.after:.2f} sigma with the answer {how}."
    if kept.after > 0.95 * kept.before:
        return (f"Not better: {change} Do not extrapolate it.", REFITTED)
    return (change.capitalize(), REFITTED)


def _calibration(d: Diagnosis) -> tuple[tuple[str, ...], tuple[tuple[str, ...], ...]]:
    if not d.found.problem.forward.calibrations:
        return ("The case lets calibration move nothing.",), ()
    z, spread = _calibrated(d)
    table = [("input", "stated", "moved to", "90 % interval", "from the middle of its range")]
    strained = []
    for i, c in enumerate(d.found.problem.forward.calibrations):
        value, low, high = interval(c.parameter.prior, z[i], spread[i])
        table.append(
            (
                c.name.replace("_", " "),
                number(c.nominal),
                number(value),
                f"{number(low)} to {number(high)}",
                f"{z[i]:+.1f} sd",
            )
        )
        if abs(z[i]) > STRAINED:
            strained.append(c.name.replace("_", " "))
    said = [f"Strained: {', '.join(strained)} more than {STRAINED:g} sd from what was stated."] if strained else []
    return tuple(said), tuple(table)


def _calibrated(d: Diagnosis) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates of the calibration under the verdict, and their sd."""
    if d.posterior.verdict == "unknown":
        return d.found.unknown.z, np.sqrt(np.diag(d.found.unknown.covariance))
    refined = verdict_fit(d)
    return refined.z, np.sqrt(np.diag(refined.covariance))
