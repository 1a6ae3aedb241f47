"""Rigs to try planted effects on, and cases of every kind made once."""

from dataclasses import replace

import numpy as np
import pytest

from mixedlub.validation.battery import generate, make
from mixedlub.validation.contact import Calibration, Contact, Solid, calibrated, dowson_toyoda, start
from mixedlub.validation.rigs import discs, gears
from mixedlub.validation.rigs.ball import hamrock_dowson, press_ball

from .helpers import ORDERS, reference_points

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


@pytest.fixture(scope="module")
def pressed():
    """The three reference points of the 17/26 pair, pressed but not lubricated."""
    return reference_points()


@pytest.fixture(scope="module")
def contact(pressed):
    """The reference points that slide, with the base model's film."""
    c = dowson_toyoda(pressed)
    return _only(c, slice(1, 3))


def _only(c: Contact, points: slice) -> Contact:
    wide = {
        n: getattr(c, n) for n in ("force", "line_load", "entrainment", "sliding", "pressure", "half_width", "film")
    }
    rig = replace(
        c.rig,
        radius=c.rig.radius[:, points],
        speed_1=c.rig.speed_1[:, points],
        speed_2=c.rig.speed_2[:, points],
        share_force=c.rig.share_force[:, points],
    )
    return replace(c, rig=rig, **{name: values[:, points] for name, values in wide.items()})


@pytest.fixture(scope="module")
def ball():
    """A steel ball of 9.525 mm on steel at three speeds."""
    speed = np.array([[0.1], [0.5], [2.0]])
    inputs = replace(
        reference_points().rig,
        solid=Solid((207e9, 207e9)),
        radius=np.array([[9.525e-3]]),
        speed_1=1.25 * speed,
        speed_2=0.75 * speed,
        share_force=np.full((3, 1), 30.0),
        width=1.0,
        temperature=np.full(3, 60.0),
        moments=np.repeat([[1e-14, 1e-4, 1e8]], 3, axis=0),
        is_point=True,
    )
    return hamrock_dowson(press_ball(start(inputs, Calibration())))
