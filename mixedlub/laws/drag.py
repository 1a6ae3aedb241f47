"""Losses of a gearbox that the mesh does not know of: air, oil bath, bearings, seals."""

from __future__ import annotations

import numpy as np

from mixedlub.chain.powers import power

AIR_DENSITY = 1.2
AIR_VISCOSITY = 1.8e-5
GRAVITY = 9.81
SLOW_BATH, FAST_BATH = 750.0, 1250.0
"""Accelerations (m/s^2) below and above which one of the two laws of Changenet and Velex holds alone."""


def windage_diab(
    wheel_radius: np.ndarray,
    wheel_speed: np.ndarray,
    face_width: np.ndarray,
    wheel_teeth: np.ndarray,
    clearance_ratio: float = 0.5,
) -> np.ndarray:
    r"""Power of one wheel against clean air (W).

    .. math:: P = \tfrac12 C_t \rho\omega^3 R^5,\quad
              C_t = 60\,Re^{-0.25}\left(\tfrac bR\right)^{0.8} z^{-0.4}\,2\left(\tfrac hR\right)^{0.56},\quad
              Re = \rho\omega R^2/\mu

    with walls on both sides at h, no more than half a radius, as for a free wheel. Within a factor 1.6 of the formulas
    of Dawson and of Anderson and Loewenthal. The density and viscosity of air make the form belong to SI.
    Source: Y. Diab, F. Ville, P. Velex, C. Changenet, J. Mech. Des. 126 (2004) 903; constants as quoted in reviews.

    >>> round(float(windage_diab(0.05, 10_000 * np.pi / 30, 0.02, 25.0)), -1)   # Anderson-Loewenthal: 70 W
    110.0
    """
    reynolds = AIR_DENSITY * wheel_speed * wheel_radius**2 / AIR_VISCOSITY
    shape = power(face_width / wheel_radius, 0.8) * power(wheel_teeth, -0.4) * 2.0 * power(clearance_ratio, 0.56)
    return 30.0 * power(reynolds, -0.25) * shape * AIR_DENSITY * wheel_speed**3 * wheel_radius**5


def churning_changenet_velex(
    wheel_radius: np.ndarray,
    wheel_speed: np.ndarray,
    face_width: np.ndarray,
    gear_module: np.ndarray,
    wheel_teeth: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    viscosity_exponent: float = 0.21,
    gravity_exponent: float = 0.60,
    immersion_ratio: float | np.ndarray = 0.5,
    volume_ratio: float | np.ndarray = 1.5,
    helix_angle: float | np.ndarray = 0.0,
) -> np.ndarray:
    r"""Power of one wheel that dips into oil (W), at low centrifugal acceleration.

    .. math:: P = \tfrac12\rho\omega^3R^3 S_m C_m,\quad
              C_m = 1.366\left(\tfrac hD\right)^{0.45}\left(\tfrac{V_0}{D^3}\right)^{0.1} Fr^{-0.6} Re^{-0.21}

    with Fr = omega^2 R/g, Re = omega R^2/nu and the wetted area S_m of flanks, rim and teeth; h/R and V_0/D^3 are the
    ratios of immersion and oil volume.
    Other exponents pivot at Fr 70, Re 16 000 (a 100 mm wheel at 1100 rpm in oil of 20 mm^2/s). Published methods
    differ by a factor 6 at 5000 rpm. The acceleration of gravity makes the form belong to m/s^2. Valid where
    `bath_acceleration` is below 750 m/s^2; above 1250 m/s^2 holds `churning_at_high_speed`.
    Source: C. Changenet, P. Velex, J. Mech. Des. 129 (2007) 128; constants as quoted in reviews.

    >>> speed = np.array([1000.0, 2000.0, 3000.0]) * np.pi / 30   # 100 mm, 50 mm^2/s
    >>> churning_changenet_velex(0.05, speed, 0.02, 4e-3, 25.0, 50e-6 * 850, 850.0).round(1).tolist()
    [5.8, 17.3, 33.0]
    """
    froude = wheel_speed**2 * wheel_radius / GRAVITY
    reynolds = wheel_speed * wheel_radius**2 * oil_density / viscosity
    depth = 0.5 * immersion_ratio
    drag = 1.366 * power(depth, 0.45) * power(volume_ratio, 0.1) * power(froude, -0.60) * power(reynolds, -0.21)
    drag = drag * power(froude / 70.0, 0.60 - gravity_exponent) * power(reynolds / 16e3, 0.21 - viscosity_exponent)
    area = wetted_area(wheel_radius, face_width, gear_module, wheel_teeth, immersion_ratio, helix_angle)
    return 0.5 * oil_density * wheel_speed**3 * wheel_radius**3 * area * drag


