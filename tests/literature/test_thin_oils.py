"""Viscosities below 2 mm2/s by the whole formula of ASTM D341."""

import numpy as np
import pytest

from mixedlub.laws.oil import from_d341, kinematic_viscosity, temperature_viscosity, to_d341, warmed_viscosity

KNOWN = (313.15, 373.15), (5.0e-6, 1.7e-6)


@pytest.mark.literature("ASTM D341: Z = nu + 0.7 + C - D + E - F + G - H, its terms worked out by hand")
@pytest.mark.parametrize(("nu", "number"), [(1.5, 2.2058758), (1.0, 1.7221999), (0.5, 1.2820361), (0.3, 1.1226734)])
def test_number_of_a_thin_oil(nu: float, number: float) -> None:
    assert 10.0 ** (10.0 ** to_d341(np.array(nu * 1e-6))) == pytest.approx(number, rel=1e-6)


@pytest.mark.literature("ASTM D341: 0.987 mm2/s at 150 °C of an oil of 5.0 and 1.7 mm2/s at 40 and 100 °C")
def test_thin_oil_when_hot() -> None:
    assert kinematic_viscosity(423.15, *KNOWN) * 1e6 == pytest.approx(0.987, abs=5e-4)
    assert kinematic_viscosity(np.array([313.15, 373.15]), *KNOWN) == pytest.approx(KNOWN[1], rel=1e-12)


def test_viscosity_has_no_step_and_its_slope_is_its_own() -> None:
    kelvin = np.linspace(300.0, 470.0, 1701)
    nu = kinematic_viscosity(kelvin, *KNOWN)
    fall = temperature_viscosity(kelvin, *KNOWN)
    assert -np.gradient(np.log(nu), kelvin)[1:-1] == pytest.approx(fall[1:-1], rel=2e-3)
    thin = np.geomspace(0.21e-6, 3e-6, 500)
    assert from_d341(to_d341(thin)) == pytest.approx(thin, rel=1e-9)


def test_constant_alone_above_2() -> None:
    nu = np.array([2.0, 7.2, 460.0])
    assert to_d341(nu * 1e-6) == pytest.approx(np.log10(np.log10(nu + 0.7)), rel=1e-14)


def test_oil_warmed_into_the_thin_range() -> None:
    warm = warmed_viscosity(5.0e-6 * 800.0, 800.0, temperature_viscosity(313.15, *KNOWN), 313.15, 110.0)
    assert warm / 800.0 == pytest.approx(kinematic_viscosity(423.15, *KNOWN), rel=1e-9)
