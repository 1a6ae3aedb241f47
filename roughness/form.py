"""Curved forms fitted to a trace: circle and involute flank."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from profiles import InputError, Profile


def circle(profile: Profile) -> tuple[np.ndarray, float]:
    """Heights (m) and radius (m) of the circle with the least squared distance to the valid points.

    >>> x = np.linspace(-1e-3, 1e-3, 401)
    >>> shape, radius = circle(Profile(np.sqrt(1e-4 - x**2), 5e-6))
    >>> round(radius * 1e3, 9)
    10.0
    """
    half = profile.length / 2
    x = (profile.positions - half) / half
    start = _parabola(profile)

    # curvature, slope and height at the middle stay finite where centre and radius would run away
    def heights(free: np.ndarray) -> np.ndarray:
        top, slope, curvature = free
        cosine = 1.0 / np.sqrt(1.0 + slope**2)
        u = np.clip(1.0 - (slope * cosine + curvature * x) ** 2, 1e-12, None)
        return top + (cosine - np.sqrt(u)) / curvature

    def across(free: np.ndarray) -> np.ndarray:
        return np.sqrt(np.clip(1.0 - (free[1] + free[2] * x) ** 2, 0.0, 1.0))

    found = _fit(profile, heights, across, (start[0], start[1], 2.0 * start[2]))
    return heights(found) * half, float(half / abs(found[2]))


def involute(profile: Profile, base_radius: float) -> tuple[np.ndarray, float]:
    r"""Heights (m) of the involute of a base radius (m) nearest to the trace, and its radius in the middle.

    From roll angle :math:`\\theta_0`, over the roll u and along the tangent there,

    .. math:: x = r_b(\\theta_0\\sin u + u\\sin u + \\cos u - 1), \\quad
              y = r_b(\\theta_0(1 - \\cos u) + \\sin u - u\\cos u)

    with the radius of curvature r_b times roll angle. Convex or concave, run from root to tip or back: the direction
    with the better fit is kept.

    >>> u = np.linspace(-0.05, 0.05, 20001)
    >>> x = 0.033 * (0.4 * np.sin(u) + u * np.sin(u) + np.cos(u) - 1)
    >>> y = 0.033 * (0.4 * (1 - np.cos(u)) + np.sin(u) - u * np.cos(u))
    >>> flank = -np.interp(np.linspace(-5e-4, 5e-4, 1001), x, y)
    >>> shape, radius = involute(Profile(flank, 1e-6), 0.033)
    >>> round(radius * 1e3, 2)
    13.2
    """
    half = profile.length / 2
    x = (profile.positions - half) / half
    base = base_radius / half
    height, slope, bend = _parabola(profile)
    sign = -1.0 if bend < 0 else 1.0
    roll = float(np.clip(1.0 / (2.0 * abs(bend) * base), 1e-3, 10.0))

    def shape(free: np.ndarray, direction: float) -> np.ndarray:
        top, tilt, theta = free[0], free[1], abs(free[2])
        widest = min(1.5 / (base * theta), 0.999 * theta)
        u = np.linspace(-widest, widest, 801)
        along = base * (theta * np.sin(u) + u * np.sin(u) + np.cos(u) - 1.0)
        off = base * (theta * (1.0 - np.cos(u)) + np.sin(u) - u * np.cos(u))
        from scipy.interpolate import CubicSpline

        return top + tilt * x + sign * CubicSpline(along, off)(direction * x)

    results = []
    for direction in (1.0, -1.0):

        def heights(free: np.ndarray, direction: float = direction) -> np.ndarray:
            return shape(free, direction)

        found = _fit(profile, heights, lambda free: 1.0, (height, slope, roll))
        fitted = heights(found)
        left = (profile.heights / half - fitted)[profile.valid]
        results.append((float(left @ left), fitted, abs(float(found[2]))))
    _, fitted, theta = min(results, key=lambda r: r[0])
    return fitted * half, base_radius * theta


def _parabola(profile: Profile) -> np.ndarray:
    """Height, slope and half the curvature in the middle, in half lengths."""
    half = profile.length / 2
    mask = profile.valid
    x = (profile.positions - half) / half
    start = np.polynomial.polynomial.polyfit(x[mask], profile.heights[mask] / half, 2)
    if abs(start[2]) < 1e-9:
        raise InputError("is too straight for a curved form; use line", where=f"profile {profile.name!r}")
    return start


def _fit(
    profile: Profile,
    heights: Callable[[np.ndarray], np.ndarray],
    across: Callable[[np.ndarray], np.ndarray | float],
    start: tuple[float, float, float],
) -> np.ndarray:
    from scipy.optimize import least_squares

    mask = profile.valid
    z = profile.heights / (profile.length / 2)

    def distance(free: np.ndarray) -> np.ndarray:
        return ((z - heights(free)) * across(free))[mask]

    scale = (1e-3, 1e-3, max(abs(start[2]), 1e-9))
    return least_squares(distance, start, x_scale=scale, xtol=1e-15, ftol=1e-15, gtol=1e-15).x
