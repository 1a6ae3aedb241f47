"""Boundary film that forms with temperature."""

import numpy as np

from mixedlub.effect import Between, LogNormal, Normal, Parameter, effect


@effect(
    stage="boundary",
    acts_on="boundary_friction",
    parameters=(
        Parameter(
            "drop", "-", Normal(0.35, 0.35), "fall of the logarithm of boundary friction when hot", null=0.0, symbol="d"
        ),
        Parameter(
            "activation", "K", Between(318.0, 413.0), "temperature at which half the film is there", symbol=r"\theta_f"
        ),
        Parameter("width", "K", LogNormal(8.0, 0.5), "temperature over which the film forms", symbol="w"),
    ),
    equation=r"\mu_B \leftarrow \mu_B \exp\left[-\frac{d}{1 + e^{-(\theta_{oil} - \theta_f)/w}}\right]",
    source="H. Spikes, Tribol. Lett. 60 (2015) 5 (friction modifiers); the sigmoid is the usual description "
    "of activation, its coefficients are not from a table",
    fingerprint={"speed": "+", "oil_temperature": "-", "roughness": "-", "slide_roll_ratio": "+"},
    separated_by="oil without the additive, or film ratios above 3, where it vanishes; it sits between two "
    "temperatures, whereas everything viscous changes steadily",
)
def boundary_film_temperature(
    boundary_friction: np.ndarray, oil_temperature: np.ndarray, *, drop: float, activation: float, width: float
) -> np.ndarray:
    """Additives cover the asperities above a certain temperature and change their friction; a negative drop raises it.

    >>> round(float(boundary_film_temperature(0.1, 353.15, drop=0.7, activation=353.15, width=8.0)), 3)
    0.07
    """
    return boundary_friction * np.exp(-drop / (1.0 + np.exp(-(oil_temperature - activation) / width)))
