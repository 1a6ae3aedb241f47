"""Viscosity-temperature relation that departs from ASTM D341."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform

FORTY_CELSIUS = 313.15
"""Reference temperature (K) of the convexity: 40 degC, where oils are graded."""
NEAREST = 5.0
"""Smallest distance (K) above the divergence that is computed."""
LARGEST_LOG = 30.0
"""Largest logarithmic change that is computed."""


@effect(
    stage="property",
    acts_on="viscosity",
    parameters=(
        Parameter(
            "share",
            "-",
            LogNormal(1.0, 0.5),
            "share of the way from ASTM D341 to Vogel's law",
            null=0.0,
            symbol="r",
        ),
        Parameter(
            "convexity",
            "-",
            Uniform(0.0, 3.4),
            "313.15 K over the distance of 40 degC from the divergence temperature of Vogel's law",
            symbol="m",
        ),
        Parameter(
            "fall",
            "-",
            LogNormal(1.0, 0.1),
            "fall of ln viscosity between the two stated temperatures, relative to the stated fall",
            symbol="g",
        ),
    ),
    equation=r"\eta_0 \leftarrow \eta_0\,\exp\left\{r\left[f_1 - g\,f_{12}\,"
    r"\frac{\theta_{oil} - \theta_1}{\theta_2 - \theta_1}\,"
    r"\frac{313\,\text{K} + m(\theta_2 - 40\,^\circ\text{C})}{313\,\text{K} + m(\theta_{oil} - 40\,^\circ\text{C})}"
    r"\right]\right\}",
    source="H. Vogel, Phys. Z. 22 (1921) 645, on ASTM D341; E. N. da C. Andrade, Nature 125 (1930) 309, with "
    "m = 1; O. Reynolds, Phil. Trans. R. Soc. 177 (1886) 157, with m = 0",
    fingerprint={"oil_temperature": "+"},
    separated_by="a third point of viscosity, between the two given ones or beyond them",
    replaces="viscosity over temperature",
    needs_variation_in="oil_temperature",
    special_cases={
        "Vogel": {"share": 1.0, "fall": 1.0},
        "Andrade": {"share": 1.0, "convexity": 1.0, "fall": 1.0},
        "Reynolds": {"share": 1.0, "convexity": 0.0, "fall": 1.0},
    },
)
def viscosity_temperature_law(
    viscosity: np.ndarray,
    oil_temperature: np.ndarray,
    first_known_temperature: float,
    second_known_temperature: float,
    known_fall: float,
    fall_from_first: np.ndarray,
    *,
    share: float,
    convexity: float,
    fall: float,
) -> np.ndarray:
    """Between and beyond the two stated temperatures the oil's viscosity follows a law other than ASTM D341.

    Vogel's ln eta = A + B/(theta - theta_c) through both points, theta_c = 313.15 K (1 - 1/m). With theta_c 73 to 123 K
    below 0 degC (m of 1.8 to 2.8), as fitted to oils, viscosity is 5 % below to 3 % above D341 between 40 and 100 degC,
    and 20 % below to twice D341 at 0 degC. Thin liquids have a smaller m: Andrade's law has m = 1, Reynolds'
    exponential m = 0; Slotte's (theta - theta_s)**-n resembles m = 313.15 K/2(313.15 K - theta_s) near 40 degC. An
    error in one of the two stated viscosities is another ``fall`` between them.

    >>> known = (313.15, 373.15, np.log(10.0))   # a tenth of the viscosity at 100 degC
    >>> oil, fall = np.array([313.15, 333.15, 373.15]), np.log(10.0) * np.array([0.0, 0.43, 1.0])
    >>> vogel = {"share": 1.0, "convexity": 313.15 / (313.15 - 178.15), "fall": 1.0}
    >>> found = viscosity_temperature_law(0.1 * np.exp(-fall), oil, *known, fall, **vogel)
    >>> found.round(5).tolist()   # at 60 degC (20/60)(195/155) = 0.41935 of the fall
    [0.1, 0.03808, 0.01]
    """
    place = (oil_temperature - first_known_temperature) / (second_known_temperature - first_known_temperature)
    far = np.maximum(FORTY_CELSIUS + convexity * (oil_temperature - FORTY_CELSIUS), convexity * NEAREST)
    vogel = known_fall * place * (FORTY_CELSIUS + convexity * (second_known_temperature - FORTY_CELSIUS)) / far
    return viscosity * np.exp(np.clip(share * (fall_from_first - fall * vogel), -LARGEST_LOG, LARGEST_LOG))
