"""Micro-geometry: distance of a flank from its involute, over path and face."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from mixedlub.gear.checks import two
from mixedlub.gear.geometry import GearPair, Pair
from profiles.errors import InputError


@dataclass(frozen=True)
class Modifications:
    """Modifications of both wheels and their deviations; all lengths in m, first entry the pinion.

    - ``tip_relief`` over ``relief_length`` along the path of contact, counted from each tip
    - ``root_relief`` over ``root_relief_length``, counted from where the mate's tip reaches the root
    - ``relief_form``: "linear" or "parabolic", each starting at zero where the relief starts
    - ``lead_crown``: sum for both flanks, C (2y/b - 1)^2
    - ``misalignment``: f y/b over the face, either sign; a slope deviation of the lead is the same
    - ``end_relief`` over ``end_relief_length``: at the front (y = 0) and at the back, both flanks together
    - ``profile_slope_deviation``: rises from zero at the root of each wheel to its value at the tip, either sign
    - ``lead_deviation``: any gap over the face, at equal steps from front to back, either sign
    """

    tip_relief: Pair = (0.0, 0.0)
    relief_length: Pair = (0.0, 0.0)
    root_relief: Pair = (0.0, 0.0)
    root_relief_length: Pair = (0.0, 0.0)
    relief_form: str = "linear"
    lead_crown: float = 0.0
    misalignment: float = 0.0
    end_relief: Pair = (0.0, 0.0)
    end_relief_length: Pair = (0.0, 0.0)
    profile_slope_deviation: Pair = (0.0, 0.0)
    lead_deviation: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        for name, key, scale in (
            ("tip_relief", "tip_relief_um", 1e6),
            ("relief_length", "relief_length_mm", 1e3),
            ("root_relief", "root_relief_um", 1e6),
            ("root_relief_length", "root_relief_length_mm", 1e3),
            ("end_relief", "end_relief_um", 1e6),
            ("end_relief_length", "end_relief_length_mm", 1e3),
            ("profile_slope_deviation", "profile_slope_deviation_um", 1e6),
        ):
            signed = name == "profile_slope_deviation"
            entries = tuple(_length(key, value, scale, signed) for value in two(key, getattr(self, name)))
            object.__setattr__(self, name, entries)
        object.__setattr__(self, "lead_deviation", _trace("lead_deviation_um", self.lead_deviation))
        object.__setattr__(self, "lead_crown", _length("lead_crown_um", self.lead_crown, 1e6))
        misalignment = _length("misalignment_um", self.misalignment, 1e6, signed=True)
        object.__setattr__(self, "misalignment", misalignment)
        for relief, length, key in (
            (self.tip_relief, self.relief_length, "relief_length_mm"),
            (self.root_relief, self.root_relief_length, "root_relief_length_mm"),
            (self.end_relief, self.end_relief_length, "end_relief_length_mm"),
        ):
            if any(depth > 0 and reach < 1e-6 for depth, reach in zip(relief, length)):
                raise InputError("a relief needs a length of at least 0.001 mm", where=key, value=length)
        if self.relief_form not in ("linear", "parabolic"):
            raise InputError("'linear' or 'parabolic'", where="relief_form", value=self.relief_form)

    def _refuse_long(self, pair: GearPair) -> None:
        """Raise an error for a relief longer than the path of contact, or than the face."""
        path = "path of contact", pair.path_end - pair.path_start
        for key, lengths, (place, longest) in (
            ("relief_length_mm", self.relief_length, path),
            ("root_relief_length_mm", self.root_relief_length, path),
            ("end_relief_length_mm", self.end_relief_length, ("face", pair.face_width)),
        ):
            if max(lengths) > longest:
                raise InputError(
                    f"a relief must not be longer than the {place}, {longest * 1e3:.4g} mm",
                    where=key,
                    value=max(lengths) * 1e3,
                )

    def starts(self, pair: GearPair) -> np.ndarray:
        """Positions (m) where a relief starts."""
        late = [pair.path_end - self.relief_length[0], pair.path_end - self.root_relief_length[1]]
        early = [pair.path_start + self.relief_length[1], pair.path_start + self.root_relief_length[0]]
        return np.array(late + early)

    def gap(self, pair: GearPair, position: np.ndarray, face_position: np.ndarray) -> np.ndarray:
        """Initial separation (m) along the path normal at position x and face position y (m, broadcast).

        The pinion's tip and the gear's root meet at the end of the path, the gear's tip and the pinion's root
        at its start.
        """
        to_end, from_start = pair.path_end - position, position - pair.path_start
        relief = (
            self._relief(self.tip_relief[0], self.relief_length[0], to_end)
            + self._relief(self.root_relief[1], self.root_relief_length[1], to_end)
            + self._relief(self.tip_relief[1], self.relief_length[1], from_start)
            + self._relief(self.root_relief[0], self.root_relief_length[0], from_start)
        )
        across = face_position / pair.face_width
        gap = relief + self.lead_crown * (2 * across - 1) ** 2 + self.misalignment * across
        return gap + self._ends(pair, face_position) + self._slopes(pair, from_start) + self._lead(across)

    def _ends(self, pair: GearPair, face_position: np.ndarray) -> np.ndarray:
        front, back = zip(self.end_relief, self.end_relief_length)
        return self._relief(*front, face_position) + self._relief(*back, pair.face_width - face_position)

    def _slopes(self, pair: GearPair, from_start: np.ndarray) -> np.ndarray:
        """Gap of the profile slopes; the pinion's tip is at the end of the path, the gear's at its start."""
        share = from_start / (pair.path_end - pair.path_start)
        pinion, gear = self.profile_slope_deviation
        return pinion * share + gear * (1 - share)

    def _lead(self, across: np.ndarray) -> np.ndarray | float:
        if not self.lead_deviation:
            return 0.0
        return np.interp(across, np.linspace(0, 1, len(self.lead_deviation)), self.lead_deviation)

    def _relief(self, depth: float, length: float, distance: np.ndarray) -> np.ndarray:
        if depth == 0:
            return np.zeros_like(distance)
        power = 1 if self.relief_form == "linear" else 2
        return depth * np.maximum(0, 1 - distance / length) ** power


def _trace(key: str, values: Any) -> tuple[float, ...]:
    """Deviations at equal steps over the face: none, or at least two."""
    entries = () if isinstance(values, (str, bytes)) or not isinstance(values, Iterable) else tuple(values)
    if len(entries) == 1 or (not entries and values not in ((), [])):
        raise InputError("two or more values at equal steps from front to back", where=key, value=values)
    return tuple(_length(key, value, 1e6, signed=True) for value in entries)


def _length(key: str, value: Any, scale: float, signed: bool = False) -> float:
    """A finite length in m below 0.1 m, not negative unless signed."""
    try:
        number = math.nan if isinstance(value, (bool, str, bytes)) else float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not math.isfinite(number) or abs(number) > 0.1 or (number < 0 and not signed):
        rule = "a length is finite" if signed else "a length is finite and not negative"
        shown = round(number * scale, 9) if math.isfinite(number) else value
        raise InputError(rule, where=key, value=shown)
    return number
