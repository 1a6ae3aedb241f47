"""Friction of the film as a mean over the pressure of the contact."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import Normal
from mixedlub.laws.oil import ROELANDS_PRESSURE, roelands_exponent

LEAST_FLAT = 0.72
"""Definition. Mean over largest pressure between the contact of a point, 2/3, and of a line, pi/4."""
OF_LINES, OF_POINTS = 4.0 / np.pi, 1.5
"""Definition. Largest over mean pressure of Hertz."""
PLACES, WEIGHTS = (0.5 * x for x in np.polynomial.legendre.leggauss(4))
PLACES = PLACES + 0.5
"""Distances from the middle over the half width. Up to a growth of viscosity by e^20, four are within 0.4 % rms and 2 %
at most of the integral for lines, and 1 and 5 % for points."""
PRESSURES = np.sqrt(1.0 - PLACES**2)
"""Pressures of Hertz at these places, over the largest."""


@effect(
    stage="law",
    acts_on="shear_stress",
    parameters=(
        Parameter(
            "share",
            "-",
            Normal(1.0, 0.4),
            "exponent on the friction by the mean over the friction by the largest pressure: 1 is the mean",
            null=0.0,
            symbol="w",
            base_sd=0.5,
        ),
    ),
    equation=r"\tau \leftarrow \tau\left[\frac{p_0}{p_m}\,"
    r"\frac{\int_0^1 \operatorname{asinh}[\eta(p)\,v_s/(h\tau_0)]\,ds}"
    r"{\operatorname{asinh}[\eta_p v_s/(h\tau_0)]}\right]^{w},\quad p = p_0\sqrt{1 - s^2},\ "
    r"\eta(p) = \eta_0\left(\frac{\eta_p}{\eta_0}\right)^{g(p)/g(p_0)},\ "
    r"g(p) = \left(1 + \frac{p}{p_r}\right)^Z - 1,\ p_r = 0.196\,\text{GPa},\ "
    r"Z = \frac{\alpha p_r}{\ln\eta_0 + 9.67}",
    source="A. W. Crook, Phil. Trans. R. Soc. A 255 (1963) 281; K. L. Johnson, J. A. Greenwood, Wear 61 (1980) 353: "
    "the stress of each place of the contact at its own pressure; Roelands' growth with pressure",
    fingerprint={"speed": "-", "roughness": "+"},
    separated_by="traction at very little sliding against traction at much sliding, on smooth discs: the mean is far "
    "below the stress at the largest pressure while the oil is Newtonian, and near it once the oil is sheared",
    replaces="stress at the largest pressure",
    special_cases={"mean over the contact": {"share": 1.0}},
)
def contact_average(
    shear_stress: np.ndarray,
    contact_viscosity: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    hertz_pressure: np.ndarray,
    mean_pressure: np.ndarray,
    sliding_speed: np.ndarray,
    film_thickness: np.ndarray,
    eyring_stress: np.ndarray,
    *,
    share: float,
) -> np.ndarray:
    """Film friction is the mean stress over the mean pressure of the contact, instead of both at the middle.

    Viscosity falls steeply from the middle of the contact to its edges. While the oil is Newtonian, friction is 0.3 to
    0.5 of the friction at the largest pressure on lines, and 0.1 to 0.3 on points; sheared far above the Eyring stress
    it is as large, or up to a fifth larger. The stress afterwards is friction times the largest pressure, also where
    heat acts on it. Full solutions of line contacts have the mean. Contacts of points count by rings. The film is the
    central one everywhere, and every viscosity grows along the contact in Roelands' shape. His 9.67 and p_r make
    the form belong to Pa s and Pa.

    >>> rest = dict(viscosity=0.0031853, pressure_viscosity=20e-9, hertz_pressure=0.5e9, mean_pressure=0.3927e9)
    >>> rest |= dict(sliding_speed=1e-3, film_thickness=1e-6, eyring_stress=1e12, share=1.0)
    >>> round(float(contact_average(1.0, 0.0031853 * np.exp(10.0), **rest)), 3)   # 2 [I_1(10) + L_-1(10)]/e^10 by Barus
    0.485
    """
    if share == 0.0:
        return shear_stress
    exponent = roelands_exponent(viscosity, pressure_viscosity)
    near = np.asarray(contact_viscosity * sliding_speed / (film_thickness * eyring_stress))
    rise, size = np.log(contact_viscosity / viscosity), hertz_pressure / ROELANDS_PRESSURE
    whole = np.expm1(exponent * np.log1p(size))
    grown = rise / np.where(whole == 0.0, 1.0, whole)
    is_point = mean_pressure < LEAST_FLAT * hertz_pressure
    mean = 0.0
    for place, weight, part in zip(PLACES, WEIGHTS, PRESSURES, strict=True):
        there = np.arcsinh(near * np.exp(grown * np.expm1(exponent * np.log1p(part * size)) - rise))
        mean = mean + weight * np.where(is_point, 2.0 * place, 1.0) * there
    middle = np.arcsinh(near)
    rests = middle == 0.0
    ratio = np.where(is_point, OF_POINTS, OF_LINES) * mean / np.where(rests, 1.0, middle)
    return shear_stress * np.where(rests, 1.0, ratio) ** share
