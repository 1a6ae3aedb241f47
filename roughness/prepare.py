"""From a trace to the profile that is evaluated: form removal, filters, trimming; every step recorded."""

from __future__ import annotations

import numpy as np

from profiles import InputError, Profile
from profiles.errors import nearest
from roughness.filters import gaussian_mean_line

FORMS = ("none", "mean", "line", "polynomial-N", "circle")


def level(profile: Profile) -> Profile:
    """Take off the least-squares straight line."""
    return remove_form(profile, "line")


def remove_form(profile: Profile, form: str) -> Profile:
    """Take off the least-squares form: ``none``, ``mean``, ``line``, ``polynomial-2``, ``circle``.

    Polynomials of any degree to 20; the circle by orthogonal distance. Masked points do not pull the fit.

    >>> p = Profile(np.array([1.0, 2.0, 3.0, 4.5, 5.0]) * 1e-6, 1e-6)
    >>> remove_form(p, "line").steps
    ('form line removed',)
    """
    if form == "none":
        return profile
    if form == "circle":
        radius, shape = _circle(profile)
        return profile.after(f"form circle removed, radius {radius * 1e3:.6g} mm", profile.heights - shape)
    degree = _degree(form)
    x = np.linspace(-1.0, 1.0, profile.heights.size)
    mask = _mask(profile)
    basis = np.polynomial.legendre.legvander(x, degree)
    normal, load = basis[mask].T @ basis[mask], basis[mask].T @ profile.heights[mask]
    fitted = basis @ np.linalg.solve(normal, load)
    return profile.after(f"form {form} removed", profile.heights - fitted)


def roughness_profile(
    profile: Profile,
    *,
    cutoff: float | None = None,
    short_cutoff: float | None = None,
    ends: str = "regression",
    floored: bool = False,
    trim_cutoffs: float = 0.0,
) -> Profile:
    """The band between the short cut-off lambda_s and the cut-off lambda_c (m); either may be left out.

    ``ends`` and ``floored`` as in :func:`roughness.filters.gaussian_mean_line`; ``trim_cutoffs`` cuts that
    many cut-offs off each end afterwards (instruments cut 0.5). ISO 16610-21, ISO 3274.
    """
    result = profile
    if short_cutoff is not None:
        result = primary_profile(result, short_cutoff, ends=ends, floored=floored)
    if cutoff is not None:
        if short_cutoff is not None and not short_cutoff < cutoff:
            raise InputError(
                f"short cut-off must be below the cut-off of {cutoff * 1e6:g} um",
                where=f"profile {profile.name!r}: short cut-off (um)",
                value=short_cutoff * 1e6,
            )
        if cutoff > profile.length:
            raise InputError(
                f"the trace of {profile.length * 1e3:g} mm is shorter than the cut-off",
                where=f"profile {profile.name!r}: cut-off (mm)",
                value=cutoff * 1e3,
            )
        mean_line = _mean_line(result, cutoff, ends, floored)
        result = result.after(
            f"Gaussian high-pass, cut-off {cutoff * 1e3:.6g} mm, ends {ends}",
            result.heights - mean_line,
            cutoffs={**result.cutoffs, "cutoff": cutoff},
        )
        if trim_cutoffs:
            result = trim(result, trim_cutoffs * cutoff, trim_cutoffs * cutoff)
    return result


def primary_profile(
    profile: Profile, short_cutoff: float, *, ends: str = "regression", floored: bool = False
) -> Profile:
    """The trace without what is shorter than lambda_s (m). ISO 3274, ISO 16610-21."""
    return profile.after(
        f"Gaussian low-pass, short cut-off {short_cutoff * 1e6:.6g} um, ends {ends}",
        _mean_line(profile, short_cutoff, ends, floored),
        cutoffs={**profile.cutoffs, "short_cutoff": short_cutoff},
    )


def waviness_profile(
    profile: Profile, cutoff: float, *, ends: str = "regression", floored: bool = False
) -> Profile:
    """What is longer than the cut-off (m): the mean line that the roughness profile leaves behind."""
    return profile.after(
        f"Gaussian low-pass, cut-off {cutoff * 1e3:.6g} mm, ends {ends}",
        _mean_line(profile, cutoff, ends, floored),
        cutoffs={**profile.cutoffs, "short_cutoff": cutoff},
    )


def trim(profile: Profile, start: float = 0.0, end: float = 0.0) -> Profile:
    """Cut lengths (m) off the two ends.

    >>> trim(Profile(np.arange(9.0), 1e-6), 2e-6, 1e-6).heights
    array([2., 3., 4., 5., 6., 7.])
    """
    first = round(start / profile.spacing)
    last = profile.heights.size - round(end / profile.spacing)
    if start < 0 or end < 0 or last - first < 3:
        raise InputError(
            f"no profile of {profile.length * 1e3:g} mm is left after trimming",
            where=f"profile {profile.name!r}: trimmed lengths (mm)",
            value=(start * 1e3, end * 1e3),
        )
    return profile.after(
        f"trimmed {start * 1e3:.6g} mm and {end * 1e3:.6g} mm",
        profile.heights[first:last],
        valid=_mask(profile)[first:last],
    )


def _mean_line(profile: Profile, cutoff: float, ends: str, floored: bool) -> np.ndarray:
    return gaussian_mean_line(
        profile.heights, profile.spacing, cutoff, ends=ends, floored=floored, valid=_mask(profile)
    )


def _mask(profile: Profile) -> np.ndarray:
    return np.asarray(profile.valid)


def _degree(form: str) -> int:
    if form in ("mean", "line"):
        return 0 if form == "mean" else 1
    head, _, tail = form.partition("-")
    if head == "polynomial" and tail.isdigit() and int(tail) <= 20:
        return int(tail)
    raise InputError(f"must be a known form; {nearest(form, FORMS)}", where="form", value=form)


def _circle(profile: Profile) -> tuple[float, np.ndarray]:
    """Radius and heights of the circle with the least squared distance to the valid points."""
    from scipy.optimize import least_squares

    mask = _mask(profile)
    half = profile.length / 2
    x = (profile.positions - half) / half
    z = profile.heights / half
    a, b, c = np.polynomial.polynomial.polyfit(x[mask], z[mask], 2)
    if abs(c) < 1e-9:
        raise InputError("is too straight for a circle", where=f"profile {profile.name!r}", value=None)

    # curvature, slope and height at the middle stay finite where centre and radius would run away
    def heights(free: np.ndarray) -> np.ndarray:
        top, slope, curvature = free
        cosine = 1.0 / np.sqrt(1.0 + slope**2)
        sine = slope * cosine
        u = np.clip(1.0 - (sine + curvature * x) ** 2, 0.0, None)
        return top + (cosine - np.sqrt(u)) / curvature

    def distance(free: np.ndarray) -> np.ndarray:
        residual = z[mask] - heights(free)[mask]
        return residual * np.sqrt(np.clip(1.0 - (free[1] + free[2] * x[mask]) ** 2, 0.0, 1.0))

    found = least_squares(distance, (a, b, 2 * c), x_scale=(1e-3, 1e-3, abs(2 * c)), xtol=1e-15, ftol=1e-15)
    return float(half / abs(found.x[2])), heights(found.x) * half
