"""Bands of the results: scatter of the traces over a surface, another short cut-off, uncertain oil and friction.

A group is the study at one short cut-off, with the inputs moved to both ends of every axis of their uncertainty. The
squares of the changes of an output add up over the axes; the band of the study is the widest of its groups.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mixedlub.rig.measured import ACROSS, ALONG, moved
from mixedlub.rig.rig import Rig
from mixedlub.rig.surface import Surface
from mixedlub.schema.findings import finding, report
from mixedlub.schema.units import ending_of, without_unit
from mixedlub.study.schema import StudyFile
from profiles.errors import InputError

FACTORS = (1.0, 0.5, 2.0)
"""Short cut-offs relative to the study's; the study itself first."""
LOW, HIGH = "lowest_", "highest_"
"""Prefixes of output names: ends of the band."""
LOSS_AT = "loss_at_"
"""Prefix of the power loss of a group, and of its power loss at an end of an axis."""
REACH = 1.6449
"""Definition. Standard deviations from the mean to an end of a 90 % interval of a normal distribution."""
OF_OIL = ("viscosity", "pressure_viscosity", "eyring_stress")
"""Uncertain inputs of the oil."""
BOUNDARY, ROUGHNESS = "boundary_friction", "roughness"
"""Uncertain inputs that are no factor on an input of the chain."""
AT_MOST_ONE = ("area_ratio", "mean_asperity_load_share", "asperity_load_share", "efficiency", "tooth_efficiency")

Pairs = list[tuple[Surface, Surface]]
Values = Mapping[str, Any]


Cause = tuple[int, int] | str
"""Side of a pairing and place of an axis of its surface, or the name of an uncertain input."""


@dataclass(frozen=True, eq=False)
class Axis:
    """Inputs at both ends of one uncertainty; ``reach``: way down to an input of 0 over the way to an uncut low end."""

    low: Values
    high: Values
    cause: Cause
    reach: float = np.inf


@dataclass(frozen=True, eq=False)
class Group:
    """Inputs at one short cut-off, relative to the study's, and at both ends of each axis of their uncertainty."""

    own: Values
    axes: tuple[Axis, ...]
    factor: float = 1.0


def uncertain_inputs(file: StudyFile) -> dict[str, float]:
    """Standard deviations of inputs common to all pairings; raises an error for uncertain oil in full solutions."""
    found = file.uncertainty.stated
    for name in OF_OIL if file.options.base == "full_solution" else ():
        if name in found:
            rule = 'base = "full_solution" takes the oil as known; leave it out'
            raise InputError(rule, where=f"uncertainty.{name}", value=found[name])
    return found


def groups(
    kind: str,
    rig: Rig,
    surfaces: Mapping[str, Surface],
    pairings: Sequence[tuple[str, str]],
    inputs: Callable[[Pairs], Values],
    uncertain: Mapping[str, float],
    common: Values,
) -> tuple[Group, ...]:
    """Groups of a kind of band: ``traces``, ``short_cutoff``, ``both`` or ``none``.

    ``uncertain``: standard deviations of inputs common to all pairings, with their values in ``common``. Without both
    there are no groups.
    """
    measured = [name for name in surfaces if rig.file.surfaces[name].is_measured]
    assumed = [name for name in surfaces if rig.file.surfaces[name].one_number is not None]
    if kind != "none":
        _check_surfaces(kind, surfaces, measured, assumed)
    elif not uncertain:
        return ()
    scattered = kind in ("traces", "both")
    spread = {name: rig.axes(name) for name in (*measured, *assumed)} if scattered else {}
    if spread:
        _tell_samples(rig, measured)
    over_cutoffs = kind in ("short_cutoff", "both")
    found = []
    for factor in FACTORS if over_cutoffs else FACTORS[:1]:
        at = {name: rig.at_short_cutoff(name, factor) if factor != 1.0 else one for name, one in surfaces.items()}
        if factor != 1.0 and all(at[name] is surfaces[name] for name in surfaces):
            continue
        own = inputs([(at[a], at[b]) for a, b in pairings])
        axes = [Axis(inputs(low), inputs(high), cause) for low, high, cause in _ends(at, spread, pairings)]
        axes += [_stated(name, sd, {**common, **own}, at, pairings, inputs) for name, sd in uncertain.items()]
        found.append(Group(own, tuple(axes), factor))
    if over_cutoffs:
        _tell_cutoffs(rig, measured)
    _tell_cut(uncertain, common)
    return tuple(found)


