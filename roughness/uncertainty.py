"""How far moments and asperities can be trusted: short cut-off band and bootstrap over sampling lengths."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from profiles import InputError, Profile
from roughness.asperities import Asperities, mccool_asperities
from roughness.filters import gaussian_mean_line
from roughness.moments import Moments, moments
from roughness.parameters import section_count

Prepare = Callable[[Profile, float], Profile]


def short_cutoff_band(
    before: Profile, short_cutoff: float, prepare: Prepare, *, factors: Sequence[float] = (0.5, 1.0, 2.0)
) -> tuple[Moments, ...]:
    """Moments at half, one and two short cut-offs (m); ``prepare(before, short_cutoff)`` filters the trace.

    m2, m4, radius and density follow the short cut-off, by factors of thousands over its usual range: this
    is the band to quote with them. Cut-offs of fewer than two points or more than half the trace are left out.
    """
    limits = [factor * short_cutoff for factor in factors]
    return tuple(
        moments(prepare(before, limit)) for limit in limits if 2.0 * before.spacing <= limit < before.length / 2
    )


def smoothed_moments(profile: Profile, short_cutoff: float) -> Moments:
    """Moments of a profile as if its short cut-off had been a longer one (m).

    Two Gaussian low-passes in a row act as one whose cut-off squared is the sum of theirs.
    """
    present = profile.cutoffs.get("short_cutoff", 0.0)
    if not short_cutoff > present:
        raise InputError(
            f"must be above the {present * 1e6:g} um already filtered",
            where="short cut-off (m)",
            value=short_cutoff,
        )
    added = float(np.sqrt(short_cutoff**2 - present**2))
    heights = gaussian_mean_line(profile.heights, profile.spacing, added, valid=profile.valid)
    return moments(profile.after("smoothed", heights, cutoffs={**profile.cutoffs, "short_cutoff": short_cutoff}))


def bootstrap(
    profile: Profile, *, sections: int | None = None, draws: int = 400, level: float = 0.9, seed: int = 0
) -> dict[str, tuple[float, float]]:
    """Interval of m0, m2, m4 and McCool's asperities by resampling the sampling lengths.

    Sections drawn with replacement, their mean squares averaged, deviations widened by sqrt(n/(n-1)) for
    the few there are. With five sections the interval is rough; it does not see what every section shares.
    """
    count = section_count(profile) if sections is None else sections
    if count < 3:
        raise InputError(
            "the bootstrap needs at least three",
            where=f"profile {profile.name!r}: sampling lengths",
            value=count,
        )
    parts = [
        moments(Profile(z, profile.spacing, valid=m))
        for z, m in zip(np.array_split(profile.heights, count), np.array_split(profile.valid, count))
    ]
    table = np.log([(p.m0, p.m2, p.m4) for p in parts])
    centre = np.log(np.exp(table).mean(axis=0))
    picks = np.random.default_rng(seed).integers(0, count, (draws, count))
    means = np.log(np.exp(table)[picks].mean(axis=1))
    means = np.exp(centre + (means - centre) * np.sqrt(count / (count - 1)))
    columns: dict[str, list[float]] = {}
    for m0, m2, m4 in means:
        one: Asperities = mccool_asperities(Moments(m0, m2, m4))
        row = {"m0": m0, "m2": m2, "m4": m4, "density": one.density, "radius": one.radius}
        row |= {"sigma": one.sigma, "plane_offset": one.plane_offset}
        for name, value in row.items():
            columns.setdefault(name, []).append(float(value))
    tails = ((1 - level) / 2, (1 + level) / 2)
    return {
        name: (float(low), float(high))
        for name, values in columns.items()
        for low, high in [np.quantile(values, tails)]
    }
