"""How little an oil thins with heat, as its trade tells it."""

from __future__ import annotations

import numpy as np

LEAST = 2e-6
"""Kinematic viscosity at 100 degC (m^2/s) below which the standard defines no index."""
REFERENCE_OILS = np.array(
    [
        (3.8, 1.14673, 1.7576, -0.109, 0.84155, 1.5521, -0.077),
        (4.4, 3.38095, -15.4952, 33.196, 0.78571, 1.7929, -0.183),
        (5.0, 2.5, -7.2143, 13.812, 0.82143, 1.5679, 0.119),
        (6.4, 0.101, 16.635, -45.469, 0.04985, 9.1613, -18.557),
        (7.0, 3.35714, -23.5643, 78.466, 0.22619, 7.7369, -16.656),
        (7.7, 0.01191, 21.475, -72.870, 0.79762, -0.7321, 14.610),
        (9.0, 0.41858, 16.1558, -56.040, 0.05794, 10.5156, -28.240),
        (12.0, 0.88779, 7.5527, -16.600, 0.26665, 6.7015, -10.810),
        (15.0, 0.76720, 10.7972, -38.180, 0.20073, 8.4658, -22.490),
        (18.0, 0.97305, 5.3135, -2.200, 0.28889, 5.9741, -4.930),
        (22.0, 0.97256, 5.2500, -0.980, 0.24504, 7.4160, -16.730),
        (28.0, 0.91413, 7.4759, -21.820, 0.20323, 9.1267, -34.230),
        (40.0, 0.87031, 9.7157, -50.770, 0.18411, 10.1015, -46.750),
        (55.0, 0.84703, 12.6752, -133.310, 0.17029, 11.4866, -80.620),
        (70.0, 0.85921, 11.1009, -83.190, 0.17130, 11.3680, -76.940),
        (np.inf, 0.83531, 14.6731, -216.246, 0.16841, 11.8493, -96.947),
    ]
)
"""Up to which viscosity at 100 degC (mm^2/s), and the coefficients of its square, itself and 1 in L and in H."""


def viscosity_index(at_40: float, at_100: float) -> float:
    r"""Viscosity index (-) of an oil from its kinematic viscosities (m^2/s) at 40 and 100 degC; nan below 2 mm^2/s.

    .. math:: VI = 100\,\frac{L - U}{L - H}\ (U \ge H), \quad
        VI = 100 + \frac{10^N - 1}{0.00715},\ N = \frac{\log H - \log U}{\log Y}\ (U < H)

    with U and Y at 40 and 100 degC, and L and H the viscosities at 40 degC of oils of index 0 and 100 that have Y too.
    Their table makes this form belong to mm^2/s.
    Source: ASTM D2270 (ISO 2909); its tabulated L and H are met within 0.1 %.

    >>> round(viscosity_index(73.30e-6, 8.86e-6)), round(viscosity_index(22.83e-6, 5.05e-6))   # examples there
    (92, 156)
    """
    if not at_100 >= LEAST:
        return float("nan")
    u, y = at_40 * 1e6, at_100 * 1e6
    row = REFERENCE_OILS[np.searchsorted(REFERENCE_OILS[:, 0], y, side="right")]
    low, high = (float(np.polyval(row[i : i + 3], y)) for i in (1, 4))
    if u >= high:
        return 100.0 * (low - u) / (low - high)
    return 100.0 + float(10.0 ** (np.log(high / u) / np.log(y)) - 1.0) / 0.00715
