"""Height distributions of the surfaces of a study in the contact integrals of Greenwood and Williamson.

Mean plane and standard deviation of the summits follow Nayak and McCool; the shape of their distribution is taken from
the surface: from its traces, or from two normal processes fitted to them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mixedlub.chain.model import Law
from mixedlub.laws.contact import area_per_overlap, asperity_pressure, pressure_per_overlap, real_area_ratio
from mixedlub.rig.rig import Rig
from mixedlub.rig.surface import Surface
from mixedlub.schema.findings import finding, report
from profiles.errors import InputError
from roughness.height_shapes import (
    HeightShape,
    at_gap,
    log_integrals,
    measured_shape,
    normal_shape,
    plateau_shape,
)

GAUSSIAN, PLATEAU, MEASURED, AUTO = "gaussian", "plateau", "measured", "auto"
OF_VERDICT = {"gaussian": GAUSSIAN, "gaussian_bulk": GAUSSIAN, "plateau": PLATEAU, "not_gaussian": MEASURED}
"""Height distribution at each verdict of the normal probability plot."""
WORDS = {GAUSSIAN: "Gaussian heights", PLATEAU: "a bi-Gaussian plateau", MEASURED: "its measured heights"}
NORMAL = -1
"""Row of a pairing of two surfaces with normal heights, which need no table."""


@dataclass(frozen=True, eq=False)
class HeightTables:
    """Logarithms of F_1 and F_3/2, a row per pairing with non-normal heights; ``rows`` by pairing."""

    area: np.ndarray
    load: np.ndarray
    rows: np.ndarray

    def laws(self) -> dict[str, Law]:
        """Laws of area and load by output quantity."""
        return {"area_ratio": _area_law(self.area), "asperity_pressure": _load_law(self.load)}


def _area_law(table: np.ndarray) -> Law:
    def area_of_heights(
        separation: np.ndarray,
        summit_density: np.ndarray,
        summit_radius: np.ndarray,
        summit_sigma: np.ndarray,
        height_row: np.ndarray,
    ) -> np.ndarray:
        r"""Real over nominal contact area (-) with the heights of the surfaces, held in [0, 1].

        .. math:: \pi D R_s\sigma_s \int_t^\infty (s - t) f(s)\,ds

        f is the density of the summed heights of both surfaces over their rms: of the traces, of two normal processes,
        or normal. Source: J. A. Greenwood, J. B. P. Williamson, Proc. R. Soc. A 295 (1966) 300, section 2.
        """
        summits = (summit_density, summit_radius, summit_sigma)
        row = height_row.astype(int)
        own = np.exp(at_gap(table, np.maximum(row, 0), separation)) * area_per_overlap(*summits)
        return np.where(row == NORMAL, real_area_ratio(separation, *summits), np.minimum(own, 1.0))

    return area_of_heights


def _load_law(table: np.ndarray) -> Law:
    def pressure_of_heights(
        separation: np.ndarray,
        summit_density: np.ndarray,
        summit_radius: np.ndarray,
        summit_sigma: np.ndarray,
        reduced_modulus: np.ndarray,
        height_row: np.ndarray,
    ) -> np.ndarray:
        r"""Mean pressure that elastic asperities with the heights of the surfaces would carry (Pa).

        .. math:: \tfrac43 E^* D R_s^{1/2}\sigma_s^{3/2} \int_t^\infty (s - t)^{3/2} f(s)\,ds

        Source: J. A. Greenwood, J. B. P. Williamson, Proc. R. Soc. A 295 (1966) 300, section 2.
        """
        summits = (summit_density, summit_radius, summit_sigma, reduced_modulus)
        row = height_row.astype(int)
        own = np.exp(at_gap(table, np.maximum(row, 0), separation)) * pressure_per_overlap(*summits)
        return np.where(row == NORMAL, asperity_pressure(separation, *summits), own)

    return pressure_of_heights


def height_tables(
    option: str, rig: Rig, surfaces: Mapping[str, Surface], pairings: Sequence[tuple[str, str]]
) -> HeightTables | None:
    """Tables of a study; None if all heights are normal."""
    if option == GAUSSIAN:
        return None
    measured = [name for name in surfaces if rig.file.surfaces[name].is_measured]
    if not measured:
        raise InputError("needs surfaces given by traces or a map", where="options.heights", value=option)
    shapes = {name: _shape(name, rig, option) for name in measured}
    others = [name for name in surfaces if name not in measured]
    if others:
        text = f"the moments of {', '.join(others)} are stated; Gaussian heights are taken"
        report(finding("heights_chosen", text, "options.heights"))
    rows: list[int] = []
    made: dict[tuple[str, str], tuple[int, np.ndarray]] = {}
    for a, b in pairings:
        first, second = shapes.get(a), shapes.get(b)
        if first is None and second is None:
            rows.append(NORMAL)
            continue
        if (a, b) not in made:
            share = surfaces[a].m0 / (surfaces[a].m0 + surfaces[b].m0)
            normal = normal_shape()
            made[a, b] = len(made), log_integrals(first or normal, second or normal, share)
        rows.append(made[a, b][0])
    if not made:
        return None
    tables = np.array([table for _, table in made.values()])
    return HeightTables(tables[:, 0].copy(), tables[:, 1].copy(), np.array(rows, dtype=float))


def _shape(name: str, rig: Rig, option: str) -> HeightShape | None:
    """Height distribution of a measured surface; None for normal heights. The choice is reported."""
    from roughness import normal_probability
    from roughness.probability import two_lines

    measured = rig.measured(name)
    profile = measured.profile()
    if option == AUTO:
        judged = normal_probability(profile)
        option = OF_VERDICT[judged.verdict]
        text = f"{WORDS[option]} taken, by the normal probability plot: {judged.words}"
        report(finding("heights_chosen", text, f"surfaces.{name}"))
    if option == GAUSSIAN:
        return None
    if option == MEASURED:
        return measured_shape(measured.heights())
    heights = profile.heights[profile.valid]
    try:
        return plateau_shape(two_lines(profile), float(heights.mean()), float(heights.std()))
    except InputError as error:
        raise InputError(error.rule, where=f"surfaces.{name}", value=error.value) from None
