"""Mean friction after Fernandes."""

import numpy as np

from mixedlub.chain.friction_law import Coefficient, friction_law
from mixedlub.chain.powers import power


@friction_law(
    "Fernandes",
    "mesh",
    sources=1,
    status="one source, a program, which has no factor of the oil; papers fold one in",
    diverges=("pitch_entrainment_speed",),
    coefficients=(Coefficient("lubricant_factor", "-", "factor of the oil, X_L", 1.0, (0.6, 1.15)),),
)
def fernandes(
    pitch_entrainment_speed: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    transmitted_force: np.ndarray,
    base_helix_angle: float,
    mean_roughness: np.ndarray,
    contact_ratio: float,
    face_width: float,
    pitch_radius: float,
    *,
    lubricant_factor: float,
) -> np.ndarray:
    r"""Mean friction coefficient of a gear mesh (-), from gear and bearing tests of wind-turbine oils.

    .. math:: \mu_m = 0.014\,S_p^{-0.25} S_g^{0.125} X_L,\quad
              S_p = v_{\Sigma C}\,\eta\sqrt{\alpha/F_n},\quad S_g = \frac{R_a^2}{\epsilon_\alpha b\,\rho_C}

    in SI; F_n is the normal force on the flank. The source has the shortest total contact line in place of the face
    width b, which differs in helical gears.

    Source: C. M. C. G. Fernandes, P. M. T. Marques, R. C. Martins, J. H. O. Seabra, Tribol. Int. 88 (2015) 309;
    constants as in the authors' program.

    >>> gear = (6.3362 / 2, 0.010, 15e-9, 387.24e3 * 14e-3, 0.0, 0.2e-6, 1.44, 14e-3, 8.3820e-3)
    >>> round(float(fernandes(*gear, lubricant_factor=1.0)), 4)   # test gear FZG C at 183.4 N m and 8.3 m/s
    0.0487
    """
    force = transmitted_force / np.cos(base_helix_angle)
    speed = 2.0 * pitch_entrainment_speed * viscosity * np.sqrt(pressure_viscosity / force)
    finish = mean_roughness**2 / (contact_ratio * face_width * pitch_radius)
    return 0.014 * power(speed, -0.25) * power(finish, 0.125) * lubricant_factor
