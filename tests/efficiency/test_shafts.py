"""Forces of a mesh on the bearings of its shafts: static balance, shares, and forces that no bearing carries."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mixedlub.efficiency import read_gearbox
from mixedlub.efficiency.shafts import WheelForce, bearing_reactions
from mixedlub.gear import GearPair
from profiles.errors import InputError
from tests.efficiency.gearboxes import STAGE, gearbox, gearbox_file, written

HELICAL = {"teeth": [23, 67], "normal_module_mm": 2.0, "helix_angle_deg": 28.0, "face_width_mm": 26.0}
BEARING: dict[str, Any] = {
    "law": "skf_deep_groove",
    "series": "62",
    "bore_mm": 35,
    "outside_diameter_mm": 72,
    "static_rating_N": 15300,
}
SEAT = BEARING | {"shaft": "pinion"}
LEFT, RIGHT = SEAT | {"position_mm": -30.0, "axial": "fixed"}, SEAT | {"position_mm": 50.0}


def stage(gears: dict[str, Any] | None = None, thrust: str | None = "positive", **bearings: Any) -> dict[str, Any]:
    direction = {} if thrust is None else {"pinion_thrust": thrust}
    return STAGE | direction | {"gears": gears or HELICAL, "bearings": bearings}


def loads(folder: Path, *stages: dict[str, Any]) -> dict[str, tuple[float, float]]:
    box = gearbox(folder, *stages)
    return {part.name: part.load for one in box.stages for part in one.parts}


@pytest.mark.literature("Budynas and Nisbett, Shigley's Mechanical Engineering Design, example with figure 13-39")
def test_the_overhung_pinion_of_a_textbook() -> None:
    """1 hp at 1800 rpm, 18 teeth, 30 degrees: 40.4, 17.0 and 23.3 lbf 13 in from A; B stands at 10 in."""
    pair = GearPair((18, 36), 25.4e-3 / 12, math.radians(20), 0.025, helix_angle=math.radians(30))
    radius, angle = pair.operating_radius[0], pair.working_pressure_angle
    power, speed = 745.7, 1800 * math.pi / 30
    tangential = power / speed / radius / 4.4482  # lbf
    assert tangential == pytest.approx(40.4, abs=0.05)
    assert tangential * math.tan(angle) == pytest.approx(17.0, abs=0.05)
    thrust = tangential * math.tan(pair.base_helix_angle) / math.cos(angle)
    assert thrust == pytest.approx(23.3, abs=0.05)
    wheel = WheelForce(13.0, complex(-tangential * math.tan(angle), tangential), -thrust, radius / 0.0254)
    a, b = bearing_reactions([wheel], 0.0, 10.0)
    assert (-a.real, a.imag, b.real, -b.imag) == pytest.approx((3.1, 12.1, 20.1, 52.5), abs=0.1)  # from rounded forces


class TestPositions:
    def test_a_spur_pinion_between_its_bearings(self, tmp_path: Path) -> None:
        """T/r_b divides as the lever: 5/8 on the bearing at 30 mm, 3/8 on that at 50 mm."""
        found = loads(tmp_path, stage({"preset": "fzg_c"}, None, left=LEFT, right=RIGHT))
        force = 1.0 / gearbox(tmp_path, STAGE).stages[0].pair.base_radius[0]
        assert found["left"] == pytest.approx((force * 5 / 8, 0.0))
        assert found["right"] == pytest.approx((force * 3 / 8, 0.0))

    @pytest.mark.parametrize(("thrust", "sign"), [("positive", 1.0), ("negative", -1.0)])
    def test_thrust_tilts_a_helical_pinion(self, tmp_path: Path, thrust: str, sign: float) -> None:
        """By hand: tangential part by the lever, radial part with the moment of the thrust at the pitch radius."""
        found = loads(tmp_path, stage(thrust=thrust, left=LEFT, right=RIGHT))
        pitch, normal = 23 * 2e-3 / (2 * math.cos(math.radians(28))), math.radians(20)
        tangential = 1.0 / pitch
        radial = tangential * math.tan(normal) / math.cos(math.radians(28))
        axial = tangential * math.tan(math.radians(28))
        right = math.hypot(tangential * 0.030 / 0.080, (radial * 0.030 + sign * axial * pitch) / 0.080)
        left = math.hypot(tangential * 0.050 / 0.080, (radial * 0.050 - sign * axial * pitch) / 0.080)
        assert found["left"] == pytest.approx((left, axial))
        assert found["right"] == pytest.approx((right, 0.0))

    def test_a_bearing_for_thrust_alone_needs_no_position(self, tmp_path: Path) -> None:
        alone = {"left": LEFT | {"axial": "loose"}, "right": RIGHT, "middle": SEAT | {"axial": "positive"}}
        found = loads(tmp_path, stage(**alone))
        assert found["middle"][0] == 0.0
        assert found["middle"][1] == pytest.approx(loads(tmp_path, stage(left=LEFT, right=RIGHT))["left"][1])
        assert found["left"][1] == 0.0

    def test_two_wheels_of_a_shared_shaft(self, tmp_path: Path) -> None:
        """Equal wheels in one plane, mates opposite: tangential forces cancel in torque and add in the plane."""
        spur = {"teeth": [30, 30], "normal_module_mm": 2.0, "face_width_mm": 20.0}
        middle = {"left": LEFT | {"shaft": "gear"}, "right": RIGHT | {"shaft": "gear"}}
        for angle, factor in ((180.0, 2.0), (0.0, 2.0 * math.tan(math.radians(20)))):
            second = stage(spur, None) | {"shared_shaft": {"distance_mm": 0.0, "angle_deg": angle}}
            found = loads(tmp_path, stage(spur, None, **middle), second)
            assert found["left"][0] == pytest.approx(factor / 0.030 * 5 / 8)

    def test_thrusts_of_equal_wheels_cancel(self, tmp_path: Path) -> None:
        equal = HELICAL | {"teeth": [40, 40]}
        middle = {"left": SEAT | {"shaft": "gear", "position_mm": -30.0}, "right": RIGHT | {"shaft": "gear"}}
        second = stage(equal, "positive") | {"shared_shaft": {"distance_mm": 40.0}}
        assert all(axial == 0.0 for _, axial in loads(tmp_path, stage(equal, "positive", **middle), second).values())
        with pytest.raises(InputError, match="no bearing takes the axial force"):
            loads(tmp_path, stage(equal, "positive", **middle), second | {"pinion_thrust": "negative"})

    def test_loads_of_the_shaft_do_not_depend_on_the_stage_that_lists_its_bearings(self, tmp_path: Path) -> None:
        first, second = stage(), stage() | {"shared_shaft": {"distance_mm": 40.0, "angle_deg": 120.0}}
        left = LEFT | {"shaft": "gear"}
        here = loads(
            tmp_path, first | {"bearings": {"a": left, "b": left | {"position_mm": 70.0, "axial": "loose"}}}, second
        )
        after = {"b": LEFT | {"position_mm": 30.0, "axial": "loose"}}
        there = loads(tmp_path, first | {"bearings": {"a": left}}, second | {"bearings": after})
        ratio = 67 / 23
        assert there["a"] == pytest.approx(here["a"])
        assert there["b"] == pytest.approx(tuple(load / ratio for load in here["b"]))


REFUSED = {
    "a helical stage whose thrust nobody carries": ({"a": SEAT, "b": SEAT}, "no bearing carries the axial force"),
    "shares above 1": ({"a": SEAT | {"radial_share": 5.0}}, "radial_share adds up to 5, not to 1"),
    "axial shares above 1": (
        {"a": SEAT | {"axial_share": 1.0}, "b": SEAT | {"axial_share": 2.0}},
        "axial_share adds up to 3, not to 1",
    ),
    "one bearing with half the force": ({"a": SEAT | {"axial_share": 1.0}}, "radial_share adds up to 0.5"),
    "no fixed bearing": ({"a": LEFT | {"axial": "loose"}, "b": RIGHT}, "no bearing takes the axial force"),
    "thrust to the other side": ({"a": LEFT | {"axial": "negative"}, "b": RIGHT}, "no bearing takes .* positive side"),
    "two fixed bearings": ({"a": LEFT, "b": RIGHT | {"axial": "fixed"}}, "2 bearings take the axial force"),
    "one position": ({"a": LEFT}, "two bearings at different positions, not 1"),
    "three positions": ({"a": LEFT, "b": RIGHT, "c": RIGHT | {"position_mm": 80.0}}, "not 3 at"),
    "one place": ({"a": LEFT, "b": RIGHT | {"position_mm": -30.0}}, "different positions"),
    "a position and a share": ({"a": LEFT | {"radial_share": 0.5}, "b": RIGHT}, "a.radial_share.*leave it out"),
    "several at one place": ({"a": LEFT | {"count": 2}, "b": RIGHT}, "a.count.*one by one"),
    "a bearing without a place": ({"a": LEFT, "b": RIGHT, "c": SEAT}, "c: needs position_mm"),
    "a kind of seat without positions": (
        {"a": SEAT | {"axial": "fixed", "axial_share": 1.0}, "b": SEAT},
        "a.axial.*acts only with position_mm",
    ),
}


class TestRefusals:
    @pytest.mark.parametrize("name", REFUSED)
    def test_a_force_is_carried_once(self, tmp_path: Path, name: str) -> None:
        bearings, rule = REFUSED[name]
        with pytest.raises(InputError, match=rule):
            loads(tmp_path, stage(**bearings))

    def test_positions_need_the_direction_of_the_thrust(self, tmp_path: Path) -> None:
        with pytest.raises(InputError, match=r"stages\.a\.pinion_thrust"):
            loads(tmp_path, stage(thrust=None, left=LEFT, right=RIGHT))

    def test_the_second_wheel_of_a_shaft_is_carried_too(self, tmp_path: Path) -> None:
        halves = {"both": SEAT | {"shaft": "gear", "count": 2, "axial_share": 0.5}}
        with pytest.raises(InputError, match="no bearing carries the force on the pinion of stage 'b'"):
            loads(tmp_path, stage(**halves), stage())
        with pytest.raises(InputError, match="every bearing of a shared shaft needs position_mm"):
            loads(tmp_path, stage(**halves), stage() | {"shared_shaft": {"distance_mm": 40.0}})
        with pytest.raises(InputError, match="no stage before it"):
            loads(tmp_path, stage() | {"shared_shaft": {"distance_mm": 40.0}})

    def test_shafts_without_bearings_are_said(self, tmp_path: Path) -> None:
        _, notes = read_gearbox(written(tmp_path, gearbox_file(stage(left=LEFT, right=RIGHT))))
        assert ["a.gear" in one.text for one in notes if one.code == "shaft_without_bearings"] == [True]


class TestFindings:
    def codes(self, folder: Path, bearing: dict[str, Any], torque: list[float]) -> list[str]:
        file = gearbox_file(stage({"preset": "fzg_c"}, None, a=bearing | {"count": 2}))
        file["conditions"]["torque_Nm"] = torque
        return [one.code for one in read_gearbox(written(folder, file))[1] if one.code != "shaft_without_bearings"]

    @pytest.mark.parametrize(("rating", "doubted"), [(15.3, 1), (15300.0, 0), (15.3e6, 1), (3000.0, 0), (200e3, 0)])
    def test_a_rating_in_another_unit_is_doubted(self, tmp_path: Path, rating: float, doubted: int) -> None:
        found = self.codes(tmp_path, SEAT | {"static_rating_N": rating}, [50.0])
        assert found.count("static_rating_implausible") == doubted

    def test_bearings_that_lose_nothing_at_zero_torque_are_said(self, tmp_path: Path) -> None:
        palmgren = {name: SEAT[name] for name in ("shaft", "bore_mm", "outside_diameter_mm")}
        palmgren |= {"law": "palmgren", "series": "deep_groove"}
        code = "bearing_free_without_load"
        assert code in self.codes(tmp_path, SEAT, [0.0, 50.0])
        for bearing, torque in ((SEAT, [50.0]), (SEAT | {"radial_load_N": 20.0}, [0.0, 50.0]), (palmgren, [0.0, 50.0])):
            assert code not in self.codes(tmp_path, bearing, torque)

    @pytest.mark.parametrize(
        ("keys", "told"),
        [
            ({"series": "tapered_roller"}, True),
            ({"series": "angular_contact"}, True),
            ({"series": "tapered_roller", "axial_load_N": 300.0}, False),
            ({"series": "deep_groove"}, False),
            ({"series": "four_point_contact"}, False),
        ],
    )
    def test_thrust_induced_by_a_contact_angle_is_said(self, tmp_path: Path, keys: dict[str, Any], told: bool) -> None:
        palmgren = {name: SEAT[name] for name in ("shaft", "bore_mm", "outside_diameter_mm")} | {"law": "palmgren"}
        assert ("induced_thrust_left_out" in self.codes(tmp_path, palmgren | keys, [50.0])) == told


def test_thrust_of_a_fast_helical_stage_is_lost_in_its_fixed_bearing(tmp_path: Path) -> None:
    """28 degrees, 300 N m, 16,000 rpm: the bearings lose much more than radial forces alone would make them lose."""
    at = np.array([300.0]), np.array([16_000 * math.pi / 30])
    free = gearbox(tmp_path, stage(a=SEAT | {"axial_share": 1.0}, b=SEAT)).losses(*at).by_origin
    spur = HELICAL | {"helix_angle_deg": 0.0}
    without = gearbox(tmp_path, stage(spur, None, a=SEAT, b=SEAT)).losses(*at).by_origin
    assert free["a", "bearings", "b"] == pytest.approx(without["a", "bearings", "b"], rel=0.25)
    assert free["a", "bearings", "a"] > 1.5 * free["a", "bearings", "b"]


def test_loads_of_every_bearing_balance_the_mesh() -> None:
    """Whatever the positions, both transverse reactions add up to the force on the wheel."""
    rng = np.random.default_rng(5)
    for _ in range(20):
        z, x, y, thrust, r, first, second = rng.normal(size=7)
        wheel = WheelForce(z, complex(x, y), thrust, complex(r, 0.3))
        a, b = bearing_reactions([wheel], first, second)
        assert a + b == pytest.approx(-wheel.transverse)
        moments = (z - 0.2) * wheel.transverse - wheel.arm * thrust + (first - 0.2) * a + (second - 0.2) * b
        assert abs(moments) < 1e-9 * (1.0 + abs(a) + abs(b))


@pytest.mark.parametrize(("position_mm", "doubted"), [(50.0, False), (600.0, False), (3000.0, True), (-3000.0, True)])
def test_a_bearing_metres_from_its_gear_is_doubted(tmp_path: Path, position_mm: float, doubted: bool) -> None:
    """The centre distance of the gears is 102 mm."""
    right = RIGHT | {"position_mm": position_mm}
    found = read_gearbox(written(tmp_path, gearbox_file(stage(left=LEFT, right=right))))[1]
    told = [one for one in found if one.code == "value_unusual"]
    assert [one.place for one in told] == ["stages.a.bearings.right.position_mm"] * doubted
    assert all("29 times the centre distance" in one.text for one in told)


def test_a_shared_shaft_of_metres_is_doubted(tmp_path: Path) -> None:
    spur = {"teeth": [30, 30], "normal_module_mm": 2.0, "face_width_mm": 20.0}
    second = stage(spur, None) | {"shared_shaft": {"distance_mm": 4000.0}}
    middle = {"left": LEFT | {"shaft": "gear"}, "right": RIGHT | {"shaft": "gear"}}
    found = read_gearbox(written(tmp_path, gearbox_file(stage(spur, None, **middle), second)))[1]
    assert [one.place for one in found if one.code == "value_unusual"] == ["stages.b.shared_shaft.distance_mm"]
