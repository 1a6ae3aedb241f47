"""Viscosity under pressure after Roelands."""

import numpy as np

from mixedlub.effect import LogNormal, Parameter, effect
from mixedlub.laws.oil import roelands_viscosity


@effect(
    stage="property",
    acts_on="contact_viscosity",
    parameters=(
        Parameter(
            "share", "-", LogNormal(1.0, 0.1), "share of the way from the exponential to Roelands", null=0.0, symbol="s"
        ),
    ),
    equation=r"\ln\eta_p \leftarrow (1 - s)\ln\eta_p + s\ln\eta_R,\quad "
    r"\eta_R = \eta_0\exp\{(\ln\eta_0 + 9.67)[(1 + p_0/p_r)^Z - 1]\},\quad "
    r"Z = \frac{\alpha p_r}{\ln\eta_0 + 9.67},\ p_r = 0.196\,\text{GPa}",
    source="C. J. A. Roelands, thesis, Delft 1966, as written by L. Houpert, J. Tribol. 107 (1985) 241",
    fingerprint={"hertz_pressure": "-"},
    separated_by="a high-pressure viscometer beyond 0.4 GPa: Roelands bends down for good, many liquids bend up again",
    after=("pressure_viscosity_law",),
    kinds=("viscosity",),
)
def roelands_pressure_law(contact_viscosity, viscosity, pressure_viscosity, hertz_pressure, *, share):
    """The logarithm of viscosity grows with a power of pressure below one.

    The 9.67 and p_r make the form belong to Pa s and Pa.

    >>> x = roelands_pressure_law(1.0, 0.01489, 14.81e-9, 0.9642e9, share=1.0)
    >>> round(float(x), 1)
    80.1
    """
    log = np.log(roelands_viscosity(viscosity, pressure_viscosity, hertz_pressure) / contact_viscosity)
    return contact_viscosity * np.exp(share * log)
