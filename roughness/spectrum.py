"""Power spectral density and autocorrelation of a profile."""

from __future__ import annotations

import numpy as np

from profiles import InputError, Profile
from profiles.profile import of_profile


@of_profile
def power_density(profile: Profile) -> tuple[np.ndarray, np.ndarray]:
    """One-sided spectral density (m3) over the wavenumber (cycles per m).

    .. math:: \\int_0^\\infty G(f)\\,df = \\langle (z - \\bar z)^2 \\rangle

    Hann taper over the whole length, divided by the taper's mean square: without it the step between the
    two ends would fill the short waves. The sum over the returned wavenumbers times their spacing is the
    variance, to the accuracy with which the tapered half speaks for the whole. Points beyond the last length
    that transforms fast, at most one in a hundred, are left out.

    >>> wave = Profile(np.sin(2 * np.pi * np.arange(4096) / 16), 1e-6)
    >>> f, density = power_density(wave)
    >>> float(f[density.argmax()]), round(float(density.sum() * f[1]), 3)
    (62500.0, 0.5)
    """
    from scipy.fft import next_fast_len, rfft

    size = profile.heights.size
    while size > 50 and next_fast_len(size, real=True) != size:
        size -= 1
    z = profile.heights[:size]
    amplitude = rfft(z - z.mean(), overwrite_x=True)
    # the taper 1 - cos is a difference of neighbours in the spectrum, which repeats beyond its ends
    beyond = np.conj(amplitude[size - amplitude.size])
    neighbours = amplitude[:-2] + amplitude[2:]
    neighbours *= 0.5
    ends = amplitude[1].real, 0.5 * (amplitude[-2] + beyond)
    amplitude[1:-1] -= neighbours
    amplitude[0] -= ends[0]
    amplitude[-1] -= ends[1]
    parts = amplitude.view(float)
    parts *= parts
    density = parts[::2] + parts[1::2]
    density[1 : (size + 1) // 2] *= 2.0
    # the mean square of 1 - cos is 3/2
    density *= profile.spacing / (1.5 * size)
    return np.arange(density.size) / (size * profile.spacing), density


def log_binned(wavenumber: np.ndarray, density: np.ndarray, *, per_decade: int = 12) -> tuple[np.ndarray, np.ndarray]:
    """Spectrum averaged in equal steps of the logarithm, for drawing."""
    f, g = wavenumber[1:], density[1:]
    bins = np.floor(np.log10(f / f[0]) * per_decade).astype(int)
    count = np.bincount(bins)
    used = count > 0
    return (
        np.bincount(bins, f)[used] / count[used],
        np.bincount(bins, g)[used] / count[used],
    )


@of_profile
def autocorrelation(profile: Profile) -> np.ndarray:
    """Correlation of the heights with themselves, lags 0 to n-1 samples, 1 at lag 0.

    The biased estimate (divided by n at every lag): it is a positive definite function, with little noise at long lags.

    >>> autocorrelation(Profile(np.array([1.0, -1.0, 1.0, -1.0]), 1e-6))
    array([ 1.  , -0.75,  0.5 , -0.25])
    """
    from scipy.fft import irfft, next_fast_len, rfft

    z = profile.heights - profile.heights.mean()
    size = next_fast_len(2 * z.size, real=True)
    transform = rfft(z, size)
    products = irfft(transform.real**2 + transform.imag**2, size)[: z.size]
    if products[0] <= 0:
        raise InputError("is flat: it has no autocorrelation", where=f"profile {profile.name!r}")
    return products / products[0]


@of_profile
def correlation_length(profile: Profile, *, fall_to: float = 0.2) -> float:
    """Lag (m) at which the autocorrelation first falls to ``fall_to``; linear between samples.

    ISO 25178-2 takes 0.2 for Sal, tribology often 1/e or 0.1. Infinite if the autocorrelation stays above.
    """
    correlation = autocorrelation(profile)
    below = np.flatnonzero(correlation <= fall_to)
    if not below.size:
        return float("inf")
    k = int(below[0])
    before, after = correlation[k - 1], correlation[k]
    return float((k - 1 + (before - fall_to) / (before - after)) * profile.spacing)
