"""Gaussian traces of exact spectrum or moments, self-affine traces, and heights bent to given Ra, Rq, Rz.

Random numbers are taken raw from the PCG64 stream, which numpy keeps stable, so a seed gives the same trace under every
version.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from profiles.errors import InputError
from profiles.profile import Profile

Spectrum = Callable[[np.ndarray], np.ndarray]
Measure = Callable[[np.ndarray], tuple[float, float, float]]


@dataclass(frozen=True, eq=False)
class Synthetic:
    """A trace and its exact or measured moments: mean squares of height m0 (m2), slope m2 and curvature m4 (1/m2).
    ``exact``: moments of the continuous trace, from its Fourier coefficients; else by differences of the heights."""

    profile: Profile
    m0: float
    m2: float
    m4: float
    exact: bool

    @property
    def bandwidth(self) -> float:
        """Nayak's alpha = m0 m4 / m2^2."""
        return self.m0 * self.m4 / self.m2**2


def uniform(seed: int, count: int) -> np.ndarray:
    """Numbers in (0, 1) from the raw stream of a seed, the same under every version of numpy.

    >>> uniform(1, 2).round(6)
    array([0.511822, 0.950464])
    """
    if not 0 <= seed < 2**64:
        raise InputError("must be a whole number from 0 to 2^64 - 1", where="seed", value=seed)
    raw = np.random.PCG64(seed).random_raw(count)
    return ((raw >> np.uint64(11)).astype(float) + 0.5) * 2.0**-53


