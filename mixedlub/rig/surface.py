"""Flank as input of the chain: spectral moments in one or two directions, coating and substrate."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from mixedlub.laws.contact import MEAN_OF_NORMAL
from mixedlub.schema.findings import Finding, finding
from profiles.errors import InputError
from profiles.profile import Profile


@dataclass(frozen=True)
class Surface:
    """Surface in SI: profile moments, optional coating, thermal properties of the body (steel unless given).

    ``m2`` and ``m4`` are across the ``lay`` if known, ``m2_along`` and ``m4_along`` along it (None without a lay).
    ``peklenik``: correlation length across over along the lay; ``steps``: processing of the trace; ``mean_over_rms``:
    measured Ra over sqrt(m0). ``cutoff``, ``short_cutoff``: wavelengths of the applied filters (m); None if there are
    none. ``profiles``: filtered traces across the lay; empty for stated moments and maps.
    """

    name: str
    m0: float
    m2: float
    m4: float
    coating_thickness: float
    coating_conductivity: float
    conductivity: float
    density: float
    heat_capacity: float
    steps: tuple[str, ...] = ()
    lay: str | None = None
    m2_along: float | None = None
    m4_along: float | None = None
    peklenik: float | None = None
    mean_over_rms: float | None = None
    cutoff: float | None = None
    short_cutoff: float | None = None
    profiles: tuple[Profile, ...] = field(default=(), compare=False, repr=False)

    @property
    def mean_roughness(self) -> float:
        """Ra (m), as measured, or for normal heights if only moments are given."""
        return (self.mean_over_rms or MEAN_OF_NORMAL) * float(self.m0) ** 0.5

    @property
    def bandwidth(self) -> float:
        """Nayak's m0 m4/m2^2 of the equivalent isotropic surface."""
        along = self._along
        return self.m0 * (self.m4 * along[1]) ** 0.5 / (self.m2 * along[0])

    @property
    def in_motion(self) -> tuple[float, float]:
        """m2 and m4 in the direction of motion."""
        return self._along if self.lay == "longitudinal" else (self.m2, self.m4)

    @property
    def across_motion(self) -> tuple[float, float]:
        """m2 and m4 across the direction of motion."""
        return (self.m2, self.m4) if self.lay == "longitudinal" else self._along

    @property
    def _along(self) -> tuple[float, float]:
        across = (self.m2, self.m4)
        return across if self.m2_along is None or self.m4_along is None else (self.m2_along, self.m4_along)

    @property
    def orientation(self) -> float:
        """Correlation length in over across the direction of motion: below 1 for transverse ridges.

        >>> one = Surface("a", 1e-14, 4e-3, 1e9, 0, 0, 46, 7800, 470, lay="transverse", m2_along=1e-3, m4_along=1e8)
        >>> one.orientation
        0.5
        """
        ratio = self.peklenik
        if ratio is None:
            ratio = (self._along[0] / self.m2) ** 0.5
        return 1.0 / ratio if self.lay == "longitudinal" else ratio


def check_lays(first: Surface, second: Surface) -> None:
    """Raise an error if only one of two surfaces has a lay."""
    if (first.lay is None) != (second.lay is None):
        known, unknown = (first, second) if first.lay else (second, first)
        rule = (
            f"its lay is unknown, and that of {known.name}, against which it runs, is known; give traces_along, or "
            'm2_along and m4_along_per_um2, or a map, or lay = "isotropic", for both or for neither'
        )
        raise InputError(rule, where=f"surfaces.{unknown.name}")


def mean_over_rms(first: Sequence[Surface], second: Sequence[Surface]) -> np.ndarray:
    """Sum of both Ra over sum of both Rq, by pair."""
    pairs = list(zip(first, second, strict=True))
    ra = np.array([a.mean_roughness + b.mean_roughness for a, b in pairs])
    return ra / np.array([float(a.m0) ** 0.5 + float(b.m0) ** 0.5 for a, b in pairs])


def mean_assumed(surfaces: Iterable[Surface]) -> Iterator[Finding]:
    """Finding on Ra calculated from Rq for normal heights, as input of a law."""
    stated = [one.name for one in surfaces if one.mean_over_rms is None]
    if stated:
        text = f"Ra of {', '.join(stated)} taken as {MEAN_OF_NORMAL:.3f} Rq, as of normal heights: no trace gives it"
        yield finding("mean_roughness_assumed", text, "surfaces")


def paired(first: Sequence[Surface], second: Sequence[Surface], coated: bool = False) -> dict[str, np.ndarray]:
    """Chain inputs of pairs of surfaces: moments add, thermal properties average.

    Spectra of independent surfaces add (Nayak 1971), so moments are summed by direction before any other step. A
    surface with a lay is replaced by an isotropic surface: m2 and m4 are geometric means of both directions. Coating
    inputs are left out if no pair has a coating, unless ``coated`` (pairs elsewhere have coatings).
    """

    def each(attribute: str, side: Sequence[Surface]) -> np.ndarray:
        return np.array([getattr(s, attribute) for s in side], dtype=float)

    for a, b in zip(first, second, strict=True):
        check_lays(a, b)
    both = _moments(first, second)
    if all(s.lay is not None for s in (*first, *second)):
        both["peklenik_number"] = _peklenik(first, second)
    for name, attribute in (
        ("solid_conductivity", "conductivity"),
        ("solid_density", "density"),
        ("solid_heat_capacity", "heat_capacity"),
    ):
        both[name] = 0.5 * (each(attribute, first) + each(attribute, second))
    thickness = each("coating_thickness", first) + each("coating_thickness", second)
    if coated or thickness.any():
        both["coating_thickness"] = thickness
        resistance = sum(
            each("coating_thickness", side) / each("coating_conductivity", side) for side in (first, second)
        )
        both["coating_conductivity"] = np.where(thickness > 0, thickness / np.maximum(resistance, 1e-30), 1.0)
    return both


def _peklenik(first: Sequence[Surface], second: Sequence[Surface]) -> np.ndarray:
    """Peklenik number of two surfaces together, in the direction of motion.

    At first order, flow factors depend on each surface by its variance times 1/(1 + gamma), so that these terms add up.
    Source: J. H. Tripp, J. Lubr. Technol. 105 (1983) 458.
    """
    m0, gamma = (
        np.array([[getattr(s, name) for s in side] for side in (first, second)]) for name in ("m0", "orientation")
    )
    return np.asarray(m0.sum(axis=0) / (m0 / (1.0 + gamma)).sum(axis=0) - 1.0)


def _moments(first: Sequence[Surface], second: Sequence[Surface]) -> dict[str, np.ndarray]:
    """Summed moments, with the share of the first surface in each."""
    m0 = [np.array([s.m0 for s in side], dtype=float) for side in (first, second)]
    motion, across = (
        [np.array([getattr(s, name) for s in side], dtype=float) for side in (first, second)]
        for name in ("in_motion", "across_motion")
    )
    found = {"m0": m0[0] + m0[1]}
    shares = {"height_share": m0[0] / found["m0"]}
    for order, (moment, share) in enumerate((("m2", "slope_share"), ("m4", "curvature_share"))):
        x, y = ([of[:, order] for of in direction] for direction in (motion, across))
        alike = all((one == other).all() for one, other in zip(x, y))
        # without a lay the sums stay as they are, to the last bit
        own = x if alike else [np.sqrt(a * b) for a, b in zip(x, y)]
        found[moment] = x[0] + x[1] if alike else np.sqrt((x[0] + x[1]) * (y[0] + y[1]))
        shares[share] = own[0] / (own[0] + own[1])
    return found | shares
