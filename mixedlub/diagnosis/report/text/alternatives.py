"""What else it could be, in words: look-alikes, what was rejected, what these readings cannot show."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from mixedlub.diagnosis.assessment.identifiability import VISIBLE, Confusion
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING
from mixedlub.diagnosis.labels import effect_words
from mixedlub.diagnosis.problem import effects_of
from mixedlub.diagnosis.report.text.headline import chance
from mixedlub.diagnosis.report.text.nearest_effect import nearest

NEAR, ALIKE = 0.8, 0.95
"""Cosine of two signatures from which they are near, and from which they have nearly the same form."""
REJECTED = 0.01
"""Probability below which an effect counts as rejected."""


AS_IF_NOTHING = "as if nothing were missing"
"""How the noise is estimated, where the recording states none and nothing is told to be missing."""


HIDDEN = f"the noise was estimated {AS_IF_NOTHING}, and what is taken for noise may hide some of them"


def resembling(d: Diagnosis, alike: Confusion) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Sentences, and the tests that separate what is tied."""
    said = _resemblance(d, alike)
    names = dict.fromkeys(name for key in d.posterior.tied for name in key.effects)
    items = tuple(f"{effect_words(e.id)}: {e.separated_by}" for e in effects_of(names))
    if len(d.posterior.tied) < 2 or not items:
        return said, ()
    return (*said, "To separate them:"), items


def _resemblance(d: Diagnosis, alike: Confusion) -> tuple[str, ...]:
    judged = d.posterior
    verdict = judged.verdict.effects
    said, twins = [], set()
    for name in verdict:
        i = alike.ids.index(name)
        others = {
            other: float(alike.cosine[i, j])
            for j, other in sorted(enumerate(alike.ids), key=lambda item: -alike.cosine[i, item[0]])
            if other not in verdict and alike.cosine[i, j] > NEAR
        }
        twins |= {other for other, cosine in others.items() if cosine > ALIKE}
        if others:
            listed = ", ".join(f"{effect_words(other)} ({cosine:.2f})" for other, cosine in list(others.items())[:3])
            said.append(
                f"At these conditions {effect_words(name)} looks most like {listed} (similarity of the signatures, 1 = "
                "identical)."
            )
    # What is told as the nearest to a mismatch without a name shows here and is not simply rejected.
    near = nearest(d)
    told = () if near is None else near.explanation.effects
    hidden = unshown(d, alike)
    unseen = [name for name in hidden if name not in told]
    improbable = [name for name in _improbable(d) if name not in (*hidden, *told)]
    every = judged.inclusion(d.search)
    open_still = _open_still(d, every, (*hidden, *told))
    if open_still:
        said.append(f"Less probable, not excluded: {', '.join(open_still)}.")
    rejected = ", ".join(effect_words(name) for name in improbable if name not in twins)
    if rejected:
        why = "Weighed and rejected" if verdict or judged.verdict.is_discrepancy else "Would show here, and did not"
        under = "" if verdict or judged.verdict.is_discrepancy or d.noise_stated else f"; {HIDDEN}"
        said.append(f"{why} (probability below {REJECTED:g} each{under}): {rejected}.")
    close = ", ".join(effect_words(name) for name in improbable if name in twins)
    if close:
        said.append(f"Nearly the same signature, but they would need an implausible strength or calibration: {close}.")
    if unseen:
        said.append(
            f"This test cannot show them (below {VISIBLE:g} sigma at usual strength after recalibration), so they are "
            f"neither named nor excluded: {', '.join(_with_chance(name, every) for name in unseen)}."
        )
    return tuple(said)


def unshown(d: Diagnosis, alike: Confusion) -> list[str]:
    """Effects outside the tied explanations that these readings would not show at usual strength."""
    told = {name for key in d.posterior.tied for name in key.effects}
    return [name for name in alike.unseen() if name not in told]


def _open_still(d: Diagnosis, every: Mapping[str, float], told: Collection[str]) -> list[str]:
    """What is neither in a tied explanation nor rejected nor told elsewhere, with its probability, most probable first.

    Nothing missing and the unnamed are among it.
    """
    named = {name for key in d.posterior.tied for name in key.ids}
    left = [name for name, p in every.items() if p >= REJECTED and name not in named and name not in told]
    return [_with_chance(name, every) for name in sorted(left, key=lambda n: -every[n])]


def _with_chance(name: str, every: Mapping[str, float]) -> str:
    """An effect with its probability among those of all, where that is not small enough to be rejected."""
    p = every.get(name, 0.0)
    return f"{effect_words(name)} ({chance(p)})" if p >= REJECTED else effect_words(name)


def _improbable(d: Diagnosis) -> list[str]:
    """Improbable effects; faults of the channel are none of them where single readings have one."""
    weighed = {
        name: p for name, p in d.posterior.inclusion(d.search).items() if name not in NOTHING.ids + DISCREPANCY.ids
    }
    faulty = bool(d.outlier_runs)
    return [e.id for e in effects_of(weighed) if weighed[e.id] < REJECTED and not (faulty and "reading" in e.acts_on)]
