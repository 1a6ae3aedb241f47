"""Torque of rolling bearings by SKF's model of the frictional moment: one law a type of bearing."""

import numpy as np

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law
from mixedlub.laws.drag import bearing_asperity_share

STATUS = (
    "equations of the catalogue, read in print; constants of the series in the table are confirmed by public programs, "
    "those of other series are yours. Drag of an oil bath is not in it; seals are parts of their own"
)


def _common(film_friction: float) -> tuple[Coefficient, ...]:
    return (
        Coefficient("replenishment", "-", "K_rs: 3e-8 in an oil bath or jet, 6e-8 for grease and oil-air", 3e-8),
        Coefficient("boundary_friction", "-", "mu_bl, sliding friction without a film", 0.12),
        Coefficient("film_friction", "-", "mu_EHL, sliding friction with a full film", film_friction),
    )


def skf_rolling_torque(
    rolling_variable: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    shaft_speed: np.ndarray,
    bore_diameter: np.ndarray,
    outside_diameter: np.ndarray,
    replenishment: float,
    geometry: float,
) -> np.ndarray:
    r"""Rolling frictional moment (N m).

    .. math:: M_{rr} = \phi_{ish}\,\phi_{rs}\,G_{rr}(\nu n)^{0.6},\quad
              \phi_{ish} = \frac{1}{1 + 1.84\times10^{-9}(n d_m)^{1.28}\nu^{0.64}},\quad
              \phi_{rs} = \exp\left[-K_{rs}\,\nu n (d + D)\sqrt{\frac{K_z}{2(D - d)}}\right]

    with n in rpm, nu in mm^2/s, lengths in mm and M in N mm; `rolling_variable` is G_rr. Its constants make the form
    belong to SI. Source: SKF, Rolling Bearings, 2018, model of the frictional moment.

    >>> oil = dict(viscosity=20e-6 * 850, oil_density=850.0, shaft_speed=1000 * np.pi / 30)
    >>> size = dict(bore_diameter=0.035, outside_diameter=0.072, replenishment=3e-8, geometry=3.1)
    >>> round(float(skf_rolling_torque(0.07183, **oil, **size)) * 1e3, 1)   # by a public program
    26.6
    """
    speed, nu = shaft_speed * 30.0 / np.pi, viscosity / oil_density * 1e6
    bore, outside, motion = bore_diameter * 1e3, outside_diameter * 1e3, nu * speed
    heating = 1.0 / (1.0 + 1.84e-9 * (speed * 0.5 * (bore + outside)) ** 1.28 * nu**0.64)
    starved = np.exp(-replenishment * motion * (bore + outside) * np.sqrt(geometry / (2.0 * (outside - bore))))
    return heating * starved * rolling_variable * motion**0.6 * 1e-3


def skf_sliding_friction(
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    shaft_speed: np.ndarray,
    mean_diameter: np.ndarray,
    boundary_friction: float,
    film_friction: float,
) -> np.ndarray:
    r"""Sliding friction of a rolling bearing (-), :math:`\mu_{sl} = \phi_{bl}\mu_{bl} + (1 - \phi_{bl})\mu_{EHL}`.

    Source: SKF, Rolling Bearings, 2018, model of the frictional moment.

    >>> float(skf_sliding_friction(0.01, 850.0, 0.0, 0.045, 0.12, 0.05))   # at rest: no film
    0.12
    """
    share = bearing_asperity_share(viscosity, oil_density, shaft_speed, mean_diameter)
    return share * boundary_friction + (1.0 - share) * film_friction


def _moment(
    rolling_variable: np.ndarray,
    sliding_variable: np.ndarray,
    oil: tuple[np.ndarray, np.ndarray, np.ndarray],
    bore_diameter: np.ndarray,
    outside_diameter: np.ndarray,
    replenishment: float,
    geometry: float,
    boundary_friction: float,
    film_friction: float,
) -> np.ndarray:
    """Moment of rolling and of sliding together (N m); ``oil`` is viscosity, density and speed of the shaft."""
    rolled = skf_rolling_torque(rolling_variable, *oil, bore_diameter, outside_diameter, replenishment, geometry)
    mean = 0.5 * (bore_diameter + outside_diameter)
    return rolled + sliding_variable * skf_sliding_friction(*oil, mean, boundary_friction, film_friction) * 1e-3


