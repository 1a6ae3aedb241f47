"""Errors of the height-integral fits in circulation, as a survey of them computed to 25 digits."""

import numpy as np
import pytest

from roughness.integrals import gaussian_integral

FITS = {
    "F5/2 power": (2.5, lambda t: 4.4086e-5 * (4.0 - t) ** 6.804),
    "F2 power": (2.0, lambda t: 3.5e-5 * (4.0 - t) ** 6.9),
    "F5/2 exponential": (2.5, lambda t: 0.6189 * np.exp(-1.973 * t)),
    "F2 exponential": (2.0, lambda t: 0.5025 * np.exp(-1.844 * t)),
}


@pytest.mark.parametrize(
    ("name", "percent"),
    [
        ("F5/2 power", (-10.7, -3.5, -9.2, -74.0)),
        ("F2 power", (-0.2, -9.0, -28.0, -83.0)),
        ("F5/2 exponential", (0.4, 7.0, 121.0, 870.0)),
        ("F2 exponential", (0.5, 6.0, 118.0, 880.0)),
    ],
)
def test_errors_at_gaps_of_0_to_3_sigma(name: str, percent: tuple[float, ...]) -> None:
    (n, fit), gap = FITS[name], np.arange(4.0)
    found = 100.0 * (fit(gap) / gaussian_integral(n, gap) - 1.0)
    assert found == pytest.approx(percent, rel=0.02, abs=0.6)
