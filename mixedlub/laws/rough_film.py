"""Films between rough surfaces with a lay: the flow factors of Patir and Cheng in the inlet of the contact."""

from __future__ import annotations

from functools import cache

import numpy as np

FLOW_FACTORS = {
    1 / 9: (1.48, 0.42),
    1 / 6: (1.38, 0.42),
    1 / 3: (1.18, 0.42),
    1.0: (0.90, 0.56),
    3.0: (0.225, 1.5),
    6.0: (0.520, 1.5),
    9.0: (0.870, 1.5),
}
"""C and r by Peklenik number; N. Patir, H. S. Cheng, J. Lubr. Technol. 100 (1978) 12."""
THINNEST = 1.0
"""Film over composite roughness down to which the flow factors hold where ridges are transverse."""
_THICKEST, _STEPS = 300.0, 240


def pressure_flow_factor(film_over_roughness: np.ndarray, peklenik_number: float) -> np.ndarray:
    r"""Flow between rough surfaces over that between smooth ones under a pressure gradient (-).

    .. math:: \phi_x = 1 - C e^{-rH}\ (\gamma \le 1),\quad 1 + C H^{-r}\ (\gamma > 1)

    with film over composite roughness H, and C and r of the table at the nearest Peklenik numbers, linear in
    :math:`\ln\gamma` between them and constant beyond 1/9 and 9. Valid for H above 1 (0.5 where :math:`\gamma \ge 1`).
    Source: N. Patir, H. S. Cheng, J. Lubr. Technol. 100 (1978) 12.

    >>> round(float(pressure_flow_factor(3.0, 1.0)), 3), round(1 - 1.5 / 3**2, 3)   # and Tripp's first order
    (0.832, 0.833)
    """
    known, ratio = np.array(sorted(FLOW_FACTORS)), np.asarray(film_over_roughness, dtype=float)
    factors = []
    for gamma in known.tolist():
        c, r = FLOW_FACTORS[gamma]
        factors.append(1.0 - c * np.exp(-r * ratio) if gamma <= 1.0 else 1.0 + c * ratio**-r)
    place = np.interp(np.log(peklenik_number), np.log(known), np.arange(known.size))
    if np.isnan(place):
        return np.full_like(ratio, np.nan)
    lower = min(int(place), known.size - 2)
    return np.asarray((1.0 - place + lower) * factors[lower] + (place - lower) * factors[lower + 1])


@cache
def _thickening() -> np.ndarray:
    """Logarithm of rough over smooth film by Peklenik number of the table (rows) and smooth film over roughness."""
    from scipy.special import roots_jacobi

    nodes, weights = roots_jacobi(80, 1.0 / 3.0, 2.0 / 3.0)
    wider = 2.0 / (1.0 - nodes)
    rough = np.geomspace(THINNEST, 10.0 * _THICKEST, 4 * _STEPS)
    rows = []
    for gamma in sorted(FLOW_FACTORS):
        hindered = (weights / pressure_flow_factor(rough[:, None] * wider, gamma)).sum(axis=1) / weights.sum()
        thicker = 0.75 * np.log(hindered)
        rows.append(np.interp(_smooth(), np.log(rough) - thicker, thicker))
    return np.array(rows)


def _smooth() -> np.ndarray:
    """Logarithms of the smooth film over the roughness at which the table stands."""
    return np.linspace(np.log(0.3), np.log(_THICKEST), _STEPS)


def rough_film(smooth_film: np.ndarray, m0: np.ndarray, peklenik_number: np.ndarray) -> np.ndarray:
    r"""Film thickness of a line contact of rough surfaces with a lay (m).

    .. math:: \left(\frac{h}{h_0}\right)^{4/3} =
              \frac{\int_0^\infty t^{2/3}(1+t)^{-3}\,\phi_x^{-1}\,dt}{\int_0^\infty t^{2/3}(1+t)^{-3}\,dt},\quad
              \phi_x = \phi_x\!\left(\frac{h(1+t)}{\sigma}\right)

    the inlet of Grubin, whose gap is :math:`h(1+t)` with :math:`t \propto x^{3/2}`, with the flow factor of Patir and
    Cheng. Ridges across the motion hinder the backflow and thicken the film. Where h is below :math:`\sigma` the
    thickening is that at :math:`\sigma`. Source: N. Patir, H. S. Cheng, J. Lubr. Technol. 100 (1978) 12, for the flow
    factor; A. N. Grubin, 1949, for the inlet.

    >>> thick = rough_film(np.array([3.0, 3.0, 30.0]), 1.0, np.array([1 / 9, 9.0, 1 / 9]))
    >>> (thick / np.array([3.0, 3.0, 30.0])).round(3).tolist()   # transverse, longitudinal, far apart
    [1.092, 0.959, 1.0]
    """
    table, known = _thickening(), np.log(sorted(FLOW_FACTORS))
    ratio, gamma = np.broadcast_arrays(np.log(smooth_film / np.sqrt(m0)), np.log(peklenik_number))
    start = _smooth()[0]
    column = np.clip((ratio - start) / (_smooth()[1] - start), 0.0, _STEPS - 1.0)
    row = np.interp(gamma, known, np.arange(known.size))
    unknown = np.isnan(row + column)
    row, column = np.where(unknown, 0.0, row), np.where(unknown, 0.0, column)
    i, j = np.minimum(row.astype(int), known.size - 2), np.minimum(column.astype(int), _STEPS - 2)
    u, v = row - i, column - j
    low = table[i, j] * (1 - v) + table[i, j + 1] * v
    high = table[i + 1, j] * (1 - v) + table[i + 1, j + 1] * v
    return np.where(unknown, np.nan, smooth_film * np.exp(low * (1 - u) + high * u))


def film_over_roughness(film_thickness: np.ndarray, m0: np.ndarray) -> np.ndarray:
    r"""Film thickness over composite roughness at a point (-), :math:`h/\sigma`.

    >>> float(film_over_roughness(3e-7, 1e-14))
    3.0
    """
    return film_thickness / np.sqrt(m0)
