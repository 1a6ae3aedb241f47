"""Preparation of a trace for evaluation: form removal, filters, trimming; every step recorded."""

from __future__ import annotations

import math

import numpy as np

from profiles import InputError, Profile
from profiles.errors import nearest
from profiles.profile import of_profile
from roughness.filters import gaussian_mean_line
from roughness.form import circle, involute
from roughness.robust import robust_mean_line, spline_mean_line

METHODS = ("gaussian", "robust", "spline")
HIGHEST = 20
"""Highest degree of a polynomial form."""
FORMS = ("none", "mean", "line", "polynomial-N", "circle", "involute-RADIUS")


@of_profile
def level(profile: Profile) -> Profile:
    """Remove the least-squares straight line."""
    return remove_form(profile, "line")


@of_profile
def remove_form(profile: Profile, form: str) -> Profile:
    """Remove the least-squares form; masked points have no weight.

    ``none``, ``mean``, ``line``, ``polynomial-2`` (any degree to 20), ``circle`` (by orthogonal distance) or
    ``involute-33.245``, a tooth flank of that base radius in mm. Crowning and tip relief on top of these take a
    polynomial of degree 4 or more.

    >>> p = Profile(np.array([1.0, 2.0, 3.0, 4.5, 5.0]) * 1e-6, 1e-6)
    >>> remove_form(p, "line").steps
    ('form line removed',)
    """
    if form == "none":
        return profile
    if form == "circle":
        shape, radius = circle(profile)
        return profile.after(f"form circle removed, radius {radius * 1e3:.6g} mm", profile.heights - shape)
    if form.startswith("involute-"):
        shape, curvature_radius = involute(profile, _base_radius(form))
        return profile.after(
            f"form {form} removed, radius of curvature {curvature_radius * 1e3:.6g} mm in the middle",
            profile.heights - shape,
        )
    degree = _degree(form)
    x = np.linspace(-1.0, 1.0, profile.heights.size)
    mask = profile.valid
    basis = np.polynomial.legendre.legvander(x, degree)
    weighted = basis if mask.all() else basis * mask[:, None]
    fitted = basis @ np.linalg.solve(weighted.T @ basis, weighted.T @ profile.heights)
    return profile.after(f"form {form} removed", profile.heights - fitted)


