"""Laws of a worm mesh: kinematics, mean film, mean friction, efficiency in both directions of power."""

from __future__ import annotations

import numpy as np

FOOT_PER_MINUTE = 0.00508
"""Definition. One foot a minute in m/s."""


def lead_angle(threads: int, axial_module: float, worm_diameter: float) -> float:
    r"""Lead angle (rad) at the reference cylinder of the worm.

    .. math:: \tan\gamma = m_x z_1/d_1

    Source: SDP/SI, Elements of Metric Gear Technology, section 9, with this example.

    >>> round(float(np.degrees(lead_angle(2, 3.0, 44.0))), 6)
    7.765166
    """
    return float(np.arctan(axial_module * threads / worm_diameter))


def sliding_speed(worm_speed: np.ndarray | float, worm_diameter: float, lead: float) -> np.ndarray:
    r"""Sliding speed (m/s) at the reference cylinder along the thread.

    .. math:: v_g = \frac{\omega_1 d_1}{2\cos\gamma}

    Source: ISO/TR 14521.
    """
    return np.asarray(worm_speed * worm_diameter / (2.0 * np.cos(lead)))


def mean_film(
    torque: np.ndarray,
    speed: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    *,
    parameter: float,
    coefficient: float,
    centre_distance: float,
    modulus: float,
) -> np.ndarray:
    r"""Mean minimum film (m), in the form of Dowson and Higginson with the sizes of a worm drive.

    .. math:: h = k\,h^*\,\alpha^{0.6}\,(\eta_0 n_1)^{0.7}\,a^{1.39}\,E^{0.03}/T_2^{0.13}

    ``coefficient``: k for h in um with alpha in m2/N, eta_0 in N s/m2, n_1 in rpm, a in mm, E in N/mm2 and T_2 in N m,
    as the standard prints it; ``parameter``: h*. Inputs in SI: ``torque`` of the wheel, ``speed`` of the worm.
    The exponents follow from R^0.43 alpha^0.6 (eta u)^0.7 E^0.03/w^0.13 with R as a, u as n_1 a and w as T_2/a^2.

    Source: form of ISO/TR 14521; D. Dowson, G. R. Higginson, J. Mech. Eng. Sci. 1 (1959) 6, for the exponents.
    """
    turns = speed * 30.0 / np.pi
    entrained = pressure_viscosity**0.6 * (viscosity * turns) ** 0.7
    size = (1e3 * centre_distance) ** 1.39 * (1e-6 * modulus) ** 0.03
    return np.asarray(1e-6 * coefficient * parameter * entrained * size / torque**0.13)


def base_friction(
    speed: np.ndarray, *, constant: float, gain: float, shift: float, exponent: float, largest: float
) -> np.ndarray:
    r"""Friction coefficient of a reference drive, which falls with the sliding speed (m/s).

    .. math:: \mu_0 = \min\left(c + \frac{g}{(v_g + v_0)^e}, \mu_\mathrm{max}\right)

    Source: form of ISO/TR 14521; its numbers, by oil, wheel and supply of oil, are the user's.

    >>> own = {"constant": 0.02, "gain": 0.01, "shift": 0.2, "exponent": 1.0, "largest": 0.06}
    >>> base_friction(np.array([0.0, 0.8, 1e9]), **own).round(6).tolist()
    [0.06, 0.03, 0.02]
    """
    return np.minimum(constant + gain / (speed + shift) ** exponent, largest)


def power_factor(value: float, reference: float, exponent: float) -> float:
    r"""Factor of a size, a film parameter or a roughness on the friction of the reference drive.

    .. math:: Y = (x/x_\mathrm{ref})^e

    Source: form of ISO/TR 14521.

    >>> power_factor(200.0, 100.0, -0.5) == 0.5**0.5
    True
    """
    return float((value / reference) ** exponent)


def agma_6034(speed: np.ndarray) -> np.ndarray:
    r"""Friction coefficient of a hardened steel worm and a bronze wheel at a sliding speed (m/s), v in ft/min.

    .. math:: \mu = 0.103\exp(-0.110\,v^{0.450}) + 0.012\quad\text{above 10},\quad 0.124\exp(-0.074\,v^{0.645})

    Source: ANSI/AGMA 6034-B92.

    >>> agma_6034(np.array([0.05, 0.5, 5.0])).round(4)
    array([0.0897, 0.0553, 0.0209])
    """
    feet = np.asarray(speed) / FOOT_PER_MINUTE
    slow, fast = 0.124 * np.exp(-0.074 * feet**0.645), 0.103 * np.exp(-0.110 * feet**0.450) + 0.012
    return np.where(feet <= 10.0, slow, fast)


def friction_angle(friction: np.ndarray, pressure_angle: float) -> np.ndarray:
    r"""Friction angle (rad) of flanks inclined by the normal pressure angle.

    .. math:: \rho = \arctan(\mu/\cos\alpha_n)

    Source: ISO/TR 14521 takes the pressure angle 0, as its mean coefficient contains the inclination.
    """
    return np.arctan(friction / np.cos(pressure_angle))


def driving_efficiency(lead: float, angle: np.ndarray) -> np.ndarray:
    r"""Efficiency of the mesh where the worm drives.

    .. math:: \eta = \tan\gamma/\tan(\gamma + \rho)

    Source: ISO/TR 14521. Leads of 1, 2.5 and 5 deg with a friction of 0.05 at 14.5 deg are printed as 25.2, 45.7 and
    62.6 % (J. E. Shigley, C. R. Mischke, Mechanical Engineering Design):

    >>> lead, angle = np.radians([1.0, 2.5, 5.0]), friction_angle(0.05, np.radians(14.5))
    >>> (100 * driving_efficiency(lead, angle)).round(1)
    array([25.2, 45.7, 62.6])
    """
    return np.tan(lead) / np.tan(lead + np.asarray(angle))


def driven_efficiency(lead: float, angle: np.ndarray) -> np.ndarray:
    r"""Efficiency of the mesh where the wheel drives; not above 0 where the drive locks itself.

    .. math:: \eta' = \tan(\gamma - \rho)/\tan\gamma

    Source: ISO/TR 14521.
    """
    return np.tan(lead - np.asarray(angle)) / np.tan(lead)
