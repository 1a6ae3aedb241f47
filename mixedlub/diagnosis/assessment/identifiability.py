"""Identifiability: effects with nearly the same signature at the recorded conditions after calibration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.diagnosis.assessment.mismatch_test import judged_weight
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.map_fit import whitening
from mixedlub.diagnosis.search.search import PriorDraws, Search
from mixedlub.diagnosis.settings.assessment import VISIBLE
from mixedlub.diagnosis.settings.inference import STRONG_EVIDENCE


@dataclass(frozen=True, eq=False)
class Confusion:
    """Cosines between the signatures of the effects, and their visibility.

    ``cosine`` has shape (effects, effects): 1 means that these readings cannot separate two effects, -1 that they
    cannot separate an effect from the negative of another. ``visibility`` is the median size of an effect in standard
    deviations after calibration; ``absorbed`` is the share removed by calibration.
    """

    ids: tuple[str, ...]
    cosine: np.ndarray
    visibility: np.ndarray
    absorbed: np.ndarray

    def unseen(self) -> tuple[str, ...]:
        """Effects that are not visible in these readings at a typical strength."""
        return tuple(name for name, size in zip(self.ids, self.visibility, strict=True) if size < VISIBLE)


def confusion(search: Search) -> Confusion:
    """Compare the effects' signatures at the recorded conditions under the base model's fit.

    A signature is the change of the readings in sigmas: as fitted if there is strong evidence for the effect, otherwise
    at the draw nearest the middle of its prior.
    """
    search = search.full_screen
    null_fit = search.null_fit
    columns = np.hstack([null_fit.slopes, search.problem.shared])
    weight = judged_weight(search)
    left_over = whitening(columns, weight)

    ids, signatures, visibility, absorbed = [], [], [], []
    for draws in (*search.draws, *search.untestable):
        size = np.sqrt(np.maximum(np.einsum("ij,ij->i", draws.change, left_over(draws.change)), 0.0))
        raw = np.sqrt(np.einsum("ij,ij->i", draws.change * weight, draws.change))
        ids.append(draws.id)
        visibility.append(float(np.median(size)))
        absorbed.append(1.0 - float(np.median(size)) / max(float(np.median(raw)), 1e-12))
        signatures.append(_signature(search, draws))
    if not ids:
        return Confusion((), np.zeros((0, 0)), np.zeros(0), np.zeros(0))
    each = np.array(signatures)
    product = each @ left_over(each).T
    length = np.sqrt(np.maximum(np.diag(product), 1e-24))
    cosine = np.clip(product / length[:, None] / length[None, :], -1.0, 1.0)
    return Confusion(tuple(ids), cosine, np.array(visibility), np.array(absorbed))


def _signature(search: Search, draws: PriorDraws) -> np.ndarray:
    fit = search.fits.get(Explanation.of(draws.id))
    if fit is not None and fit.evidence > search.null_fit.evidence + STRONG_EVIDENCE:
        return np.asarray((fit.prediction - search.problem.base(fit.z)) / search.problem.sd)
    middle = int(np.argmin(np.einsum("ij,ij->i", draws.z, draws.z)))
    return draws.change[middle]
