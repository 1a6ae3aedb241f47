"""Height and slope parameters of a profile, under named conventions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from profiles import InputError, Profile
from profiles.errors import nearest


@dataclass(frozen=True)
class Convention:
    """Which parameters are means over sampling lengths; the rest are taken over the whole profile.

    No convention moves the zero line: the filter or the form removal has put it there.
    """

    name: str
    averages_sectioned: bool  # Ra Rq Rsk Rku Rdq
    extremes_sectioned: bool  # Rp Rv Rz
    source: str


CONVENTIONS = {
    c.name: c
    for c in (
        Convention("ISO 4287:1997", True, True, "ISO 4287:1997, 3.1.9 and 4; ISO 4288:1996, 4.4"),
        Convention("ISO 21920-2:2021", False, True, "ISO 21920-2:2021, 4.3 and 4.4"),
        Convention(
            "NIST", False, False, "NIST surface metrology algorithm testing system: profile as a whole"
        ),
        Convention(
            "Mitutoyo", True, True, "SurfTest report, ISO 1997 setting: as ISO 4287 with its N sections"
        ),
    )
}


@dataclass(frozen=True)
class HeightParameters:
    """Heights in m, the rest without unit; ``sections`` sampling lengths under ``convention``.

    Rt is the height over the whole profile and Rz1max the greatest height within one section.
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


def height_parameters(
    profile: Profile, *, convention: str = "ISO 4287:1997", sections: int | None = None
) -> HeightParameters:
    """Ra Rq Rz Rt Rp Rv Rz1max Rsk Rku Rdq about the zero line; masked points are left out.

    Without ``sections`` the profile is split into as many equal sampling lengths as cut-offs fit into it,
    or none where no cut-off is recorded. Rdq uses the seven-point slope. A flat profile has no Rsk and Rku
    (nan).

    >>> wave = Profile(np.sqrt(2) * np.sin(2 * np.pi * np.arange(8000) / 400), 1.0)
    >>> p = height_parameters(wave, sections=4)
    >>> round(p.Rq, 12), round(p.Rku, 12), round(p.Rdq * 400 / (2 * np.pi), 2)
    (1.0, 1.5, 1.0)
    """
    rule = _convention(convention)
    count = section_count(profile) if sections is None else sections
    if not 1 <= count <= profile.heights.size // 8:
        raise InputError(
            "each sampling length needs at least eight points",
            where=f"profile {profile.name!r}: number of sections",
            value=count,
        )
    mask = np.asarray(profile.valid)
    parts = [z[m] for z, m in zip(np.array_split(profile.heights, count), np.array_split(mask, count))]
    parts = [z for z in parts if z.size]
    whole = profile.heights[mask]
    tops = np.array([z.max() for z in parts])
    bottoms = np.array([z.min() for z in parts])
    if rule.averages_sectioned:
        averages = [_averages(*pair) for pair in zip(parts, _slopes_by_section(profile, count))]
    else:
        averages = [_averages(whole, *_slopes_by_section(profile, 1))]
    ra, rq, rsk, rku, rdq = np.mean(averages, axis=0)
    top, bottom = (tops, -bottoms) if rule.extremes_sectioned else (tops.max(), -bottoms.min())
    return HeightParameters(
        Ra=float(ra),
        Rq=float(rq),
        Rz=float(np.mean(top + bottom)),
        Rt=float(tops.max() - bottoms.min()),
        Rp=float(np.mean(top)),
        Rv=float(np.mean(bottom)),
        Rz1max=float((tops - bottoms).max()),
        Rsk=float(rsk),
        Rku=float(rku),
        Rdq=float(rdq),
        sections=count,
        convention=rule.name,
    )


def section_count(profile: Profile) -> int:
    """Whole cut-offs that fit into the profile; 1 where no cut-off is recorded.

    >>> section_count(Profile(np.zeros(4001), 1e-6, cutoffs={"cutoff": 0.8e-3}))
    5
    """
    cutoff = profile.cutoffs.get("cutoff")
    return 1 if cutoff is None else max(1, int(profile.heights.size * profile.spacing / cutoff + 0.01))


def slopes(heights: np.ndarray, spacing: float) -> np.ndarray:
    """Slope at each point with three neighbours to either side, seven-point formula of ISO 4287, 4.4.1.

    .. math:: z' = (z_3 - 9 z_2 + 45 z_1 - 45 z_{-1} + 9 z_{-2} - z_{-3}) / 60 \\Delta x

    Six fewer than the heights. Exact for polynomials to degree 6.

    >>> slopes(np.arange(8.0) ** 3, 1.0)
    array([27., 48.])
    """
    z = heights
    near = z[4:-2] - z[2:-4]
    near *= 45.0
    middle = z[5:-1] - z[1:-5]
    middle *= 9.0
    near -= middle
    near += z[6:]
    near -= z[:-6]
    near /= 60.0 * spacing
    return near


def _slopes_by_section(profile: Profile, count: int) -> list[np.ndarray]:
    """Slopes at the points of each section; the formula may look across the border of two sections."""
    values = slopes(profile.heights, profile.spacing)
    mask = np.asarray(profile.valid)
    borders = [part[0] - 3 for part in np.array_split(np.arange(mask.size), count)[1:]]
    if mask.all():
        return np.split(values, borders)
    usable = np.lib.stride_tricks.sliding_window_view(mask, 7).all(axis=1)
    return [v[u] for v, u in zip(np.split(values, borders), np.split(usable, borders)) if u.any()]


def _averages(z: np.ndarray, slope: np.ndarray) -> tuple[float, ...]:
    square = z * z
    variance = square.mean()
    with np.errstate(invalid="ignore", divide="ignore"):
        skewness = (square @ z) / z.size / variance**1.5
        kurtosis = (square @ square) / z.size / variance**2
    return (
        np.abs(z).mean(),
        np.sqrt(variance),
        skewness,
        kurtosis,
        np.sqrt(slope @ slope / max(slope.size, 1)),
    )


def _convention(name: str) -> Convention:
    try:
        return CONVENTIONS[name]
    except KeyError:
        raise InputError(
            f"must be a known convention; {nearest(name, CONVENTIONS)}", where="convention", value=name
        ) from None
