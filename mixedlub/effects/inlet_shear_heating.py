"""Inlet shear heating."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform

REFERENCE_PRESSURE_RATIO = 0.005
"""Hertz pressure over reduced modulus at which the published factors nearly agree."""


@effect(
    stage="film",
    acts_on="film_thickness",
    parameters=(
        Parameter(
            "strength", "-", LogNormal(1.0, 0.6), "factor on both terms of the thermal loading", null=0.0, symbol="c"
        ),
        Parameter(
            "sliding", "-", LogNormal(1.0, 0.8), "weight of sliding, which blends the published factors", symbol="d"
        ),
        Parameter("loading_power", "-", Uniform(0.5, 0.65), "exponent of the thermal loading", symbol="m"),
        Parameter("pressure_power", "-", Uniform(0.0, 0.9), "exponent of the Hertz pressure", symbol="q"),
    ),
    equation=r"h \leftarrow h\,\frac{e^{-13.2\,c\,(p_0/E')\,L^{0.42}}}{1 + 0.213\,c\,(1 + "
    r"2.23\,d\,S^{0.83})\,L^m\,(p_0/0.005E')^q},\quad L = \beta\eta_0 u^2/k_f",
    source="P. K. Gupta, H. S. Cheng, D. Zhu, N. H. Forster, J. B. Schrand, Tribol. Trans. 35 (1992) 269, with m = "
    "0.64 and q = 0; d = 0 is close to H. Murch, W. R. D. Wilson, J. Lubr. Technol. 97 (1975) 212; load as in "
    "C.-H. Hsu, R.-T. Lee, J. Tribol. 116 (1994) 762",
    fingerprint={"load": "-", "speed": "+", "oil_temperature": "-"},
    separated_by="a speed sweep in cold oil: the loss of film grows with viscosity times speed squared, and does "
    "not change with oil flow as starvation does",
    valid={"slide_roll_ratio": (0.0, 2.0)},
    special_cases={"Gupta": {"loading_power": 0.64, "pressure_power": 0.0}},
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
    loading_power: float,
    pressure_power: float,
) -> np.ndarray:
    """Shear in the inlet warms the oil, so the film is thinner than the isothermal law predicts.

    The published numerator 1 - 13.2 (p0/E') L^0.42 is written as an exponential, which stays positive; the two
    differ by 2 % at L = 10. Fits of full solutions differ in the exponent of the thermal loading, 0.5 to 0.65, and in
    whether the loss grows with load.

    >>> gupta = {"loading_power": 0.64, "pressure_power": 0.0}
    >>> h = inlet_shear_heating(1.0, 0.04, 0.1, 1.0, 0.004, 0.5, 0.005, 1.0, strength=1.0, sliding=1.0, **gupta)
    >>> round(float(h), 2)   # L = 1, S = 0.5, p0/E' = 0.005; the published form gives 0.631
    0.63
    >>> h = inlet_shear_heating(1.0, 0.04, 0.1, 1.0, 0.004, 0.5, 0.0, 1.0, strength=1.0, sliding=0.0, **gupta)
    >>> round(float(h), 2)   # Murch-Wilson at L = 1: 0.80
    0.82
    """
    loading = temperature_viscosity * viscosity * entrainment_speed**2 / oil_conductivity
    pressure = hertz_pressure / reduced_modulus
    rolling = 13.2 * strength * pressure * loading**0.42
    slid = 1.0 + 2.23 * sliding * slide_roll_ratio**0.83
    shear = 0.213 * strength * slid * loading**loading_power * (pressure / REFERENCE_PRESSURE_RATIO) ** pressure_power
    return film_thickness * (np.exp(-rolling) / (1.0 + shear))
