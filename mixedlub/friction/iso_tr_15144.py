"""Mean friction after ISO/TR 15144-1."""

import numpy as np

from mixedlub.chain.friction_law import Coefficient, friction_law
from mixedlub.chain.powers import power
from mixedlub.friction.schlenk import pitch_load


@friction_law(
    "ISO/TR 15144-1",
    "mesh",
    sources=1,
    status="one source",
    diverges=("pitch_entrainment_speed",),
    coefficients=(
        Coefficient("lubricant_factor", "-", "factor of the oil, X_L", 1.0, (0.6, 1.15)),
        Coefficient("load_factor", "-", "product of the factors of load, K_A K_v K_Ha K_Hb K_Bg", 1.0),
    ),
)
def iso_tr_15144(
    mesh_line_load: np.ndarray,
    pitch_entrainment_speed: np.ndarray,
    pitch_radius: float,
    viscosity: np.ndarray,
    mean_roughness: np.ndarray,
    *,
    lubricant_factor: float,
    load_factor: float,
) -> np.ndarray:
    r"""Mean friction coefficient of a gear mesh (-), as rating against micropitting takes it.

    .. math:: \mu_m = 0.045\left(\frac{K w_m}{v_{\Sigma C}\,\rho_C}\right)^{0.2}\eta^{-0.05} X_R X_L,\quad
              X_R = 2.2\left(\frac{R_a}{\rho_C}\right)^{0.25}

    w_m in N/mm, the sum speed v_Sigma,C at the pitch point in m/s, rho_C in mm, eta in mPa s, Ra in um.

    Source: ISO/TR 15144-1:2014.

    >>> fzg = (387.24e3, 6.3362 / 2, 8.3820e-3, 0.010, 0.2e-6)   # test gear FZG C at 183.4 N m and 8.3 m/s
    >>> round(float(iso_tr_15144(*fzg, lubricant_factor=1.0, load_factor=1.0)), 4)
    0.0516
    """
    finish = 2.2 * power(mean_roughness * 1e3 / pitch_radius, 0.25) * lubricant_factor
    load = pitch_load(mesh_line_load * load_factor, pitch_entrainment_speed, pitch_radius)
    return 0.045 * load * power(viscosity * 1e3, -0.05) * finish
