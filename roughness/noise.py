"""Noise and height steps of the instrument in the moments, and the limits of its tip."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from profiles import InputError, Profile
from profiles.profile import of_profile
from roughness.filters import gaussian_kernel
from roughness.moments import Moments


@of_profile
def height_quantum(profile: Profile) -> float | None:
    """Step between the height levels of a digitised trace (m); None for heights without levels. Use the trace as read:
    any filter blurs the levels.

    >>> height_quantum(Profile(np.round(np.sin(np.arange(500.0)) * 20) * 0.076e-6, 1e-6))
    7.6e-08
    """
    levels = np.unique(profile.heights)
    if not 3 <= levels.size <= 0.7 * profile.heights.size:
        return None
    steps = np.diff(levels)
    # the same level read through decimal text differs in the last digits
    steps = steps[steps > 1e-9 * (levels[-1] - levels[0])]
    return float(np.round(np.median(steps), 15)) if steps.size else None


def noise_moments(sigma: float, spacing: float, short_cutoff: float | None = None) -> tuple[float, float, float]:
    r"""Contribution of white noise to m0, m2 and m4 by differences, before or after the short cut-off.

    .. math:: \sigma^2,\quad 2\sigma^2/\Delta^2,\quad 6\sigma^2/\Delta^4

    times the share of each that passes the Gaussian low-pass. A quantum q has sigma = q/sqrt(12). Lengths in m. Exact
    for noise without correlation.

    >>> noise_moments(2.0, 0.5)
    (4.0, 32.0, 384.0)
    """
    weights = np.ones(1) if short_cutoff is None else gaussian_kernel(short_cutoff, spacing)
    first, second = np.convolve(weights, (1.0, -1.0)), np.convolve(weights, (1.0, -2.0, 1.0))
    gains = (weights @ weights, first @ first / spacing**2, second @ second / spacing**4)
    m0, m2, m4 = (float(sigma**2 * gain) for gain in gains)
    return m0, m2, m4


def without_noise(moments: Moments, sigma: float) -> Moments:
    """Moments less the contribution of white noise of a known sigma (m).

    >>> bare = Moments(1e-14, 1e-3, 1e9, spacing=1e-6, estimator="differences")
    >>> round(without_noise(bare, 5e-9).m4 / 1e9, 4)
    0.85
    """
    if moments.spacing is None:
        raise InputError("the spacing must be known to take noise off", where="moments")
    added = noise_moments(sigma, moments.spacing, moments.short_cutoff)
    left = [m - a for m, a in zip((moments.m0, moments.m2, moments.m4), added)]
    if min(left) <= 0:
        raise InputError(
            "is as large as the roughness: nothing is left of m0, m2 or m4",
            where="noise sigma (m)",
            value=sigma,
        )
    return replace(moments, m0=left[0], m2=left[1], m4=left[2], estimator=f"{moments.estimator}, noise removed")


@of_profile
def tip_traced(profile: Profile, radius: float) -> Profile:
    """Trace drawn by a round tip of a radius (m): the height of its lowest point while resting on the surface.

    Grey dilation by the arc of the tip; valleys narrower than the tip are filled.

    >>> pit = Profile(np.array([0.0, 0.0, -1.0, 0.0, 0.0]) * 1e-6, 1e-6)
    >>> bool(tip_traced(pit, 5e-6).heights[2] > -0.2e-6)
    True
    """
    from scipy.ndimage import grey_dilation

    arc = _tip_arc(profile, radius)
    drawn = grey_dilation(profile.heights, structure=-arc, mode="nearest")
    return profile.after(f"traced by a tip of {radius * 1e6:g} um", drawn)


@of_profile
def tip_reconstructed(profile: Profile, radius: float) -> Profile:
    """Highest surface that gives this trace under a round tip of a radius (m).

    Grey erosion by the arc; equal to the surface wherever the tip touched it.
    """
    from scipy.ndimage import grey_erosion

    arc = _tip_arc(profile, radius)
    return profile.after(
        f"reconstructed for a tip of {radius * 1e6:g} um",
        grey_erosion(profile.heights, structure=-arc, mode="nearest"),
    )


def tip_limited_wavelength(profile: Profile, radius: float) -> float:
    """Shortest wavelength (m) that a tip of a radius (m) can have drawn without touching with its flanks.

    Curvature over a lever l is (z(x+l) - 2z(x) + z(x-l))/l^2; below the l at which the sharpest valley
    reaches half the tip's curvature the trace shows the tip. A wave spans about four levers. 0 where every
    scale is clean. After the reliability cut-off of Jacobs, Junge and Pastewka, Surf. Topogr. 5
    (2017) 013001.

    >>> tip_limited_wavelength(Profile(1e-8 * np.sin(np.arange(400) / 20), 1e-6), 2e-6)
    0.0
    """
    z = profile.heights
    limited = 0.0
    for step in np.unique(np.geomspace(1, max(z.size // 8, 2), 40).astype(int)):
        lever = step * profile.spacing
        curvature = z[2 * step :] - 2.0 * z[step:-step] + z[: -2 * step]
        if curvature.max() / lever**2 >= 0.5 / radius:
            limited = 4.0 * lever
    return limited


def _tip_arc(profile: Profile, radius: float) -> np.ndarray:
    """Drop of the tip's outline at whole samples (m), as far out as the heights can reach."""
    if not radius > 0:
        raise InputError("must be above zero", where="tip radius (m)", value=radius)
    reach = min(radius, float(np.sqrt(2.0 * radius * np.ptp(profile.heights))) + profile.spacing)
    half = max(int(reach / profile.spacing), 1)
    x = np.arange(-half, half + 1) * profile.spacing
    return radius - np.sqrt(np.maximum(radius**2 - x**2, 0.0))
