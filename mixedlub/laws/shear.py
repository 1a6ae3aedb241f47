"""Shear of the film."""

from __future__ import annotations

import numpy as np

from mixedlub.chain.slots import SHEAR

MOST_FRICTION = {"fluid_friction": (0.0, 0.12)}
"""Judgement. Oils yield at a share of the pressure of 0.03 to 0.09 in the literature, traction fluids at up to 0.12."""


@SHEAR.offers("asinh", "effective viscosity such that the stress is tau0 asinh(eta v_s/(h tau0))", MOST_FRICTION)
def ree_eyring(
    contact_viscosity: np.ndarray,
    sliding_speed: np.ndarray,
    film_thickness: np.ndarray,
    eyring_stress: np.ndarray,
) -> np.ndarray:
    r"""Shear stress of the film (Pa), :math:`\tau = \tau_0 \operatorname{asinh}(\eta v_s / (h \tau_0))`.

    Newtonian far below tau_0, logarithmic far above; tau_0 3 to 10 MPa for gear oils.
    Source: H. Eyring, J. Chem. Phys. 4 (1936) 283, single-term form.

    >>> round(float(ree_eyring(70.2, 0.7518, 0.2310e-6, 5e6)) / 1e6, 2)
    22.58
    """
    return eyring_stress * np.arcsinh(contact_viscosity * sliding_speed / (film_thickness * eyring_stress))


@SHEAR.offers("secant", "effective viscosity eta/cosh(tau_m/tau0), which caps the stress at tau0")
def ree_eyring_secant(
    contact_viscosity: np.ndarray,
    sliding_speed: np.ndarray,
    film_thickness: np.ndarray,
    eyring_stress: np.ndarray,
) -> np.ndarray:
    r"""Shear stress with the viscosity of the Eyring-Reynolds equation, :math:`\eta/\cosh(\tau_m/\tau_0)` (Pa).

    .. math:: \tau = \frac{\eta v_s/h}{\sqrt{1 + (\eta v_s/(h\tau_0))^2}} \le \tau_0

    A second reading of the effective viscosity; it caps friction at tau_0/p.
    Source: Hong, Aneshansley, Talbot, Gear Technology, eq. 2.

    >>> round(float(ree_eyring_secant(70.2, 0.7518, 0.2310e-6, 5e6)) / 1e6, 2)
    5.0
    """
    rate = contact_viscosity * sliding_speed / film_thickness
    return rate / np.sqrt(1.0 + (rate / eyring_stress) ** 2)
