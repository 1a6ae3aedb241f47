"""Rigs to try planted effects on, and cases of every kind made once."""

from dataclasses import replace

import numpy as np
import pytest

from mixedlub.validation.battery import generate, make
from mixedlub.validation.contact import calibrated
from mixedlub.validation.rigs import discs, gears

from .helpers import ORDERS

SEED = 10


@pytest.fixture(scope="session")
def gear_case():
    return gears.draw_case(np.random.default_rng(3), coated=True)


@pytest.fixture(scope="session")
def rigs(gear_case):
    disc = discs.draw_case(np.random.default_rng(4), coated=True)
    return {
        "gear_pair": (gears.inputs_of(gear_case, 48), calibrated(gear_case.settings, np.zeros(5))),
        "disc": (discs.inputs_of(disc), calibrated(disc.settings, np.zeros(5))),
    }


@pytest.fixture(scope="session")
def battery(tmp_path_factory):
    """Eight cases of gears and discs, every class among them."""
    folder = tmp_path_factory.mktemp("battery")
    return generate(folder, seed=11, cases=8)


@pytest.fixture(scope="session")
def named_orders():
    return {name: replace(order, name=f"case_{place:03d}") for place, (name, order) in enumerate(ORDERS.items())}


@pytest.fixture(scope="session")
def others(tmp_path_factory, named_orders):
    """The ordered cases of all other kinds."""
    folder = tmp_path_factory.mktemp("others")
    made = [folder / make(SEED, place, order, folder) for place, order in enumerate(named_orders.values())]
    return dict(zip(ORDERS, made))


@pytest.fixture(scope="session")
def folders(battery, others):
    return [*battery, *others.values()]
