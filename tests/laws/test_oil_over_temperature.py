"""Viscosity over temperature by ASTM D341: no step, its slope, and oils that are warmed into the thin range."""

import numpy as np
import pytest

from mixedlub.laws.oil import from_d341, kinematic_viscosity, temperature_viscosity, to_d341, warmed_viscosity

KNOWN = (313.15, 373.15), (5.0e-6, 1.7e-6)


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
