"""Laws of machine parts: limits, signs and powers."""

from __future__ import annotations

import numpy as np
import pytest

from mixedlub.chain.part_law import COMPUTED, PartLaw
from mixedlub.parts import catalogue, find, of_kind, series
from mixedlub.report.equations import equation as drawn

STATE = {
    "shaft_speed": 100.0,
    "viscosity": 0.010,
    "oil_density": 850.0,
    "radial_load": 2000.0,
    "axial_load": 0.0,
    "wheel_radius": 0.1,
    "root_diameter": 0.18,
    "tip_diameter": 0.21,
    "face_width": 0.03,
    "gear_module": 4e-3,
    "wheel_teeth": 50.0,
    "helix_angle": 0.0,
    "bore_diameter": 0.035,
    "outside_diameter": 0.072,
    "static_rating": 15e3,
    "seal_diameter": 0.035,
    "immersion": 0.03,
    "oil_volume": 2e-3,
    "exit_area": 4e-5,
    "oil_flow": 4e-5,
    "jet_speed": 0.0,
}
GIVEN = {
    "palmgren": {"f0": 2.0, "f1": 3e-4},
    "harris": {"f0": 2.0, "z": 5e-4, "y": 0.5},
    "skf_deep_groove": dict(series()["deep_groove"]["62"]),
    "skf_cylindrical": dict(series()["cylindrical"]["NU4"]),
    "skf_angular_contact": dict(series()["angular_contact"]["QJ3"]),
    "hoehn": {"torque_at_rest": 0.1, "growth": 0.3},
    "incompressible": {"pocket_volume": 0.5, "mixture_density": 50.0},
    "own_torque": {"constant": 0.3},
    "skf_bearing_seals": dict(series()["bearing_seals"]["deep_groove_62_to_80"]),
}
OF_REPORT = {"seal": {"torque_per_diameter": 3.7}, "churning": {"dip_factor": 0.25}}


def value(law: PartLaw, **changed: float) -> float:
    state = STATE | changed
    own = GIVEN.get(law.name) or (OF_REPORT[law.kind] if law.name == "iso_tr_14179_1" else {})
    return float(law.law(*(np.asarray(state[name]) for name in law.reads), **law.values(own)))


@pytest.mark.parametrize("key", sorted(catalogue()), ids="-".join)
class TestEveryLaw:
    def test_it_is_positive_and_finite(self, key: tuple[str, str]) -> None:
        found = value(catalogue()[key])
        assert np.isfinite(found)
        assert found > 0.0

    def test_it_loses_no_less_when_it_turns_faster(self, key: tuple[str, str]) -> None:
        law = catalogue()[key]
        slow, fast = (value(law, shaft_speed=speed) for speed in (50.0, 200.0))
        slow, fast = (slow * 50.0, fast * 200.0) if law.kind in ("bearing", "seal", "other") else (slow, fast)
        assert fast > slow

    def test_its_page_says_what_it_reads_and_where_it_is_from(self, key: tuple[str, str]) -> None:
        law = catalogue()[key]
        assert law.source
        assert law.equation
        assert max(map(len, law.page().splitlines())) <= 80
        assert all(name in law.page() for name in law.reads if name in COMPUTED)


@pytest.mark.parametrize("name", sorted(of_kind("bearing")))
def test_bearings_lose_more_under_load(name: str) -> None:
    law = find("bearing", name)
    light, heavy, thrust = (
        value(law, radial_load=radial, axial_load=axial)
        for radial, axial in ((500.0, 0.0), (5000.0, 0.0), (500.0, 3000.0))
    )
    assert light < heavy
    assert light < thrust


@pytest.mark.parametrize("name", sorted(of_kind("windage")))
def test_powers_of_windage_are_those_of_turbulence(name: str) -> None:
    slow, fast = (value(find("windage", name), shaft_speed=speed) for speed in (500.0, 1000.0))
    assert 2.7 <= np.log2(fast / slow) <= 3.0


def test_wheels_at_rest_lose_nothing() -> None:
    for kind in ("windage", "churning", "pocketing", "jet"):
        for law in of_kind(kind).values():
            assert value(law, shaft_speed=1e-12) == pytest.approx(0.0, abs=1e-9), law.name


def test_the_laws_of_changenet_and_velex_are_joined_without_a_step() -> None:
    law = find("churning", "changenet_velex")
    speed = np.linspace(150.0, 300.0, 3000)
    found = law.law(*({**STATE, "shaft_speed": speed}[name] for name in law.reads))
    assert np.all(np.diff(found) > 0.0)
    assert np.diff(np.log(found)).max() < 5e-3


@pytest.mark.parametrize("key", sorted(catalogue()), ids="-".join)
def test_its_equation_can_be_drawn(key: tuple[str, str]) -> None:
    assert drawn(catalogue()[key].equation.replace(r"\frac", r"\dfrac")).startswith("<svg")
