"""Uncertainty of moments and asperities: short cut-off band and bootstrap over sampling lengths."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from profiles import InputError, Profile
from profiles.profile import of_profile
from roughness.asperities import mccool_asperities
from roughness.filters import gaussian_mean_line
from roughness.moments import Moments, moments
from roughness.parameters import section_count

Prepare = Callable[[Profile, float], Profile]


@of_profile
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


@of_profile
def smoothed_moments(profile: Profile, short_cutoff: float) -> Moments:
    """Moments of a profile as if its short cut-off had been a longer one (m). Two Gaussian low-passes in a row act as
    one; the squares of their cut-offs add."""
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


@of_profile
def bootstrap(
    profile: Profile, *, sections: int | None = None, draws: int = 400, level: float = 0.9, seed: int = 0
) -> dict[str, tuple[float, float]]:
    """Interval of m0, m2, m4 and McCool's asperities by resampling the sampling lengths.

    Sections drawn with replacement and their mean squares averaged give the scatter of each logarithm, widened by
    sqrt(n/(n-1)) for the few there are; Student's t of n - 1 makes the interval of it. On simulated Gaussian surfaces
    90 % intervals of 3 to 10 sections hold the truth in 85 to 95 %. Errors common to all sections are not included.
    """
    from scipy.special import stdtrit

    squares = _by_section(profile, sections)
    count = len(squares)
    picks = np.random.default_rng(seed).integers(0, count, (draws, count))
    drawn = np.log([_quantities(*means) for means in squares[picks].mean(axis=1)])
    centre = np.log(_quantities(*squares.mean(axis=0)))
    reach = stdtrit(count - 1, (1 + level) / 2) * np.sqrt(count / (count - 1)) * drawn.std(axis=0)
    bounds = np.exp((centre - reach, centre + reach)).T
    return {name: (float(low), float(high)) for name, (low, high) in zip(_QUANTITIES, bounds, strict=True)}


@of_profile
def resampled_moments(profile: Profile, random: np.random.Generator) -> Moments:
    """Moments of a bootstrap sample of the profile's sampling lengths.

    >>> from profiles import shipped
    >>> from roughness import evaluation_profile
    >>> profile = evaluation_profile(shipped("0258"), cutoff=0.8e-3)
    >>> draws = [resampled_moments(profile, np.random.default_rng(seed)).m0 for seed in range(3)]
    >>> all(0.8 < m0 / moments(profile).m0 < 1.25 for m0 in draws), len(set(draws))
    (True, 3)
    """
    squares = _by_section(profile, None)
    m0, m2, m4 = squares[random.integers(0, len(squares), len(squares))].mean(axis=0)
    return Moments(float(m0), float(m2), float(m4))


def _by_section(profile: Profile, sections: int | None) -> np.ndarray:
    """m0, m2 and m4 of each sampling length."""
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
    return np.array([(p.m0, p.m2, p.m4) for p in parts])


_QUANTITIES = ("m0", "m2", "m4", "density", "radius", "sigma", "plane_offset")


def _quantities(m0: float, m2: float, m4: float) -> tuple[float, ...]:
    one = mccool_asperities(Moments(m0, m2, m4))
    return m0, m2, m4, one.density, one.radius, one.sigma, one.plane_offset
