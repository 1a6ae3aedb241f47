"""Mean friction after Schlenk, as ISO/TR 14179-2 has it."""

import numpy as np

from mixedlub.chain.friction_law import Coefficient, friction_law
from mixedlub.chain.powers import power


@friction_law(
    "Schlenk (ISO/TR 14179-2)",
    "mesh",
    sources=3,
    status="three sources: two programs and a thesis",
    valid={"pitch_line_speed": (0.0, 50.0)},
    diverges=("pitch_entrainment_speed",),
    coefficients=(
        Coefficient(
            "lubricant_factor",
            "-",
            "factor of the oil, X_L; mineral 0.85 to 1, PAO 0.65 to 0.8, PAG 0.6 to 0.7",
            1.0,
            (0.6, 1.15),
        ),
    ),
)
def schlenk(
    mesh_line_load: np.ndarray,
    pitch_entrainment_speed: np.ndarray,
    pitch_radius: float,
    viscosity: np.ndarray,
    mean_roughness: np.ndarray,
    *,
    lubricant_factor: float,
) -> np.ndarray:
    r"""Mean friction coefficient of a gear mesh (-), from gear tests.

    .. math:: \mu_m = 0.048\left(\frac{w_m}{v_{\Sigma C}\,\rho_C}\right)^{0.2}\eta^{-0.05} R_a^{0.25} X_L

    w_m in N/mm, the sum speed v_Sigma,C at the pitch point in m/s, rho_C in mm, eta in mPa s, Ra in um.

    Source: ISO/TR 14179-2:2001, after C. Schlenk, thesis, TU München, 1994; G. Niemann, H. Winter,
    Maschinenelemente II.

    >>> fzg = (387.24e3, 6.3362 / 2, 8.3820e-3, 0.010, 0.2e-6)   # test gear FZG C at 183.4 N m and 8.3 m/s
    >>> round(float(schlenk(*fzg, lubricant_factor=1.0)), 5)
    0.04257
    """
    load = pitch_load(mesh_line_load, pitch_entrainment_speed, pitch_radius)
    return 0.048 * load * power(viscosity * 1e3, -0.05) * power(mean_roughness * 1e6, 0.25) * lubricant_factor


def pitch_load(mesh_line_load: np.ndarray, pitch_entrainment_speed: np.ndarray, pitch_radius: float) -> np.ndarray:
    r"""Group of load, speed and curvature that the laws of FZG share, :math:`(w_m/(v_{\Sigma C}\rho_C))^{0.2}`.

    w_m in N/mm, the sum speed in m/s, rho_C in mm, which the form belongs to.

    >>> round(float(pitch_load(387.24e3, 6.3362 / 2, 8.3820e-3)), 4)
    1.4879
    """
    return power(1e-3 * mesh_line_load / (2.0 * pitch_entrainment_speed * 1e3 * pitch_radius), 0.2)
