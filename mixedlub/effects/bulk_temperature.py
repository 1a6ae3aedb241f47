"""Teeth warmer than the oil."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform
from mixedlub.laws import heating, oil

EVEN = 0.01
"""Share of the transmitted power that becomes heat in the mesh, where this share is taken as constant."""
LEAST_REMAINING = 0.2
"""Share of the pressure-viscosity coefficient that remains at any temperature rise; keeps its linear fall positive."""


def rise_of_teeth(
    nominal_loss: np.ndarray,
    reading_scale: np.ndarray,
    torque: np.ndarray,
    pinion_speed: np.ndarray,
    pinion_radius: float,
    gear_radius: float,
    face_width: float,
    *,
    strength: float,
    exponent: float,
    friction: float,
) -> np.ndarray:
    """By how much the effect makes the teeth warmer than the oil (K).

    >>> gears = dict(torque=150.0, pinion_speed=314.0, pinion_radius=0.0366, gear_radius=0.0549, face_width=0.014)
    >>> standard = dict(strength=1.0, exponent=0.72, friction=1.0)
    >>> [round(float(rise_of_teeth(500.0, scale, **gears, **standard)), 1) for scale in (100.0, 500.0)]
    [13.3, 13.3]
    """
    typical = heating.tooth_rise(reading_scale, pinion_radius, gear_radius, face_width)
    heat = nominal_loss**friction * (EVEN * torque * pinion_speed) ** (1.0 - friction)
    return np.asarray(strength * typical * (heat / reading_scale) ** exponent)


@effect(
    stage="property",
    acts_on=("viscosity", "pressure_viscosity"),
    parameters=(
        Parameter(
            "strength", "-", LogNormal(1.0, 0.8), "factor on the temperature rise of the standard", null=0.0, symbol="c"
        ),
        Parameter("exponent", "-", Uniform(0.6, 1.0), "exponent of the heat in the temperature rise", symbol="n"),
        Parameter(
            "friction",
            "-",
            Uniform(0.0, 1.0),
            "source of heat: 1 loss of the base model, 0 a constant share of the power",
            symbol="k",
        ),
    ),
    equation=r"\eta_0, \alpha \leftarrow \eta_0(\theta_{oil} + \Delta T), \alpha(\theta_{oil} + \Delta T),\quad "
    r"\Delta T = 1.26\times10^{-3}\,c"
    r"\left[\frac{y_0}{(r_1 + r_2)\,b_w}\right]^{0.72}\left[\frac{P_n^k\,(0.01\,T_1\omega_1)^{1-k}}{y_0}\right]^n",
    source="ISO/TR 15144-1, bulk temperature, with n = 0.72",
    fingerprint={"speed": "+", "oil_temperature": "-", "roughness": "+"},
    separated_by="a thermocouple in a tooth, or the same point again with twice the flow of oil",
    special_cases={"ISO/TR 15144-1": {"exponent": heating.TOOTH_RISE_EXPONENT, "friction": 1.0}},
    applied_after=("viscosity_temperature_law", "viscosity_drift"),
    kinds=("gear_pair",),
)
def bulk_temperature(
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    temperature_viscosity: np.ndarray,
    coefficient_fall: np.ndarray,
    oil_density: np.ndarray,
    oil_temperature: np.ndarray,
    nominal_loss: np.ndarray,
    reading_scale: np.ndarray,
    torque: np.ndarray,
    pinion_speed: np.ndarray,
    pinion_radius: float,
    gear_radius: float,
    face_width: float,
    *,
    strength: float,
    exponent: float,
    friction: float,
) -> tuple[np.ndarray, np.ndarray]:
    """Mesh losses warm the teeth above the recorded oil temperature; the entrained oil has tooth temperature.

    The rise of the standard applies at the typical reading. The heat is the loss of the base model before calibration,
    or one per cent of the power where a constant share is taken. The standard's constant makes this
    form belong to SI.

    >>> oil = dict(temperature_viscosity=0.02605, coefficient_fall=0.0036, oil_density=819.6, oil_temperature=343.15)
    >>> gears = dict(pinion_radius=0.0366, gear_radius=0.0549, face_width=0.014, torque=150.0, pinion_speed=314.0)
    >>> iso = dict(strength=1.0, exponent=0.72, friction=1.0)
    >>> eta, alpha = bulk_temperature(0.01126, 14.6e-9, **oil, nominal_loss=500.0, reading_scale=500.0, **gears, **iso)
    >>> round(float(eta), 5), round(float(alpha) * 1e9, 2)   # 13.3 K warmer: at 83.3 degC
    (0.00815, 13.9)
    """
    gears = (torque, pinion_speed, pinion_radius, gear_radius, face_width)
    rise = rise_of_teeth(nominal_loss, reading_scale, *gears, strength=strength, exponent=exponent, friction=friction)
    thinner = oil.warmed_viscosity(viscosity, oil_density, temperature_viscosity, oil_temperature, rise)
    return thinner, pressure_viscosity * np.maximum(1.0 - coefficient_fall * rise, LEAST_REMAINING)
