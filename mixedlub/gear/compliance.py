"""Elastic laws of one tooth under a line load: bending and shear, foundation, local flattening.

All per unit face width: a compliance is deflection along the load line over line load, m / (N/m).
"""

from __future__ import annotations

import math

import numpy as np

from mixedlub.gear.geometry import GearPair
from mixedlub.gear.tooth import Tooth


def bending_compliance(
    tooth: Tooth, roll_distance: np.ndarray, youngs_modulus: float, poisson_ratio: float
) -> np.ndarray:
    r"""Bending, shear and compression of the tooth as a tapered cantilever in plane strain.

    (cos^2 a'/E) {12 (1-nu^2) INT (y_p-y)^2/t^3 dy + [2.4 (1+nu) + (1-nu^2) tan^2 a'] INT dy/t}, from the root
    section to the crossing y_p of load line and centreline; t(y) thickness, a' the load's angle to the
    centreline's normal. ``roll_distance`` (m, any shape): from the wheel's base tangent point to the contact.

    Source: Weber and Banaschek 1953 (they print 10.92 and 3.1 (1 + 0.294 tan^2 a'), these constants at nu 0.3).
    """
    height, thickness = tooth.height, 2 * tooth.half_thickness
    reach = np.maximum(tooth.load_height(roll_distance), height[0])
    moments = [_running_integral(height, (height - height[0]) ** k / thickness**3) for k in range(3)]
    zeroth, first, second = (np.interp(reach, height, moment) for moment in moments)
    arm = reach - height[0]
    bend = arm**2 * zeroth - 2 * arm * first + second
    slender = np.interp(reach, height, _running_integral(height, 1 / thickness))
    angle = tooth.load_angle(roll_distance)
    stretch = 2.4 * (1 + poisson_ratio) + (1 - poisson_ratio**2) * np.tan(angle) ** 2
    plane = 12 * (1 - poisson_ratio**2)
    return np.cos(angle) ** 2 / youngs_modulus * (plane * bend + stretch * slender)


def weber_foundation(poisson_ratio: float) -> tuple[float, float, float, float]:
    """Coefficients (arm squared, arm, shear, tan^2 part of shear) of a tooth on an elastic half plane.

    delta_f/(F/b) = (cos^2 a'/E) [c2 (u/s)^2 + c1 (u/s) + c0 (1 + q tan^2 a')], u the arm from the root section,
    s its chord. Source: Weber 1949 as given by Cornell 1981.

    >>> print(*(round(c, 3) for c in weber_foundation(0.3)))
    4.828 1.04 1.396 0.32
    """
    strain = 1 - poisson_ratio**2
    return (
        5.306 * strain,
        2 * (1 - poisson_ratio - 2 * poisson_ratio**2),
        1.534 * strain,
        0.4166 / (1 + poisson_ratio),
    )


SAINSOT_ANGLES = 0.01, 0.12
"""Half root angles (rad) for which the ring foundation holds."""
SAINSOT = np.array(
    [
        [-5.574e-5, -1.9986e-3, -2.3015e-4, 4.7702e-3, 0.0271, 6.8045],
        [60.111e-5, 28.100e-3, -83.431e-4, -9.9256e-3, 0.1624, 0.9086],
        [-50.952e-5, 185.50e-3, 0.0538e-4, 53.300e-3, 0.2895, 0.9236],
        [-6.2042e-5, 9.0889e-3, -4.0964e-4, 7.8297e-3, -0.1472, 0.6904],
    ]
)


def sainsot_foundation(root_to_bore: float, half_root_angle: float) -> tuple[float, float, float, float]:
    """The same four coefficients for a tooth on an elastic ring.

    X = A/theta^2 + B h^2 + C h/theta + D/theta + E h + F with h the root radius over the bore's and theta the
    half angle of the tooth at the root, rad. Valid for h from 1.4 to 7 and theta from 0.01 to 0.12. About a
    fifth softer than the half plane. Source: Sainsot, Velex and Duverger 2004, table 1.

    >>> print(round(sainsot_foundation(1.4, 0.12)[0], 2))
    6.87
    """
    h, theta = root_to_bore, half_root_angle
    values = SAINSOT @ np.array([theta**-2, h**2, h / theta, 1 / theta, h, 1.0])
    return float(values[0]), float(values[1]), float(values[2]), float(values[3])


