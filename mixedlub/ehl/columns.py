"""Shear across the film: mean stress at the sliding speed, and flow driven by pressure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.ehl import across
from mixedlub.ehl.across import NODES, WEIGHTS
from mixedlub.ehl.oil.oil import Oil

MOMENTS = WEIGHTS[:, None] * NODES[:, None] ** np.arange(3)
"""Weights of the integrals of a function times s^0, s^1 and s^2."""
STRESS_TOLERANCE, LEAST_STRESS = 1e-9, 1.0
"""Relative tolerance of the stress, and the smallest reference stress (Pa)."""
STRESS_STEPS = 60


@dataclass(frozen=True)
class FilmColumn:
    """Columns of film: oil at its pressure (Pa), temperature (K) across, gap (m), pressure gradient (Pa/m).

    All arrays have the shape of the columns; the temperature has an additional last axis of nodes across.
    """

    oil: Oil
    pressure: np.ndarray
    temperature: np.ndarray
    gap: np.ndarray
    gradient: np.ndarray
    sliding: np.ndarray


@dataclass(frozen=True)
class Sheared:
    """Shear of columns: mean stress, shear rate across with derivatives, and stress across.

    ``miss``: relative change of the mean stress in its last iteration.
    """

    mean_stress: np.ndarray
    stress: np.ndarray
    rate: np.ndarray
    by_stress: np.ndarray
    by_pressure: np.ndarray
    by_temperature: np.ndarray
    miss: np.ndarray


def sheared(column: FilmColumn, start: np.ndarray) -> Sheared:
    r"""Shear of columns between sliding walls: mean stress by Newton's method from a start.

    .. math:: h \int_{-1/2}^{1/2} \dot\gamma(\tau_m + s h p_x)\,ds = u_2 - u_1

    The iteration uses asinh of the sliding speed over the speed at the oil's stress scale, which is nearly linear.
    """
    pressure = column.pressure[..., None]
    log, by_p, by_t = column.oil.log_viscosity(pressure, column.temperature)
    fluidity = np.exp(-log)
    slope = NODES * (column.gap * column.gradient)[..., None]
    least = column.gap * column.oil.stress_scale(column.pressure) * across.mean(fluidity)
    wanted = np.arcsinh(column.sliding / least)
    most = column.oil.stress_limit(column.pressure)
    mean_stress = start
    for _ in range(STRESS_STEPS):
        stress = mean_stress[..., None] + slope
        rate, soft, *_ = column.oil.sheared(stress, pressure, column.temperature)
        rate, soft = rate * fluidity, soft * fluidity
        slid = column.gap * (rate @ WEIGHTS)
        off = np.arcsinh(slid / least) - wanted
        change = off * np.hypot(least, slid) / (column.gap * (soft @ WEIGHTS))
        mean_stress = np.clip(mean_stress - change, -most, most)
        miss = np.abs(change) / (np.max(np.abs(stress), axis=-1) + LEAST_STRESS)
        if np.all(miss <= STRESS_TOLERANCE):
            break
    stress = mean_stress[..., None] + slope
    flowing = column.oil.sheared(stress, pressure, column.temperature)
    rate, soft, hard, warm = (value * fluidity for value in flowing)
    return Sheared(mean_stress, stress, rate, soft, hard - rate * by_p, warm - rate * by_t, miss)


@dataclass(frozen=True)
class Driven:
    """Volume flow driven by pressure (m^2/s, positive towards falling pressure), with derivatives."""

    flow: np.ndarray
    by_pressure: np.ndarray
    by_gradient: np.ndarray
    by_gap: np.ndarray


def driven(column: FilmColumn, shear: Sheared) -> Driven:
    r"""Flow driven by the pressure gradient, :math:`h^2\int s\,\dot\gamma\,ds`, at the sliding speed of the walls."""
    gap, gradient = column.gap, column.gradient
    zeroth, first, second = np.moveaxis(shear.by_stress @ MOMENTS, -1, 0)
    pressed0, pressed1, _ = np.moveaxis(shear.by_pressure @ MOMENTS, -1, 0)
    whole, lever, _ = np.moveaxis(shear.rate @ MOMENTS, -1, 0)
    flow = gap**2 * lever
    by_gradient = -gap * first / zeroth
    by_gap = -(whole / gap + gradient * first) / zeroth
    by_pressure = -pressed0 / zeroth
    return Driven(
        flow,
        gap**2 * (first * by_pressure + pressed1),
        gap**2 * (first * by_gradient + gap * second),
        2.0 * flow / gap + gap**2 * (first * by_gap + gradient * second),
    )


def newtonian(column: FilmColumn) -> Driven:
    r"""Flow of an isothermal Newtonian oil, :math:`h^3 p_x/(12\eta)`, without the shear of the walls."""
    log, by_p, _ = column.oil.log_viscosity(column.pressure, column.temperature[..., 0])
    mobility = column.gap**3 * np.exp(-log) / 12.0
    flow = mobility * column.gradient
    return Driven(flow, -flow * by_p, mobility, 3.0 * flow / column.gap)
