"""Force from a periodic displacement: regularised division by the frequency response of the rig."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from profiles.errors import InputError


@dataclass(frozen=True, eq=False)
class Response:
    """Complex displacement per force (m/N in SI, or other units) at ascending frequencies (Hz)."""

    frequency: np.ndarray
    value: np.ndarray
    source: str

    def at(self, frequency: np.ndarray) -> np.ndarray:
        """Response at other frequencies, by linear interpolation of real and imaginary part."""
        outside = (frequency < self.frequency[0]) | (frequency > self.frequency[-1] * (1.0 + 1e-6))
        if np.any(outside):
            rule = f"the response is known from {self.frequency[0]:g} to {self.frequency[-1]:g} Hz"
            raise InputError(rule, where=f"{self.source}: frequency_Hz", value=round(float(frequency[outside][0]), 3))
        real, imaginary = (np.interp(frequency, self.frequency, part) for part in (self.value.real, self.value.imag))
        return np.asarray(real + 1j * imaginary)


@dataclass(frozen=True, eq=False)
class Division:
    """Regularised inverse response at harmonics 0 to J of a period, and the gain (at most 1) of the regularisation."""

    inverse: np.ndarray
    gain: np.ndarray

    def force(self, displacement: np.ndarray) -> np.ndarray:
        """Force harmonics (..., J+1) of displacements over one period (..., M)."""
        return self.harmonics(displacement) * self.inverse

    def harmonics(self, signal: np.ndarray) -> np.ndarray:
        """Harmonics (..., J+1) of signals over one period (..., M)."""
        return np.fft.rfft(signal, axis=-1)[..., : self.inverse.size] / signal.shape[-1]


def over_period(harmonics: np.ndarray, count: int) -> np.ndarray:
    """Signals (..., M) over one period from their harmonics (..., J+1)."""
    padded = np.zeros((*harmonics.shape[:-1], count // 2 + 1), dtype=complex)
    padded[..., : harmonics.shape[-1]] = harmonics
    return np.fft.irfft(padded * count, n=count, axis=-1)


def division(response: Response, fundamental: float, low_pass: float, regularisation: float, least: float) -> Division:
    r"""Division of harmonics up to ``low_pass`` by the response, :math:`F_j = X_j H_j^*/(|H_j|^2 + \epsilon^2)`.

    epsilon: ``regularisation`` times the static response. A response below ``least`` of the static one is an error.

    Source: Vaishya and Houser 1999, AGMA 99FTMS1, section 8, for the division and the filter.

    >>> spring = Response(np.array([0.0, 100.0]), np.array([0.5 + 0j, 0.5 + 0j]), "x")
    >>> division(spring, 10.0, 25.0, 0.0, 0.01).inverse.real.tolist()
    [2.0, 2.0, 2.0]
    """
    count = int(np.floor(low_pass / fundamental + 1e-9))
    if count < 1:
        rule = f"must pass the frequency of the mesh, {fundamental:.4g} Hz, and better some of its multiples"
        raise InputError(rule, where="filter.low_pass_Hz", value=low_pass)
    frequency = fundamental * np.arange(count + 1)
    value = response.at(frequency)
    size, static = np.abs(value), abs(response.value[0])
    worst = int(np.argmin(size))
    if size[worst] <= least * static:
        rule = f"response at {frequency[worst]:.4g} Hz is too small to divide by"
        raise InputError(rule, where=f"{response.source}: frequency response", value=float(f"{size[worst]:.4g}"))
    epsilon = (regularisation * static) ** 2
    inverse = value.conj() / (size**2 + epsilon)
    return Division(inverse, size**2 / (size**2 + epsilon))
