"""Pressure-viscosity relation that departs from the laws of Barus and Roelands."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, LogUniform, Normal
from mixedlub.laws.oil import roelands_coefficient, roelands_viscosity

FORTY_CELSIUS = 313.15
HUNDRED_KELVIN = 100.0
GLASS = 1e8
SAMPLE = ("viscosity",)
CONTACT = ("gear_pair", "disc", "friction_history", "mesh_friction")


@effect(
    stage="property",
    acts_on="contact_viscosity",
    parameters=(
        Parameter(
            "roelands",
            "-",
            Normal(0.5, 0.5),
            "share of the way from the exponential of Barus to the power law of Roelands",
            null=0.0,
            symbol="r",
            kinds=SAMPLE,
        ),
        Parameter(
            "exponent",
            "-",
            Normal(0.6, 0.1),
            "Roelands' exponent, the same at all temperatures",
            symbol="Z",
            kinds=SAMPLE,
        ),
        Parameter(
            "slope",
            "-",
            LogNormal(1.0, 0.25),
            "slope of ln viscosity far above the onset relative to that below, at 40 degC",
            null=1.0,
            symbol="s",
        ),
        Parameter(
            "onset",
            "Pa",
            LogUniform(0.1e9, 0.6e9),
            "pressure about which the slope changes",
            null=0.15e9,
            symbol="p_s",
            kinds=CONTACT,
        ),
        Parameter(
            "slope_with_temperature",
            "-",
            Normal(0.0, 0.3),
            "change of the logarithm of that slope per 100 K at 40 degC, linear in 1/T",
            null=0.0,
            symbol="d",
            kinds=CONTACT,
        ),
        Parameter(
            "slope_bow",
            "-",
            Normal(0.0, 0.3),
            "quadratic coefficient of that change in 1/T",
            null=0.0,
            symbol="w",
            kinds=CONTACT,
        ),
        Parameter(
            "bend_down",
            "1/Pa",
            LogNormal(5e-10, 1.2),
            "rate at which the slope falls at low pressure",
            null=0.0,
            symbol="C",
        ),
        Parameter(
            "bend_up",
            "1/Pa",
            LogNormal(5e-10, 1.2),
            "rate at which the slope rises towards the glass transition",
            null=0.0,
            symbol="B",
        ),
        Parameter(
            "down_with_temperature",
            "-",
            Normal(0.0, 0.5),
            "change of the logarithm of the fall rate per 100 K at 40 degC, linear in 1/T",
            symbol="c",
        ),
        Parameter(
            "up_with_temperature",
            "-",
            Normal(-0.8, 1.0),
            "change of the logarithm of the rise rate per 100 K at 40 degC, linear in 1/T",
            symbol="b",
        ),
    ),
    equation=r"\ln\eta_p \leftarrow \ln\eta_p + G(f\ell) - G(\ell),\quad "
    r"\ell = (1 - r)\ln\frac{\eta_p}{\eta_0} + r\,\ell_R,\ "
    r"\ell_R = (\ln\eta_0 + 9.67)\left[\left(1 + \frac{p_0}{p_r}\right)^Z - 1\right],\ "
    r"p_r = 0.196\,\text{GPa},\quad "
    r"f = \left[1 + (s' - 1)(1 - e^{-p_0/p_s})\right]\frac{e^{B'p_0} - e^{-C'p_0}}{(B' + C')\,p_0},\ "
    r"s' = s e^{d z + w z^2},\ B' = B e^{b z},\ C' = C e^{c z},\ "
    r"z = \frac{\theta_{oil} - \theta_r}{100\,\text{K}}\,\frac{\theta_r}{\theta_{oil}},\ "
    r"\theta_r = 313.15\,\text{K},\quad "
    r"G(x) = \frac{x}{[1 + (x/g)^8]^{1/8}},\ g = \ln\frac{10^8\,\text{Pa s}}{\eta_0}",
    source="J. B. Irving, A. J. Barlow, J. Phys. E 4 (1971) 232, double exponential of pressure; on C. J. A. Roelands, "
    "thesis, Delft 1966, as written by L. Houpert, J. Tribol. 107 (1985) 241",
    fingerprint={"speed": "+"},
    separated_by="a high-pressure viscometer at two temperatures: an exponential is straight in a log plot, Roelands "
    "only bends down, a liquid near its glass bends up again",
    replaces="viscosity under pressure",
    special_cases={
        "Roelands": {
            "roelands": 1.0,
            "slope": 1.0,
            "slope_with_temperature": 0.0,
            "slope_bow": 0.0,
            "bend_down": 0.0,
            "bend_up": 0.0,
        }
    },
)
def pressure_viscosity_law(
    contact_viscosity: np.ndarray,
    viscosity: np.ndarray,
    hertz_pressure: np.ndarray,
    oil_temperature: np.ndarray,
    *,
    roelands: float,
    exponent: float,
    slope: float,
    onset: float,
    slope_with_temperature: float,
    slope_bow: float,
    bend_down: float,
    bend_up: float,
    down_with_temperature: float,
    up_with_temperature: float,
) -> np.ndarray:
    """ln viscosity curves with pressure otherwise than in the base law (Barus for samples, Roelands in contacts).

    Its slope falls at first and rises again towards the glass transition. At contact pressures Roelands' law, the base
    of gears and discs, contains most of the curvature; a sample in a viscometer starts from Barus' exponential. The
    coefficient in the film law holds at inlet pressures, up to about 0.1 GPa: the slope in the contact may differ, and
    neither need be linear between the temperatures at which the coefficient was measured. The temperature dependence of
    the slope is an interpolation of this catalogue. Both curvatures change exponentially with 1/T. Viscosity is limited
    to the viscosity of a glass. The glass's 1e8 Pa s, 9.67 and p_r make the form belong to Pa s and Pa.

    >>> rest = dict(down_with_temperature=0.0, up_with_temperature=0.0, bend_up=0.0, exponent=0.53135)
    >>> rest |= dict(slope=1.0, onset=0.15e9, slope_with_temperature=0.0, slope_bow=0.0)
    >>> x = pressure_viscosity_law(np.exp(10.0), 1.0, 0.5e9, 313.15, roelands=0.0, bend_down=2e-9, **rest)
    >>> round(float(np.log(x)), 1)   # 10 (1 - exp(-1))/1 = 6.32
    6.3
    >>> x = pressure_viscosity_law(1.0, 0.01489, 0.9642e9, 313.15, roelands=1.0, bend_down=0.0, **rest)
    >>> round(float(x), 1)
    80.1
    """
    warmer = (oil_temperature - FORTY_CELSIUS) / HUNDRED_KELVIN * (FORTY_CELSIUS / oil_temperature)
    down = bend_down * np.exp(down_with_temperature * warmer) * hertz_pressure
    up = bend_up * np.exp(up_with_temperature * warmer) * hertz_pressure
    changed = slope * np.exp((slope_with_temperature + slope_bow * warmer) * warmer)
    steeper = 1.0 - (changed - 1.0) * np.expm1(-hertz_pressure / onset)
    log = np.log(contact_viscosity / viscosity)
    power = np.log(roelands_viscosity(viscosity, roelands_coefficient(viscosity, exponent), hertz_pressure) / viscosity)
    half = np.minimum(0.5 * (down + up), 50.0)
    shape = np.where(half > 1e-8, np.sinh(half) / np.maximum(half, 1e-8), 1.0) * np.exp(
        np.minimum(0.5 * (up - down), 50.0)
    )
    solid = np.log(GLASS / viscosity)
    mixed = log + roelands * (power - log)
    return contact_viscosity * np.exp(
        _below(np.minimum(mixed * steeper * shape, 9.0 * solid), solid) - _below(log, solid)
    )


def _below(log: np.ndarray, solid: np.ndarray) -> np.ndarray:
    """Logarithm of viscosity with a smooth upper limit at the viscosity of a glass."""
    return log / (1.0 + (log / solid) ** 8) ** 0.125