def churning_at_high_speed(
    wheel_radius: np.ndarray,
    wheel_speed: np.ndarray,
    face_width: np.ndarray,
    gear_module: np.ndarray,
    wheel_teeth: np.ndarray,
    oil_density: np.ndarray,
    immersion_ratio: float | np.ndarray = 0.5,
    volume_ratio: float | np.ndarray = 1.5,
    helix_angle: float | np.ndarray = 0.0,
) -> np.ndarray:
    r"""Power of one wheel that dips into oil (W), at high centrifugal acceleration, whatever the viscosity.

    .. math:: P = \tfrac12\rho\omega^3R^3 S_m C_m,\quad
              C_m = 3.644\left(\tfrac{h}{D}\right)^{0.1}\left(\tfrac{V_0}{D^3}\right)^{-0.35} Fr^{-0.88}
              \left(\tfrac{b}{D}\right)^{0.85}

    The acceleration of gravity makes the form belong to m/s^2.
    Source: C. Changenet, P. Velex, J. Mech. Des. 129 (2007) 128; constants as quoted in reviews.

    >>> speed = np.array([1000.0, 2000.0, 3000.0, 5000.0]) * np.pi / 30
    >>> churning_at_high_speed(0.05, speed, 0.02, 4e-3, 25.0, 850.0).round().tolist()
    [10.0, 24.0, 40.0, 76.0]
    """
    froude = np.maximum(wheel_speed, 1e-9) ** 2 * wheel_radius / GRAVITY
    slim = power(face_width / (2.0 * wheel_radius), 0.85)
    drag = 3.644 * power(0.5 * immersion_ratio, 0.1) * power(volume_ratio, -0.35) * power(froude, -0.88) * slim
    area = wetted_area(wheel_radius, face_width, gear_module, wheel_teeth, immersion_ratio, helix_angle)
    return 0.5 * oil_density * wheel_speed**3 * wheel_radius**3 * area * drag


def churning_at_either_speed(
    slow: np.ndarray, fast: np.ndarray, bath_acceleration: np.ndarray, share: float = 1.0
) -> np.ndarray:
    r"""Power of one wheel that dips into oil, from the laws of low and of high speed (W).

    .. math:: P = P_{slow} + x\,\mathrm{clip}\left(\frac{\gamma - 750}{1250 - 750}, 0, 1\right)(P_{fast} - P_{slow})

    with gamma in m/s^2, to which the constants make the form belong; a share x below 1 leaves some of the first law.
    Source: C. Changenet, P. Velex, J. Mech. Des. 129 (2007) 128: one law below 750, the other above 1250.

    >>> churning_at_either_speed(20.0, 30.0, np.array([700.0, 1000.0, 1300.0])).tolist()
    [20.0, 25.0, 30.0]
    """
    passed = np.clip((bath_acceleration - SLOW_BATH) / (FAST_BATH - SLOW_BATH), 0.0, 1.0)
    return slow + share * passed * (fast - slow)


def wetted_area(
    wheel_radius: np.ndarray,
    face_width: np.ndarray,
    gear_module: np.ndarray | float,
    wheel_teeth: np.ndarray | float,
    immersion_ratio: float | np.ndarray,
    helix_angle: float | np.ndarray = 0.0,
) -> np.ndarray:
    r"""Area of a wheel in the oil (m^2): sides, rim and flanks of the teeth, which are 2.25 modules high.

    .. math:: S_m = R^2(2\theta - \sin2\theta) + D b\,\theta + \frac{2 z b h_t\theta}{\pi\cos\alpha\cos\beta},\quad
              \cos\theta = 1 - h/R

    Source: C. Changenet, P. Velex, J. Mech. Des. 129 (2007) 128.

    >>> round(float(wetted_area(0.05, 0.02, 4e-3, 0.0, 1.0)) * 1e4, 2)   # half of both sides and of the rim, cm^2
    109.96
    >>> teeth = [wetted_area(0.05, 0.02, 4e-3, 25.0, 1.0, b) - wetted_area(0.05, 0.02, 0.0, 0.0, 1.0) for b in (0, 1)]
    >>> round(float(teeth[1] / teeth[0] * np.cos(1.0)), 9)   # the flanks of a helical wheel are longer than it is wide
    1.0
    """
    wetted = np.arccos(1.0 - immersion_ratio)
    sides = wheel_radius**2 * (2.0 * wetted - np.sin(2.0 * wetted))
    rim = 2.0 * wheel_radius * face_width * wetted
    flanks = 2.0 * wheel_teeth * face_width * 2.25 * gear_module * wetted / (np.pi * np.cos(np.radians(20.0)))
    return sides + rim + flanks / np.cos(helix_angle)


