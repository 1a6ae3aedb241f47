"""Height and slope parameters of a profile, under named conventions."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from profiles import InputError, Profile
from profiles.errors import nearest
from profiles.profile import of_profile

FEWEST = 8
"""Fewest points of a sampling length: the slope formula alone takes seven."""


@dataclass(frozen=True)
class Convention:
    """Which parameters are means over sampling lengths; the rest are taken over the whole profile.

    The zero line is set by the filter or the form removal. ``discrimination``: least height of an element of RSm and
    Rc; ``core``: method for the line of the Rk family.
    """

    name: str
    averages_sectioned: bool  # Ra Rq Rsk Rku Rdq
    extremes_sectioned: bool  # Rp Rv Rz
    source: str
    discrimination: str = "10 % of Rz"
    core: str = "least squares"


CONVENTIONS = {
    c.name: c
    for c in (
        Convention("ISO 4287:1997", True, True, "ISO 4287:1997, 3.1.9 and 4; ISO 4288:1996, 4.4"),
        Convention("ISO 21920-2:2021", False, True, "ISO 21920-2:2021, 4.3 and 4.4"),
        Convention(
            "NIST",
            False,
            False,
            "NIST surface metrology algorithm testing system: profile as a whole, elements above 5 % of Pz",
            "5 % of Rz",
        ),
        Convention(
            "Mitutoyo",
            True,
            True,
            "SurfTest report, ISO 1997 setting: what reproduces the values it prints",
            "10 % of Rt",
            "class levels",
        ),
    )
}


@dataclass(frozen=True)
class HeightParameters:
    """Heights in m, the rest without unit; ``sections`` sampling lengths under ``convention``.

    Rt is the height over all sections and Rz1max the greatest height within one.
    """

    Ra: float
    Rq: float
    Rz: float
    Rt: float
    Rp: float
    Rv: float
    Rz1max: float
    Rsk: float
    Rku: float
    Rdq: float
    sections: int
    convention: str


@of_profile
def height_parameters(
    profile: Profile, *, convention: str = "ISO 4287:1997", sections: int | None = None
) -> HeightParameters:
    """Ra Rq Rz Rt Rp Rv Rz1max Rsk Rku Rdq about the zero line; masked points are left out.

    Without ``sections``: as many sampling lengths of exactly the cut-off as fit, in the middle of the profile, without
    the rest at its ends (ISO 4287, 3.1.9 and 3.1.10); a profile shorter than the cut-off, or without one, is one
    section. With ``sections`` the whole profile is split equally.

    Rdq uses the seven-point slope. A flat profile has no Rsk and Rku (nan). A mean of section Rq is at most the rms of
    the whole, sqrt(m0), and less where the sections differ: it describes the finish, m0 the contact.

    >>> wave = Profile(np.sqrt(2) * np.sin(2 * np.pi * np.arange(8000) / 400), 1.0)
    >>> p = height_parameters(wave, sections=4)
    >>> round(p.Rq, 12), round(p.Rku, 12), round(p.Rdq * 400 / (2 * np.pi), 2)
    (1.0, 1.5, 1.0)
    """
    rule = named_convention(convention)
    count = section_count(profile) if sections is None else sections
    if sections is None and rule.extremes_sectioned:
        profile = evaluation_length(profile)
    if not 1 <= count <= profile.heights.size // FEWEST:
        raise _too_short(profile, sections)
    mask = profile.valid
    borders = _borders(mask.size, count)
    z, at = _kept(profile.heights, mask, borders)
    top, bottom = np.maximum.reduceat(z, at), -np.minimum.reduceat(z, at)
    Rt, Rz1max = float(top.max() + bottom.max()), float((top + bottom).max())
    if not rule.extremes_sectioned:
        top, bottom = top.max(), bottom.max()
    first = at if rule.averages_sectioned else np.zeros(1, int)
    # two buffers for all powers: fresh memory costs as much as the sums
    power, square = np.abs(z), z * z
    Ra, variance = _means(power, first), _means(square, first)
    with np.errstate(invalid="ignore", divide="ignore"):
        skewness = _means(np.multiply(square, z, out=power), first) / variance**1.5
        kurtosis = _means(np.multiply(square, square, out=power), first) / variance**2
    slope = slopes(profile.heights, profile.spacing)
    whole = np.asarray(mask[6:] if mask.all() else np.lib.stride_tricks.sliding_window_view(mask, 7).all(axis=1))
    # a slope belongs to its middle point; the formula may look across the border of two sections
    slope, first = _kept(slope, whole, borders - 3 if rule.averages_sectioned else np.zeros(1, int))
    return HeightParameters(
        Ra=float(Ra.mean()),
        Rq=float(np.sqrt(variance).mean()),
        Rz=float(np.mean(top + bottom)),
        Rt=Rt,
        Rp=float(np.mean(top)),
        Rv=float(np.mean(bottom)),
        Rz1max=Rz1max,
        Rsk=float(skewness.mean()),
        Rku=float(kurtosis.mean()),
        Rdq=float(np.sqrt(_means(np.square(slope, out=slope), first)).mean()),
        sections=count,
        convention=rule.name,
    )


def _too_short(profile: Profile, sections: int | None) -> InputError:
    """Error for too many sections, or for a cut-off too short for the spacing."""
    cutoff, where = profile.cutoffs.get("cutoff"), f"profile {profile.name!r}"
    needs = f"each sampling length needs at least {FEWEST} points"
    if sections is not None or cutoff is None:
        size = profile.heights.size
        return InputError(f"{needs}, the profile has {size}", where=f"{where}: number of sections", value=sections)
    held = f"the cut-off holds {cutoff / profile.spacing:.2g} of {profile.spacing * 1e6:.4g} um (is their unit right?)"
    return InputError(f"{needs}, {held}", where=f"{where}: cut-off (mm)", value=round(cutoff * 1e3, 9))


def section_count(profile: Profile) -> int:
    """Whole cut-offs that fit into the profile; 1 where no cut-off is recorded.

    >>> section_count(Profile(np.zeros(4001), 1e-6, cutoffs={"cutoff": 0.8e-3}))
    5
    """
    cutoff = profile.cutoffs.get("cutoff")
    return 1 if cutoff is None else max(1, int(profile.heights.size * profile.spacing / cutoff + 0.01))


def evaluation_length(profile: Profile, most: int | None = None) -> Profile:
    """Whole cut-offs in the middle of the profile, ``most`` at most; the whole profile without a cut-off that fits.

    >>> evaluation_length(Profile(np.arange(4700.0), 1e-6, cutoffs={"cutoff": 0.8e-3})).heights[[0, -1]]
    array([ 350., 4349.])
    """
    cutoff, size = profile.cutoffs.get("cutoff"), profile.heights.size
    if cutoff is None:
        return profile
    count = section_count(profile)
    wanted = round((count if most is None else min(count, most)) * cutoff / profile.spacing)
    if wanted >= size:
        return profile
    first = (size - wanted) // 2
    part = slice(first, first + wanted)
    return replace(profile, heights=profile.heights[part], valid=profile.valid[part])


SEVEN_POINTS = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0])


def slopes(heights: np.ndarray, spacing: float) -> np.ndarray:
    """Slope at each point with three neighbours to either side, seven-point formula of ISO 4287, 4.4.1.

    .. math:: z' = (z_3 - 9 z_2 + 45 z_1 - 45 z_{-1} + 9 z_{-2} - z_{-3}) / 60 \\Delta x

    Six fewer than the heights. Exact for polynomials to degree 6.

    >>> slopes(np.arange(8.0) ** 3, 1.0)
    array([27., 48.])
    """
    return np.correlate(heights, SEVEN_POINTS / (60.0 * spacing), "valid")


def _borders(size: int, count: int) -> np.ndarray:
    """First points of sections of nearly equal size, the longer ones first."""
    short, longer = divmod(size, count)
    return np.arange(count) * short + np.minimum(np.arange(count), longer)


def _kept(values: np.ndarray, mask: np.ndarray, borders: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Valid values, and the index of the first of each section that has any."""
    borders = np.maximum(borders, 0)
    if mask.all():
        return values, borders
    starts = np.concatenate(([0], np.cumsum(mask)))[borders]
    ends = np.append(starts[1:], np.count_nonzero(mask))
    return values[mask], starts[ends > starts]


def _means(values: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """Mean of each section."""
    return np.add.reduceat(values, starts) / np.diff(np.append(starts, values.size))


def named_convention(name: str) -> Convention:
    """One of ``CONVENTIONS``."""
    try:
        return CONVENTIONS[name]
    except KeyError:
        raise InputError(
            f"must be a known convention; {nearest(name, CONVENTIONS)}", where="convention", value=name
        ) from None
