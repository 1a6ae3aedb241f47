"""Units that make a table of plain numbers a measured trace."""

from __future__ import annotations

import math

import numpy as np

from profiles.errors import InputError
from profiles.units import METRES

USUAL = {
    ("mm", "um"): 1.0,
    ("um", "um"): 1.0,
    ("mm", "mm"): 0.3,
    ("m", "m"): 0.3,
    ("um", "nm"): 0.3,
    ("in", "uin"): 0.1,
    ("mm", "nm"): 0.05,
    ("mil", "uin"): 0.1,
    ("nm", "nm"): 0.03,
}
"""Frequency weight of a pair of units of position and height in files; others have 0.01, inch beside metre 0.001."""

_POSITIONS = ("m", "mm", "um", "nm", "in", "mil")
_HEIGHTS = ("m", "mm", "um", "nm", "in", "mil", "uin")
_INCHES = ("in", "mil", "uin")
_STEPS = (5e-9, 50e-6)
_SLOPES = (1e-5, 2.0)
_CLEARLY = 10.0

Units = tuple[str | None, str | None]


def inferred_units(step: float, heights: np.ndarray, where: str, known: Units = (None, None)) -> tuple[str, str]:
    """Units of position and height that clearly make the numbers a stylus or optical trace, else an error.

    The weight of a pair is its frequency in files, reduced by the distance of its step from 0.6 um and of its typical
    slope from 0.05: exponential laws in decades, of scale 0.5, or 0.35 above the slope. Steps outside 5 nm to 50 um and
    slopes outside 1e-5 to 2 are excluded. ``known`` units are kept. Several pairs may be plausible, as units differ by
    less than traces do: unless the best weighs ten times the next, the error names both. A trace smoother than a slope
    of 2e-4 cannot be told from a thousand times rougher trace and is read as such.
    """
    if known[0] and known[1]:
        return known[0], known[1]
    weights = _weights(step, typical_slope(step, heights), known)
    best, *others = sorted(weights, key=lambda pair: -weights[pair])
    if weights[best] == 0.0:
        rule = f"{_named(known)}, and none can be inferred: heading 'x_mm, z_um', or give them as unit 'mm, um'"
        raise InputError(rule, where=where)
    if others and weights[others[0]] * _CLEARLY > weights[best]:
        one, other = (f"{x}, {z}" for x, z in (best, others[0]))
        rule = (
            f"{_named(known)}; '{one}' and '{other}' are about as plausible: say which in a heading, or as unit '{one}'"
        )
        raise InputError(rule, where=where)
    return best


def inferred_note(known: Units, found: tuple[str, str]) -> str:
    """Note on inferred units and the known units beside them.

    >>> inferred_note((None, "nm"), ("um", "nm"))
    'the file names nm for the heights only; inferred from the numbers: position um'
    """
    new = [f"{what} {unit}" for what, own, unit in zip(("position", "height"), known, found, strict=True) if not own]
    return f"{_named(known)}; inferred from the numbers: {', '.join(new)}"


def doubt(
    step: float,
    heights: np.ndarray,
    units: tuple[str, str],
    *,
    steps: tuple[float, float] = _STEPS,
    kind: str = "trace",
) -> str | None:
    """Reason to doubt a trace by its step (m) or typical slope, for heights in m, and the unit that suits its numbers.

    ``steps``: the range of usual steps; ``kind``: what is measured, for the message.

    >>> doubt(0.5e-6, np.arange(9) * 36e-6, ("mm", "mm"))
    'a typical slope of 1.1e+02, unlike a measured trace; are the heights in um?'
    """
    slope, (x, z) = typical_slope(step, heights), units
    known: Units
    if not steps[0] <= step <= steps[1]:
        said, what, known = f"a step of {step * 1e6:.3g} um", "positions", (None, z)
    # a trace of flats has no typical slope
    elif slope and not _SLOPES[0] <= slope <= _SLOPES[1]:
        said, what, known = f"a typical slope of {slope:.2g}", "heights", (x, None)
    else:
        return None
    weights = _weights(step / METRES[x], slope * METRES[x] / METRES[z], known)
    best = max(weights, key=lambda pair: weights[pair])
    asked = f"; are the {what} in {best[known[1] is None]}?" if weights[best] else ""
    return f"{said}, unlike a measured {kind}{asked}"


def _weights(step: float, slope: float, known: Units) -> dict[tuple[str, str], float]:
    """Weights of the pairs of units with these known units, for a step and slope as written."""
    return {
        (x, z): USUAL.get((x, z), 0.01 if (x in _INCHES) == (z in _INCHES) else 0.001)
        * (1.0 if known[0] else _weight(step * METRES[x], 0.6e-6, (0.5, 0.5), _STEPS))
        * _weight(slope * METRES[z] / METRES[x], 0.05, (0.5, 0.35), _SLOPES)
        for x in ([known[0]] if known[0] else _POSITIONS)
        for z in ([known[1]] if known[1] else _HEIGHTS)
    }


def typical_slope(step: float, heights: np.ndarray) -> float:
    """1.48 times the median of \\|dz\\|/dx, the sigma of Gaussian slopes; the mean where most heights repeat."""
    rises = np.abs(np.diff(heights))
    rises = rises[np.isfinite(rises)]
    if not rises.size:
        return 0.0
    return (1.4826 * float(np.median(rises)) or float(rises.mean())) / step


def _weight(value: float, centre: float, decades: tuple[float, float], window: tuple[float, float]) -> float:
    if not window[0] <= value <= window[1]:
        return 0.0
    off = math.log10(value / centre)
    return math.exp(-abs(off) / decades[off > 0])


def _named(known: Units) -> str:
    if known == (None, None):
        return "the file names no units"
    return (
        f"the file names {known[0]} for the positions only"
        if known[0]
        else (f"the file names {known[1]} for the heights only")
    )