def bath_acceleration(
    gear_speed: np.ndarray, gear_radius: np.ndarray, face_width: np.ndarray, gear_module: np.ndarray
) -> np.ndarray:
    r"""Centrifugal acceleration that decides which law of churning holds (m/s^2), :math:`\omega^2 (R\,b\,m_n)^{1/3}`.

    Source: C. Changenet, P. Velex, J. Mech. Des. 129 (2007) 128.

    >>> round(float(bath_acceleration(3000 * np.pi / 30, 0.05, 0.02, 4e-3)))   # 100 mm: the upper law
    1567
    """
    return gear_speed**2 * power(gear_radius * face_width * gear_module, 1.0 / 3.0)


def _oil_motion(viscosity: np.ndarray, oil_density: np.ndarray, wheel_speed: np.ndarray) -> np.ndarray:
    """Kinematic viscosity times speed as bearing catalogues count it, mm^2/s rpm."""
    return viscosity / oil_density * 1e6 * wheel_speed * 30.0 / np.pi


def palmgren_idle_torque(
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    wheel_speed: np.ndarray,
    bearing_diameter: np.ndarray,
    factor: float = 2.0,
) -> np.ndarray:
    r"""Torque of one unloaded rolling bearing (N m); f_0 = 2 is a deep-groove ball bearing in an oil bath.

    .. math:: M_0 = 10^{-7} f_0 \max(\nu n,\ 2000\ \text{mm}^2/\text{s rpm})^{2/3} d_m^3\ \text{N mm}

    Below 2000 the source rounds 158.7 to 160, 0.8 % more, which would be a step. Its constant makes the form belong to
    SI.
    Source: A. Palmgren, Grundlagen der Waelzlagertechnik, 1964; ISO/TR 14179-2.

    >>> torque = palmgren_idle_torque(15e-6 * 850, 850.0, 1500 * np.pi / 30, 0.045)
    >>> round(float(torque) * 1e3, 1)   # 2e-7 x 22 500^(2/3) x 45^3 N mm
    14.5
    """
    motion = _oil_motion(viscosity, oil_density, wheel_speed)
    return factor * 1e-7 * np.maximum(np.abs(motion), 2000.0) ** (2.0 / 3.0) * (bearing_diameter * 1e3) ** 3 * 1e-3


def palmgren_load_torque(
    load: np.ndarray, bearing_diameter: np.ndarray, factor: float | np.ndarray = 3e-4
) -> np.ndarray:
    r"""Torque that load adds in one rolling bearing (N m), :math:`M_1 = f_1 P_1 d_m`, f_1 = 0.0003 where not given.

    Cylindrical roller bearings have f_1 of 0.0002 to 0.0004 by their series; ball bearings 0.0006 to 0.0009 times the
    root of their static load over its rating. Source: A. Palmgren, Grundlagen der Waelzlagertechnik, 1964; ISO 15312.

    >>> round(float(palmgren_load_torque(1500.0, 0.045)) * 1e3, 2)
    20.25
    """
    return factor * load * bearing_diameter


def bearing_asperity_share(
    viscosity: np.ndarray, oil_density: np.ndarray, wheel_speed: np.ndarray, bearing_diameter: np.ndarray
) -> np.ndarray:
    r"""Share of boundary friction in the sliding of a rolling bearing (-): 1 without a film, 0 with a full one.

    .. math:: \phi_{bl} = \exp\left[-2.6\times10^{-8}\,(n\nu)^{1.4} d_m\right]

    with n in rpm, nu in mm^2/s, d_m in mm. Its constant makes the form belong to SI.
    Source: SKF, Rolling Bearings, 2018, model of the frictional moment.

    >>> round(float(bearing_asperity_share(20e-6 * 850, 850.0, 1000 * np.pi / 30, 0.045)), 2)   # exp(-1.23)
    0.29
    """
    motion = _oil_motion(viscosity, oil_density, wheel_speed)
    return np.exp(-2.6e-8 * np.abs(motion) ** 1.4 * bearing_diameter * 1e3)


def seal_torque(seal_diameter: np.ndarray) -> np.ndarray:
    r"""Torque of one radial lip seal (N m), :math:`T = 7.34\times10^{-5} d^2`, d in mm.

    The force of the lip that the constant stands for makes the form belong to N/m.
    Source: ISO/TR 14179-2, P = 7.69e-6 d^2 n in W, mm and rpm.

    >>> round(float(seal_torque(0.05)), 3)   # ISO/TR 14179-1, Viton: 0.187 N m
    0.184
    """
    return 7.343e-5 * (seal_diameter * 1e3) ** 2
