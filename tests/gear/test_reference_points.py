"""Three contact points of the 17/26 gear, worked out by an independent program, through the real chain."""

import numpy as np
import pytest

from mixedlub.base_model.chains import GEAR_CONTACT
from mixedlub.chain.model import Model
from mixedlub.gear import GearPair, RigidSharing, at_roll_angle
from mixedlub.gear.inputs import motion_inputs
from mixedlub.laws.film import dowson_higginson
from mixedlub.laws.shear import ree_eyring_secant

POINTS = ("pitch point", "highest single contact", "end of contact")
REFERENCE = {
    "radius": (8.3262e-3, 8.6914e-3, 7.9264e-3),
    "entrainment_speed": (2.1630, 2.2417, 2.4039),
    "hertz_pressure": (0.9642e9, 0.9437e9, 0.6988e9),
    "film_thickness": (0.2214e-6, 0.2310e-6, 0.2502e-6),
    "separation": (0.1806, 0.2001, 0.2393),
    "area_ratio": (0.16749, 0.16309, 0.15449),
    "asperity_pressure": (2.10e9, 2.04e9, 1.92e9),
    "contact_viscosity": (80.1, 70.2, 13.1),
    "friction": (0.01675, 0.03633, 0.03889),
}


@pytest.fixture(scope="module")
def state():
    pair = GearPair(
        (17, 26), 25.4e-3 / 6, np.radians(22.5), 14e-3, youngs_modulus=(206e9, 206e9), poisson_ratio=(0.3, 0.3)
    )
    places = np.array([pair.pitch_point, pair.highest_single_contact, pair.path_end])
    points = at_roll_angle(pair, RigidSharing(), places / pair.base_radius[0])
    inputs = {
        **motion_inputs(points, np.array([100.0]), np.array([1500.0 * np.pi / 30.0])),
        "load_share": np.array([1.0, 1.0, 0.5]),
        "viscosity": 0.01489,
        "pressure_viscosity": 14.81e-9,
        "eyring_stress": 5e6,
        "boundary_friction": 0.1,
        "solid_conductivity": 46.0,
        "solid_density": 7800.0,
        "solid_heat_capacity": 470.0,
        "m0": (0.321**2 + 0.374**2) * 1e-12,
        "m2": 0.005,
        "m4": 7.2e9,
    }
    want = (*REFERENCE, "sliding_speed", "fluid_friction", "line_load", "reduced_modulus")
    return {**inputs, **Model(GEAR_CONTACT, tuple(inputs), want)(inputs)}


@pytest.mark.parametrize("point", range(3), ids=POINTS)
@pytest.mark.parametrize("quantity", REFERENCE)
def test_local_value_to_half_a_percent(state, quantity, point):
    assert state[quantity][point] == pytest.approx(REFERENCE[quantity][point], rel=5e-3)


@pytest.mark.parametrize(("point", "speed", "friction"), [(0, 0.0, 0.0), (1, 0.7518, 0.02392), (2, 2.3021, 0.02773)])
def test_sliding_and_film_friction(state, point, speed, friction):
    assert state["sliding_speed"][point] == pytest.approx(speed, rel=5e-3, abs=1e-9)
    assert state["fluid_friction"][point] == pytest.approx(friction, rel=5e-3, abs=1e-9)


@pytest.mark.parametrize(("point", "film"), [(0, 0.1671e-6), (1, 0.1745e-6), (2, 0.1927e-6)])
def test_minimum_film(state, point, film):
    arguments = ("radius", "entrainment_speed", "line_load", "viscosity", "pressure_viscosity", "reduced_modulus")
    found = dowson_higginson(*(state[name] for name in arguments))
    assert found[point] == pytest.approx(film, rel=5e-3)


@pytest.mark.parametrize(("point", "friction"), [(1, 0.00530), (2, 0.00715)])
def test_secant_film_friction(state, point, friction):
    arguments = ("contact_viscosity", "sliding_speed", "film_thickness", "eyring_stress")
    found = ree_eyring_secant(*(state[name] for name in arguments)) / state["hertz_pressure"]
    assert found[point] == pytest.approx(friction, rel=5e-3)