def _check_surfaces(
    kind: str, surfaces: Mapping[str, Surface], measured: Sequence[str], assumed: Sequence[str]
) -> None:
    """Raise an error for bands without a surface that scatters; report the surfaces taken as exact."""
    if not measured and not assumed:
        raise InputError("needs surfaces given by traces or a map", where="options.bands", value=kind)
    stated = [name for name in surfaces if name not in (*measured, *assumed)]
    if stated:
        text = f"the moments of {', '.join(stated)} are stated; the bands take them as exact"
        report(finding("band_stated_moments", text, "options.bands"))


def _stated(
    name: str,
    sd: float,
    own: Values,
    at: Mapping[str, Surface],
    pairings: Sequence[tuple[str, str]],
    inputs: Callable[[Pairs], Values],
) -> Axis:
    """Axis of an uncertain input, at both ends of its 90 % interval; other inputs as in the group."""
    if name == ROUGHNESS:
        step = 2.0 * REACH * sd
        low, high = (
            inputs([(_rougher(at[a], sign * step), _rougher(at[b], sign * step)) for a, b in pairings])
            for sign in (-1.0, 1.0)
        )
    elif name == BOUNDARY:
        reach = _reach(own[name], sd)
        low, high = ({**own, name: own[name] + step * REACH * sd} for step in (-min(reach, 1.0), 1.0))
        return Axis(low, high, name, reach)
    else:
        low, high = ({**own, name: own[name] * np.exp(sign * REACH * sd)} for sign in (-1.0, 1.0))
    return Axis(low, high, name)


def _reach(value: float, sd: float) -> float:
    """Way from a value down to 0, over the way to the low end of its band; the band is cut below 1.

    >>> round(_reach(0.1, 0.1), 3), round(_reach(0.1, 0.02), 3)
    (0.608, 3.04)
    """
    return float(value / (REACH * sd)) if sd > 0.0 else np.inf


def _tell_cut(uncertain: Mapping[str, float], common: Values) -> None:
    """Report a band of boundary friction that ends at 0 before its low end."""
    sd = uncertain.get(BOUNDARY, 0.0)
    if (reach := _reach(common.get(BOUNDARY, 0.0), sd)) < 1.0:
        value = common[BOUNDARY]
        text = (
            f"its 90 % band would begin at {value - REACH * sd:.2g}, below 0, and begins at 0 instead: "
            f"{100.0 * min(reach, 0.99):.0f} % of the way down from {value:g}"
        )
        report(finding("band_end_cut", text, f"uncertainty.{BOUNDARY}"))


def _rougher(surface: Surface, step: float) -> Surface:
    """Surface with all its moments times the exponential of a step."""
    known = [key for key in (*ACROSS, *ALONG) if getattr(surface, key) is not None]
    return moved(surface, dict.fromkeys(known, 1.0), step)


def _ends(
    at: Mapping[str, Surface],
    spread: Mapping[str, Sequence[Mapping[str, float]]],
    pairings: Sequence[tuple[str, str]],
) -> Iterator[tuple[Pairs, Pairs, Cause]]:
    """Pairings with a side at both ends of an axis; a surface paired with itself is moved on both sides at once."""
    sides = (0, 1) if any(a != b for a, b in pairings) else (0,)
    for side in sides:
        for axis in range(max(map(len, spread.values()), default=0)):
            low, high = (
                {n: moved(at[n], axes[axis], sign) for n, axes in spread.items() if axis < len(axes)}
                for sign in (-1.0, 1.0)
            )
            yield _pairs(at, low, pairings, side), _pairs(at, high, pairings, side), (side, axis)


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


def losses_at_ends(found: Sequence[tuple[Values, Sequence[tuple[Values, Values]]]]) -> dict[str, Any]:
    """Power loss of every group and at both ends of every axis, by `loss_name`."""
    named: dict[str, Any] = {}
    for group, (own, axes) in enumerate(found):
        named[loss_name(group)] = own["power_loss"]
        for axis, ends in enumerate(axes):
            named |= {loss_name(group, axis, end): one["power_loss"] for end, one in zip((LOW, HIGH), ends)}
    return named


def loss_name(group: int, axis: int | None = None, end: str = "") -> str:
    """Name of the power loss of a group, or at an end of one of its axes.

    >>> loss_name(0), loss_name(1, 2, LOW)
    ('loss_at_0', 'loss_at_1_2_lowest')
    """
    return f"{LOSS_AT}{group}" if axis is None else f"{LOSS_AT}{group}_{axis}_{end.rstrip('_')}"


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
