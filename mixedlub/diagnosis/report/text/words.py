"""Sections of the report: the same sentences for the text file and the HTML page."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from mixedlub.case.missing_part import FILE
from mixedlub.chain.effect import Effect
from mixedlub.chain.plain_text import plain_equation
from mixedlub.diagnosis.assessment.campaign import Campaign
from mixedlub.diagnosis.assessment.identifiability import confusion
from mixedlub.diagnosis.assessment.power_law import Absorbed, DescribedDiscrepancy
from mixedlub.diagnosis.diagnose import CALIBRATION as BASE_ALONE
from mixedlub.diagnosis.diagnose import LAW, TABLE, Diagnosis
from mixedlub.diagnosis.discovery.files import FILE as LAW_FILE
from mixedlub.diagnosis.discrepancy.modulated import ADDITIVE, READING
from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.diagnosis.labels import (
    STAGE_WORDS,
    effect_words,
    explanation_words,
    in_units_of_case,
    number,
    with_names,
    words_of,
)
from mixedlub.diagnosis.report.text.alternatives import AS_IF_NOTHING, alternatives
from mixedlub.diagnosis.report.text.found_law import found_law
from mixedlub.diagnosis.report.text.headline import (
    chance,
    doubts,
    headline,
    lesser,
    p_words,
    probabilities,
    probability_words,
)
from mixedlub.diagnosis.report.text.hypotheses import hypotheses
from mixedlub.diagnosis.report.text.location_text import where
from mixedlub.diagnosis.report.text.nearest_effect import nearest_name
from mixedlub.diagnosis.report.text.next_test_text import box_place, local_position, next_test, wave_period
from mixedlub.diagnosis.report.text.outlier_text import checked_channel, outliers, shrunk_noise
from mixedlub.diagnosis.report.text.past_text import past_words
from mixedlub.diagnosis.report.text.tables import calibration, parameters
from mixedlub.diagnosis.settings.inference import STRONG_EVIDENCE
from mixedlub.diagnosis.settings.report import MOST_SIMILAR, NOT_BETTER
from mixedlub.study.plan import counted

WIDTH = 80
REFITTED = "Parameters were refitted without each level; the answer itself was selected with all levels."
ANSWER = "Answer"
CHANGED = "What did the added readings change?"
MISMATCH = "Is there a mismatch beyond noise and calibration?"
WHERE = "Where?"
LEFT_OUT = "What was left out?"
BEST_TIED = "What was left out? Best of the tied candidates"
UNNAMED = "If it is something unknown"
ALIKE = "What else could it be?"
OWN = "Your hypotheses"
GAIN = "How much better is it on conditions it did not fit?"
NATS = (
    f"A nat is a factor 2.7 in the odds: below about {STRONG_EVIDENCE:g} nats these readings do not distinguish the "
    "quantities, and the two answers may name different ones."
)
CHECK = "Does a channel that was not fitted agree?"
OUTLIERS = "Outlier readings"
CALIBRATION = "What calibration was moved to"
IMPROVED = "Improved model"
NEXT = "Next test"


@dataclass(frozen=True)
class Section:
    """A section of the report: question, answering sentences, and a table with a header row.

    ``heading`` replaces a misleading title, ``alarms`` precede the first sentence, and ``items`` are a list after the
    last.
    """

    title: str
    sentences: tuple[str, ...]
    table: tuple[tuple[str, ...], ...] = ()
    heading: str = ""
    alarms: tuple[str, ...] = ()
    items: tuple[str, ...] = ()


@in_units_of_case
def sections(d: Diagnosis, unnamed: DescribedDiscrepancy | None = None) -> list[Section]:
    """All sections of the answer with content."""
    resemblance, separating = alternatives(d, confusion(d.search))
    parts = [
        Section(ANSWER, (headline(d), *probabilities(d)), alarms=doubts(d)),
        *([] if d.campaign is None else [_changed(d.campaign)]),
        Section(MISMATCH, (*_mismatch(d), *shrunk_noise(d))),
        Section(WHERE, where(d)),
        _left_out(d),
        *([_discrepancy(d, unnamed)] if unnamed is not None else []),
        Section(OWN, *hypotheses(d)),
        Section(ALIKE, resemblance, items=separating),
        Section(GAIN, _gain(d)),
        Section(CHECK, checked_channel(d)),
        Section(OUTLIERS, *outliers(d)),
        Section(CALIBRATION, *calibration(d)),
        Section(IMPROVED, _improved(d)),
        Section(NEXT, next_test(d)),
        Section("Warnings", lesser(d)),
    ]
    return [s for s in parts if s.sentences or s.table or s.items]


def _changed(campaign: Campaign) -> Section:
    """The answers before and after the added readings, side by side."""
    runs = f"run {campaign.runs[0]}" + (f" to {campaign.runs[-1]}" if len(campaign.runs) > 1 else "")
    then, now = campaign.before, campaign.after
    sentence = (
        f"{counted(len(campaign.runs), 'reading')} ({runs}) told {campaign.realised_bits:.2f} bit about the "
        f"explanation, where {campaign.expected_bits:.2f} bit was expected on average."
    )
    table = [("explanation", "before", "after")]
    for ids, after in sorted(now.explanations.items(), key=lambda item: -item[1]):
        before = then.explanations.get(ids)
        table.append((explanation_words(ids), "not listed" if before is None else chance(before), chance(after)))
    return Section(CHANGED, (sentence,), tuple(table))


def as_text(title: str, parts: Iterable[Section]) -> str:
    """Sections as plain text, wrapped."""
    lines = [title, "=" * len(title)]
    for part in parts:
        lines += ["", (part.heading or part.title).upper()]
        for sentence in (*part.alarms, *part.sentences):
            lines += _wrapped(sentence, "  ") or [""]
        for item in part.items:
            lines += _wrapped(item, "  - ")
        if part.table:
            lines += _aligned(part.table)
    return "\n".join(lines) + "\n"


def _aligned(table: Sequence[Sequence[str]]) -> list[str]:
    """Rows of a table in columns; the last column is wrapped beside or below the others, whichever is shorter.

    >>> _aligned([("input", "meaning"), ("roughness", "factor on Rq")])
    ['    input      meaning', '    roughness  factor on Rq']
    """
    widths = [max(map(len, cells)) for cells in zip(*table, strict=True)][:-1]
    margin = 4 + sum(width + 2 for width in widths)
    starts = ["    " + "".join(cell.ljust(width + 2) for cell, width in zip(row, widths)) for row in table]
    below = [starts[0].rstrip()]
    for start, row in zip(starts[1:], table[1:], strict=True):
        below += [start.rstrip(), *_wrapped(row[-1], 8 * " ")]
    if WIDTH - margin < max(len(word) for row in table for word in row[-1].split() or [""]):
        return below
    beside = []
    for start, row in zip(starts, table, strict=True):
        first, *rest = _wrapped(row[-1], margin * " ") or [""]
        beside += [(start + first[margin:]).rstrip(), *rest]
    return min(beside, below, key=len)


def _wrapped(text: str, start: str) -> list[str]:
    return textwrap.wrap(text, WIDTH, initial_indent=start, subsequent_indent=" " * len(start), break_long_words=False)


def _mismatch(d: Diagnosis) -> tuple[str, ...]:
    test = d.test
    alarm = (
        "The test examines whether residuals follow the conditions or the form of an effect, not only chi-square. "
        f"It is wrong in {100 * test.level:g} % of the cases in which nothing is missing."
    )
    counted = d.counted
    squares = d.search.problem.single_reading_units(d.search.null_fit.residual) ** 2
    strain = float(d.search.null_fit.z @ d.search.null_fit.z)
    exclusion = "" if counted.all() else ", outliers left out"
    squared = number(float(squares[counted].sum()) + strain)
    chi2 = f"chi-square {squared} for {int(counted.sum())} readings after calibration{exclusion}{_noise(d)}"
    size = p_words(test.p_value)
    size = f"p {size}" if size[0].isalpha() else f"p = {size}"
    if test.noise_adapted:
        size += (
            " even with the autocorrelation that this would need" if d.noise_stated else ", with the noise estimated"
        )
    if test.detected:
        return (f"Yes ({size}; {chi2}).", alarm)
    return (f"None distinguishable from noise ({size}; {chi2}).", alarm)


def _noise(d: Diagnosis) -> str:
    """Clause on the noise estimate behind a chi-square; empty if the recording states the noise."""
    if d.noise_stated:
        return ""
    condition = AS_IF_NOTHING if d.posterior.verdict == NOTHING else "together with the missing part"
    return f"; the noise was estimated {condition}"


def _left_out(d: Diagnosis) -> Section:
    posterior = d.posterior
    if not posterior.verdict.effects:
        return Section(LEFT_OUT, ())
    sentences: list[str] = []
    for e in d.search.problem.effects_of(posterior.verdict.effects):
        sentences += [
            f"{with_names(effect_words(e.id))}, {probability_words(d, e.id)}, in {STAGE_WORDS[e.stage]}: {e.summary}",
            equation_sentence(e),
            f"Source: {e.source}",
            *(c.text for c in d.contained if c.effect == e.id),
            f"To make sure: {e.separated_by}.",
        ]
    notes, table = parameters(d)
    return Section(LEFT_OUT, (*sentences, *notes), table, heading=BEST_TIED if len(posterior.tied) > 1 else "")


def equation_sentence(e: Effect) -> str:
    """The equation of an effect as a sentence."""
    return f"Equation: {plain_equation(e.equation)}"


def _discrepancy(d: Diagnosis, discrepancy: DescribedDiscrepancy) -> Section:
    law = discrepancy.law
    shape = d.search.discrepancy.best
    along = " and ".join(words_of(name) for name in shape.axes) or "all conditions together"
    sentences = [f"Of all forms tried, the most probable {_form(d, along)}."]
    laws = d.search.discrepancy.base.explanation
    if laws != NOTHING:
        sentences.append(f"It adds to a model in which another published law fits: {explanation_words(laws.ids)}.")
    sentences += nearest_name(d)
    if discrepancy.stages and not distinguishable(discrepancy.stages):
        equal = [words_of(absorbed.quantity) for absorbed in discrepancy.stages]
        sentences.append(
            "These readings do not show which quantity could take it up if a factor there were free to vary with every "
            f"condition: {', '.join(equal[:-1])} and {equal[-1]} do so equally well."
        )
    elif discrepancy.stages:
        best, *others = discrepancy.stages
        worse = [f"{words_of(o.quantity)} {best.evidence - o.evidence:.1f} nats worse" for o in others[:MOST_SIMILAR]]
        sentences.append(
            "Another question is which quantity could take it up if a factor there were free to vary with every "
            f"condition: best {words_of(best.quantity)}{_stage(best)}{'; ' if worse else ''}{'; '.join(worse)}."
        )
        if worse:
            sentences.append(NATS)
    if law is None and d.law is None:
        sentences.append(
            "No simple law: no power law of conditions or film quantities predicts levels it was not fitted to."
        )
    elif law is not None:
        sentences.append(
            f"Shortest form found, empirical (a description, not physics): {law.text}. On whole levels left out, of "
            f"one condition after another, the error falls from {law.heldout_before:.2f} to {law.heldout_after:.2f} "
            "sigma."
        )
    return Section(UNNAMED, (*sentences, *found_law(d)))


def distinguishable(stages: Sequence[Absorbed]) -> bool:
    """Whether the readings distinguish the quantities that could take up a mismatch.

    >>> distinguishable([Absorbed("boundary", "boundary_friction", 90.0), Absorbed("boundary", "friction", 89.9)])
    False
    """
    ranked = [absorbed.evidence for absorbed in stages]
    return len(ranked) == 1 or max(ranked, default=0.0) - min(ranked, default=0.0) >= STRONG_EVIDENCE


def _form(d: Diagnosis, along: str) -> str:
    """The most probable form of the discrepancy, as a predicate."""
    shape = d.search.discrepancy.best
    if shape.form == "delay":
        return "follows the temperature of the previous reading: oil or parts had not reached the recorded one"
    if shape.form == "history":
        return f"{past_words(d)}, as {_carried(shape.modulates)}"
    if shape.form == "box":
        return f"is a shift where {box_place(d)}, as {_carried(shape.modulates)}"
    if shape.form == "smooth":
        named = [d.search.space.axes[d.search.space.place(name)].named for name in shape.axes]
        how = "varies smoothly with" if not any(named) else "differs between" if all(named) else "varies with"
        return f"{how} {along}, as {_carried(shape.modulates)}"
    if shape.form == "wave":
        return f"is a wave with a period of {wave_period(d)} in {along}"
    return f"is a {shape.form} at {local_position(d)}, as {_carried(shape.modulates)}"


def _carried(modulated: str) -> str:
    outside = {READING: "a share of the reading", ADDITIVE: "an addition to the reading"}
    return outside.get(modulated, f"a factor on {words_of(modulated)}")


def _stage(absorbed: Absorbed) -> str:
    stage = STAGE_WORDS[absorbed.stage]
    return "" if stage == words_of(absorbed.quantity) else f" ({stage})"


def _improved(d: Diagnosis) -> tuple[str, ...]:
    """Instruction to run the improved model at other conditions."""
    run = "mixedlub simulate runs it, at other conditions with --at."
    if d.handed_on == TABLE:
        error = d.tabulated.rms_error
        return (
            "The folder improved is the calibrated base model with a table of the missing part, which has no law: "
            f"{FILE}, with its standard deviation. {run} At the recorded conditions it follows the predictions to "
            f"{error:.2g} sigma (rms). It holds inside the recorded range only. Rows outside say so in their column "
            "validity; they keep the value at the end of the range, as a jump there would be an invention, and rows "
            "with surfaces that were not recorded have the calibrated base model.",
        )
    if d.handed_on == LAW:
        return (
            f"The folder improved is the case with the law found, {LAW_FILE}, at its most probable parameters. {run} "
            "It is empirical: outside the range of the file, the column validity says so.",
        )
    if d.handed_on == BASE_ALONE:
        return (f"The folder improved is the calibrated base model alone. {run}",)
    return (
        "The folder improved is a case with the most probable parameters and calibration of this answer alone: no "
        f"average over explanations, no error of form. {run}",
    )


def _gain(d: Diagnosis) -> tuple[str, ...]:
    heldout = d.heldout
    split = heldout.split
    for axis in d.search.space.axes:
        split = split.replace(axis.name, words_of(axis.name))
    how = f"({split}, {heldout.folds} folds; 1 is noise)"
    if d.posterior.verdict == NOTHING:
        return (f"Calibration alone predicts left-out levels to {heldout.before:.2f} sigma {how}.",)
    change = (
        f"from {heldout.before:.2f} sigma with calibration alone to {heldout.after:.2f} sigma with the answer {how}."
    )
    if heldout.after > NOT_BETTER * heldout.before:
        return (f"Not better: {change} Do not extrapolate it.", REFITTED)
    return (f"{change[:1].upper()}{change[1:]}", REFITTED)
