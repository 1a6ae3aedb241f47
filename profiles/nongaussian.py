"""Traces that are not Gaussian: prescribed skewness and kurtosis, and the Weierstrass-Mandelbrot function."""

from __future__ import annotations

import math

import numpy as np

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.synthesise import Synthetic, measured, uniform

SWEEPS = 40


def non_gaussian(base: Synthetic, *, skewness: float, kurtosis: float) -> Synthetic:
    """Trace with the given Rsk and Rku, the rms height and nearly the spectrum of a Gaussian trace.

    The heights follow a Johnson distribution, fitted so that the moments of the sample are exact to 1e-6; they are put
    in the order of the base trace, and order and spectrum are then reconciled by turns (iterated amplitude-adjusted
    Fourier transform), heights last. Kurtosis must exceed 1.2 + skewness^2. Moments are measured, for m2 and m4 depend
    on the remaining change of the spectrum.

    Johnson, Biometrika 36 (1949) 149; Schreiber and Schmitz, Phys. Rev. Lett. 77 (1996) 635.

    >>> from profiles.synthesise import self_affine
    >>> base = self_affine(1e-7, hurst=0.8, rolloff=3e-5, shortest=2e-6, points=8000, spacing=5e-7, seed=1)
    >>> w = non_gaussian(base, skewness=-1.0, kurtosis=5.0).profile.heights / 1e-7
    >>> bool(np.allclose([np.mean(w), np.mean(w**2), np.mean(w**3), np.mean(w**4)], [0, 1, -1, 5], atol=1e-6))
    True
    """
    profile = base.profile
    count = profile.heights.size
    sorted_heights = math.sqrt(base.m0) * johnson_sample(count, skewness, kurtosis)
    amplitude = np.abs(np.fft.rfft(profile.heights))
    heights = profile.heights
    for _ in range(SWEEPS):
        ranked = np.empty(count)
        ranked[np.argsort(heights, kind="stable")] = sorted_heights
        spectrum = np.fft.rfft(ranked)
        size = np.abs(spectrum)
        heights = np.fft.irfft(spectrum * amplitude / np.where(size > 0, size, 1.0), count)
    ranked = np.empty(count)
    ranked[np.argsort(heights, kind="stable")] = sorted_heights
    name = f"{profile.name} Rsk {skewness:g} Rku {kurtosis:g}"
    origin = {**profile.origin, "skewness": skewness, "kurtosis": kurtosis}
    return measured(Profile(ranked, profile.spacing, name=name, origin=origin))


def johnson_sample(count: int, skewness: float, kurtosis: float) -> np.ndarray:
    """Sorted numbers of mean 0 and rms 1 with the given skewness and kurtosis, from a Johnson curve.

    .. math:: y = \\sinh[(w - \\gamma)/\\delta] \\quad\\text{or}\\quad 1/(1 + e^{-(w - \\gamma)/\\delta})

    w are the normal quantiles of ``count`` equal shares; unbounded above the lognormal line, bounded below it.
    """
    from scipy.optimize import least_squares
    from scipy.special import expit, ndtri

    if not (math.isfinite(skewness) and math.isfinite(kurtosis) and kurtosis > 1.2 + skewness**2):
        raise InputError("kurtosis must exceed 1.2 + skewness^2", where="Rsk, Rku", value=(skewness, kurtosis))
    w = ndtri((np.arange(count) + 0.5) / count)
    unbounded = kurtosis >= _lognormal_kurtosis(skewness)

    def sample(free: np.ndarray) -> np.ndarray:
        u = (w - free[0]) * math.exp(-free[1])
        y = np.sinh(np.clip(u, -300.0, 300.0)) if unbounded else expit(u)
        y = y - y.mean()
        return y / max(float(np.sqrt(np.mean(y**2))), 1e-300)

    def miss(free: np.ndarray) -> list[float]:
        y = sample(free)
        return [float(np.mean(y**3)) - skewness, float(np.mean(y**4)) - kurtosis]

    side = -math.copysign(1.0, skewness) if unbounded else math.copysign(1.0, skewness)
    for gamma, delta in [(g * (skewness != 0), d) for g in (0.3, 1.0, 3.0) for d in (0.7, 0.0, 1.5, 3.0)]:
        found = least_squares(miss, (side * gamma, delta), xtol=1e-15, ftol=1e-15)
        if np.abs(found.fun).max() < 1e-6:
            return sample(found.x)
    raise InputError("no Johnson curve found", where="Rsk, Rku", value=(skewness, kurtosis))


def _lognormal_kurtosis(skewness: float) -> float:
    """Kurtosis of the lognormal curve of a skewness, the border between Johnson's two families."""
    root = (2 + skewness**2 + math.sqrt(skewness**4 + 4 * skewness**2)) / 2
    omega = root ** (1 / 3) + root ** (-1 / 3) - 1
    return omega**4 + 2 * omega**3 + 3 * omega**2 - 3


def weierstrass_mandelbrot(
    *,
    dimension: float,
    roughness_length: float,
    longest: float,
    shortest: float,
    points: int,
    spacing: float,
    seed: int,
    ratio: float = 1.5,
    name: str = "Weierstrass-Mandelbrot",
) -> Synthetic:
    """Weierstrass-Mandelbrot trace of fractal dimension D and roughness length G (m), phases random.

    .. math:: z(x) = G^{D-1} \\sum_n \\frac{\\cos(2\\pi\\gamma^n x + \\varphi_n)}{(\\gamma^n)^{2-D}}

    with frequencies gamma^n (1/m) from 1/``longest`` up to 1/``shortest``; 1 < D < 2. The moments hold for the endless
    trace, sums of half the squared amplitudes times the powers of frequency; a finite trace approaches them with many
    of the longest waves. Majumdar and Tien, Wear 136 (1990) 313, eq. 6.

    >>> t = weierstrass_mandelbrot(dimension=1.5, roughness_length=1e-9, longest=1e-4, shortest=2e-6,
    ...                            points=40000, spacing=2.5e-7, seed=2)
    >>> bool(np.isclose(np.var(t.profile.heights), t.m0, rtol=0.02)), t.exact
    (True, True)
    """
    if not (1 < dimension < 2 and ratio > 1 and roughness_length > 0 and 0 < shortest < longest):
        raise InputError(
            "needs 1 < D < 2, ratio above 1, G above 0 and shortest < longest",
            where=f"synthesis of {name!r}",
            value=(dimension, ratio, roughness_length, shortest, longest),
        )
    frequency = (1 / longest) * ratio ** np.arange(math.floor(math.log(longest / shortest) / math.log(ratio)) + 1)
    amplitude = roughness_length ** (dimension - 1) * frequency ** (dimension - 2)
    q = 2 * math.pi * frequency
    x = np.arange(points) * spacing
    heights = np.zeros(points)
    for a, wave, phase in zip(amplitude, q, 2 * math.pi * uniform(seed, q.size)):
        heights += a * np.cos(wave * x + phase)
    origin = {"synthetic": True, "seed": seed, "dimension": dimension, "roughness_length_m": roughness_length}
    power = amplitude**2 / 2
    m0, m2, m4 = (float(power @ q**n) for n in (0, 2, 4))
    return Synthetic(Profile(heights, spacing, name=name, origin=origin), m0, m2, m4, exact=True)
