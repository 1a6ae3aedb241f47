"""Viscosities below 2 mm2/s by the whole formula of ASTM D341."""

import numpy as np
import pytest

from mixedlub.laws.oil import kinematic_viscosity, to_d341

KNOWN = (313.15, 373.15), (5.0e-6, 1.7e-6)


@pytest.mark.literature("ASTM D341: Z = nu + 0.7 + C - D + E - F + G - H, its terms worked out by hand")
@pytest.mark.parametrize(("nu", "number"), [(1.5, 2.2058758), (1.0, 1.7221999), (0.5, 1.2820361), (0.3, 1.1226734)])
def test_number_of_a_thin_oil(nu: float, number: float) -> None:
    assert 10.0 ** (10.0 ** to_d341(np.array(nu * 1e-6))) == pytest.approx(number, rel=1e-6)


@pytest.mark.literature("ASTM D341: 0.987 mm2/s at 150 °C of an oil of 5.0 and 1.7 mm2/s at 40 and 100 °C")
def test_thin_oil_when_hot() -> None:
    assert kinematic_viscosity(423.15, *KNOWN) * 1e6 == pytest.approx(0.987, abs=5e-4)
    assert kinematic_viscosity(np.array([313.15, 373.15]), *KNOWN) == pytest.approx(KNOWN[1], rel=1e-12)
