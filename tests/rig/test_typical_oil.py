"""Typical oils of a base stock, where a case gives none."""

import numpy as np
import pytest

from mixedlub.rig import build
from mixedlub.rig.build import named_bases
from mixedlub.schema import system_file
from mixedlub.schema.findings import collected


@pytest.mark.parametrize("base", list(named_bases()))
def test_a_typical_oil_keeps_its_z_at_every_temperature(base):
    """Roelands: alpha = Z (ln eta + 9.67) / 1.96e8 Pa; a straight line would be below zero at 300 °C."""
    with collected():
        oil = build.lubricant(system_file.Lubricant(base=base))
    kelvin = np.array([253.15, 313.15, 373.15, 573.15])
    z = oil.pressure_coefficient(kelvin) * 1.96e8 / (np.log(oil.viscosity(kelvin)) + 9.67)
    assert z == pytest.approx(z[1], rel=1e-9)
    assert np.all(z > 0.0)
    scale, power = named_bases()[base]["gold"]
    gold = scale * (1e6 * oil.kinematic_viscosity[0]) ** power * 1e-9
    assert oil.pressure_coefficient(kelvin[1]) == pytest.approx(gold, rel=0.02)
