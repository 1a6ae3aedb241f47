"""Torque of a rolling bearing after Harris."""

import numpy as np

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law
from mixedlub.laws.drag import palmgren_idle_torque, palmgren_load_torque


@part_law(
    "bearing",
    "harris",
    "Harris",
    sources=0,
    status="the form is that of the book; its tables of f0, z, y and f_f are not confirmed, so that they are yours",
    coefficients=(
        Coefficient("f0", "-", "factor of the torque without load"),
        Coefficient("z", "-", "factor of the torque by load; of the order of 0.0005 for deep groove ball bearings"),
        Coefficient("y", "-", "exponent of the static load over its rating; about 0.5 for balls, 0 for rollers"),
        Coefficient("flange", "-", "factor of the axial load on the flanges of rollers; 0 for balls", 0.0),
    ),
)
def bearing_harris(
    shaft_speed: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    radial_load: np.ndarray,
    axial_load: np.ndarray,
    bore_diameter: np.ndarray,
    outside_diameter: np.ndarray,
    static_rating: np.ndarray,
    *,
    f0: float,
    z: float,
    y: float,
    flange: float,
) -> np.ndarray:
    r"""Torque of a rolling bearing (N m) with a factor of load that grows with load.

    .. math:: M = M_0(f_0) + z\left(\frac{F_s}{C_s}\right)^y F_\beta d_m + f_f F_a d_m,\quad
              F_\beta = \max(F_r,\ 3F_a - 0.1F_r),\quad F_s = \max(F_r,\ 0.6F_r + 0.5F_a)

    M_0 as of Palmgren. The loads F_beta and F_s are those of deep groove ball bearings; without axial load both are the
    radial load. SKF had this form, with y = 0.55, in its catalogues until 1994.

    Source: T. A. Harris, M. N. Kotzalas, Rolling Bearing Analysis, 5th ed., 2007, friction torque.

    >>> size = dict(bore_diameter=0.025, outside_diameter=0.065, static_rating=15e3, viscosity=0.01, oil_density=850.0)
    >>> found = bearing_harris(0.0, radial_load=3000.0, axial_load=0.0, **size, f0=0.0, z=5e-4, y=0.5, flange=0.0)
    >>> round(float(found) * 1e3, 2)   # 5e-4 x sqrt(0.2) x 3000 x 45
    30.19
    """
    diameter = 0.5 * (bore_diameter + outside_diameter)
    load = np.maximum(radial_load, 3.0 * axial_load - 0.1 * radial_load)
    static = np.maximum(radial_load, 0.6 * radial_load + 0.5 * axial_load)
    by_load = palmgren_load_torque(load, diameter, z * (static / static_rating) ** y)
    idle = palmgren_idle_torque(viscosity, oil_density, shaft_speed, diameter, f0)
    return idle + by_load + flange * axial_load * diameter
