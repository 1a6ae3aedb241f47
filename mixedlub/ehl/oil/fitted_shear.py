"""Shear by the traction part of an oil: Eyring stress and limiting stress over pressure and temperature."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from mixedlub.effects.limiting_shear_stress import FORTY_CELSIUS, REFERENCE_PRESSURE
from mixedlub.effects.shear_law import MIDDLE_PRESSURE, MIDDLE_TEMPERATURE
from mixedlub.ehl.oil.oil import Slopes, WarmSlopes
from mixedlub.ehl.oil.shear import eyring_sinh
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.schema.traction_part import Traction

LEAST_PRESSURE = 0.1e9
"""Judgement. Pressure (Pa) below which stresses keep their value there: powers fitted to Hertz pressures would let the
oil of the inlet flow without stress."""
NEAR_LIMIT = 0.999
"""Grid. Stress over limiting stress above which the law continues linearly."""


def stresses(
    pressure: np.ndarray, temperature: np.ndarray, *, eyring_stress: float, part: Traction
) -> tuple[Slopes, Slopes]:
    r"""Eyring stress and limiting stress (Pa) with derivatives by pressure and temperature.

    .. math:: \tau_0 = \tau_1 (p/p_1)^a e^{-b(T - T_1)},\quad
              \tau_L = \Lambda[(1 - c)\,p + c\,p_1]\,e^{-d(T - T_2)}

    with 1 GPa, 80 and 40 degC; infinite without a limit. Source: the effects `shear_law` and `limiting_shear_stress`.
    """
    held, grows = np.maximum(pressure, LEAST_PRESSURE), pressure > LEAST_PRESSURE
    exponent, fall = part.eyring_pressure_exponent.value, part.eyring_fall_per_K.value
    own = eyring_stress * (held / MIDDLE_PRESSURE) ** exponent * np.exp(-fall * (temperature - MIDDLE_TEMPERATURE))
    eyring = own, own * exponent / held * grows, -fall * own
    if part.limit_over_pressure is None:
        none = np.zeros_like(own)
        return eyring, (none + np.inf, none, none)
    fall, offset = part.limit_fall_per_K.value, part.limit_offset.value
    slope = part.limit_over_pressure.value * np.exp(-fall * (temperature - FORTY_CELSIUS))
    limit = slope * ((1.0 - offset) * held + offset * REFERENCE_PRESSURE)
    return eyring, (limit, slope * (1.0 - offset) * grows, -fall * limit)


def fitted_shear(
    stress: np.ndarray, pressure: np.ndarray, temperature: np.ndarray, *, eyring_stress: float, part: Traction
) -> WarmSlopes:
    r"""Viscosity times shear rate at a stress, with derivatives by stress, pressure and temperature.

    .. math:: \eta\dot\gamma = \tau_0 \sinh(\tau_E/\tau_0),\quad
              \tau_E = \tau\,[1 - (\tau/\tau_L)^n]^{-1/n}

    The inverse of the base model's stress with the effects `shear_law` and `limiting_shear_stress`. Source: see these.
    """
    (own, own_p, own_t), (limit, limit_p, limit_t) = stresses(
        pressure, temperature, eyring_stress=eyring_stress, part=part
    )
    if part.limit_over_pressure is None:
        rate, by_stress, by_own = eyring_sinh(stress, own)
        return rate, by_stress, by_own * own_p, by_own * own_t
    ratio, n = np.abs(stress) / limit, part.limit_sharpness.value
    inside = np.minimum(ratio, NEAR_LIMIT)
    left = 1.0 - inside**n
    slope = left ** (-1.0 / n - 1.0)
    free = inside * left ** (-1.0 / n) + slope * (ratio - inside)
    sense = np.sign(stress)
    rate, by_inner, by_own = eyring_sinh(sense * limit * free, own)
    by_limit = by_inner * sense * (free - ratio * slope)
    return (
        rate,
        by_inner * slope,
        by_own * own_p + by_limit * limit_p,
        by_own * own_t + by_limit * limit_t,
    )


def _at_middle(stress: np.ndarray, pressure: np.ndarray, **law: Any) -> Slopes:
    """Shear at the temperature of the stated Eyring stress."""
    return fitted_shear(stress, pressure, np.full_like(pressure, MIDDLE_TEMPERATURE), **law)[:3]


def _scale(pressure: np.ndarray, **law: Any) -> np.ndarray:
    return stresses(pressure, np.full_like(pressure, MIDDLE_TEMPERATURE), **law)[0][0]


def _cold_limit(pressure: np.ndarray, **law: Any) -> np.ndarray:
    """Upper bound of the stress: the limit of the cold oil, the largest one."""
    return stresses(pressure, np.full_like(pressure, ZERO_CELSIUS), **law)[1][0]


def laws_of(part: Traction, eyring_stress: float) -> dict[str, Any]:
    """Fields of the solver's oil; ``eyring_stress`` (Pa) at 1 GPa and 80 degC."""
    law: dict[str, Any] = {"eyring_stress": eyring_stress, "part": part}
    return {
        "shear": partial(_at_middle, **law),
        "warm_shear": partial(fitted_shear, **law),
        "stress_scale": partial(_scale, **law),
        "stress_limit": partial(_cold_limit, **law),
    }
