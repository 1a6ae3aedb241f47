"""Errors of the height-integral fits in circulation, as a survey of them computed to 25 digits."""

import pytest

from roughness.integrals import popular_fit_error


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
    found = 100.0 * popular_fit_error(name, [0.0, 1.0, 2.0, 3.0])
    assert found == pytest.approx(percent, rel=0.02, abs=0.6)
