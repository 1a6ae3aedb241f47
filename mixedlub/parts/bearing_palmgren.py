"""Torque of a rolling bearing after Palmgren."""

import numpy as np

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law
from mixedlub.laws.drag import palmgren_idle_torque, palmgren_load_torque


@part_law(
    "bearing",
    "palmgren",
    "Palmgren",
    sources=2,
    status="the form has two sources, the factors by type of bearing one; those of your catalogue are better",
    coefficients=(
        Coefficient(
            "f0", "-", "factor of the torque without load; about 2 for deep groove ball bearings in an oil bath"
        ),
        Coefficient("f1", "-", "factor of the torque by load; 0.0002 to 0.0004 for cylindrical roller bearings"),
        Coefficient("axial_factor", "-", "factor Y of the axial load; 3 is that of deep groove ball bearings", 3.0),
    ),
    series="palmgren",
)
def bearing_palmgren(
    shaft_speed: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    radial_load: np.ndarray,
    axial_load: np.ndarray,
    bore_diameter: np.ndarray,
    outside_diameter: np.ndarray,
    *,
    f0: float,
    f1: float,
    axial_factor: float,
) -> np.ndarray:
    r"""Torque of a rolling bearing (N m): of the oil, and of the load. SKF's model until its catalogue of 1994.

    .. math:: M = 10^{-7} f_0 \max(\nu n,\ 2000)^{2/3} d_m^3 + f_1 P_1 d_m,\quad P_1 = \max(F_r,\ Y F_a - 0.1F_r)

    with N, mm, mm^2/s and rpm. Y is 3 for deep groove ball bearings, and to be given for others; without axial load P_1
    is the radial load.

    Source: A. Palmgren, Grundlagen der Waelzlagertechnik, 1964; ISO/TR 14179-2.

    >>> load = dict(radial_load=1500.0, axial_load=0.0, bore_diameter=0.025, outside_diameter=0.065)
    >>> oil = dict(viscosity=15e-6 * 850, oil_density=850.0)
    >>> factors = dict(f0=2.0, f1=3e-4, axial_factor=3.0)
    >>> round(float(bearing_palmgren(1500 * np.pi / 30, **oil, **load, **factors)) * 1e3, 1)   # 14.5 + 20.25
    34.8
    """
    diameter = 0.5 * (bore_diameter + outside_diameter)
    load = np.maximum(radial_load, axial_factor * axial_load - 0.1 * radial_load)
    idle = palmgren_idle_torque(viscosity, oil_density, shaft_speed, diameter, f0)
    return idle + palmgren_load_torque(load, diameter, f1)
