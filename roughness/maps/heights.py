"""Height and hybrid parameters of a map, ISO 25178-2:2012, 4.1 and 4.3."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from profiles import InputError
from profiles.maps import HeightMap
from roughness.parameters import SEVEN_POINTS

FLAT = 1e-12
"""Judgement. Range of levelled heights over the largest height up to which they are rounding noise."""


@dataclass(frozen=True)
class HeightParameters:
    """Height parameters: lengths in m, Ssk and Sku dimensionless."""

    Sa: float
    Sq: float
    Sz: float
    Sp: float
    Sv: float
    Ssk: float
    Sku: float


@dataclass(frozen=True)
class HybridParameters:
    """Rms gradient Sdq and developed area ratio Sdr, both dimensionless (Sdr is not in percent)."""

    Sdq: float
    Sdr: float


def known_heights(area: HeightMap) -> np.ndarray:
    """Heights of a map in one line, holes left out, about their mean (m)."""
    flat = area.heights.ravel()
    there = np.isfinite(flat)
    kept = flat if there.all() else flat[there]
    about_mean: np.ndarray = kept - kept.mean()
    return about_mean


def refuse_flat(levelled: np.ndarray, area: HeightMap) -> None:
    """Raise an error for a map of which the levelled heights are rounding noise."""
    if np.nanmax(levelled) - np.nanmin(levelled) <= FLAT * np.nanmax(np.abs(area.heights)):
        raise InputError("is flat: it has no roughness", where=f"map {area.name!r}")


def height_parameters(area: HeightMap) -> HeightParameters:
    r"""Height parameters of a map, holes left out.

    .. math:: S_a = \langle|z|\rangle,\quad S_q = \langle z^2\rangle^{1/2},\quad
              S_{sk} = \langle z^3\rangle/S_q^3,\quad S_{ku} = \langle z^4\rangle/S_q^4

    with heights z about their mean; Sp and Sv are the highest peak and the deepest pit, Sz is their sum.
    ISO 25178-2:2012, 4.1.1 to 4.1.7.

    >>> x = np.arange(400)
    >>> p = height_parameters(HeightMap(np.outer(np.ones(20), 1e-6 * np.sin(2 * np.pi * x / 40)), 1e-6, 1e-6))
    >>> round(p.Sq * 1e6, 9), round(p.Sz * 1e6, 9), round(p.Sku, 9)
    (0.707106781, 2.0, 1.5)
    """
    z = known_heights(area)
    refuse_flat(z, area)
    square = z * z
    m2 = float(square.mean())
    sq, top, bottom = math.sqrt(m2), float(z.max()), float(z.min())
    return HeightParameters(
        Sa=float(np.abs(z).mean()),
        Sq=sq,
        Sz=top - bottom,
        Sp=top,
        Sv=-bottom,
        Ssk=float(square @ z) / z.size / sq**3,
        Sku=float(square @ square) / z.size / m2**2,
    )


def hybrid_parameters(area: HeightMap) -> HybridParameters:
    r"""Gradient and developed area of a map; a slope next to a hole is left out.

    .. math:: S_{dq} = \langle z_x^2 + z_y^2\rangle^{1/2},\quad
              S_{dr} = \left\langle\sqrt{1 + z_x^2 + z_y^2} - 1\right\rangle

    with slopes by the seven-point formula of the profile's Rdq, exact for polynomials of degree 6. Programs that
    triangulate between neighbours give less on short waves. ISO 25178-2:2012, 4.3.1 and 4.3.2.

    >>> y, x = np.mgrid[0:40, 0:40]
    >>> p = hybrid_parameters(HeightMap(1e-6 * (0.3 * x + 0.4 * y), 1e-6, 1e-6))
    >>> round(p.Sdq, 9), round(p.Sdr, 9)   # sqrt(1.25) - 1
    (0.5, 0.118033989)
    """
    z = area.heights
    square = _slopes(z[3:-3], area.spacing_x) ** 2
    square += _slopes(z[:, 3:-3].T, area.spacing_y).T ** 2
    there = np.isfinite(square)
    kept = square if there.all() else square[there]
    if not kept.size:
        raise InputError("has a hole within three points of every point", where=f"map {area.name!r}")
    # the difference of two numbers near one would lose the digits of a small slope
    return HybridParameters(Sdq=math.sqrt(kept.mean()), Sdr=float((kept / (1.0 + np.sqrt(1.0 + kept))).mean()))


def _slopes(rows: np.ndarray, spacing: float) -> np.ndarray:
    """Slopes along the rows by seven points; three points are lost at either end."""
    size = rows.shape[1] - 6
    found = np.zeros((rows.shape[0], size))
    for place, weight in enumerate(SEVEN_POINTS):
        if weight:
            found += (weight / (60.0 * spacing)) * rows[:, place : place + size]
    return found
