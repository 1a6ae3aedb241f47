"""Asperities of one surface, or of the gap between two, from the spectral moments."""

from __future__ import annotations

from dataclasses import dataclass

from roughness.mccool import nayak_parameter, plane_offset, summit_density, summit_radius, summit_sigma
from roughness.moments import Moments


@dataclass(frozen=True)
class Asperities:
    """Summits for Greenwood-Williamson: ``density`` (1/m2), ``radius`` (m), ``sigma`` of their heights (m).

    ``plane_offset`` is how far their mean plane stands above that of the surface (m); ``nayak`` the
    bandwidth (-); ``model`` the relations that gave them.
    """

    density: float
    radius: float
    sigma: float
    plane_offset: float
    nayak: float
    model: str

    @property
    def packing(self) -> float:
        """Density x radius x sigma (-), the one number by which the real area of contact scales."""
        return self.density * self.radius * self.sigma


def mccool(moments: Moments) -> Asperities:
    """McCool's asperities of an isotropic Gaussian surface; Wear 107 (1986) 37, after Nayak 1971.

    Add the moments of two surfaces first. Below a bandwidth of 3/2 no such surface exists: sigma and plane
    offset are then those of 3/2.

    >>> a = mccool(Moments(0.16e-12, 0.01, 0.004e12))
    >>> round(a.density * 1e-6, 2), round(a.radius * 1e6, 4), round(a.sigma * 1e6, 6)
    (12251.75, 10.5094, 0.370918)
    """
    m0, m2, m4 = moments.m0, moments.m2, moments.m4
    return Asperities(
        density=float(summit_density(m2, m4)),
        radius=float(summit_radius(m4)),
        sigma=float(summit_sigma(m0, m2, m4)),
        plane_offset=float(plane_offset(m0, m2, m4)),
        nayak=float(nayak_parameter(m0, m2, m4)),
        model="McCool 1986",
    )
