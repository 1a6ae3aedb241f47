"""Orders of rigs that follow other laws can all be dealt, or are refused with the reason."""

import numpy as np
import pytest

from mixedlub.cli import main
from mixedlub.validation.sample_case import _rig_for
from mixedlub.validation.worlds.catalogue import OF_KIND, laws_on
from mixedlub.validation.worlds.deal import _allowed, plan_worlds
from profiles.errors import InputError

PRESSURE, TEMPERATURE = "pressure_viscosity_law", "viscosity_temperature_law"


@pytest.mark.parametrize("seed", [3, 4])
def test_every_order_of_a_viscometer_has_a_rig(seed):
    """Wax shows over a cycle of temperature alone, which has no pressure for a law of pressure."""
    orders = plan_worlds(seed, 12, ("viscosity",))
    for order in orders:
        rig, world, forms = _rig_for(np.random.default_rng(1), order)
        assert [one.law.id for one in world] == list(order.laws)
        assert {form.id for form in forms} == set(order.effects)
        assert set(order.laws) <= set(laws_on(rig))
    if seed == 3:
        (waxing,) = (order for order in orders if order.effects == ("waxing",))
        assert waxing.laws == (TEMPERATURE,)
        assert sum(len(order.laws) == 2 for order in orders) == 6


def test_an_order_without_any_rig_is_refused_by_its_effect():
    (order,) = (one for one in plan_worlds(3, 12, ("viscosity",)) if one.effects == ("waxing",))
    with pytest.raises(InputError, match=r"viscosity.*waxing"):
        _allowed(order, (PRESSURE,), (PRESSURE, TEMPERATURE), [])


def test_a_kind_without_other_laws_is_refused_with_the_kinds_that_have_some(tmp_path, capsys):
    assert main(["prove", "--worlds", "--kinds", "ring_gear", "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert "ring_gear" in said
    assert all(kind in said for kind in OF_KIND)
