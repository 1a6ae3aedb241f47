"""Which effects look alike at the recorded conditions, once calibration has taken its share."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.diagnosis.assessment.mismatch_test import judged_weight
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.map_fit import whitening
from mixedlub.diagnosis.search.search import Sampled, Search

WANTED = 3.0
"""Gain in log evidence from which an effect's fitted form is used rather than the middle of its prior."""
VISIBLE = 3.0
"""Sigmas from which an effect shows."""


@dataclass(frozen=True, eq=False)
class Confusion:
    """Cosines between the effects' signatures, and how visible each one is.

    ``cosine`` has shape (effects, effects): 1 means that these readings cannot tell the two apart, -1 that one
    is the other with the sign turned. ``visibility`` is the size in sigmas of what is left of an effect of
    usual strength when calibration has adapted to it; ``absorbed`` the share that calibration took.
    """

    ids: tuple[str, ...]
    cosine: np.ndarray
    visibility: np.ndarray
    absorbed: np.ndarray

    def unseen(self) -> tuple[str, ...]:
        """Effects that these readings would not show at their usual strength."""
        return tuple(name for name, size in zip(self.ids, self.visibility, strict=True) if size < VISIBLE)


def confusion(found: Search) -> Confusion:
    """Compare the effects' signatures at the recorded conditions under the base model's fit.

    A signature is the change of the readings in sigmas, as fitted where the recording asks for the effect,
    otherwise at the draw nearest the middle of its prior.
    """
    found = found.screened
    none = found.none
    columns = np.hstack([none.slopes, found.problem.shared])
    weight = judged_weight(found)
    left_over = whitening(columns, weight)

    ids, signatures, visibility, absorbed = [], [], [], []
    for sampled in (*found.sampled, *found.untestable):
        size = np.sqrt(np.maximum(np.einsum("ij,ij->i", sampled.change, left_over(sampled.change)), 0.0))
        raw = np.sqrt(np.einsum("ij,ij->i", sampled.change * weight, sampled.change))
        ids.append(sampled.id)
        visibility.append(float(np.median(size)))
        absorbed.append(1.0 - float(np.median(size)) / max(float(np.median(raw)), 1e-12))
        signatures.append(_signature(found, sampled))
    if not ids:
        return Confusion((), np.zeros((0, 0)), np.zeros(0), np.zeros(0))
    each = np.array(signatures)
    product = each @ left_over(each).T
    length = np.sqrt(np.maximum(np.diag(product), 1e-24))
    cosine = np.clip(product / length[:, None] / length[None, :], -1.0, 1.0)
    return Confusion(tuple(ids), cosine, np.array(visibility), np.array(absorbed))


def _signature(found: Search, sampled: Sampled) -> np.ndarray:
    fit = found.fits.get(Explanation.of(sampled.id))
    if fit is not None and fit.evidence > found.none.evidence + WANTED:
        return np.asarray((fit.prediction - found.problem.base(fit.z)) / found.problem.sd)
    middle = int(np.argmin(np.einsum("ij,ij->i", sampled.z, sampled.z)))
    return sampled.change[middle]
