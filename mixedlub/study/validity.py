"""Where the theory was asked for more than it can give: counted, and said with the result."""

from __future__ import annotations

import numpy as np

from mixedlub.study.results import Results
from roughness.mccool import nayak_parameter


def out_of_range(results: Results) -> tuple[str, ...]:
    """Sentences about conditions outside the range of the laws; empty when there are none."""
    return tuple(text for text in (_load_balance(results), _clipped(results), _bandwidth(results)) if text)


def _load_balance(results: Results) -> str:
    ratio = results["asperity_load_ratio"]
    count = int((ratio > 1).sum())
    if not count:
        return ""
    return (
        f"in {count} of {ratio.size} conditions ({_pairings(results, ratio > 1)}) elastic asperities at the film's gap "
        f"would carry more than the Hertz pressure, up to {ratio.max():.3g} times its mean: the film does not give "
        "way in this model, so the area ratio is there a geometric overlap, not an equilibrium"
    )


def _clipped(results: Results) -> str:
    full = results["largest_area_ratio"] >= 1.0
    if not full.any():
        return ""
    count = f"in {int(full.sum())} of {full.size} conditions ({_pairings(results, full)})"
    return f"{count} the boundary area ratio was held at 1"


def _bandwidth(results: Results) -> str:
    moments = [np.asarray(results.study.plan.inputs[name]).ravel() for name in ("m0", "m2", "m4")]
    with np.errstate(divide="ignore", over="ignore"):
        low = nayak_parameter(*moments) < 1.5
    if not low.any():
        return ""
    return (
        f"{int(low.sum())} of {low.size} pairings have a Nayak bandwidth below 1.5, which no isotropic Gaussian "
        "surface has; it was held at 1.5"
    )


def _pairings(results: Results, flagged: np.ndarray) -> str:
    which = np.flatnonzero(flagged.any(axis=(1, 2, 3)))
    count = len(results.study.pairings)
    if which.size == count:
        return "all pairings"
    return f"{which.size} of {count} pairings"