@part_law(
    "bearing",
    "skf_deep_groove",
    "SKF, deep groove ball bearings",
    sources=2,
    status=STATUS,
    coefficients=(
        Coefficient("rolling", "-", "R1 of the series"),
        Coefficient("rolling_axial", "-", "R2 of the series"),
        Coefficient("sliding", "-", "S1 of the series"),
        Coefficient("sliding_axial", "-", "S2 of the series"),
        *_common(0.05),
    ),
    series="deep_groove",
)
def skf_deep_groove(
    shaft_speed: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    radial_load: np.ndarray,
    axial_load: np.ndarray,
    bore_diameter: np.ndarray,
    outside_diameter: np.ndarray,
    static_rating: np.ndarray,
    *,
    rolling: float,
    rolling_axial: float,
    sliding: float,
    sliding_axial: float,
    replenishment: float,
    boundary_friction: float,
    film_friction: float,
) -> np.ndarray:
    r"""Torque of a deep groove ball bearing (N m) by SKF's model of rolling and sliding.

    .. math:: M = \phi_{ish}\phi_{rs} G_{rr}(\nu n)^{0.6} + G_{sl}\mu_{sl},\quad
              G_{rr} = R_1 d_m^{1.96}\left(F_r + \frac{R_2}{\sin\alpha_F}F_a\right)^{0.54},\quad
              G_{sl} = S_1 d_m^{-0.145}\left(F_r^5 + \frac{S_2 d_m^{1.5}}{\sin\alpha_F}F_a^4\right)^{1/3},\quad
              \alpha_F = 24.6^\circ\,(F_a/C_0)^{0.24}

    with N, mm, mm^2/s and rpm. Without axial load G_sl = S_1 d_m^-0.26 F_r^(5/3), which is another number than the
    limit of the form above: the catalogue's own step.

    Source: SKF, Rolling Bearings, 2018, model of the frictional moment, table 2a.

    >>> size = dict(bore_diameter=0.035, outside_diameter=0.072, static_rating=15.3e3)
    >>> series = dict(rolling=3.9e-7, rolling_axial=1.7, sliding=3.23e-3, sliding_axial=36.5)
    >>> other = dict(replenishment=3e-8, boundary_friction=0.12, film_friction=0.05)
    >>> oil = dict(viscosity=20e-6 * 850, oil_density=850.0)
    >>> found = skf_deep_groove(1000 * np.pi / 30, **oil, radial_load=3000.0, axial_load=0.0, **size, **series, **other)
    >>> round(float(found) * 1e3)   # 26.6 + 47.4 by a public program
    74
    """
    diameter = 0.5e3 * (bore_diameter + outside_diameter)
    loaded = axial_load > 0.0
    angle = np.radians(24.6 * (np.where(loaded, axial_load, 1.0) / static_rating) ** 0.24)
    axial = np.where(loaded, rolling_axial / np.sin(angle) * axial_load, 0.0)
    spin = sliding_axial * diameter**1.5 / np.sin(angle) * axial_load**4
    both = sliding * diameter**-0.145 * (radial_load**5 + spin) ** (1.0 / 3.0)
    slid = np.where(loaded, both, sliding * diameter**-0.26 * radial_load ** (5.0 / 3.0))
    rolled = rolling * diameter**1.96 * (radial_load + axial) ** 0.54
    oil = (viscosity, oil_density, shaft_speed)
    frictions = (boundary_friction, film_friction)
    return _moment(rolled, slid, oil, bore_diameter, outside_diameter, replenishment, 3.1, *frictions)


@part_law(
    "bearing",
    "skf_cylindrical",
    "SKF, cylindrical roller bearings with a cage",
    sources=2,
    status=STATUS,
    coefficients=(
        Coefficient("rolling", "-", "R1 of the series"),
        Coefficient("sliding", "-", "S2 of the series, of the radial load"),
        Coefficient("sliding_axial", "-", "S1 of the series, of the axial load on the flanges"),
        *_common(0.02),
    ),
    series="cylindrical",
)
def skf_cylindrical(
    shaft_speed: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    radial_load: np.ndarray,
    axial_load: np.ndarray,
    bore_diameter: np.ndarray,
    outside_diameter: np.ndarray,
    *,
    rolling: float,
    sliding: float,
    sliding_axial: float,
    replenishment: float,
    boundary_friction: float,
    film_friction: float,
) -> np.ndarray:
    r"""Torque of a cylindrical roller bearing (N m) by SKF's model of rolling and sliding.

    .. math:: M = \phi_{ish}\phi_{rs} G_{rr}(\nu n)^{0.6} + G_{sl}\mu_{sl},\quad
              G_{rr} = R_1 d_m^{2.41} F_r^{0.31},\quad G_{sl} = S_1 d_m^{0.9} F_a + S_2 d_m F_r

    with N, mm, mm^2/s and rpm.

    Source: SKF, Rolling Bearings, 2018, model of the frictional moment, table 2a.

    >>> size = dict(bore_diameter=0.030, outside_diameter=0.090)
    >>> series = dict(rolling=1e-6, sliding=0.0015, sliding_axial=0.16)
    >>> other = dict(replenishment=3e-8, boundary_friction=0.12, film_friction=0.02)
    >>> oil = dict(viscosity=20e-6 * 850, oil_density=850.0)
    >>> found = skf_cylindrical(1000 * np.pi / 30, **oil, radial_load=3000.0, axial_load=0.0, **size, **series, **other)
    >>> round(float(found) * 1e3)   # 85.2 + 10.6 by a public program
    96
    """
    diameter = 0.5e3 * (bore_diameter + outside_diameter)
    rolled = rolling * diameter**2.41 * radial_load**0.31
    slid = sliding_axial * diameter**0.9 * axial_load + sliding * diameter * radial_load
    oil = (viscosity, oil_density, shaft_speed)
    frictions = (boundary_friction, film_friction)
    return _moment(rolled, slid, oil, bore_diameter, outside_diameter, replenishment, 5.1, *frictions)


