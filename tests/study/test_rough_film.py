"""Films between rough surfaces with a lay: Grubin's inlet integrated by hand, limits, and two surfaces together."""

import numpy as np
import pytest

from mixedlub.laws.rough_film import pressure_flow_factor, rough_film
from mixedlub.rig.surface import Surface, paired


def test_the_table_is_the_inlet_integrated_by_hand():
    """A midpoint sum, and the film found by trial."""
    t = (np.arange(400_000) + 0.5) * 1e-3
    weight = t ** (2 / 3) / (1 + t) ** 3

    def smooth(rough, gamma):
        flow = pressure_flow_factor(rough * (1 + t), gamma)
        return rough / ((weight / flow).sum() / weight.sum()) ** 0.75

    for gamma in (1 / 9, 1.0, 3.0):
        for rough in (1.2, 2.0, 6.0):
            assert float(rough_film(smooth(rough, gamma), 1.0, np.array(gamma))) == pytest.approx(rough, rel=1e-3)


def test_far_apart_there_is_no_effect_and_below_one_sigma_it_stays():
    film = np.array([100.0, 0.2, 0.3])
    ratio = rough_film(film, 1.0, np.array(1 / 6)) / film
    assert ratio[0] == pytest.approx(1.0, abs=1e-6)
    assert ratio[1] == ratio[2] > 1.3


def surface(lay, along, m0=1e-14):
    return Surface("a", m0, 4e-3, 1.6e9, 0.0, 2.0, 46.0, 7800.0, 470.0, lay=lay, m2_along=along, m4_along=1e8)


def test_two_surfaces_together_flow_as_their_first_orders_add_up():
    rough, smooth = surface("transverse", 1e-3), surface("longitudinal", 1e-3, m0=0.5e-14)
    gamma = paired([rough], [smooth])["peklenik_number"][0]
    order = [(2 - one.orientation) / (1 + one.orientation) for one in (rough, smooth)]
    assert (2 - gamma) / (1 + gamma) == pytest.approx((2 * order[0] + order[1]) / 3)
    assert paired([rough], [rough])["peklenik_number"] == pytest.approx(0.5)
