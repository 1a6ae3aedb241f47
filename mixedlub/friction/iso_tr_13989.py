"""Mean friction after ISO/TR 13989-1."""

import numpy as np

from mixedlub.chain.friction_law import Coefficient, friction_law
from mixedlub.chain.powers import power
from mixedlub.friction.schlenk import pitch_load


@friction_law(
    "ISO/TR 13989-1",
    "mesh",
    sources=1,
    status="one source",
    diverges=("pitch_entrainment_speed",),
    coefficients=(
        Coefficient("lubricant_factor", "-", "factor of the base stock beside that of viscosity", 1.0, (0.6, 1.15)),
    ),
)
def iso_tr_13989(
    mesh_line_load: np.ndarray,
    pitch_entrainment_speed: np.ndarray,
    pitch_radius: float,
    viscosity: np.ndarray,
    mean_roughness: np.ndarray,
    *,
    lubricant_factor: float,
) -> np.ndarray:
    r"""Mean friction coefficient of a gear mesh (-), as rating against scuffing takes it.

    .. math:: \mu_m = 0.060\left(\frac{w_m}{v_{\Sigma C}\,\rho_C}\right)^{0.2} X_L\,\eta^{-0.05} R_a^{0.25}

    w_m in N/mm, the sum speed v_Sigma,C at the pitch point in m/s, rho_C in mm, eta in mPa s, Ra in um.

    Source: ISO/TR 13989-1:2000, flash temperature method.

    >>> fzg = (387.24e3, 6.3362 / 2, 8.3820e-3, 0.010, 0.2e-6)   # test gear FZG C at 183.4 N m and 8.3 m/s
    >>> round(float(iso_tr_13989(*fzg, lubricant_factor=1.0)), 5)
    0.05321
    """
    load = pitch_load(mesh_line_load, pitch_entrainment_speed, pitch_radius)
    return 0.060 * lubricant_factor * load * power(viscosity * 1e3, -0.05) * power(mean_roughness * 1e6, 0.25)
