"""Waves of a surface: how its heights, slopes and curvatures share out over the wavelengths."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from profiles import Profile
from roughness.spectrum import power_density

STEPS = 20
"""Judgement. Classes of wavelengths per factor e: 5 % wide, where filters and films act over factors."""
SPREAD = 6.0
"""Judgement. Standard deviations of a normal distribution beyond which waves count nothing."""


@dataclass(frozen=True, eq=False)
class Waves:
    """Wavelengths (m), and their shares of m0, m2 and m4 in three rows that each add up to 1."""

    lengths: np.ndarray
    shares: np.ndarray


def waves_of(profiles: Sequence[Profile]) -> Waves:
    """Waves of filtered profiles: the mean of their spectra in classes of equal ratio.

    >>> ripple = Profile(1e-7 * np.sin(2 * np.pi * np.arange(4000) / 40), 1e-6)
    >>> found = waves_of([ripple])
    >>> round(float(found.lengths @ found.shares[0]) * 1e6)   # waves of 40 um
    39
    """
    spectra = [power_density(one) for one in profiles]
    places = [np.round(STEPS * np.log(wavenumber[1:])).astype(int) for wavenumber, _ in spectra]
    first = min(int(place[0]) for place in places)
    size = max(int(place[-1]) for place in places) - first + 1
    sums = np.zeros((3, size))
    for (wavenumber, density), place in zip(spectra, places, strict=True):
        square = (2.0 * np.pi * wavenumber[1:]) ** 2
        for row in range(3):
            weight = density[1:] * square**row * wavenumber[1]
            sums[row] += np.bincount(place - first, weight, minlength=size)
    used = sums[0] > 0.0
    lengths = np.exp(-(np.arange(size) + first) / STEPS)
    return Waves(lengths[used], sums[:, used] / sums.sum(axis=1, keepdims=True))


def lognormal_waves(m0: float, m2: float, m4: float) -> Waves:
    r"""Waves of a surface known by its moments alone: lognormal, with these moments.

    The logarithm of the angular wavenumber has the mean :math:`\tfrac12\ln(m_2/m_0) - s^2` over the heights and
    the variance :math:`s^2 = \tfrac14\ln[m_0 m_4/m_2^2]`, which Nayak's number fixes.

    >>> waves = lognormal_waves(1e-14, 1e-3, 1e9)
    >>> square = (2 * np.pi / waves.lengths) ** 2
    >>> [round(float(one @ square) * 1e-11, 3) for one in waves.shares[:2]]   # m2/m0 and m4/m2
    [1.0, 10.0]
    """
    variance = 0.25 * max(float(np.log(m0 * m4 / m2**2)), 1e-6)
    sd, middle = variance**0.5, 0.5 * float(np.log(m2 / m0)) - variance
    count = int(2 * SPREAD * max(STEPS, 2.0 / sd) * (sd + variance)) + 64
    logs = np.linspace(middle - SPREAD * sd, middle + SPREAD * sd + 4.0 * variance, count)
    centres = middle + 2.0 * variance * np.arange(3)[:, None]
    shares = np.exp(-((logs - centres) ** 2) / (2.0 * variance))
    return Waves(2.0 * np.pi * np.exp(-logs), shares / shares.sum(axis=1, keepdims=True))
