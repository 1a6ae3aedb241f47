"""Spatial parameters of a map: correlation length, aspect ratio and direction of the texture, ISO 25178-2:2012."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from profiles import InputError
from profiles.maps import HeightMap
from roughness.maps.heights import refuse_flat

LEVEL = 0.2
"""Source. ISO 25178-2:2012, 4.2: value of the autocorrelation at the ends of its central lobe."""
DIRECTIONS = 720
"""Grid. Directions of half a turn in which the central lobe is followed; an aspect of 20 is met within 0.2 %."""
BINS = 180
"""Grid. Bins of half a turn of the angular spectrum."""
NEAR = 5
"""Grid. Bins to either side in means of the angular spectrum."""


@dataclass(frozen=True)
class Texture:
    """Correlation length Sal (m) and aspect ratio Str, with the directions of fastest and slowest decay (rad).

    ``is_bound``: the correlation along the lay does not fall to 0.2 within half of the map, so Str is an upper bound.
    """

    Sal: float
    Str: float
    fastest: float
    slowest: float
    is_bound: bool


def areal_autocorrelation(area: HeightMap) -> np.ndarray:
    """Autocorrelation of a map, 1 at no lag: lags along y from 0 to half of the rows, along x from minus to plus half.

    Each lag is a mean over the pairs of known heights that far apart; nothing is wrapped round. A lag without pairs
    is nan.

    >>> noise = HeightMap(np.random.default_rng(0).normal(size=(64, 64)), 1e-6, 1e-6)
    >>> found = areal_autocorrelation(noise)
    >>> found.shape, round(float(found[0, 32]), 12)
    ((33, 65), 1.0)
    """
    from scipy.fft import irfft2, next_fast_len, rfft2

    refuse_flat(area.heights, area)
    there = np.isfinite(area.heights)
    z = np.where(there, area.heights - area.heights[there].mean(), 0.0)
    rows, columns = z.shape
    half = rows // 2, columns // 2
    size = next_fast_len(rows + half[0], real=True), next_fast_len(columns + half[1], real=True)

    def pairs(values: np.ndarray) -> np.ndarray:
        power = rfft2(values, size)
        power *= np.conj(power)
        whole = irfft2(power, size, overwrite_x=True)[: half[0] + 1]
        return np.concatenate((whole[:, -half[1] :], whole[:, : half[1] + 1]), axis=1)

    if there.all():
        down = rows - np.arange(half[0] + 1.0)
        across = columns - np.abs(np.arange(-half[1], half[1] + 1.0))
        counts = np.outer(down, across)
    else:
        counts = np.round(pairs(there.astype(float)))
    with np.errstate(invalid="ignore", divide="ignore"):
        found = np.where(counts > 0.0, pairs(z) / counts, np.nan)
    normalised: np.ndarray = found / found[0, half[1]]
    return normalised


def texture_parameters(area: HeightMap) -> Texture:
    r"""Sal and Str of a map: shortest, and shortest over longest, distance at which the autocorrelation falls to 0.2.

    .. math:: S_{al} = \min_\theta r(\theta),\quad S_{tr} = \min_\theta r(\theta)/\max_\theta r(\theta)

    with the first distance r at which the autocorrelation falls to 0.2 in a direction. ISO 25178-2:2012, 4.2.1, 4.2.2.

    >>> y, x = np.mgrid[0:400, 0:400]
    >>> found = texture_parameters(HeightMap(1e-6 * np.sin(2 * np.pi * x / 20), 1e-6, 1e-6))
    >>> round(found.Sal * 1e6, 1), found.is_bound   # arccos(0.2) 20/(2 pi)
    (4.4, True)
    """
    from scipy.ndimage import map_coordinates

    found = areal_autocorrelation(area)
    reach = (found.shape[0] - 1) * area.spacing_y, (found.shape[1] // 2) * area.spacing_x
    step = min(area.spacing_x, area.spacing_y)
    angles = np.arange(DIRECTIONS) * math.pi / DIRECTIONS
    distances = np.arange(int(math.hypot(*reach) / step) + 1) * step
    x, y = np.outer(np.cos(angles), distances), np.outer(np.sin(angles), distances)
    inside = (np.abs(x) <= reach[1] * (1 + 1e-9)) & (y <= reach[0] * (1 + 1e-9))
    places = y / area.spacing_y, x / area.spacing_x + found.shape[1] // 2
    along = map_coordinates(found, places, order=1, mode="nearest")
    below = (along < LEVEL) & inside
    first = below.argmax(axis=1)
    closed = below.any(axis=1)
    before = along[np.arange(DIRECTIONS), np.maximum(first - 1, 0)]
    after = along[np.arange(DIRECTIONS), first]
    with np.errstate(invalid="ignore", divide="ignore"):
        radius = (first - 1 + (before - LEVEL) / (before - after)) * step
    radius = np.where(closed, radius, inside.sum(axis=1) * step)
    shortest, longest = int(np.where(closed, radius, np.inf).argmin()), int(radius.argmax())
    if not closed.any():
        rule = "its heights stay correlated over half of the map: take a larger map, or a shorter cut-off"
        raise InputError(rule, where=f"map {area.name!r}")
    return Texture(
        Sal=float(radius[shortest]),
        Str=float(radius[shortest] / radius[longest]),
        fastest=float(angles[shortest]),
        slowest=float(angles[longest]),
        is_bound=bool(not closed.all()),
    )


def angular_spectrum(area: HeightMap) -> tuple[np.ndarray, np.ndarray]:
    """Directions of the lay (rad from the x axis towards y, in half a turn) and the share of the spectrum in each.

    A wave belongs to the direction of its crests. The spectrum is of the map under a Hann window, holes at the mean
    height, waves up to the Nyquist limit of the coarser spacing. ISO 25178-2:2012, 3.2.9.
    """
    from scipy.fft import rfft2

    there = np.isfinite(area.heights)
    z = np.where(there, area.heights - area.heights[there].mean(), 0.0)
    rows, columns = z.shape
    z *= np.hanning(rows + 2)[1:-1, None]
    z *= np.hanning(columns + 2)[1:-1]
    waves = rfft2(z)
    power = waves.real**2 + waves.imag**2
    fy = np.fft.fftfreq(rows, area.spacing_y)[:, None]
    fx = np.fft.rfftfreq(columns, area.spacing_x)[None, :]
    power[:, 1 : (columns + 1) // 2] *= 2.0
    kept = (np.hypot(fx, fy) <= 0.5 / max(area.spacing_x, area.spacing_y)) & ((fx > 0.0) | (fy != 0.0))
    crest = np.mod(np.arctan2(fy, fx) + 0.5 * math.pi, math.pi)
    bins = np.minimum((crest * (BINS / math.pi)).astype(int), BINS - 1)
    shares = np.bincount(bins[kept], power[kept], BINS)
    return (np.arange(BINS) + 0.5) * math.pi / BINS, shares / shares.sum()


def smoothed_spectrum(shares: np.ndarray) -> np.ndarray:
    """Means of an angular spectrum over neighbouring directions, around the half turn.

    >>> float(smoothed_spectrum(np.ones(BINS)).std())
    0.0
    """
    wrapped = np.concatenate((shares[-NEAR:], shares, shares[:NEAR]))
    means: np.ndarray = np.convolve(wrapped, np.ones(2 * NEAR + 1) / (2 * NEAR + 1), "valid")
    return means


def texture_direction(area: HeightMap) -> float:
    """Std: direction of the lay (rad from the x axis towards y, 0 to pi), where the angular spectrum is highest.

    The highest is sought among means over 11 degrees, as waves of a small map have few directions; Std is the mean
    direction of the spectrum there. ISO 25178-2:2012, 4.5.1.

    >>> y, x = np.mgrid[0:200, 0:300]
    >>> turned = np.sin(2 * np.pi * (x * np.cos(0.5) + y * np.sin(0.5)) / 20)   # crests at 0.5 + pi/2
    >>> round(texture_direction(HeightMap(1e-6 * turned, 1e-6, 1e-6)), 1)
    2.1
    """
    angles, shares = angular_spectrum(area)
    best = int(smoothed_spectrum(shares).argmax())
    near = (best + np.arange(-NEAR, NEAR + 1)) % BINS
    mean = np.sum(shares[near] * np.exp(2j * angles[near]))
    return float(np.mod(0.5 * np.angle(mean), math.pi))
