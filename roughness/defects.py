"""Outliers of a trace (spikes, scratches, pits) and edges of the part: masked and bridged, never deleted."""

from __future__ import annotations

import numpy as np

from profiles import InputError, Profile
from profiles.profile import of_profile
from roughness.robust import robust_mean_line

CUT = "edges cut"
"""First words of the step that shortens a trace."""


@of_profile
def mask_outliers(
    profile: Profile,
    *,
    cutoff: float = 0.25e-3,
    sigmas: float = 5.0,
    side: str = "both",
    margin: float | None = None,
) -> Profile:
    """Mask points further than ``sigmas`` robust sigmas off the robust mean line of a cut-off (m).

    ``side`` is ``peaks`` (spikes, dirt), ``valleys`` (scratches, pits) or ``both``. ``margin`` (m) widens each mask, by
    default until the residual is back within one sigma. Masked stretches are bridged by straight lines; parameters and
    moments leave them out.

    >>> z = 1e-8 * np.sin(np.arange(2000) * 0.7); z[1000] = 1e-6
    >>> np.flatnonzero(~mask_outliers(Profile(z, 1e-6), margin=0.0).valid)
    array([1000])
    """
    if side not in ("both", "peaks", "valleys"):
        raise InputError("must be 'both', 'peaks' or 'valleys'", where="side of the outliers", value=side)
    mask = profile.valid
    mean_line = robust_mean_line(profile.heights, profile.spacing, min(cutoff, profile.length), valid=mask)
    residual = profile.heights - mean_line
    residual = residual - np.median(residual[mask])
    sigma = float(np.median(np.abs(residual[mask]))) / 0.6744897501960817
    scaled = {"both": np.abs(residual), "peaks": residual, "valleys": -residual}[side]
    found = scaled > sigmas * sigma
    if margin is None:
        found = _grown(found, scaled > sigma)
    elif margin > 0:
        reach = round(margin / profile.spacing)
        found = np.convolve(found, np.ones(2 * reach + 1), "same") > 0.5
    return masked(profile, found, f"outliers beyond {sigmas:g} sigma masked ({side})")


@of_profile
def mask_edges(profile: Profile, *, steepness: float = 8.0, share: float = 0.02) -> Profile:
    """Mask the chamfers, steps and falling ends of a trace that runs over the edges of a part.

    A window of ``share`` of the length, within the first or last fifth, is steep where its mean slope is more
    than ``steepness`` sigmas (from the deciles) off the median slope. An edge goes from there to the end, but
    only where the trace never comes back to the level extrapolated from the surface before it: scratches,
    grooves and spikes come back and stay.

    >>> x = np.arange(1000)
    >>> found = mask_edges(Profile(np.where(x > 900, -1e-6 * (x - 900.0), 1e-8 * np.sin(x)), 1e-6))
    >>> bool(found.valid[:880].all()), bool(found.valid[905:].any())
    (True, False)
    """
    z = profile.heights
    if z.size < 50:
        return profile
    window = max(int(share * z.size), 3)
    rise = z[window:] - z[:-window]
    fifth = rise.size // 5
    low, centre, high = np.quantile(rise[fifth:-fifth], (0.1, 0.5, 0.9))
    limit = steepness * (high - low) / 2.563
    left, right = _edge(z[::-1], window, -centre, limit), _edge(z, window, centre, limit)
    edge = np.zeros(z.size, bool)
    edge[:left] = True
    edge[z.size - right :] = True
    return masked(profile, edge, "edges masked")


def _edge(z: np.ndarray, window: int, centre: float, limit: float) -> int:
    """Number of edge heights at the end: from the first steep window after which none is level again."""
    rise = z[window:] - z[:-window]
    fifth = rise.size // 5
    steep = np.abs(rise[-fifth:] - centre) > limit
    begun = np.flatnonzero(np.diff(steep, prepend=False) & steep) + rise.size - fifth
    # short stretches fit between grooves; one that passes through the level on a flank is not flat
    short, half = max(window // 4, 1), fifth // 2
    flat = np.abs(z[short:] - z[:-short] - centre * short / window) <= limit / 4
    sums = np.concatenate(([0.0], np.cumsum(z - z[0])))
    means = z[0] + (sums[short + 1 :] - sums[: -short - 1]) / (short + 1)
    level_again = 0
    for first in begun:
        if first < level_again:
            continue
        near, far = np.median(z[first - half : first]), np.median(z[first - 2 * half : first - half])
        beyond = np.arange(first + window, means.size)
        level = near + (near - far) / half * (beyond - first + 0.5 * (short + half + 1))
        # a rise of the limit takes the trace off; half of it tells one level from the other
        back = beyond[flat[beyond] & (np.abs(means[beyond] - level) <= limit / 2)]
        if not back.size:
            return int(z.size - first)
        level_again = back[0]
    return 0


def masked(profile: Profile, away: np.ndarray, step: str) -> Profile:
    """Profile with more points masked, and straight bridges over all masked points."""
    valid = profile.valid & ~away
    count = int(np.count_nonzero(valid))
    if count < max(3, 0.2 * valid.size):
        raise InputError(
            "masking would leave less than a fifth of the points",
            where=f"profile {profile.name!r}: points left",
            value=count,
        )
    if not away.any():
        return profile
    at = np.arange(valid.size)
    heights = np.where(valid, profile.heights, np.interp(at, at[valid], profile.heights[valid]))
    newly = int(np.count_nonzero(away))
    return profile.after(f"{step}: {newly} points", heights, valid=valid)


@of_profile
def without_edges(profile: Profile) -> Profile:
    """Longest stretch without masked ends, between the edges of a part."""
    kept = np.flatnonzero(profile.valid)
    first, last = int(kept[0]), int(kept[-1]) + 1
    if first == 0 and last == profile.heights.size:
        return profile
    start, end = (points * profile.spacing * 1e3 for points in (first, profile.heights.size - last))
    return profile.after(
        f"{CUT}: {start:.3g} mm at the start, {end:.3g} mm at the end",
        profile.heights[first:last],
        valid=profile.valid[first:last],
    )


def _grown(seeds: np.ndarray, around: np.ndarray) -> np.ndarray:
    """Each run of ``around`` that holds a seed."""
    from scipy.ndimage import label

    runs, _ = label(around | seeds)
    return (runs > 0) & np.isin(runs, np.unique(runs[seeds]))