@part_law(
    "bearing",
    "skf_angular_contact",
    "SKF, angular contact and four-point contact ball bearings",
    sources=2,
    status=STATUS,
    coefficients=(
        Coefficient("rolling", "-", "R1 of the series"),
        Coefficient("rolling_axial", "-", "R2 of the series"),
        Coefficient("rolling_spin", "-", "R3 of the series"),
        Coefficient("sliding", "-", "S1 of the series"),
        Coefficient("sliding_axial", "-", "S2 of the series"),
        Coefficient("sliding_spin", "-", "S3 of the series"),
        Coefficient("geometry", "-", "K_z: 4.4 for single rows, 3.1 for four-point contact", 4.4),
        *_common(0.05),
    ),
    series="angular_contact",
)
def skf_angular_contact(
    shaft_speed: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    radial_load: np.ndarray,
    axial_load: np.ndarray,
    bore_diameter: np.ndarray,
    outside_diameter: np.ndarray,
    *,
    rolling: float,
    rolling_axial: float,
    rolling_spin: float,
    sliding: float,
    sliding_axial: float,
    sliding_spin: float,
    geometry: float,
    replenishment: float,
    boundary_friction: float,
    film_friction: float,
) -> np.ndarray:
    r"""Torque of an angular contact or four-point contact ball bearing (N m) by SKF's model of rolling and sliding.

    .. math:: M = \phi_{ish}\phi_{rs} G_{rr}(\nu n)^{0.6} + G_{sl}\mu_{sl},\quad
              G_{rr} = R_1 d_m^{1.97}(F_r + F_g + R_2 F_a)^{0.54},\quad
              G_{sl} = S_1 d_m^{0.26}\left[(F_r + F_g)^{4/3} + S_2 F_a^{4/3}\right],\quad
              F_g = R_3 d_m^4 n^2\ \text{or}\ S_3 d_m^4 n^2

    with N, mm, mm^2/s and rpm.

    Source: SKF, Rolling Bearings, 2018, model of the frictional moment, table 2a.

    >>> size = dict(bore_diameter=0.040, outside_diameter=0.090, geometry=3.1)
    >>> series = dict(rolling=4.78e-7, rolling_axial=2.42, rolling_spin=1.4e-12)
    >>> series |= dict(sliding=1.2e-2, sliding_axial=0.9, sliding_spin=1.4e-12)
    >>> other = dict(replenishment=3e-8, boundary_friction=0.12, film_friction=0.05)
    >>> oil = dict(viscosity=20e-6 * 850, oil_density=850.0)
    >>> load = dict(radial_load=0.0, axial_load=2000.0)
    >>> round(float(skf_angular_contact(1000 * np.pi / 30, **oil, **load, **size, **series, **other)) * 1e3)
    114
    """
    diameter = 0.5e3 * (bore_diameter + outside_diameter)
    turning = diameter**4 * (shaft_speed * 30.0 / np.pi) ** 2
    rolled = rolling * diameter**1.97 * (radial_load + rolling_spin * turning + rolling_axial * axial_load) ** 0.54
    pressed = (radial_load + sliding_spin * turning) ** (4.0 / 3.0) + sliding_axial * axial_load ** (4.0 / 3.0)
    oil = (viscosity, oil_density, shaft_speed)
    slid = sliding * diameter**0.26 * pressed
    frictions = (boundary_friction, film_friction)
    return _moment(rolled, slid, oil, bore_diameter, outside_diameter, replenishment, geometry, *frictions)