def from_spectrum(spectrum: Spectrum, *, points: int, spacing: float, seed: int, name: str = "synthetic") -> Synthetic:
    """Gaussian trace of a one-sided power spectrum S(q) (m3) of angular wavenumber q (rad/m).

    .. math:: z(x) = \\sum_k \\sqrt{2 S(q_k) \\Delta q} \\cos(q_k x + \\varphi_k),\\quad m_n = \\int S q^n dq

    Amplitudes are fixed and phases random, so the moments of this trace are exactly the sums of the spectrum; heights
    are Gaussian by the number of waves. The trace closes on itself; waves shorter than two steps are left out.

    >>> wave = from_spectrum(lambda q: np.exp(-((q * 5e-6 - 1) ** 2)), points=4096, spacing=1e-6, seed=1)
    >>> bool(np.isclose(np.mean(wave.profile.heights**2), wave.m0, rtol=1e-12))
    True
    """
    step = 2 * math.pi / (points * spacing)
    q = step * np.arange(1, (points + 1) // 2)
    power = np.asarray(spectrum(q), dtype=float) * step
    if not np.isfinite(power).all() or (power < 0).any() or not power.any():
        raise InputError("the spectrum must be finite, not negative and not all zero", where=f"synthesis of {name!r}")
    phases = 2 * math.pi * uniform(seed, q.size)
    coefficients = np.zeros(points // 2 + 1, complex)
    coefficients[1 : q.size + 1] = np.sqrt(power / 2) * points * np.exp(1j * phases)
    heights = np.fft.irfft(coefficients, points)
    profile = Profile(heights, spacing, name=name, origin={"synthetic": True, "seed": seed})
    return Synthetic(profile, float(power.sum()), float(power @ q**2), float(power @ q**4), exact=True)


def self_affine_spectrum(hurst: float, rolloff: float, shortest: float) -> Spectrum:
    """Shape of a self-affine profile: flat above the roll-off wavelength, q^(-1-2H) down to the shortest.

    Wavelengths in m; 0 < H < 1. To be scaled. Persson et al., J. Phys.: Condens. Matter 17 (2005) R1, sec. 2.
    """
    if not (0 < hurst < 1 and 0 < shortest < rolloff):
        raise InputError(
            "needs 0 < Hurst exponent < 1 and 0 < shortest < roll-off wavelength",
            where="self-affine spectrum",
            value=(hurst, shortest, rolloff),
        )
    low, high = 2 * math.pi / rolloff, 2 * math.pi / shortest

    def shape(q: np.ndarray) -> np.ndarray:
        return np.where(q <= high, np.maximum(q / low, 1.0) ** (-1 - 2 * hurst), 0.0)

    return shape


def self_affine(
    rms: float,
    *,
    hurst: float,
    rolloff: float,
    shortest: float,
    points: int,
    spacing: float,
    seed: int,
    name: str = "self-affine",
) -> Synthetic:
    """Gaussian self-affine trace of the given rms height (m), Hurst exponent and band of wavelengths (m).

    >>> t = self_affine(1e-7, hurst=0.8, rolloff=1e-4, shortest=2e-6, points=8192, spacing=5e-7, seed=3)
    >>> round(t.m0, 17), t.exact
    (1e-14, True)
    """
    shape = self_affine_spectrum(hurst, rolloff, shortest)
    return scaled(from_spectrum(shape, points=points, spacing=spacing, seed=seed, name=name), rms)


def scaled(trace: Synthetic, rms: float) -> Synthetic:
    """The trace stretched in height to an rms value (m)."""
    if not (math.isfinite(rms) and rms > 0):
        raise InputError("must be above zero", where="rms height (m)", value=rms)
    factor = rms**2 / trace.m0
    profile = trace.profile
    stretched = Profile(profile.heights * math.sqrt(factor), profile.spacing, name=profile.name, origin=profile.origin)
    return Synthetic(stretched, rms**2, trace.m2 * factor, trace.m4 * factor, trace.exact)


def of_moments(
    m0: float, m2: float, m4: float, *, points: int, spacing: float, seed: int, name: str = "moments"
) -> Synthetic:
    """Gaussian trace of exactly the given m0 (m2), m2 and m4 (1/m2).

    The spectrum is lognormal in q: with mean mu and variance s^2 of ln q its moments are

    .. math:: m_n = m_0 \\exp(n \\mu + n^2 s^2/2), \\quad \\alpha = m_0 m_4/m_2^2 = e^{4 s^2}

    so every alpha above 1 is reached; mu and s are then moved until the sums over the waves of the trace are exact to
    1e-12. The trace must hold the band, else its length or spacing is an error.

    >>> t = of_moments(1e-14, 2.5e-3, 3.6e9, points=20000, spacing=2.5e-7, seed=1)
    >>> bool(np.allclose([t.m0, t.m2, t.m4], [1e-14, 2.5e-3, 3.6e9], rtol=1e-10))
    True
    """
    values = (m0, m2, m4)
    if not all(math.isfinite(m) and m > 0 for m in values) or m0 * m4 <= m2**2 * (1 + 1e-9):
        raise InputError("moments must be above zero with m0 m4 > m2^2", where=f"synthesis of {name!r}", value=values)
    step = 2 * math.pi / (points * spacing)
    q = step * np.arange(1, (points + 1) // 2)
    spread = math.sqrt(math.log(m0 * m4 / m2**2) / 4)
    center = 0.5 * math.log(m2 / m0) - spread**2
    exact = None
    for _ in range(60):
        power = _lognormal(q, center, spread)
        total = power.sum()
        first, second = (power @ q**2) / total, (power @ q**4) / total
        if not (0 < first < math.inf and 0 < second < math.inf):
            break
        miss = math.log(first * m0 / m2), math.log(second * m0 / m4)
        if max(map(abs, miss)) < 1e-13:
            exact = power * (m0 / (total * step))
            break
        grow = (miss[1] - 2 * miss[0]) / 4  # what s^2 has too much
        spread = math.sqrt(max(spread**2 - grow, spread**2 / 4))
        center -= miss[0] / 2 - grow
    if exact is not None:
        return from_spectrum(lambda q: exact, points=points, spacing=spacing, seed=seed, name=name)
    raise InputError(
        f"a trace of {points} points every {spacing * 1e6:g} um cannot hold the band these moments need",
        where=f"synthesis of {name!r}",
        value=values,
    )


def _lognormal(q: np.ndarray, center: float, spread: float) -> np.ndarray:
    log_q = np.log(q)
    return np.exp(-0.5 * ((log_q - center) / spread) ** 2 - log_q)


def reshape_tails(
    heights: np.ndarray,
    rms: float,
    cubic: float,
    extremes: float,
    long: np.ndarray | None = None,
    knee: float = 2.2,
) -> np.ndarray:
    """Heights bent by a monotone curve: ``cubic`` widens or narrows all, ``extremes`` stretches the outliers.

    .. math:: z = R [w + c (v^3 - 3 v) + (e - 1)\\,\\mathrm{sgn}(v) \\max(|v| - k, 0)]

    w is the heights over their rms and v = w, or ``long`` over its rms, so that the bending follows the long waves and
    leaves their fine texture unchanged. Nothing is bent at c = 0, e = 1; beyond the knee k = 2.2 lie 2.8 % of a
    Gaussian surface.

    >>> reshape_tails(np.array([-1.0, 1.0]), 2.0, 0.0, 1.5)
    array([-2.,  2.])
    """
    w = _standard(heights)
    v = w if long is None else _standard(long)
    beyond = np.maximum(np.abs(v) - knee, 0.0)
    return rms * (w + cubic * (v**3 - 3 * v) + (extremes - 1.0) * np.sign(v) * beyond)


def _standard(heights: np.ndarray) -> np.ndarray:
    w = heights - heights.mean()
    return w / np.sqrt(np.mean(w**2))


def long_waves(heights: np.ndarray, spacing: float, shortest: float) -> np.ndarray:
    """Waves of a closed trace longer than ``shortest`` (m), by its Fourier series.

    >>> x = np.arange(64) * 1e-6
    >>> long_waves(np.cos(2 * np.pi * x / 4e-6), 1e-6, 8e-6).round(12).any()
    np.False_
    """
    coefficients = np.fft.rfft(heights)
    coefficients[np.fft.rfftfreq(heights.size, spacing) > 1.0 / shortest] = 0.0
    return np.fft.irfft(coefficients, heights.size)


def ra_rq_rz(heights: np.ndarray, sections: int = 1) -> tuple[float, float, float]:
    """Mean |z|, rms z and height from lowest to highest, each the mean over the sampling lengths.

    About the zero line. ISO 4287:1997, 4.1 and 4.2.

    >>> ra_rq_rz(np.array([-1.0, 1.0, -3.0, 3.0]), sections=2)
    (2.0, 2.0, 4.0)
    """
    parts = np.array_split(heights, sections)
    table = [(np.abs(z).mean(), np.sqrt(np.mean(z**2)), z.max() - z.min()) for z in parts]
    ra, rq, rz = np.mean(table, axis=0)
    return float(ra), float(rq), float(rz)


def fitted_tails(
    base: Profile,
    ra: float,
    rq: float,
    rz: float,
    measure: Measure,
    long: np.ndarray | None = None,
    knee: float = 2.2,
) -> tuple[float, float, float]:
    """The rms, cubic and extremes of :func:`reshape_tails` that give the base trace Ra, Rq and Rz (m). ``measure``
    takes heights to (Ra, Rq, Rz), filter included. An error if no gentle bending reaches the three numbers."""
    from scipy.optimize import least_squares

    target = np.log([ra, rq, rz])

    def miss(free: np.ndarray) -> np.ndarray:
        heights = reshape_tails(base.heights, rq * math.exp(free[0]), free[1], math.exp(free[2]), long, knee)
        return np.log(measure(heights)) - target

    found = least_squares(miss, [0.0, 0.0, 0.0], bounds=([-1, -0.05, -3], [1, 0.1, 2]), xtol=1e-14, ftol=1e-15)
    if np.abs(found.fun).max() > 1e-6:
        raise InputError(
            "no gentle reshaping of this trace gives these Ra, Rq, Rz (another seed or roll-off may)",
            where=f"synthesis of {base.name!r}",
            value=(ra, rq, rz),
        )
    return rq * math.exp(found.x[0]), float(found.x[1]), math.exp(found.x[2])


def of_heights(
    base: Profile, *, ra: float, rq: float, rz: float, measure: Measure | None = None, sections: int = 6
) -> Synthetic:
    """Trace of given Ra, Rq, Rz (m): the base trace with its tails bent and its waves kept. Without ``measure`` the
    three are means of the unfiltered heights over ``sections`` sampling lengths; ``measure`` may include a filter in
    their definition. Moments are measured by differences.

    >>> base = self_affine(1e-7, hurst=0.7, rolloff=9e-5, shortest=2e-6, points=9600, spacing=5e-7, seed=4)
    >>> t = of_heights(base.profile, ra=2.19e-7, rq=2.74e-7, rz=1.40e-6)
    >>> [round(v * 1e6, 6) for v in ra_rq_rz(t.profile.heights, sections=6)]
    [0.219, 0.274, 1.4]
    """
    chosen = measure or (lambda heights: ra_rq_rz(heights, sections))
    rms, cubic, extremes = fitted_tails(base, ra, rq, rz, chosen)
    origin = {**base.origin, "rms_m": rms, "cubic": cubic, "extremes": extremes}
    heights = reshape_tails(base.heights, rms, cubic, extremes)
    return measured(Profile(heights, base.spacing, name=base.name, origin=origin))


def measured(profile: Profile) -> Synthetic:
    """The trace with moments by first and second differences, for traces without exact ones."""
    first = np.diff(profile.heights) / profile.spacing
    second = np.diff(first) / profile.spacing
    m0 = np.mean((profile.heights - profile.heights.mean()) ** 2)
    return Synthetic(profile, float(m0), float(np.mean(first**2)), float(np.mean(second**2)), exact=False)
