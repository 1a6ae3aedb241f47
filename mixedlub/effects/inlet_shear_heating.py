"""Inlet shear heating."""

import numpy as np

from mixedlub.effect import LogNormal, Parameter, effect


@effect(
    stage="film",
    acts_on="film_thickness",
    parameters=(
        Parameter(
            "strength", "-", LogNormal(1.0, 0.6), "factor on both terms of the thermal loading", null=0.0, symbol="c"
        ),
        Parameter("sliding", "-", LogNormal(1.0, 0.8), "weight of sliding, between the published factors", symbol="d"),
    ),
    equation=r"h \leftarrow h\,\frac{e^{-13.2\,c\,(p_0/E')\,L^{0.42}}}{1 + 0.213\,c\,(1 + "
    r"2.23\,d\,S^{0.83})\,L^{0.64}},\quad L = \beta\eta_0 u^2/k_f",
    source="P. K. Gupta, H. S. Cheng, D. Zhu, N. H. Forster, J. B. Schrand, Tribol. Trans. 35 (1992) 269; d = "
    "0 is close to H. Murch, W. R. D. Wilson, J. Lubr. Technol. 97 (1975) 212",
    fingerprint={"load": "-", "speed": "+", "oil_temperature": "-"},
    separated_by="a speed sweep in cold oil: the loss of film grows with viscosity times speed squared, and does "
    "not change with oil flow as starvation does",
    valid={"slide_roll_ratio": (0.0, 2.0)},
)
def inlet_shear_heating(
    film_thickness: np.ndarray,
    temperature_viscosity: np.ndarray,
    viscosity: np.ndarray,
    entrainment_speed: np.ndarray,
    oil_conductivity: np.ndarray,
    slide_roll_ratio: np.ndarray,
    hertz_pressure: np.ndarray,
    reduced_modulus: np.ndarray,
    *,
    strength: float,
    sliding: float,
) -> np.ndarray:
    """Shear in the inlet warms the oil, so the film is thinner than the isothermal law says.

    The published numerator 1 - 13.2 (p0/E') L^0.42 is written as an exponential, which stays positive; the two
    differ by 2 % at L = 10.

    >>> h = inlet_shear_heating(1.0, 0.04, 0.1, 1.0, 0.004, 0.5, 0.005, 1.0, strength=1.0, sliding=1.0)
    >>> round(float(h), 2)   # L = 1, S = 0.5, p0/E' = 0.005; the published form gives 0.631
    0.63
    >>> h = inlet_shear_heating(1.0, 0.04, 0.1, 1.0, 0.004, 0.5, 0.0, 1.0, strength=1.0, sliding=0.0)
    >>> round(float(h), 2)   # Murch-Wilson at L = 1: 0.80
    0.82
    """
    loading = temperature_viscosity * viscosity * entrainment_speed**2 / oil_conductivity
    rolling = 13.2 * strength * (hertz_pressure / reduced_modulus) * loading**0.42
    shear = 0.213 * strength * (1.0 + 2.23 * sliding * slide_roll_ratio**0.83) * loading**0.64
    return film_thickness * (np.exp(-rolling) / (1.0 + shear))
