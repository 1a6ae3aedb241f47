"""Friction after Arana: a limited Eyring film, and asperities by the error function of the film parameter."""

import numpy as np

from mixedlub.chain.friction_law import Coefficient, friction_law
from mixedlub.laws.contact import mean_hertz_pressure


@friction_law(
    "Arana, Larranaga and Ulacia",
    "contact",
    sources=1,
    status="one source, read in full; gear losses measured there agree within 5 % with boundary friction 0.065",
    coefficients=(
        Coefficient(
            "limiting_stress_ratio",
            "-",
            "limiting shear stress over pressure; naphthenic oil 0.053, paraffinic 0.047, PAO 0.035, PAG 0.044",
            usual=(0.03, 0.12),
        ),
    ),
)
def arana(
    contact_viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    hertz_pressure: np.ndarray,
    sliding_speed: np.ndarray,
    film_thickness: np.ndarray,
    composite_roughness: np.ndarray,
    boundary_friction: np.ndarray,
    *,
    limiting_stress_ratio: float,
) -> np.ndarray:
    r"""Friction coefficient of a mixed contact (-): Eyring film below its limiting stress, and asperities.

    .. math:: \mu = (1 - \xi)\min\left[\frac{2\Lambda}{\alpha\bar p}\operatorname{asinh}
              \frac{\eta_p\,\alpha\,v_s}{2\Lambda h},\ \Lambda\right] + \xi\mu_B,\quad
              \xi = 1 - \operatorname{erf}(h/\sigma)

    with the mean Hertz pressure; the Eyring stress is 2 Lambda/alpha. The source takes the viscosity at the mean
    pressure and temperature of the contact, alpha at the pressure there, a film reduced by inlet heating, and boundary
    friction 0.065 to 0.07; here the options and effects of the study choose viscosity and film, and alpha is that at
    the inlet. For oils up to ISO VG 220, which is not checked.

    Source: A. Arana, J. Larranaga, I. Ulacia, Proc. IMechE J 233 (2019) 303, eq. 13 and 14.

    >>> [round(float(arana(1.0, 15e-9, 1e9, 0.0, h, 1e-6, 1.0, limiting_stress_ratio=0.047)), 4)
    ...  for h in (0.5e-6, 1e-6, 1.5e-6)]   # the share of the asperities
    [0.4795, 0.1573, 0.0339]
    """
    from scipy.special import erfc

    stress = 2.0 * limiting_stress_ratio / pressure_viscosity
    rate = contact_viscosity * sliding_speed / film_thickness
    film = stress * np.arcsinh(rate / stress) / mean_hertz_pressure(hertz_pressure)
    film = np.minimum(film, limiting_stress_ratio)
    return film + (boundary_friction - film) * erfc(film_thickness / composite_roughness)
