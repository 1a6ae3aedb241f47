"""Oil and air squeezed out of the tooth spaces."""

import numpy as np

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law


@part_law(
    "pocketing",
    "incompressible",
    "Incompressible flow out of the tooth spaces",
    sources=0,
    status="an order of magnitude by the balance of energy; the volume squeezed and the area of its exit are yours",
    coefficients=(
        Coefficient("pocket_volume", "-", "volume squeezed a tooth space over module² times face width"),
        Coefficient("mixture_density", "kg/m³", "density of what fills the spaces: oil, air or both"),
    ),
)
def pocketing(
    shaft_speed: np.ndarray,
    wheel_teeth: np.ndarray,
    gear_module: np.ndarray,
    face_width: np.ndarray,
    exit_area: np.ndarray,
    *,
    pocket_volume: float,
    mixture_density: float,
) -> np.ndarray:
    r"""Power that squeezes the filling of the tooth spaces out of the mesh (W), with the cube of speed.

    .. math:: P = \tfrac12\rho\,\frac{Q^3}{A^2},\quad Q = \frac{z\,\omega}{2\pi}\,c\,m_n^2 b

    The flow leaves with its kinetic energy through the area A of both ends and the backlash.

    Source: the scaling of S. Seetharaman, A. Kahraman, J. Tribol. 131 (2009) 022201, for an incompressible filling.

    >>> round(float(pocketing(100 * np.pi, 20.0, 4e-3, 0.02, 2e-5, pocket_volume=0.5, mixture_density=100.0)), 2)
    0.51
    """
    flow = wheel_teeth * shaft_speed / (2.0 * np.pi) * pocket_volume * gear_module**2 * face_width
    return 0.5 * mixture_density * flow**3 / exit_area**2
