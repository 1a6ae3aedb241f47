"""Verdict in a few sentences, with the findings that question it."""

from __future__ import annotations

from mixedlub.data_checks.audit import SCARCE
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.diagnosis.labels import STAGE_WORDS, effect_words, enumerated, explanation_words, with_names
from mixedlub.diagnosis.settings.inference import LIKELY
from mixedlub.diagnosis.settings.report import LEAST_P, MOST_TIED, STAGE_SHOWN
from mixedlub.schema.findings import Severity, codes, grouped, of_severity

NO_ANSWER = (
    "No answer: every reading counts as wrong under every explanation. Check first the units and scales of all "
    "columns; the rest of this report says nothing about the rig."
)


def chance(p: float) -> str:
    """Printed probability, never 0 or 1.

    >>> chance(0.853), chance(0.9999), chance(0.001)
    ('0.85', 'above 0.99', 'below 0.01')
    """
    share = hundredths(p)
    return "above 0.99" if share > 99 else "below 0.01" if share < 1 else f"{share / 100:.2f}"


def percent(p: float) -> str:
    """Printed probability in percent, never 0 or 100.

    >>> percent(0.853), percent(0.9999), percent(0.001)
    ('85 %', '>99 %', '<1 %')
    """
    share = hundredths(p)
    return ">99 %" if share > 99 else "<1 %" if share < 1 else f"{share} %"


def hundredths(p: float) -> int:
    """Probability in hundredths, rounded alike in all texts.

    >>> [hundredths(p) for p in (0.0049, 0.0055, 0.9945, 0.9951)]
    [0, 1, 99, 100]
    """
    return round(100.0 * p)


def p_words(p: float) -> str:
    """Printed p-value of the mismatch test.

    >>> p_words(0.0042), p_words(1e-304)
    ('0.0042', 'below 1e-300')
    """
    return f"{p:.2g}" if p > LEAST_P else f"below {LEAST_P:.0e}"


def doubts(d: Diagnosis) -> tuple[str, ...]:
    """Findings that question the whole answer, printed above it."""
    return tuple(f"Doubtful: {one}." for one in grouped(of_severity(d.warnings, Severity.DOUBT)))


def lesser(d: Diagnosis) -> tuple[str, ...]:
    """The other findings, cautions first."""
    others = (of_severity(d.warnings, severity) for severity in (Severity.CAUTION, Severity.NOTE))
    return tuple(str(one) for findings in others for one in grouped(findings))


def headline(d: Diagnosis) -> str:
    """Verdict in one sentence, after a warning about few, contradictory or only outlying readings."""
    count = d.readings.size
    sentence = _verdict(d)
    if d.posterior.verdict.is_discrepancy and "repeats_contradictory" in codes(d.warnings):
        sentence = f"Readings at equal conditions contradict each other: check instrument and set-up first. {sentence}"
    if count < SCARCE:
        sentence = f"Only {count} readings: take this as a hint, not as a finding. {sentence}"
    return f"{NO_ANSWER} {sentence}" if (d.outlier_chance > LIKELY).all() else sentence


def _verdict(d: Diagnosis) -> str:
    posterior = d.posterior
    common = _common(d)
    if common:
        return _tie_with_common(d, common)
    if len(posterior.tied) > 1:
        named = [f"{explanation_words(k.ids)} ({chance(posterior.weights[k])})" for k in posterior.tied[:MOST_TIED]]
        rest = _rest(d)
        if posterior.verdict == NOTHING:
            others = _listed([*named[1:], *rest], "or")
            return (
                f"No mismatch beyond noise: nothing needs to be missing ({chance(posterior.weights[NOTHING])}). A tie "
                f"all the same: these readings do not exclude {others}."
            )
        return f"A tie. Most probable: {named[0]}. Not excluded: {'; '.join([*named[1:], *rest])}."
    p = chance(posterior.weights[posterior.verdict])
    if posterior.verdict == NOTHING:
        return f"Nothing is missing that these readings could show: the calibrated model explains them ({p})."
    if posterior.verdict.is_discrepancy:
        count = len(d.excluded)
        which = f"of those weighed explains ({count} left out on request)" if count else "of the catalogue explains"
        return f"Something is missing that no one effect {which}, nor any two tried together (probability {p})."
    effects = d.search.problem.effects_of(posterior.verdict.effects)
    free = [effect_words(e.id) for e in effects if e.descriptive]
    physics = [effect_words(e.id) for e in effects if e.stage != "measurement" and not e.replaces and not e.descriptive]
    laws = [effect_words(e.id) for e in effects if e.replaces]
    faults = [effect_words(e.id) for e in effects if e.stage == "measurement"]
    if not physics and not free and not laws:
        return f"No physics is missing; the instrument is at fault: {' and '.join(faults)} (probability {p})."
    parts = [f"Missing physics: {' and '.join(physics)}"] if physics else []
    if free:
        parts.append(f"{'a' if parts else 'A'} change of free form, its cause not named: {' and '.join(free)}")
    if laws:
        start = "another published law" if parts else "No physics is missing, but another published law"
        parts.append(f"{start} fits in place of that of the base model: {' and '.join(laws)}")
    if faults:
        parts.append(f"a fault of the instrument: {' and '.join(faults)}")
    return f"{'; and '.join(parts)} (probability {p})."


