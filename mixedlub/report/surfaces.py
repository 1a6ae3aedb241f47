"""What the page says of the surfaces: moments and asperities, and the traces where there are any."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mixedlub.report.figures import Drawn
from mixedlub.study.study import Study
from roughness.mccool import nayak_parameter, summit_density, summit_radius

SHOWN = 6


def surface_rows(study: Study) -> list[tuple[str, ...]]:
    """Name, Rq (um), rms slope, rms curvature (1/mm), Nayak bandwidth, summits per mm2 and their radius (um)."""
    rows = []
    for s in list(study.surfaces.values())[: 4 * SHOWN]:
        moments = (s.m0, s.m2, s.m4)
        rows.append(
            (
                s.name,
                f"{np.sqrt(s.m0) * 1e6:.3f}",
                f"{np.sqrt(s.m2):.4f}",
                f"{np.sqrt(s.m4) * 1e-3:.3g}",
                f"{nayak_parameter(*moments):.3g}",
                f"{summit_density(s.m2, s.m4) * 1e-6:.3g}",
                f"{summit_radius(s.m4) * 1e6:.3g}",
            )
        )
    return rows


def surface_figures(study: Study) -> Iterator[Drawn]:
    """Traces and normal probability plots of the surfaces that come from traces."""
    yield from ()
