"""Inlet shear heating."""

import numpy as np

from mixedlub.effect import LogNormal, Parameter, effect


@effect(
    stage="film",
    acts_on="film_thickness",
    parameters=(
        Parameter("strength", "-", LogNormal(1.0, 0.6), "factor on the thermal loading parameter's terms", null=0.0),
    ),
    equation=r"h \leftarrow h\,\frac{1 - 13.2\,(p_0/E')\,L^{0.42}}{1 + 0.213\,(1 + 2.23\,S^{0.83})\,L^{0.64}},"
    r"\quad L = \beta\eta_0 u^2/k_f",
    source="P. K. Gupta, H. S. Cheng, D. Zhu, N. H. Forster, J. B. Schrand, Tribol. Trans. 35 (1992) 269",
    fingerprint={"entrainment_speed": "-", "viscosity": "-"},
    separated_by="a speed sweep in cold oil: the loss of film grows with viscosity times speed squared, and does "
    "not change with oil flow as starvation does",
    valid={"slide_roll_ratio": (0.0, 2.0)},
)
def inlet_shear_heating(
    film_thickness,
    temperature_viscosity,
    viscosity,
    entrainment_speed,
    oil_conductivity,
    slide_roll_ratio,
    hertz_pressure,
    reduced_modulus,
    *,
    strength,
):
    """Shear in the inlet warms the oil, so the film is thinner than the isothermal law says.

    The factor is kept above 0.2; the numerator would turn negative for L above about 300.

    >>> h = inlet_shear_heating(1.0, 0.04, 0.1, 1.0, 0.004, 0.5, 0.005, 1.0, strength=1.0)
    >>> round(float(h), 2)   # L = 1, S = 0.5, p0/E' = 0.005
    0.63
    """
    loading = temperature_viscosity * viscosity * entrainment_speed**2 / oil_conductivity
    rolling = 1.0 - 13.2 * strength * (hertz_pressure / reduced_modulus) * loading**0.42
    sliding = 1.0 + 0.213 * strength * (1.0 + 2.23 * slide_roll_ratio**0.83) * loading**0.64
    return film_thickness * np.maximum(rolling / sliding, 0.2)