@of_profile
def roughness_profile(
    profile: Profile,
    *,
    cutoff: float | None = None,
    short_cutoff: float | None = None,
    ends: str = "regression",
    floored: bool = False,
    trim_cutoffs: float = 0.0,
    method: str = "gaussian",
) -> Profile:
    """The band between the short cut-off lambda_s and the cut-off lambda_c (m); either may be left out.

    ``ends`` and ``floored`` as in :func:`roughness.filters.gaussian_mean_line`; ``trim_cutoffs`` cuts that
    many cut-offs off each end afterwards (instruments cut 0.5). ``method`` is the filter of the cut-off:
    ``gaussian`` (ISO 16610-21), ``robust`` (ISO 16610-31) or ``spline`` (ISO 16610-22), the last two with
    their own ends; the short cut-off is always Gaussian. ISO 3274.
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
        if method == "gaussian":
            mean_line, kind = _mean_line(result, cutoff, ends, floored), f"Gaussian high-pass, ends {ends}"
        elif method == "robust":
            mean_line = robust_mean_line(result.heights, result.spacing, cutoff, valid=result.valid)
            kind = "robust Gaussian regression high-pass"
        elif method == "spline":
            mean_line, kind = spline_mean_line(result.heights, result.spacing, cutoff), "spline high-pass"
        else:
            raise InputError(f"must be a known filter; {nearest(method, METHODS)}", where="method", value=method)
        rough = np.subtract(result.heights, mean_line, out=mean_line)
        # handed over for good, so the profile need not copy it
        rough.flags.writeable = False
        result = result.after(
            f"{kind}, cut-off {cutoff * 1e3:.6g} mm",
            rough,
            cutoffs={**result.cutoffs, "cutoff": min(cutoff, result.cutoffs.get("cutoff", cutoff))},
        )
        if trim_cutoffs:
            result = trim(result, trim_cutoffs * cutoff, trim_cutoffs * cutoff)
    return result


@of_profile
def primary_profile(
    profile: Profile, short_cutoff: float, *, ends: str = "regression", floored: bool = False
) -> Profile:
    """Primary profile: the trace without waves shorter than lambda_s (m). ISO 3274, ISO 16610-21.

    Two Gaussian low-passes in a row act as one; the squares of their cut-offs add, and the sum's root is recorded.
    """
    return profile.after(
        f"Gaussian low-pass, short cut-off {short_cutoff * 1e6:.6g} um, ends {ends}",
        smooth_bridges(_mean_line(profile, short_cutoff, ends, floored), profile.valid),
        cutoffs={
            **profile.cutoffs,
            "short_cutoff": math.hypot(short_cutoff, profile.cutoffs.get("short_cutoff", 0.0)),
        },
    )


@of_profile
def waviness_profile(profile: Profile, cutoff: float, *, ends: str = "regression", floored: bool = False) -> Profile:
    """Waviness profile: waves longer than the cut-off (m), the mean line of the roughness profile."""
    return profile.after(
        f"Gaussian low-pass, cut-off {cutoff * 1e3:.6g} mm, ends {ends}",
        _mean_line(profile, cutoff, ends, floored),
        cutoffs={**profile.cutoffs, "short_cutoff": cutoff},
    )


@of_profile
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
            value=(float(f"{start * 1e3:.6g}"), float(f"{end * 1e3:.6g}")),
        )
    return profile.after(
        f"trimmed {start * 1e3:.6g} mm and {end * 1e3:.6g} mm",
        profile.heights[first:last],
        valid=profile.valid[first:last],
    )


def _mean_line(profile: Profile, cutoff: float, ends: str, floored: bool) -> np.ndarray:
    return gaussian_mean_line(profile.heights, profile.spacing, cutoff, ends=ends, floored=floored, valid=profile.valid)


def smooth_bridges(heights: np.ndarray, valid: np.ndarray) -> np.ndarray:
    """Heights with cubic bridges over invalid points, of equal level and slope at both ends. A filter leaves steps at
    the ends of a straight bridge, which would show in a spectrum.

    >>> z = smooth_bridges(np.array([0.0, 1.0, 9.0, 9.0, 4.0, 5.0]), np.array([True, True, False, False, True, True]))
    >>> np.round(z, 12)
    array([0., 1., 2., 3., 4., 5.])
    """
    if valid.all():
        return heights
    at = np.flatnonzero(valid)
    z, gap = heights[at], np.diff(at)
    inner = np.flatnonzero(~valid)
    inner = inner[(inner > at[0]) & (inner < at[-1])]
    k = np.searchsorted(at, inner) - 1
    chord = np.diff(z)
    measured = np.where(gap == 1, chord, 0.0)
    # a slope that would throw a long bridge off the surface is taken as far as it does not
    most = 4.0 * z.std()
    leaving = np.clip(np.append(0.0, measured[:-1]) * gap - chord, -most, most)
    arriving = np.clip(np.append(measured[1:], 0.0) * gap - chord, -most, most)
    t = (inner - at[k]) / gap[k]
    bridged = heights.copy()
    bridged[inner] = z[k] + chord[k] * t + t * (1.0 - t) * ((1.0 - t) * leaving[k] - t * arriving[k])
    return bridged


def _base_radius(form: str) -> float:
    """Base radius (m) from ``involute-33.245``, in mm as on the gear's data sheet."""
    try:
        radius = float(form.removeprefix("involute-"))
    except ValueError:
        radius = 0.0
    if not radius > 0:
        raise InputError("needs the base radius in mm, as in involute-33.245", where="form", value=form)
    return radius * 1e-3


def _degree(form: str) -> int:
    if form in ("mean", "line"):
        return 0 if form == "mean" else 1
    head, _, tail = form.partition("-")
    if head == "polynomial" and tail.isdigit():
        if int(tail) <= HIGHEST:
            return int(tail)
        raise InputError(f"must be polynomial-0 to polynomial-{HIGHEST}", where="form", value=form)
    raise InputError(f"must be a known form; {nearest(form, FORMS)}", where="form", value=form)
