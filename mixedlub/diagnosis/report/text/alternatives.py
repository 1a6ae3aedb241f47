"""Alternatives in words: similar, rejected and undetectable effects."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from mixedlub.diagnosis.assessment.identifiability import Confusion
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING
from mixedlub.diagnosis.labels import effect_words
from mixedlub.diagnosis.report.text.headline import chance
from mixedlub.diagnosis.report.text.nearest_effect import nearest
from mixedlub.diagnosis.settings.assessment import VISIBLE
from mixedlub.diagnosis.settings.report import MOST_SIMILAR, REJECTED, SAME_SIGNATURE, SIMILAR

AS_IF_NOTHING = "as if nothing were missing"
"""Condition of the noise estimate if no noise is stated and the verdict is nothing missing."""


HIDDEN = f"the noise was estimated {AS_IF_NOTHING}, and what is taken for noise may hide some of them"


def alternatives(d: Diagnosis, similarity: Confusion) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Sentences on the alternatives, and the tests that separate the tied effects."""
    sentences = _resemblance(d, similarity)
    names = dict.fromkeys(name for key in d.posterior.tied for name in key.effects)
    items = tuple(f"{effect_words(e.id)}: {e.separated_by}" for e in d.search.problem.effects_of(names))
    if len(d.posterior.tied) < 2 or not items:
        return sentences, ()
    return (*sentences, "To separate them:"), items


def _resemblance(d: Diagnosis, similarity: Confusion) -> tuple[str, ...]:
    posterior = d.posterior
    verdict = posterior.verdict.effects
    sentences, same_form = [], set()
    for name in verdict:
        i = similarity.ids.index(name)
        others = {
            other: float(similarity.cosine[i, j])
            for j, other in sorted(enumerate(similarity.ids), key=lambda item: -similarity.cosine[i, item[0]])
            if other not in verdict and similarity.cosine[i, j] > SIMILAR
        }
        same_form |= {other for other, cosine in others.items() if cosine > SAME_SIGNATURE}
        if others:
            listed = ", ".join(
                f"{effect_words(other)} ({cosine:.2f})" for other, cosine in list(others.items())[:MOST_SIMILAR]
            )
            sentences.append(
                f"At these conditions {effect_words(name)} looks most like {listed} (similarity of the signatures "
                "after recalibration, 1 = identical)."
            )
    # Effects named as the nearest to the discrepancy are visible here and not simply rejected.
    nearest_effects = nearest(d)
    named = () if nearest_effects is None else nearest_effects.explanation.effects
    undetectable = undetectable_effects(d, similarity)
    not_shown = [name for name in undetectable if name not in named]
    improbable = [name for name in _improbable(d) if name not in (*undetectable, *named)]
    inclusion = posterior.inclusion(d.search)
    open_still = _not_excluded(d, inclusion, (*undetectable, *named))
    if open_still:
        sentences.append(f"Less probable, not excluded: {', '.join(open_still)}.")
    rejected = ", ".join(effect_words(name) for name in improbable if name not in same_form)
    if rejected:
        why = "Weighed and rejected" if verdict or posterior.verdict.is_discrepancy else "Would show here, and did not"
        under = "" if verdict or posterior.verdict.is_discrepancy or d.noise_stated else f"; {HIDDEN}"
        sentences.append(f"{why} (probability below {REJECTED:g} each{under}): {rejected}.")
    same_signature = ", ".join(effect_words(name) for name in improbable if name in same_form)
    if same_signature:
        why = "Nearly the same signature, but they would need an implausible strength or calibration"
        sentences.append(f"{why}: {same_signature}.")
    if not_shown:
        sentences.append(
            f"This test cannot show them (below {VISIBLE:g} sigma at typical strength after recalibration), so they "
            f"are neither named nor excluded: {', '.join(_with_chance(name, inclusion) for name in not_shown)}."
        )
    return tuple(sentences)


def undetectable_effects(d: Diagnosis, similarity: Confusion) -> list[str]:
    """Effects outside the tied explanations that are undetectable in these readings at typical strength."""
    tied = {name for key in d.posterior.tied for name in key.effects}
    return [name for name in similarity.unseen() if name not in tied]


def _not_excluded(d: Diagnosis, inclusion: Mapping[str, float], named_elsewhere: Collection[str]) -> list[str]:
    """Explanations (also none and unknown) neither tied, rejected nor ``named_elsewhere``, with probability."""
    named = {name for key in d.posterior.tied for name in key.ids}
    names = [
        name for name, p in inclusion.items() if p >= REJECTED and name not in named and name not in named_elsewhere
    ]
    return [_with_chance(name, inclusion) for name in sorted(names, key=lambda n: -inclusion[n])]


def _with_chance(name: str, inclusion: Mapping[str, float]) -> str:
    """Name of an effect, with its probability unless rejected."""
    p = inclusion.get(name, 0.0)
    return f"{effect_words(name)} ({chance(p)})" if p >= REJECTED else effect_words(name)


def _improbable(d: Diagnosis) -> list[str]:
    """Improbable effects, except effects on the reading if there are outliers."""
    weighed = {
        name: p for name, p in d.posterior.inclusion(d.search).items() if name not in NOTHING.ids + DISCREPANCY.ids
    }
    faulty, every = bool(d.outlier_runs), d.search.problem.effects_of(weighed)
    return [e.id for e in every if weighed[e.id] < REJECTED and not (faulty and "reading" in e.acts_on)]
