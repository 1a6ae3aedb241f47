"""Limits of asperities that yield: hard ones are elastic, soft ones carry their hardness."""

import numpy as np
import pytest

from mixedlub.laws import contact, yielding

LAWS = ("chang_etsion_bogy", "zhao_maietta_chang", "kogut_etsion", "jackson_green")
SUMMITS, E_PRIME = (4.4106e10, 7.8332e-6, 0.48970e-6), 226.374e9


@pytest.mark.parametrize("name", LAWS)
def test_hard_asperities_stay_elastic(name):
    summits = SUMMITS
    gap = np.linspace(-1.0, 6.0, 30)
    hard = 1e12
    area = getattr(yielding, f"{name}_area")(gap, *summits, E_PRIME, hard)
    pressure = getattr(yielding, f"{name}_pressure")(gap, *summits, E_PRIME, hard)
    assert area == pytest.approx(contact.real_area_ratio(gap, *summits), rel=3e-7, abs=0.0)
    assert pressure == pytest.approx(contact.asperity_pressure(gap, *summits, E_PRIME), rel=3e-7, abs=0.0)


@pytest.mark.parametrize("name", ["zhao_maietta_chang", "kogut_etsion"])
def test_soft_asperities_carry_their_hardness_on_twice_the_elastic_area(name):
    summits, gap, soft = SUMMITS, np.linspace(0.0, 4.0, 10), 1e6
    area = getattr(yielding, f"{name}_area")(gap, *summits, E_PRIME, soft)
    pressure = getattr(yielding, f"{name}_pressure")(gap, *summits, E_PRIME, soft)
    assert area == pytest.approx(2.0 * contact.real_area_ratio(gap, *summits), rel=1e-4)
    assert pressure / area == pytest.approx(soft, rel=1e-3)
