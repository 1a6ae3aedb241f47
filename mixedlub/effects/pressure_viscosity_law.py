"""Viscosity under pressure that follows neither one exponential nor one power."""

import numpy as np

from mixedlub.effect import LogNormal, Normal, Parameter, effect

WARM = 313.15
KELVIN = 100.0
STEEPEST = 200.0


@effect(
    stage="property",
    acts_on="contact_viscosity",
    parameters=(
        Parameter("bend_down", "1/Pa", LogNormal(2e-9, 1.0), "rate at which the slope falls at low pressure", null=0.0),
        Parameter(
            "bend_up", "1/Pa", LogNormal(1.2e-9, 1.0), "rate at which the slope rises towards the glass", null=0.0
        ),
        Parameter("down_with_temperature", "-", Normal(0.0, 0.5), "log change of the fall over 100 K, in 1/T"),
        Parameter("up_with_temperature", "-", Normal(-0.8, 0.5), "log change of the rise over 100 K, in 1/T"),
    ),
    equation=r"\ln\frac{\eta}{\eta_0} \leftarrow \ln\frac{\eta}{\eta_0}\;"
    r"\frac{e^{Bp} - e^{-Cp}}{(B + C)\,p}",
    source="J. B. Irving, A. J. Barlow, J. Phys. E 4 (1971) 232, double exponential of pressure",
    fingerprint={},
    separated_by="a high-pressure viscometer at two temperatures: an exponential is straight in a log plot, Roelands "
    "only bends down, a liquid near its glass bends up again",
)
def pressure_viscosity_law(
    contact_viscosity,
    viscosity,
    hertz_pressure,
    oil_temperature,
    *,
    bend_down,
    bend_up,
    down_with_temperature,
    up_with_temperature,
):
    """The logarithm of viscosity rises more slowly with pressure at first and faster again near the glass.

    Exponents are kept below 200, far beyond any liquid, so that wild parameters stay finite.

    >>> x = pressure_viscosity_law(np.exp(10.0), 1.0, 0.5e9, 313.15, bend_down=2e-9, bend_up=0.0,
    ...     down_with_temperature=0.0, up_with_temperature=0.0)
    >>> round(float(np.log(x)), 3)   # 10 (1 - exp(-1))/1
    6.321
    """
    warmer = (oil_temperature - WARM) / KELVIN * (WARM / oil_temperature)
    down = bend_down * np.exp(down_with_temperature * warmer) * hertz_pressure
    up = bend_up * np.exp(up_with_temperature * warmer) * hertz_pressure
    log = np.log(contact_viscosity / viscosity)
    half = np.minimum(0.5 * (down + up), STEEPEST)
    shape = np.where(half > 1e-8, np.sinh(half) / np.maximum(half, 1e-8), 1.0) * np.exp(0.5 * (up - down))
    return contact_viscosity * np.exp(np.clip(log * (shape - 1.0), -STEEPEST, STEEPEST))
