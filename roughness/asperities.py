"""Asperities of one surface, or of the gap between two, by named models."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from profiles import InputError, Profile
from profiles.errors import nearest
from profiles.profile import of_profile
from roughness.mccool import nayak_parameter, plane_offset, summit_density, summit_radius, summit_sigma
from roughness.moments import Moments, moments
from roughness.probability import two_lines

MODELS = ("McCool", "no offset", "bi-Gaussian", "summit count")


@dataclass(frozen=True)
class Asperities:
    """Summits for Greenwood-Williamson: ``density`` (1/m2), ``radius`` (m), ``sigma`` of their heights (m).

    ``plane_offset``: mean plane of the summits above the mean plane of the surface (m); ``nayak``: bandwidth (-);
    ``model``: name of the relations.
    """

    density: float
    radius: float
    sigma: float
    plane_offset: float
    nayak: float
    model: str


@of_profile
def asperities(profile: Profile, *, model: str = "McCool") -> Asperities:
    """Asperities of one profile under one of ``MODELS``.

    ``McCool`` is for computation, the others are for comparison. ``no offset`` gives the summits the height spread and
    the mean plane of the surface, as is often done. ``bi-Gaussian`` takes only the heights above the knee of the
    probability plot. ``summit count`` counts the profile's peaks.
    """
    if model not in MODELS:
        raise InputError(f"must be known; {nearest(model, MODELS)}", where="asperity model", value=model)
    if model == "bi-Gaussian":
        return bi_gaussian(profile)
    if model == "summit count":
        return summit_count(profile)
    found = mccool_asperities(moments(profile))
    return found if model == "McCool" else without_offset(moments(profile))


def mccool_asperities(moments: Moments) -> Asperities:
    """McCool's asperities of an isotropic Gaussian surface; Wear 107 (1986) 37, after Nayak 1971.

    Add the moments of two surfaces first. Below a bandwidth of 3/2 no such surface exists: sigma and plane offset are
    then taken at 3/2.

    >>> a = mccool_asperities(Moments(0.16e-12, 0.01, 0.004e12))
    >>> round(a.density * 1e-6, 2), round(a.radius * 1e6, 4), round(a.sigma * 1e6, 6)
    (12251.75, 10.5094, 0.370918)
    """
    m0, m2, m4 = moments.m0, moments.m2, moments.m4
    return Asperities(
        density=float(summit_density(m2, m4)),
        radius=float(summit_radius(m4)),
        sigma=float(summit_sigma(m0, m2, m4)),
        plane_offset=float(plane_offset(m0, m2, m4)),
        nayak=float(nayak_parameter(m0, m2, m4)),
        model="McCool",
    )


def without_offset(moments: Moments) -> Asperities:
    """Summits that share the height spread and the mean plane of the surface, as is often done.

    Density and radius are McCool's. Leaving the offset out costs contact: at a bandwidth of 5 a factor of
    five to twelve between one and three sigma.

    >>> without_offset(Moments(0.16e-12, 0.01, 0.004e12)).plane_offset
    0.0
    """
    return replace(mccool_asperities(moments), sigma=float(np.sqrt(moments.m0)), plane_offset=0.0, model="no offset")


def bi_gaussian(profile: Profile) -> Asperities:
    """McCool's asperities of the plateau alone: sigma from the probability plot, slope and curvature from the points
    above the knee, mean plane relative to the mean plane of the whole profile. On a single Gaussian process the knee
    means little and the result is close to McCool's."""
    lines = two_lines(profile)
    z, dx = profile.heights, profile.spacing
    high = (z > lines.knee_height) & profile.valid
    first = (np.diff(z) / dx)[high[1:] & high[:-1]]
    second = (np.diff(z, 2) / dx**2)[high[2:] & high[1:-1] & high[:-2]]
    if second.size < 20:
        raise InputError("has too few points above the knee", where=f"profile {profile.name!r}")
    found = mccool_asperities(Moments(lines.plateau_sigma**2, float(np.mean(first**2)), float(np.mean(second**2)), dx))
    lift = lines.plateau_mean - float(z[profile.valid].mean())
    return replace(found, plane_offset=found.plane_offset + lift, model="bi-Gaussian")


def summit_count(profile: Profile) -> Asperities:
    r"""Asperities from counted three-point peaks, turned from profile peaks into summits.

    On an isotropic Gaussian surface summits and profile peaks are in fixed relations (Nayak 1971): :math:`D =
    (2\pi/3\sqrt3)\,N^2` for N peaks a length, mean curvature and mean height of summits 1.2004 and 1.8006 times the
    means of peaks. Sigma is the standard deviation of the peak heights. Peaks at the sampling interval are not
    asperities: filter first, to eight points a short cut-off.
    """
    z, dx = profile.heights, profile.spacing
    middle = z[1:-1]
    peak = (middle > z[:-2]) & (middle >= z[2:]) & profile.valid[1:-1]
    count = int(np.count_nonzero(peak))
    if count < 10:
        raise InputError("has fewer than ten peaks", where=f"profile {profile.name!r}", value=count)
    curvature = float(np.mean(2.0 * middle[peak] - z[:-2][peak] - z[2:][peak])) / dx**2
    per_length = count / (peak.size * dx)
    return Asperities(
        density=float(2.0 * np.pi / (3.0 * np.sqrt(3.0)) * per_length**2),
        radius=float(3.0 * np.pi / (8.0 * np.sqrt(2.0)) / curvature),
        sigma=float(middle[peak].std()),
        plane_offset=float(4.0 / np.sqrt(np.pi) / np.sqrt(np.pi / 2.0) * (middle[peak].mean() - z.mean())),
        nayak=moments(profile).bandwidth,
        model="summit count",
    )