def foundation_compliance(
    tooth: Tooth, roll_distance: np.ndarray, youngs_modulus: float, coefficients: tuple[float, ...]
) -> np.ndarray:
    """Compliance of the wheel's body under the tooth, from the four coefficients of a foundation law."""
    angle = tooth.load_angle(roll_distance)
    arm = np.maximum(tooth.load_height(roll_distance) - tooth.height[0], 0) / tooth.root_chord
    square, linear, shear, slope = coefficients
    bracket = square * arm**2 + linear * arm + shear * (1 + slope * np.tan(angle) ** 2)
    return np.cos(angle) ** 2 / youngs_modulus * bracket


def hertz_approach(
    line_load: np.ndarray,
    radius: np.ndarray,
    reduced_modulus: float,
    depths: tuple[np.ndarray, np.ndarray],
    youngs_modulus: tuple[float, float],
    poisson_ratio: tuple[float, float],
) -> tuple[np.ndarray, np.ndarray]:
    r"""Approach of two points at the given depths below a line contact, and its slope in the line load.

    delta = SUM_i (2 w (1-nu_i^2)/(pi E_i)) {asinh(h_i/b) - [nu_i/(1-nu_i)] h_i/(sqrt(h_i^2+b^2) + h_i)} with the
    half width b = sqrt(8 w R/(pi E')). ``line_load`` w > 0 in N/m; radius and depths in m; exact in plane strain.
    Returns (m, m/(N/m)).

    Source: integrated from McEwen's stresses; Weber's logarithm 2h >> b follows.

    >>> steel = dict(youngs_modulus=(206e9, 206e9), poisson_ratio=(0.3, 0.3))
    >>> delta, _ = hertz_approach(3e5, 8e-3, 206e9 / 0.91, (4e-3, 4e-3), **steel)
    >>> print(round(delta * 1e6, 2))
    6.2
    """
    half_width = np.sqrt(8 * line_load * radius / (math.pi * reduced_modulus))
    approach, slope = np.zeros_like(half_width), np.zeros_like(half_width)
    for depth, young, poisson in zip(depths, youngs_modulus, poisson_ratio):
        scale = 2 * (1 - poisson**2) / (math.pi * young)
        far = np.hypot(depth, half_width)
        ratio = poisson / (1 - poisson)
        bracket = np.arcsinh(depth / half_width) - ratio * depth / (far + depth)
        # db/dw = b/(2w); both terms fall as the contact widens.
        widening = -depth / far + ratio * depth * half_width**2 / (far * (far + depth) ** 2)
        approach = approach + scale * line_load * bracket
        slope = slope + scale * (bracket + widening / 2)
    return approach, slope


def iso_single_stiffness(pair: GearPair) -> float:
    """Theoretical stiffness c'_th of one tooth pair per unit face width, N/m per m (1e9 = 1 N/(mm um)).

    1/q' with q' = 0.04723 + 0.15551/z_1 + 0.25791/z_2 - 0.00635 x_1 - 0.11654 x_1/z_1 - 0.00193 x_2
    - 0.24188 x_2/z_2 + 0.00529 x_1^2 + 0.00182 x_2^2 in mm um/N, z the equivalent spur teeth, infinite for a
    ring gear. Steel, standard rack. Source: ISO 6336-1, method B.

    >>> print(round(iso_single_stiffness(GearPair((17, 43), 1e-3, math.radians(20), 10e-3)) / 1e9, 3))
    16.032
    """
    (x1, x2) = pair.profile_shift
    cosine = math.cos(pair.helix_angle) * math.cos(pair.base_helix_angle) ** 2
    z1, z2 = pair.teeth[0] / cosine, math.inf if pair.ring else pair.teeth[1] / cosine
    compliance = 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 * x1 - 0.11654 * x1 / z1
    compliance += -0.00193 * x2 - 0.24188 * x2 / z2 + 0.00529 * x1**2 + 0.00182 * x2**2
    return 1e9 / compliance


def _running_integral(grid: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Trapezoidal integral from the first grid point to every other."""
    pieces = np.diff(grid) * (values[1:] + values[:-1]) / 2
    return np.concatenate([[0.0], np.cumsum(pieces)])
