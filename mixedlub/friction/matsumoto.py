"""Mean friction after Matsumoto and Morikawa, with the film friction of the user."""

import numpy as np

from mixedlub.chain.friction_law import Coefficient, friction_law


@friction_law(
    "Matsumoto and Morikawa",
    "mesh",
    sources=2,
    status="the share of the asperities has two sources; the friction of the film is yours",
    coefficients=(
        Coefficient("film_friction", "-", "friction of the film", usual=(0.003, 0.04)),
        Coefficient("rz_sum_um", "µm", "peak-to-valley heights of both surfaces, Rz1 + Rz2", usual=(0.5, 20.0)),
    ),
)
def matsumoto(
    pitch_minimum_film: np.ndarray, boundary_friction: np.ndarray, *, film_friction: float, rz_sum_um: float
) -> np.ndarray:
    r"""Mean friction coefficient of a gear mesh (-): film and boundary friction, weighted by peaks over film.

    .. math:: \mu_m = (1 - \xi)\mu_F + \xi\mu_B,\quad
              \xi = \tfrac12\log_{10}\frac{R_{z,1} + R_{z,2}}{h_{min}}

    xi is 0 below a ratio of 1 and 1 above one of 100. The minimum film follows Dowson and Higginson.

    Source: S. Matsumoto, K. Morikawa, International Gear Conference, Lyon, 2014.

    >>> [round(float(matsumoto(10e-6 / d, 0.09, film_friction=0.0093, rz_sum_um=10.0)), 5) for d in (1.0, 5.0, 10.0)]
    [0.0093, 0.0375, 0.04965]
    """
    share = np.clip(0.5 * np.log10(rz_sum_um * 1e-6 / pitch_minimum_film), 0.0, 1.0)
    return film_friction + (boundary_friction - film_friction) * share
