"""Mean friction after Doleschel, with the film friction of the user."""

import numpy as np

from mixedlub.chain.friction_law import Coefficient, friction_law
from mixedlub.chain.powers import power


@friction_law(
    "Doleschel",
    "mesh",
    sources=3,
    status="the share of the asperities has three sources; constants of the film friction none: they are the oil's, "
    "measured by the FVA efficiency test, and yours",
    coefficients=(
        Coefficient(
            "film_friction", "-", "friction of the film at 1000 N/mm², 8.3 m/s and 20 mPa s", usual=(0.005, 0.04)
        ),
        Coefficient("pressure_exponent", "-", "exponent of the pressure", 0.0, (-0.3, 0.3)),
        Coefficient("speed_exponent", "-", "exponent of the sum speed", 0.0, (-0.3, 0.3)),
        Coefficient("viscosity_exponent", "-", "exponent of the viscosity", 0.0, (-0.3, 0.3)),
    ),
)
def doleschel(
    pitch_film: np.ndarray,
    mean_roughness: np.ndarray,
    pitch_pressure: np.ndarray,
    pitch_entrainment_speed: np.ndarray,
    viscosity: np.ndarray,
    boundary_friction: np.ndarray,
    *,
    film_friction: float,
    pressure_exponent: float,
    speed_exponent: float,
    viscosity_exponent: float,
) -> np.ndarray:
    r"""Mean friction coefficient of a gear mesh (-): film and boundary friction, weighted by the film parameter.

    .. math:: \mu_m = (1 - \xi)\,\mu_F\left(\frac{p_C}{1000}\right)^a\left(\frac{v_{\Sigma C}}{8.3}\right)^c
              \left(\frac{\eta}{20}\right)^d + \xi\mu_B,\quad \xi = (1 - \lambda/2)^2

    lambda is the central film over the mean Ra of both surfaces, and xi is 0 above 2; p_C in N/mm2, the sum speed in
    m/s, eta in mPa s.

    Source: A. Doleschel, thesis, TU München, 2003.

    >>> plain = dict(film_friction=0.0093, pressure_exponent=0.0, speed_exponent=0.0, viscosity_exponent=0.0)
    >>> [round(float(doleschel(h, 1e-6, 1e9, 4.15, 0.02, 0.09, **plain)), 4) for h in (0.5e-6, 1e-6, 1.5e-6, 3e-6)]
    [0.0547, 0.0295, 0.0143, 0.0093]
    """
    share = np.maximum(1.0 - 0.5 * pitch_film / mean_roughness, 0.0) ** 2
    speed = power(2.0 * pitch_entrainment_speed / 8.3, speed_exponent) * power(viscosity / 0.020, viscosity_exponent)
    film = film_friction * power(pitch_pressure / 1e9, pressure_exponent) * speed
    return film + (boundary_friction - film) * share
