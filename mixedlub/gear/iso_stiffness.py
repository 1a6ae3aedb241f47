"""Mesh stiffness of ISO 6336-1, method B, from the data sheet alone."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from mixedlub.gear.checks import number
from mixedlub.gear.compliance import iso_single_stiffness
from mixedlub.gear.geometry import GearPair
from mixedlub.schema.findings import finding, report

CORRECTION = 0.8
"""C_M: measured stiffness over the theoretical one."""
STEEL = 206e9
"""Young's modulus (Pa) of the gears of the standard."""
LOW_LOAD = 100e3
"""Load per face width (N/m) below which the standard's stiffness falls with the load."""


@dataclass(frozen=True)
class IsoStiffness:
    """Stiffnesses per face width, N/m per m (1e9 = 1 N/(mm um)), in the transverse plane.

    ``theoretical`` c'_th of one pair, ``single`` c' with the corrections, ``mesh`` c_gamma,alpha of all pairs in
    contact (for dynamics), ``face`` c_gamma,beta (for the load distribution over the face).
    """

    theoretical: float
    single: float
    mesh: float
    face: float


def iso_stiffness(
    pair: GearPair, line_load: float | None = None, *, dedendum: float | None = None, blank_factor: float = 1.0
) -> IsoStiffness:
    r"""Single and mesh stiffness of ISO 6336-1.

    c' = c'_th C_M C_R C_B cos(beta) with C_M = 0.8 and C_B = [1 + 0.5 (1.2 - h_fP/m_n)] [1 - 0.02 (20 - alpha_n)];
    c_gamma,alpha = c' (0.75 eps_alpha + 0.25), c_gamma,beta = 0.85 c_gamma,alpha. Other materials: c' E/206 GPa with E
    = 2 E_1 E_2/(E_1 + E_2). Below 100 N/mm: c' times (line load/100 N/mm)^(1/4).

    ``line_load``: K_A F_t/b in N/m, None for a full load; ``dedendum`` h_fP of the basic rack over module, None for the
    pair's; ``blank_factor`` C_R of thin rims, 1 of solid discs. Holds for x_1 >= x_2, -0.5 <= x_1 + x_2 <= 2 and
    contact ratios from 1.2; outside it is a finding.

    Source: ISO 6336-1:2006, clause 9, method B.

    The pair of ISO/TR 6336-30, example 1, in N/(mm um):

    >>> example = GearPair(
    ...     (17, 103), 8e-3, math.radians(20), 0.1, math.radians(15.8), (0.145, 0.0), centre_distance=0.5
    ... )
    >>> found = iso_stiffness(example, dedendum=1.4)
    >>> print(round(found.theoretical / 1e9, 5), round(found.single / 1e9, 5))
    17.85584 12.37047
    """
    if dedendum is not None:
        pair = replace(pair, dedendum=dedendum)
    number("blank_factor", blank_factor, 0.0, 1.0 + 1e-12, "the blank factor lies above 0 and up to 1")
    x1, x2 = pair.profile_shift
    outside = [
        text
        for beyond, text in (
            (x1 < x2, f"x_1 = {x1:g} below x_2 = {x2:g}"),
            (not -0.5 <= x1 + x2 <= 2.0, f"x_1 + x_2 = {x1 + x2:g} outside -0.5 to 2"),
            (pair.contact_ratio < 1.2, f"a contact ratio of {pair.contact_ratio:.3g}, below 1.2"),
        )
        if beyond
    ]
    if outside:
        report(finding("law_extrapolated", f"ISO 6336-1 does not hold for {'; '.join(outside)}", "mesh stiffness"))
    theoretical = iso_single_stiffness(pair)
    rack = (1 + 0.5 * (1.2 - pair.dedendum)) * (1 - 0.02 * (20.0 - math.degrees(pair.pressure_angle)))
    first, second = pair.youngs_modulus
    single = theoretical * CORRECTION * blank_factor * rack * math.cos(pair.helix_angle)
    single *= 2 * first * second / (first + second) / STEEL
    if line_load is not None:
        single *= min(line_load / LOW_LOAD, 1.0) ** 0.25
    mesh = single * (0.75 * pair.contact_ratio + 0.25)
    return IsoStiffness(theoretical, single, mesh, 0.85 * mesh)
