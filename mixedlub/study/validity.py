"""Number of conditions outside the validity range of the laws."""

from __future__ import annotations

import numpy as np

from mixedlub.schema.findings import Finding, finding
from mixedlub.study.results import Results
from roughness.mccool import nayak_parameter


def out_of_range(results: Results) -> tuple[Finding, ...]:
    """Findings on conditions outside the validity range of the laws; empty where all are within."""
    return (*_load_balance(results), *_clipped(results), *_bandwidth(results))


def _load_balance(results: Results) -> list[Finding]:
    ratio = results["asperity_load_ratio"]
    count = int((ratio > 1).sum())
    if not count:
        return []
    text = (
        f"{count} of {ratio.size} conditions ({_pairings(results, ratio > 1)}) are outside the model's range: elastic "
        f"asperities would carry up to {ratio.max():.3g} times the mean Hertz pressure, so the boundary area ratio and "
        "the loss of these conditions are not quantitative"
    )
    return [finding("asperities_overloaded", text)]


def _clipped(results: Results) -> list[Finding]:
    full = results["largest_area_ratio"] >= 1.0
    if not full.any():
        return []
    count = f"in {int(full.sum())} of {full.size} conditions ({_pairings(results, full)})"
    return [finding("area_ratio_limited", f"{count} the boundary area ratio was limited to 1")]


def _bandwidth(results: Results) -> list[Finding]:
    moments = [np.asarray(results.study.plan.inputs[name]).ravel() for name in ("m0", "m2", "m4")]
    with np.errstate(divide="ignore", over="ignore"):
        low = nayak_parameter(*moments) < 1.5
    if not low.any():
        return []
    text = (
        f"{int(low.sum())} of {low.size} pairings have a Nayak bandwidth below 1.5, which no isotropic Gaussian "
        "surface has; 1.5 was used"
    )
    return [finding("bandwidth_limited", text)]


def _pairings(results: Results, flagged: np.ndarray) -> str:
    which = np.flatnonzero(flagged.any(axis=(1, 2, 3)))
    count = len(results.study.pairings)
    if which.size == count:
        return "all pairings"
    return f"{which.size} of {count} pairings"
