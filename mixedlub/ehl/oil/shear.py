"""Laws of shear: viscosity times shear rate at a stress, with derivatives by stress and pressure.

Every law is odd in the stress, and Newtonian at small stress.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mixedlub.ehl.oil.declared import GIGA, MEGA, SHEAR, Given, times
from mixedlub.ehl.oil.oil import Slopes

LARGEST_RATIO = 200.0
"""Stress over Eyring stress above which the law continues linearly: rates beyond any contact."""
CAP, CAP_END, PASSED = 0.01, 26.0, 1.2
"""Smooth cap over the limiting stress: its width, the width after which it is linear, and the largest ratio of stress
to limit in iterations."""


@SHEAR.offers("rate in proportion to stress; friction far too high above 0.5 GPa")
def newton(stress: np.ndarray, pressure: np.ndarray) -> Slopes:
    r"""Newtonian oil.

    .. math:: \eta\dot\gamma = \tau

    Source: definition.

    >>> float(newton(np.array(2e6), 0.0)[0])
    2000000.0
    """
    return stress, np.ones_like(stress), np.zeros_like(stress)


OWN = Given(
    "eyring_stress",
    "eyring_stress_MPa",
    "Eyring stress, at ambient pressure where it grows",
    times(MEGA),
    example=5.0,
    limits={"gt": 0.0},
)


@SHEAR.offers("sinh of stress over the Eyring stress", OWN, scale="eyring_stress")
def ree_eyring(stress: np.ndarray, pressure: np.ndarray, *, eyring_stress: float) -> Slopes:
    r"""One-term Ree-Eyring oil.

    .. math:: \eta\dot\gamma = \tau_0 \sinh(\tau/\tau_0)

    Source: K. L. Johnson, J. L. Tevaarwerk, Proc. R. Soc. A 356 (1977) 215.

    >>> round(float(ree_eyring(np.array(22.58e6), 0.0, eyring_stress=5e6)[0]) / 1e6)   # inverse of asinh
    229
    """
    rate, slope, _ = eyring_sinh(stress, np.asarray(eyring_stress))
    return rate, slope, np.zeros_like(stress)


def _grown(pressure: np.ndarray, **numbers: float) -> np.ndarray:
    return eyring_stress_at(pressure, **numbers)[0]


def _grows_upwards(section: Any) -> None:
    start, end = section.growth_start_GPa, section.growth_end_GPa
    if end <= start:
        raise ValueError(f"growth_end_GPa: {end:g}: must be above growth_start_GPa, {start:g}")


@SHEAR.offers(
    "the same, with a stress that grows with pressure (Li and Kahraman)",
    OWN,
    Given("eyring_growth", "eyring_growth", "its growth by pressure", limits={"ge": 0.0}),
    Given("growth_start", "growth_start_GPa", "pressure where it begins to grow", times(GIGA), limits={"ge": 0.0}),
    Given("growth_end", "growth_end_GPa", "pressure where it has grown", times(GIGA), limits={"gt": 0.0}),
    scale=_grown,
    refuse=_grows_upwards,
)
def growing_eyring(
    stress: np.ndarray,
    pressure: np.ndarray,
    *,
    eyring_stress: float,
    eyring_growth: float,
    growth_start: float,
    growth_end: float,
) -> Slopes:
    r"""One-term Ree-Eyring oil with a stress that grows with pressure between two levels.

    .. math:: \tau_0(p) = \tau_a + \frac{\tau_e}{2}\left\{1 + \tanh\left[\Theta\left(\frac{2p}{p_s + p_e} - 1\right)
              \right]\right\},\quad \tau_e = \tau_a + \kappa(p_e - p_s),\quad \Theta = \frac{\kappa(p_e - p_s)}{\tau_e}

    Source: S. Li, A. Kahraman, Tribol. Int. 59 (2013), for 75W90: 5 MPa, 0.035, 0.5 and 3.5 GPa.

    >>> args = (5e6, 0.035, 0.5e9, 3.5e9)
    >>> [round(float(eyring_stress_at(p, *args)[0]) / 1e6, 1) for p in (0.5e9, 1e9, 1.5e9, 2e9)]
    [26.2, 35.6, 47.1, 60.0]
    """
    own, growth = eyring_stress_at(pressure, eyring_stress, eyring_growth, growth_start, growth_end)
    rate, slope, by_own = eyring_sinh(stress, own)
    return rate, slope, by_own * growth


def eyring_stress_at(
    pressure: np.ndarray, eyring_stress: float, eyring_growth: float, growth_start: float, growth_end: float
) -> tuple[np.ndarray, np.ndarray]:
    """Eyring stress of `growing_eyring` (Pa) and its derivative by pressure. Source: see `growing_eyring`."""
    added = eyring_growth * (growth_end - growth_start)
    span = eyring_stress + added
    scale, middle = added / span, 0.5 * (growth_start + growth_end)
    tanh = np.tanh(scale * (pressure / middle - 1.0))
    return eyring_stress + 0.5 * span * (1.0 + tanh), 0.5 * span * (1.0 - tanh**2) * scale / middle


def eyring_sinh(stress: np.ndarray, own: np.ndarray) -> Slopes:
    """Eyring stress times sinh of the stress ratio, with derivatives by stress and Eyring stress."""
    ratio = stress / own
    inside = np.clip(ratio, -LARGEST_RATIO, LARGEST_RATIO)
    sinh, cosh = np.sinh(inside), np.cosh(inside)
    sinh = sinh + cosh * (ratio - inside)
    return own * sinh, cosh, sinh - ratio * cosh


@SHEAR.offers(
    "power law above a shear modulus",
    Given(
        "shear_modulus",
        "shear_modulus_MPa",
        "stress above which the power law acts",
        times(MEGA),
        limits={"gt": 0.0},
    ),
    Given("power", "power", "its exponent", limits={"gt": 0.0, "le": 1.0}),
    scale="shear_modulus",
)
def carreau(stress: np.ndarray, pressure: np.ndarray, *, shear_modulus: float, power: float) -> Slopes:
    r"""Carreau oil in Bair's stress form.

    .. math:: \eta\dot\gamma = \tau\left[1 + (\tau/G)^2\right]^{(1/n - 1)/2}

    Source: S. Bair, High-Pressure Rheology for Quantitative Elastohydrodynamics (2007).

    >>> round(float(carreau(np.array(3e6), 0.0, shear_modulus=3e6, power=0.5)[0]) / 1e6, 3)
    4.243
    """
    square = (stress / shear_modulus) ** 2
    exponent = 0.5 * (1.0 / power - 1.0)
    factor = (1.0 + square) ** exponent
    return stress * factor, factor * (1.0 + 2.0 * exponent * square / (1.0 + square)), np.zeros_like(stress)


def _limit(pressure: np.ndarray, *, limiting_stress: float, limiting_growth: float) -> np.ndarray:
    return limiting_stress + limiting_growth * pressure


def _passed(pressure: np.ndarray, **numbers: float) -> np.ndarray:
    return PASSED * _limit(pressure, **numbers)


@SHEAR.offers(
    "limiting stress in proportion to pressure (Bair and Winer)",
    Given(
        "limiting_stress",
        "limiting_stress_MPa",
        "limiting stress at ambient pressure",
        times(MEGA),
        limits={"gt": 0.0},
    ),
    Given("limiting_growth", "limiting_growth", "its growth by pressure", limits={"gt": 0.0, "lt": 1.0}),
    scale=_limit,
    limit=_passed,
)
def limiting(stress: np.ndarray, pressure: np.ndarray, *, limiting_stress: float, limiting_growth: float) -> Slopes:
    r"""Newtonian oil with a limiting stress that grows with pressure, as a smooth cap.

    .. math:: \eta\dot\gamma = \tau + \sigma\,e^{(|\tau| - \tau_L)/\sigma}\operatorname{sign}\tau,\quad
              \tau_L = \tau_{L0} + \Lambda p,\quad \sigma = 0.01\,\tau_L

    The stress passes the limit by 12 % where the Newtonian one is a thousand times it. Source: limiting stress by
    S. Bair, W. O. Winer, J. Lubr. Technol. 101 (1979) 258; the cap is a smooth form of a kink.

    >>> round(float(limiting(np.array(41e6), 1e9, limiting_stress=1e6, limiting_growth=0.04)[0]) / 1e6, 2)
    41.41
    """
    limit = limiting_stress + limiting_growth * pressure
    over = np.abs(stress) / limit - 1.0
    inside = np.minimum(over / CAP, CAP_END)
    beyond = np.exp(inside)
    capped = CAP * beyond * (1.0 + over / CAP - inside)
    by_limit = capped - beyond * np.abs(stress) / limit
    return stress + np.sign(stress) * limit * capped, 1.0 + beyond, np.sign(stress) * limiting_growth * by_limit
