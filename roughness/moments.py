"""Spectral moments m0, m2, m4 of a profile, always with their band and spacing."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from profiles import InputError, Profile
from profiles.errors import nearest
from profiles.profile import of_profile
from roughness.mccool import nayak_parameter
from roughness.spectrum import power_density

ESTIMATORS = ("differences", "spectral")


@dataclass(frozen=True)
class Moments:
    """Mean squares of height m0 (m2), slope m2 (-) and curvature m4 (1/m2) along a profile.

    m2 and m4 depend on ``spacing`` and the cut-offs (m); None: unknown, or different in two added surfaces. Angular
    frequency: no factor of 2 pi.

    >>> both = Moments(1e-14, 1e-3, 1e9, cutoff=8e-4) + Moments(2e-14, 1e-3, 2e9, cutoff=8e-4)
    >>> round(both.m0 * 1e14, 9), both.m2, both.m4, both.cutoff
    (3.0, 0.002, 3000000000.0, 0.0008)
    """

    m0: float
    m2: float
    m4: float
    spacing: float | None = None
    short_cutoff: float | None = None
    cutoff: float | None = None
    estimator: str = "given"

    def __post_init__(self) -> None:
        for name in ("m0", "m2", "m4"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0):
                raise InputError("must be above zero", where=f"moment {name}", value=value)

    def __add__(self, other: Moments) -> Moments:
        """The moments of the gap between two independent surfaces: their spectra add."""
        return Moments(
            self.m0 + other.m0,
            self.m2 + other.m2,
            self.m4 + other.m4,
            spacing=_shared(self.spacing, other.spacing),
            short_cutoff=_shared(self.short_cutoff, other.short_cutoff),
            cutoff=_shared(self.cutoff, other.cutoff),
            estimator=self.estimator if self.estimator == other.estimator else "mixed",
        )

    @property
    def bandwidth(self) -> float:
        """Nayak's alpha = m0 m4 / m2^2; at least 3/2 on an isotropic Gaussian surface."""
        return float(nayak_parameter(self.m0, self.m2, self.m4))


def across_and_along(across: Moments, along: Moments, *, rule: str = "geometric") -> Moments:
    """Moments of the isotropic surface equivalent to a surface with a lay, from traces across and along it.

    m2 and m4 by ``rule``: ``geometric`` (the usual reading of Sayles and Thomas 1976), ``harmonic``, ``arithmetic``, or
    ``across`` alone, as from a single trace: an upper bound of slope and curvature. m0 belongs to the surface, so its
    two estimates are averaged.

    >>> both = across_and_along(Moments(1e-14, 4e-3, 1e10), Moments(1e-14, 1e-3, 1e8))
    >>> round(both.m2, 6), round(both.m4)
    (0.002, 1000000000)
    """
    rules = {
        "geometric": lambda x, y: (x * y) ** 0.5,
        "harmonic": lambda x, y: 2.0 * x * y / (x + y),
        "arithmetic": lambda x, y: 0.5 * (x + y),
        "across": lambda x, y: x,
    }
    if rule not in rules:
        raise InputError(f"must be known; {nearest(rule, rules)}", where="rule of the lay", value=rule)
    merge = rules[rule]
    return replace(
        across + along,
        m0=0.5 * (across.m0 + along.m0) if rule != "across" else across.m0,
        m2=merge(across.m2, along.m2),
        m4=merge(across.m4, along.m4),
        estimator=f"{across.estimator}, {rule} over the lay",
    )


@of_profile
def moments(profile: Profile, *, estimator: str = "differences") -> Moments:
    """Moments of a levelled, filtered profile.

    ``differences``: mean squares of first and second differences over spacing and its square. ``spectral``:
    omega^n weighted sum of the Hann-tapered periodogram. On a wave of N points the differences lose
    1 - sinc^2(pi/N) of m2 and 1 - sinc^4(pi/N) of m4: 1.3 % and 2.5 % at N = 16. m0 is about the mean.
    Masked points are left out of the differences; the spectral sum takes them as bridged.

    >>> wave = Profile(1e-6 * np.cos(2 * np.pi * np.arange(1601) / 16), 1e-6, cutoffs={"cutoff": 8e-4})
    >>> m = moments(wave)
    >>> round(m.m2 * (16 / (2 * np.pi)) ** 2, 3), m.cutoff     # true value 0.5
    (0.494, 0.0008)
    """
    if estimator not in ESTIMATORS:
        raise InputError(f"must be known; {nearest(estimator, ESTIMATORS)}", where="estimator", value=estimator)
    found = (_by_differences if estimator == "differences" else _by_spectrum)(profile)
    if min(found) <= 0:
        raise InputError("is flat: it has no roughness", where=f"profile {profile.name!r}")
    return Moments(
        *found,
        spacing=profile.spacing,
        short_cutoff=profile.cutoffs.get("short_cutoff"),
        cutoff=profile.cutoffs.get("cutoff"),
        estimator=estimator,
    )


def _shared(one: float | None, other: float | None) -> float | None:
    return one if one == other else None


def _by_differences(profile: Profile) -> tuple[float, float, float]:
    z, dx = profile.heights, profile.spacing
    mask = profile.valid
    first = np.diff(z)
    second = np.diff(first)
    if mask.all():
        height = z - z.mean()
    else:
        height = z[mask] - z[mask].mean()
        first = first[mask[1:] & mask[:-1]]
        second = second[mask[2:] & mask[1:-1] & mask[:-2]]
        if not second.size:
            raise InputError("has no three valid points in a row", where=f"profile {profile.name!r}")
    return (
        _mean_square(height),
        _mean_square(first) / dx**2,
        _mean_square(second) / dx**4,
    )


def _mean_square(values: np.ndarray) -> float:
    # not values @ values: a threaded dot product waits for its threads on a busy machine
    return float(np.einsum("i,i->", values, values) / values.size)


def _by_spectrum(profile: Profile) -> tuple[float, float, float]:
    wavenumber, density = power_density(profile)
    density *= wavenumber[1]
    square = (2 * np.pi * wavenumber) ** 2
    return float(profile.heights.var()), float(density @ square), float(density @ square**2)
