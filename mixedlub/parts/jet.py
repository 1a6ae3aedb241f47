"""Oil of a jet that the teeth carry along."""

import numpy as np

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law


@part_law(
    "jet",
    "ariura",
    "Ariura",
    sources=1,
    status="the momentum of the oil; the factor has one source, 0.85 to 1",
    coefficients=(
        Coefficient("momentum_factor", "-", "C1, share of the oil that the teeth carry along", 1.0),
        Coefficient("against", "-", "1: the jet meets the motion of the teeth; -1: it goes along with it", -1.0),
    ),
)
def jet(
    wheel_radius: np.ndarray,
    shaft_speed: np.ndarray,
    oil_density: np.ndarray,
    oil_flow: np.ndarray,
    jet_speed: np.ndarray,
    *,
    momentum_factor: float,
    against: float,
) -> np.ndarray:
    r"""Power that brings the oil of a jet to the speed of the teeth (W).

    .. math:: P = C_1\rho\,Q\,v_t (v_t \pm v_j)

    Source: Y. Ariura, T. Ueno, T. Sunaga, S. Sunamoto, Bull. JSME 16 (1973) 881.

    >>> flow = dict(oil_density=820.0, oil_flow=2.5e-3 / 60, jet_speed=0.4, momentum_factor=1.0, against=1.0)
    >>> round(float(jet(0.1, 300.0, **flow)))   # 30 m/s
    31
    """
    speed = shaft_speed * wheel_radius
    return momentum_factor * oil_density * oil_flow * speed * np.maximum(speed + against * jet_speed, 0.0)
