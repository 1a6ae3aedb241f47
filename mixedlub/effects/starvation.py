"""Starvation."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, LogUniform, SinhNormal

REFERENCE_PRESSURE = 1e9
SMALLEST_RATIO = 1e-300
"""Ratio to the onset that is treated as zero."""
LARGEST_LOSS = 60.0
"""Logarithm of the film's loss beyond which no film remains."""


@effect(
    stage="film",
    acts_on="film_thickness",
    parameters=(
        Parameter(
            "strength",
            "-",
            LogNormal(0.4, 0.8),
            "exponent of the film's fall far above onset",
            null=0.0,
            symbol="s",
        ),
        Parameter(
            "onset", "N/m", LogUniform(0.01, 1.0), "viscosity times speed at the onset of starvation", symbol="c"
        ),
        Parameter("steepness", "-", LogNormal(2.5, 0.4), "sharpness of the onset", symbol=r"\gamma"),
        Parameter("width_power", "-", SinhNormal(0.5), "exponent of the contact's width in the onset", symbol="w"),
    ),
    equation=r"h \leftarrow h\,\left[1 + \left(\frac{\eta_0 u}{c\,(p_0/p_u)^w}\right)^{\gamma}\right]^{-s/\gamma},"
    r"\quad p_u = 1\,\text{GPa}",
    source="F. Chevalier, A. A. Lubrecht, P. M. E. Cann, F. Colin, G. Dalmaz, J. Tribol. 120 (1998) 126, with the "
    "supply taken as fixed; the onset follows P. M. E. Cann, B. Damiens, A. A. Lubrecht, Tribol. Int. 37 (2004) 859",
    fingerprint={"load": "-", "speed": "+", "oil_temperature": "-", "slide_roll_ratio": "-"},
    separated_by="an oil flow or jet position sweep: more oil lifts the onset to higher speed, whereas inlet heating "
    "does not change",
)
def starvation(
    film_thickness: np.ndarray,
    viscosity: np.ndarray,
    entrainment_speed: np.ndarray,
    hertz_pressure: np.ndarray,
    *,
    strength: float,
    onset: float,
    steepness: float,
    width_power: float,
) -> np.ndarray:
    """Above a certain viscosity times speed the inlet lacks oil; the film is thinner than fully flooded.

    Chevalier and others write h/h_ff = r/(1 + r^gamma)^(1/gamma) with gamma 2 to 5 and r the supplied over the fully
    flooded film; here r = (c/(eta u))^s. The exponent s is 0.1 for a meniscus at fixed distance (Hamrock and Dowson)
    and 0.7 for a film that no longer grows.

    A wide contact takes longer to refill, w = -1 (Cann and others). By Hamrock and Dowson h/h_ff = (f/m*)^0.29 with
    m* = 3.06 [(R/b)^2 h_ff/R]^0.58 and f the distance of the meniscus in half-widths b: with h_ff proportional to (eta
    u)^0.67 p0^-0.2, s = 0.113, and w = 3.3 at constant f, 0.7 at constant distance. Width is proportional to the Hertz
    pressure; its reference 1 GPa makes the form belong to Pa.

    >>> law = dict(strength=1.0, onset=0.1, steepness=1.0, width_power=0.0)   # r = 1, gamma = 1
    >>> round(float(starvation(1.0, 0.1, 1.0, 1e9, **law)), 12)
    0.5
    """
    beyond = np.log(np.maximum(viscosity * entrainment_speed / onset, SMALLEST_RATIO))
    beyond = steepness * (beyond - width_power * np.log(hertz_pressure / REFERENCE_PRESSURE))
    return film_thickness * np.exp(-np.minimum(strength / steepness * np.logaddexp(0.0, beyond), LARGEST_LOSS))
