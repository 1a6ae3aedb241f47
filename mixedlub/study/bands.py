"""Bands of the results: the effect of the scatter of the traces over a surface and of another short cut-off.

A group is the study at one short cut-off, with the surfaces moved to both ends of every axis of their scatter. The
squares of the changes of an output add up over the axes; the band of the study is the widest of its groups.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mixedlub.rig.measured import moved
from mixedlub.rig.rig import Rig
from mixedlub.rig.surface import Surface
from mixedlub.schema.findings import finding, report
from mixedlub.schema.units import ending_of, without_unit
from profiles.errors import InputError

FACTORS = (1.0, 0.5, 2.0)
"""Short cut-offs relative to the study's; the study itself first."""
LOW, HIGH = "lowest_", "highest_"
"""Prefixes of output names: ends of the band."""
AT_MOST_ONE = ("area_ratio", "mean_asperity_load_share", "asperity_load_share", "efficiency", "tooth_efficiency")

Pairs = list[tuple[Surface, Surface]]
Values = Mapping[str, Any]


@dataclass(frozen=True, eq=False)
class Group:
    """Inputs of the surfaces at one short cut-off and at both ends of each axis of their scatter."""

    own: Values
    axes: tuple[tuple[Values, Values], ...]


def groups(
    kind: str,
    rig: Rig,
    surfaces: Mapping[str, Surface],
    pairings: Sequence[tuple[str, str]],
    inputs: Callable[[Pairs], Values],
) -> tuple[Group, ...]:
    """Groups of a kind of band: ``traces``, ``short_cutoff`` or ``both``; empty for ``none``."""
    if kind == "none":
        return ()
    measured = [name for name in surfaces if rig.file.surfaces[name].is_measured]
    assumed = [name for name in surfaces if rig.file.surfaces[name].one_number is not None]
    if not measured and not assumed:
        raise InputError("needs surfaces given by traces or a map", where="options.bands", value=kind)
    stated = [name for name in surfaces if name not in (*measured, *assumed)]
    if stated:
        text = f"the moments of {', '.join(stated)} are stated; the bands take them as exact"
        report(finding("band_stated_moments", text, "options.bands"))
    spread = {name: rig.axes(name) for name in (*measured, *assumed)} if kind != "short_cutoff" else {}
    if spread:
        _tell_samples(rig, measured)
    found = []
    for factor in FACTORS if kind != "traces" else FACTORS[:1]:
        at = {name: rig.at_short_cutoff(name, factor) if factor != 1.0 else one for name, one in surfaces.items()}
        if factor != 1.0 and all(at[name] is surfaces[name] for name in surfaces):
            continue
        own = inputs([(at[a], at[b]) for a, b in pairings])
        ends = _ends(at, spread, pairings)
        found.append(Group(own, tuple((inputs(low), inputs(high)) for low, high in ends)))
    if kind != "traces":
        _tell_cutoffs(rig, measured)
    return tuple(found)


def _ends(
    at: Mapping[str, Surface],
    spread: Mapping[str, Sequence[Mapping[str, float]]],
    pairings: Sequence[tuple[str, str]],
) -> Iterator[tuple[Pairs, Pairs]]:
    """Pairings with a side at both ends of an axis; a surface paired with itself is moved on both sides at once."""
    sides = (0, 1) if any(a != b for a, b in pairings) else (0,)
    for side in sides:
        for axis in range(max(map(len, spread.values()), default=0)):
            low, high = (
                {n: moved(at[n], axes[axis], sign) for n, axes in spread.items() if axis < len(axes)}
                for sign in (-1.0, 1.0)
            )
            yield _pairs(at, low, pairings, side), _pairs(at, high, pairings, side)


def _pairs(
    at: Mapping[str, Surface], changed: Mapping[str, Surface], pairings: Sequence[tuple[str, str]], side: int
) -> Pairs:
    found = []
    for a, b in pairings:
        first, second = (side == 0, side == 0) if a == b else (side == 0, side == 1)
        found.append((changed.get(a, at[a]) if first else at[a], changed.get(b, at[b]) if second else at[b]))
    return found


def _tell_samples(rig: Rig, measured: Sequence[str]) -> None:
    """Report surfaces with fewer than three traces: their scatter is taken between sampling lengths."""
    few = [name for name in measured if rig.measured(name).by_lengths]
    if few:
        text = (
            f"fewer than three traces of {', '.join(few)}: the scatter is that of their sampling lengths and does not "
            "see what differs from place to place on the flank"
        )
        report(finding("band_of_sampling_lengths", text, "options.bands"))


def _tell_cutoffs(rig: Rig, measured: Sequence[str]) -> None:
    """Report the surfaces without values at another short cut-off."""
    for factor in FACTORS[1:]:
        fixed = [name for name in measured if rig.at_short_cutoff(name, factor) is rig.surface(name)]
        if fixed:
            text = f"not resolved at {factor:g} of their short cut-off, where they keep their own: {', '.join(fixed)}"
            report(finding("band_cutoff_left_out", text, "options.bands"))


def band(found: Sequence[tuple[Values, Sequence[tuple[Values, Values]]]], outputs: Sequence[str]) -> dict[str, Any]:
    """Ends of the band of each output, from the results of every group: unchanged, and at both ends of every axis.

    Changes of a positive output are changes of its logarithm. Student's t of each surface is taken at its number of
    traces, and the squares add: the interval holds at least its level for a sum of means with unequal numbers and
    scatter. Source: S. K. Banerjee, Sankhya 22 (1960) 357.

    >>> axes = [({"y": np.array(0.9)}, {"y": np.array(1.2)}), ({"y": np.array(1.0)}, {"y": np.array(1.0)})]
    >>> ends = band([({"y": np.array(1.0)}, axes)], ["y"])
    >>> [round(float(ends[end]), 3) for end in ("lowest_y", "highest_y")]
    [0.9, 1.2]
    """
    ends: dict[str, Any] = {}
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for name in outputs:
            spans = [_span(own[name], [(a[name], b[name]) for a, b in axes]) for own, axes in found]
            low = np.min([span[0] for span in spans], axis=0)
            high = np.max([span[1] for span in spans], axis=0)
            ends |= {LOW + name: low, HIGH + name: np.minimum(high, 1.0) if name in AT_MOST_ONE else high}
    return ends


def _span(own: np.ndarray, axes: Sequence[tuple[np.ndarray, np.ndarray]]) -> tuple[np.ndarray, np.ndarray]:
    below, above = np.zeros_like(own), np.zeros_like(own)
    low, high = own, own
    for ends in axes:
        low, high = (np.minimum(low, np.minimum(*ends)), np.maximum(high, np.maximum(*ends)))
        steps = [np.log(end / own) for end in ends]
        below += np.square(np.minimum(np.minimum(*steps), 0.0))
        above += np.square(np.maximum(np.maximum(*steps), 0.0))
    positive = own > 0.0
    return (
        np.where(positive, own * np.exp(-np.sqrt(below)), low),
        np.where(positive, own * np.exp(np.sqrt(above)), high),
    )


def column(name: str, end: str) -> str:
    """Column name of an end of a band.

    >>> column("power_loss_W", "low"), column("mean_friction", "high")
    ('power_loss_low_W', 'mean_friction_high')
    """
    unit = ending_of(name)
    return f"{without_unit(name)}_{end}_{unit}" if unit else f"{name}_{end}"
