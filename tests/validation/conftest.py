"""Rigs to try concealed effects on, and a small battery made once."""

import numpy as np
import pytest

from mixedlub.validation.battery import generate
from mixedlub.validation.build import rig_of
from mixedlub.validation.design import draw_disc, draw_gear


@pytest.fixture(scope="session")
def gear_case():
    return draw_gear(np.random.default_rng(3), coated=True)


@pytest.fixture(scope="session")
def rigs(gear_case):
    disc = draw_disc(np.random.default_rng(4), coated=True)
    return {case.kind: (rig_of(case, 48), case.nominal) for case in (gear_case, disc)}


@pytest.fixture(scope="session")
def battery(tmp_path_factory):
    """Eight cases, every class among them."""
    folder = tmp_path_factory.mktemp("battery")
    return generate(folder, seed=11, cases=8)
