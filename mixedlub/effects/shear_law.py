"""Shear of the film by another law than Ree and Eyring's with one stress."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Normal

MIDDLE_PRESSURE, MIDDLE_TEMPERATURE = 1e9, 353.15
"""Definition. Pressure (Pa) and oil temperature (K) at which the Eyring stress is the stated one."""


@effect(
    stage="law",
    acts_on="eyring_stress",
    parameters=(
        Parameter(
            "pressure_exponent",
            "-",
            Normal(0.5, 0.5),
            "exponent of pressure in the Eyring stress",
            null=0.0,
            symbol="a",
            base_sd=0.15,
        ),
        Parameter(
            "fall",
            "1/K",
            Normal(0.0, 0.01),
            "relative fall of the Eyring stress per kelvin of oil temperature",
            null=0.0,
            symbol="b",
        ),
        Parameter(
            "rate_exponent",
            "-",
            Normal(0.0, 0.3),
            "exponent of the shear rate in the Eyring stress, far above that stress",
            null=0.0,
            symbol="m",
        ),
        Parameter(
            "rate_onset",
            "-",
            LogNormal(8.0, 0.6),
            "Newtonian stress over the Eyring stress from which it grows with the rate",
            symbol="c",
        ),
    ),
    equation=r"\tau_0 \leftarrow \tau_0\left(\frac{p_0}{1\,\text{GPa}}\right)^{a} "
    r"e^{-b(\theta_{oil} - 80\,^\circ\text{C})}\left[1 + \left(\frac{\eta_p v_s}{c\,h\,\tau_0}\right)^2\right]^{m/2}",
    source="C. R. Evans, K. L. Johnson, Proc. IMechE C 200 (1986) 313, the Eyring stress over pressure and "
    "temperature; P. J. Carreau, Trans. Soc. Rheol. 16 (1972) 99, a power of the shear rate",
    fingerprint={"load": "+"},
    separated_by="traction curves of smooth discs at several pressures: their slope over the logarithm of sliding is "
    "the Eyring stress, and a power law is straight where both scales are logarithmic",
    replaces="shear of the film",
    special_cases={"Eyring stress that grows with pressure": {"fall": 0.0, "rate_exponent": 0.0}},
)
def shear_law(
    eyring_stress: np.ndarray,
    contact_viscosity: np.ndarray,
    sliding_speed: np.ndarray,
    film_thickness: np.ndarray,
    hertz_pressure: np.ndarray,
    oil_temperature: np.ndarray,
    *,
    pressure_exponent: float,
    fall: float,
    rate_exponent: float,
    rate_onset: float,
) -> np.ndarray:
    """The film shears by another law than an inverse sine hyperbolic with one stress.

    Eyring stresses that are fitted at each pressure grow with it, by an exponent of 0.5 to 1, and fall as the oil
    warms. A power law of the shear rate, as Carreau's, is an Eyring stress that grows with the rate: with m = 0.26 and
    0.7 of the stress and c = 14, it is within 2.5 % of Carreau's with the exponent 0.4, over four decades. The
    stress is the stated one at 1 GPa, which makes the form belong to Pa.

    >>> state = (5e6, 70.2, 0.7518, 0.2310e-6)
    >>> grows = dict(pressure_exponent=0.5, fall=0.0, rate_exponent=0.0, rate_onset=1.0)
    >>> round(float(shear_law(*state, 4e9, 353.15, **grows)) / 1e6, 1)
    10.0
    >>> rate = dict(pressure_exponent=0.0, fall=0.0, rate_exponent=0.5, rate_onset=1.0)   # Newtonian: 228.5 MPa
    >>> round(float(shear_law(*state, 1e9, 353.15, **rate)) / 1e6, 1)
    33.8
    """
    change = pressure_exponent * np.log(hertz_pressure / MIDDLE_PRESSURE)
    change = change - fall * (oil_temperature - MIDDLE_TEMPERATURE)
    if rate_exponent != 0.0:
        newtonian = contact_viscosity * sliding_speed / (film_thickness * eyring_stress)
        change = change + 0.5 * rate_exponent * np.log1p((newtonian / rate_onset) ** 2)
    return eyring_stress * np.exp(change)
