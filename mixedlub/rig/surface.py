"""A flank as the chain sees it: spectral moments, coating, and the body beneath."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Surface:
    """One surface in SI: profile moments, optional coating, thermal properties of the body (steel unless given).

    ``steps`` is what was done to the trace that the moments are of.
    """

    name: str
    m0: float
    m2: float
    m4: float
    coating_thickness: float
    coating_conductivity: float
    conductivity: float
    density: float
    heat_capacity: float
    steps: tuple[str, ...] = ()


def paired(first: Sequence[Surface], second: Sequence[Surface], coated: bool = False) -> dict[str, np.ndarray]:
    """Chain inputs of surfaces taken in pairs: moments add, thermal properties average; one entry a pair.

    Independent surfaces add their spectra (Nayak 1971), so moments are summed before anything else is formed.
    Where no pair has a coating there are no inputs of one, unless others than these pairs are ``coated``.
    """

    def each(attribute: str, side: Sequence[Surface]) -> np.ndarray:
        return np.array([getattr(s, attribute) for s in side], dtype=float)

    both = {name: each(name, first) + each(name, second) for name in ("m0", "m2", "m4")}
    for moment, share in (("m0", "height_share"), ("m2", "slope_share"), ("m4", "curvature_share")):
        both[share] = each(moment, first) / both[moment]
    for name, attribute in (
        ("solid_conductivity", "conductivity"),
        ("solid_density", "density"),
        ("solid_heat_capacity", "heat_capacity"),
    ):
        both[name] = 0.5 * (each(attribute, first) + each(attribute, second))
    thickness = each("coating_thickness", first) + each("coating_thickness", second)
    if coated or thickness.any():
        both["coating_thickness"] = thickness
        resistance = sum(
            each("coating_thickness", side) / each("coating_conductivity", side) for side in (first, second)
        )
        both["coating_conductivity"] = np.where(thickness > 0, thickness / np.maximum(resistance, 1e-30), 1.0)
    return both
