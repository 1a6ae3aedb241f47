"""The Gaussian profile filter of ISO 16610-21, with ends kept by local regression (ISO 16610-28, -31)."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from profiles import InputError

ALPHA = math.sqrt(math.log(2.0) / math.pi)
"""Half transmission at the cut-off: exp(-pi ALPHA^2) = 1/2 (ISO 16610-21, 4.2)."""

_FINE = 4.99  # points a cut-off from which samples of the Gaussian transmit as it does, to 2e-5
_COARSE_HALF = 32

_TOGETHER = 4  # blocks transformed at once: two fill the processor's vectors, more than eight leave the cache

ENDS = ("regression", "normalised", "reflect", "periodic")


def gaussian_transmission(wavelength: np.ndarray | float, cutoff: float) -> np.ndarray | float:
    """Share of a wave's amplitude in the mean line.

    .. math:: A_1/A_0 = \\exp[-\\pi (\\alpha \\lambda_c/\\lambda)^2] = 2^{-(\\lambda_c/\\lambda)^2}

    Lengths in m, any shape. Exact for the endless continuous filter. ISO 16610-21, eq. 4.

    >>> gaussian_transmission(0.8e-3, 0.8e-3), 1 - gaussian_transmission(0.4e-3, 0.8e-3)
    (0.5, 0.9375)
    """
    return 2.0 ** -((cutoff / wavelength) ** 2)


def gaussian_kernel(cutoff: float, spacing: float, *, floored: bool = False) -> np.ndarray:
    """Weights of the mean line at whole samples, cut at one cut-off to either side and normalised.

    .. math:: s(x) = \\exp[-\\pi (x/\\alpha\\lambda_c)^2] / (\\alpha\\lambda_c)

    ``floored`` first lowers the cut-off to a whole number of samples, as the NIST surface metrology service does. The
    weights beyond the cut are 3e-7 of the whole. ISO 16610-21, eq. 1. With fewer than five points a cut-off, samples of
    the Gaussian would transmit too much (0.89 at two points): there the weights transmit eq. 4 exactly at equal steps
    of the wavenumber, with a ripple of at most 0.007 between them.

    >>> kernel = gaussian_kernel(0.8e-6, 0.25e-6, floored=True)
    >>> kernel.size, round(float(kernel.sum()), 12)
    (7, 1.0)
    """
    half = math.floor(cutoff / spacing + 1e-9)
    if half < 1:
        raise InputError(
            f"the cut-off must be at least the spacing of {spacing * 1e6:g} um",
            where="filter cut-off (um)",
            value=round(cutoff * 1e6, 9),
        )
    if not floored and cutoff < _FINE * spacing:
        wavenumber = np.fft.rfftfreq(2 * _COARSE_HALF + 1, spacing)
        return np.fft.fftshift(np.fft.irfft(2.0 ** -((cutoff * wavenumber) ** 2), 2 * _COARSE_HALF + 1))
    width = (half if floored else cutoff / spacing) * ALPHA
    weights = np.exp(-np.pi * (np.arange(-half, half + 1) / width) ** 2)
    return weights / weights.sum()


def gaussian_mean_line(
    heights: np.ndarray,
    spacing: float,
    cutoff: float,
    *,
    ends: str = "regression",
    floored: bool = False,
    valid: np.ndarray | None = None,
) -> np.ndarray:
    """Gaussian mean line, as long as the heights (m).

    Ends: ``regression`` fits a local straight line under the cut weights, so no length is lost and a slope
    passes unchanged; ``normalised`` fits a local constant; ``reflect`` mirrors; ``periodic`` wraps. Points
    that are not ``valid`` get no weight. Agrees with direct summation to 1e-15 of the largest height.

    >>> slope = np.linspace(0.0, 1e-6, 500)
    >>> bool(np.allclose(gaussian_mean_line(slope, 1e-6, 1e-4), slope, rtol=0, atol=1e-18))
    True
    """
    if ends not in ENDS:
        raise InputError(f"must be one of {', '.join(ENDS)}", where="filter ends", value=ends)
    kernel = gaussian_kernel(cutoff, spacing, floored=floored)
    half = kernel.size // 2
    if ends in ("reflect", "periodic") and (valid is None or valid.all()):
        padded = np.pad(heights, half, mode="symmetric" if ends == "reflect" else "wrap")
        return convolve(padded, kernel)[half:-half]
    order = 1 if ends == "regression" else 0
    gaps = valid is not None and not valid.all()
    if gaps or heights.size < 4 * half:
        weights = np.ones(heights.size) if valid is None else valid.astype(float)
        return local_regression(heights, weights, kernel, order=order)
    mean_line = convolve(heights, kernel)
    left, right = _half_kernels(heights, mean_line, kernel, order)
    mean_line[:half], mean_line[: -half - 1 : -1] = left, right
    return mean_line


def _half_kernels(heights: np.ndarray, summed: np.ndarray, kernel: np.ndarray, order: int) -> np.ndarray:
    """Local constant or line at the first half kernel of points, from either end of the trace inwards.

    ``summed`` are the sums that stop at the end of the trace. The sums of weights are running sums of the
    kernel, so only the first moment of the heights is new; both ends are transformed together.
    """
    from scipy.fft import irfft, next_fast_len, rfft

    half = kernel.size // 2
    lever = np.arange(-half, half + 1) / half
    sums = [np.cumsum((kernel * lever**k)[::-1])[half : 2 * half] for k in range(2 * order + 1)]
    level = np.stack((summed[:half], summed[: -half - 1 : -1]))
    if order == 0:
        return level / sums[0]
    # what wraps round at this length falls outside the points that are wanted
    size = next_fast_len(3 * half + 1, real=True)
    outer = np.stack((heights[: 2 * half], heights[: -2 * half - 1 : -1]))
    tilt = irfft(rfft(outer, size) * _spectrum((-kernel * lever).tobytes(), size), size)[:, half : 2 * half]
    return (sums[2] * level - sums[1] * tilt) / (sums[2] * sums[0] - sums[1] ** 2)


def local_regression(heights: np.ndarray, weights: np.ndarray, kernel: np.ndarray, *, order: int) -> np.ndarray:
    """Value at each point of the polynomial fitted around it under kernel times weights.

    Order 0, 1 or 2, as the Gaussian regression filters of ISO 16610-31 (eq. 1). All sums are convolutions,
    so the cost is n log n. Where no weighted point lies within the kernel, the height itself is kept.
    """
    half = kernel.size // 2
    lever = -np.arange(-half, half + 1) / half
    sums = [convolve(weights, kernel * lever**k) for k in range(2 * order + 1)]
    loads = [convolve(weights * heights, kernel * lever**k) for k in range(order + 1)]
    with np.errstate(divide="ignore", invalid="ignore"):
        if order == 0:
            top, bottom = loads[0], sums[0]
        elif order == 1:
            top = sums[2] * loads[0] - sums[1] * loads[1]
            bottom = sums[2] * sums[0] - sums[1] ** 2
        else:
            a = sums[2] * sums[4] - sums[3] ** 2
            b = sums[2] * sums[3] - sums[1] * sums[4]
            c = sums[1] * sums[3] - sums[2] ** 2
            top = a * loads[0] + b * loads[1] + c * loads[2]
            bottom = a * sums[0] + b * sums[1] + c * sums[2]
        fitted = top / bottom
    return np.where((sums[0] > 1e-9) & np.isfinite(fitted), fitted, heights)


@lru_cache(maxsize=16)
def _spectrum(kernel: bytes, size: int) -> np.ndarray:
    """Transform of a kernel; cached, as a batch of traces passes the same few filters."""
    from scipy.fft import rfft

    found: np.ndarray = rfft(np.frombuffer(kernel), size)
    found.flags.writeable = False
    return found


def convolve(values: np.ndarray, kernel: np.ndarray) -> np.ndarray:
    """Convolution of the same length as the values, with zeros beyond them; odd kernel.

    Short kernels are summed directly; long ones go through transforms of blocks that stay in cache, a few at a time
    because that halves their cost. Memory: the values, the result and a few blocks.
    """
    half = kernel.size // 2
    if kernel.size <= 25 or values.size <= 64:
        return np.convolve(values, kernel, "full")[half : half + values.size]
    from scipy.fft import irfft, next_fast_len, rfft

    # five times a power of two transforms fastest, and six kernels a block waste little
    block = 5 * 2 ** math.ceil(math.log2(max(6 * kernel.size, 20480) / 5))
    size = min(next_fast_len(values.size + 2 * half, real=True), block)
    step = size - 2 * half
    blocks = -(-values.size // step)
    padded = np.pad(values, (half, half + blocks * step - values.size))
    windows = np.lib.stride_tricks.sliding_window_view(padded, size)[::step]
    spectrum = _spectrum(kernel.tobytes(), size)
    result = np.empty(values.size)
    for first in range(0, blocks, _TOGETHER):
        waves = rfft(windows[first : first + _TOGETHER])
        waves *= spectrum
        whole = irfft(waves, size, overwrite_x=True)[:, 2 * half :].reshape(-1)
        part = result[first * step : (first + _TOGETHER) * step]
        part[:] = whole[: part.size]
    return result