def _rest(d: Diagnosis) -> list[str]:
    """Count of the tied explanations beyond MOST_TIED, as an item of the list."""
    more = len(d.posterior.tied) - MOST_TIED
    return [f"{more} less probable one{'s' if more > 1 else ''}"] if more > 0 else []


def _common(d: Diagnosis) -> list[str]:
    """Effects common to all of several tied explanations."""
    named = [set(k.effects) for k in d.posterior.tied if not k.is_discrepancy]
    return sorted(set.intersection(*named)) if len(named) == len(d.posterior.tied) > 1 else []


def _tie_with_common(d: Diagnosis, common: list[str]) -> str:
    """Tie of explanations that share some effects."""
    posterior, inclusion = d.posterior, d.posterior.inclusion(d.search)
    shared = enumerated([f"{effect_words(name)} ({chance(inclusion[name])})" for name in common])
    each = []
    for key in posterior.tied[:MOST_TIED]:
        others = [name for name in key.ids if name not in common]
        p = chance(posterior.weights[key])
        each.append(f"{explanation_words(others) if others else 'nothing else'} ({p})")
    return f"In every explanation left: {shared}. A tie in what acts as well: {'; '.join([*each, *_rest(d)])}."


def _listed(items: list[str], last: str) -> str:
    """Items with semicolons, the last one joined by a word.

    >>> _listed(["a", "b and c", "d"], "or")
    'a; b and c; or d'
    """
    return items[0] if len(items) == 1 else f"{'; '.join(items[:-1])}; {last} {items[-1]}"


def probabilities(d: Diagnosis) -> list[str]:
    """Probabilities of the answer's effects, and of the steps of the model at fault."""
    posterior = d.posterior
    sentences = _each(d, set(_common(d)))
    stages = {name: p for name, p in posterior.stages(d.search).items() if p >= STAGE_SHOWN}
    if posterior.verdict != NOTHING and stages:
        ranked = sorted(stages.items(), key=lambda item: -item[1])
        sentences.append(
            "Step of the model at fault: " + ", ".join(f"{STAGE_WORDS[s]} ({chance(p)})" for s, p in ranked) + "."
        )
    return sentences


def _each(d: Diagnosis, named: set[str]) -> list[str]:
    """Probability of each effect over all explanations, if printed differently from the answer's probability."""
    posterior = d.posterior
    inclusion, answer = posterior.inclusion(d.search), chance(posterior.weights[posterior.verdict])
    names = [name for name in posterior.verdict.effects if name not in named and chance(inclusion[name]) != answer]
    if not names:
        return []
    return [f"{with_names(effect_words(name))}: {probability_words(d, name)}." for name in names]


def probability_words(d: Diagnosis, name: str) -> str:
    """Probability of an effect of the verdict, alone and together with others."""
    key = d.posterior.verdict
    answer, overall = chance(d.posterior.weights[key]), chance(d.posterior.inclusion(d.search)[name])
    if answer == overall:
        return f"probability {overall}"
    if len(key.effects) == 1:
        return f"probability {answer} alone, {overall} alone or with a second effect"
    others = explanation_words([other for other in key.effects if other != name])
    return f"probability {answer} together with {others}, {overall} overall"
