"""Planets: assembly, clearance, pin forces, and stages of planets in a gearbox."""

from __future__ import annotations

import math
import time
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

from mixedlub.efficiency import read_gearbox
from mixedlub.efficiency.gearbox import EXCEEDED, MESH
from mixedlub.efficiency.mesh_cycle import mesh_cycles
from mixedlub.efficiency.planetary import PlanetaryModel
from mixedlub.efficiency.planetary_table import planetary_tables
from mixedlub.efficiency.planets import PlanetSet
from mixedlub.efficiency.table import breakdown_table, map_table, stage_table
from mixedlub.efficiency.train import CARRIER, Coupling, PlanetaryTrain
from mixedlub.gear import GearPair
from mixedlub.schema.toml_file import to_toml
from mixedlub.study import read_study, run_study
from profiles.errors import InputError
from tests.efficiency.gearboxes import SMOOTH, STAGE, written
from tests.efficiency.planetary import NEEDLE, SIMPLE, mesh, planetary_box

ALPHA = math.radians(20)


def _set(train: PlanetaryTrain, count: int, modules: tuple[float, ...] | None = None) -> PlanetSet:
    sizes = modules or (2e-3,) * len(train.couplings)
    pairs = {
        one.name: GearPair(one.teeth, size, ALPHA, 20e-3) for one, size in zip(train.couplings, sizes, strict=True)
    }
    return PlanetSet(train, pairs, count)


def _train(*teeth: tuple[int, int]) -> PlanetaryTrain:
    wheels = ("sun", "planet"), ("planet", "ring")
    couplings = tuple(Coupling(f"m{i}", w, t) for i, (w, t) in enumerate(zip(wheels, teeth, strict=True)))
    return PlanetaryTrain(couplings, ("planet",), "sun", CARRIER, "ring")


class TestAssembly:
    @pytest.mark.parametrize(("sun", "ring"), [(18, 72), (30, 78), (27, 93), (20, 70)])
    def test_simple_trains_need_a_whole_sum_over_the_planets(self, sun: int, ring: int) -> None:
        planet = (ring - sun) // 2
        one = _set(_train((sun, planet), (planet, -ring)), 3)
        assert [one.can_be_assembled(n) for n in range(1, 13)] == [(sun + ring) % n == 0 for n in range(1, 13)]

    @pytest.mark.parametrize("teeth", [(30, 42, 24, 96), (18, 27, 21, 66), (25, 35, 20, 80)])
    def test_stepped_planets_by_the_greatest_common_divisor(self, teeth: tuple[int, int, int, int]) -> None:
        """(z_s z_p2 + z_r z_p1)/(n gcd(z_p1, z_p2)) is whole."""
        sun, first, second, ring = teeth
        one = _set(_train((sun, first), (second, -ring)), 3)
        total = sun * second + ring * first
        expected = [total % (n * math.gcd(first, second)) == 0 for n in range(1, 10)]
        assert [one.can_be_assembled(n) for n in range(1, 10)] == expected

    def test_planets_in_mesh_need_a_whole_difference(self) -> None:
        couplings = (
            Coupling("a", ("sun", "near"), (30, 20)),
            Coupling("b", ("near", "far"), (20, 22)),
            Coupling("c", ("far", "ring"), (22, -90)),
        )
        one = _set(PlanetaryTrain(couplings, ("near", "far"), "sun", CARRIER, "ring"), 3)
        assert [n for n in range(1, 9) if one.can_be_assembled(n)] == [n for n in range(1, 9) if (90 - 30) % n == 0]

    def test_the_message_has_the_sum(self) -> None:
        with pytest.raises(InputError, match=r"\(18 \+ 72\)/4 = 22.5 is not whole; 1, 2, 3, 5, 6, .* can"):
            _set(_train((18, 27), (27, -72)), 4).check(0.0)

    def test_planets_that_collide(self) -> None:
        """Centres 45 mm from the axis, tips of 58 mm: 2 45 sin(180/5) = 52.9 mm lie between five planets."""
        overlap = 58.0 - 90.0 * math.sin(math.pi / 5)
        with pytest.raises(InputError, match=rf"overlap by {overlap:.4g} mm"):
            _set(_train((18, 27), (27, -72)), 5).check(0.0)
        with pytest.raises(InputError, match=r"only 19\.94 mm between them"):
            _set(_train((18, 27), (27, -72)), 3).check(0.02)

    def test_two_distances_of_one_planet(self) -> None:
        with pytest.raises(
            InputError, match=r"m0 needs 45 mm and the mesh m1 44 mm|m1 needs 44 mm and the mesh m0 45 mm"
        ):
            _set(_train((18, 27), (27, -71)), 1).check(0.0)


class TestPins:
    @pytest.mark.parametrize(
        ("train", "modules"),
        [(_train((18, 27), (27, -72)), (2e-3, 2e-3)), (_train((30, 42), (24, -96)), (2.5e-3, 2.5e-3))],
    )
    def test_tangential_forces_on_the_pins_are_the_torque_of_the_carrier(self, train: Any, modules: Any) -> None:
        planets = _set(train, 3, modules)
        flow = train.flow(np.array([90.0]), np.ones((2, 1)))
        pin = planets.pin_forces(flow.force / 3, np.zeros(1), {"planet": 0.0})["planet"]
        place = planets.places["planet"]
        assert 3 * (np.conj(place) * pin).imag == pytest.approx(-flow.torque[CARRIER], rel=1e-12)

    def test_planets_in_mesh_carry_the_carrier_together(self) -> None:
        couplings = (
            Coupling("a", ("sun", "near"), (30, 20)),
            Coupling("b", ("near", "far"), (20, 22)),
            Coupling("c", ("far", "ring"), (22, -90)),
        )
        train = PlanetaryTrain(couplings, ("near", "far"), "sun", CARRIER, "ring")
        planets = _set(train, 3)
        flow = train.flow(np.array([90.0]), np.ones((3, 1)))
        pins = planets.pin_forces(flow.force / 3, np.zeros(1), {"near": 0.0, "far": 0.0})
        torque = 3 * sum((np.conj(planets.places[p]) * pins[p]).imag for p in pins)
        assert torque == pytest.approx(-flow.torque[CARRIER], rel=1e-9)
        assert abs(planets.places["near"] - planets.places["far"]) == pytest.approx(42e-3, rel=1e-12)

    def test_centrifugal_force_alone(self) -> None:
        planets = _set(_train((18, 27), (27, -72)), 3)
        pin = planets.pin_forces(np.zeros((2, 1)), np.array([200.0]), {"planet": 0.4})["planet"]
        assert pin == pytest.approx(0.4 * 45e-3 * 200.0**2, rel=1e-12)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("planetary")


def _stage(folder: Path, **changed: Any) -> PlanetaryModel:
    stage = planetary_box(folder, {**SIMPLE, **changed}).stages[0]
    assert isinstance(stage, PlanetaryModel)
    return stage


class TestStage:
    ROLES: ClassVar[list[dict[str, str]]] = [
        {},
        {"input": "carrier", "output": "sun"},
        {"input": "ring", "output": "carrier", "fixed": "sun"},
        {"input": "sun", "output": "ring", "fixed": "carrier", "others": {}},  # type: ignore[dict-item]
    ]

    @pytest.mark.parametrize("roles", ROLES)
    def test_the_output_has_what_the_losses_leave(self, folder: Path, roles: dict[str, str]) -> None:
        stage = _stage(folder, **roles)
        torque, speed = np.array([20.0, 120.0, 200.0]), np.array([300.0, 300.0, 50.0])
        state = stage.state(torque, speed)
        left = -state.flow.torque[stage.driven] * stage.train.speeds[stage.driven] * speed
        drag = sum(v for (_, origin, _), v in state.found.items() if origin == "others")
        assert left - drag == pytest.approx(torque * speed - sum(state.found.values()), rel=1e-9)

    @pytest.mark.parametrize(("index", "speed_rpm"), [(0, 3000.0 * 93 / 120), (1, 3000.0 * 93 / 120 * 27 / 33)])
    def test_each_mesh_loses_what_a_study_of_the_pair_loses_at_the_relative_speed(
        self, folder: Path, index: int, speed_rpm: float
    ) -> None:
        """Sun against planet at 2325 rpm where the sun turns with 3000 rpm, and planet against ring at its speed."""
        stage = _stage(folder)
        state = stage.state(np.array([150.0]), np.array([100.0 * np.pi]))
        pinion = float(abs(state.flow.force[index, 0] * stage.train.teeth[index, 0])) / 3
        study = {
            "schema": "mixedlub-study/1",
            "gears": [one["gears"] for one in SIMPLE["meshes"].values()][index],
            "lubricant": SIMPLE["lubricant"],
            "surfaces": {"a": SMOOTH},
            "pairings": {"pinion": ["a"], "gear": ["a"]},
            "conditions": {"torque_Nm": [pinion], "speed_rpm": [speed_rpm], "oil_temperature_C": [70.0]},
        }
        path = folder / "study.toml"
        path.write_text(to_toml(study), encoding="utf-8")
        found = run_study(read_study(path))["mesh_loss"].ravel()[0]
        assert state.sliding[index, 0] == pytest.approx(3 * found, rel=1e-4)

    def test_uneven_planets_lose_the_sum_of_theirs(self, folder: Path) -> None:
        even, uneven = _stage(folder), _stage(folder, planet_loads=[1.5, 0.75, 0.75])
        at = np.array([150.0]), np.array([300.0])
        pins = [one.state(*at).pin["planet"].max() for one in (even, uneven)]
        assert pins[1] / pins[0] == pytest.approx(1.5, rel=0.02)
        parts = [one.state(*at) for one in (even, uneven)]
        assert parts[1].rolled == pytest.approx(parts[0].rolled, rel=1e-3)
        lone = _stage(folder, planet_count=1, planets={"planet": {"mass_kg": 0.5}})
        each = [lone.state(at[0] * load / 3, at[1]).sliding[0, 0] for load in (1.5, 0.75, 0.75)]
        assert parts[1].sliding[0, 0] == pytest.approx(sum(each), rel=1e-3)

    def test_planet_bearings_feel_mesh_and_centrifugal_force(self, folder: Path) -> None:
        stage = _stage(folder)
        speed = np.array([400.0])
        state = stage.state(np.array([90.0]), speed)
        carrier = stage.train.speeds[CARRIER] * speed[0]
        out = 0.5 * 60e-3 * carrier**2
        around = 2 * 90.0 / 3 / 27e-3
        assert state.pin["planet"][0, 0] == pytest.approx(math.hypot(around, out), rel=5e-3)
        turning = abs(stage.train.speeds["planet"] - stage.train.speeds[CARRIER]) * speed
        (part,) = stage.planet_parts["planet"]
        expected = 3 * part.at(turning, stage.oil, state.pin["planet"][0])
        assert state.found["a", "bearings", "planet.needle"] == pytest.approx(expected, rel=1e-12)

    def test_drag_of_the_carrier_is_its_torque_times_its_speed(self, folder: Path) -> None:
        stage = _stage(folder)
        lost = stage.state(np.array([90.0]), np.array([400.0])).found["a", "others", "drag"]
        assert lost == pytest.approx(0.2 * 400.0 * 27 / 120, rel=1e-12)

    def test_a_train_with_much_circulating_power_is_said_to_lock(self, folder: Path) -> None:
        stage = {
            **SIMPLE,
            "input": "a",
            "output": "carrier",
            "fixed": "b",
            "planet_count": 1,
            "meshes": {
                "first": mesh("a", "planet", teeth=(50, 49), normal_module_mm=1.0),
                "second": mesh("planet", "b", teeth=(50, 51), normal_module_mm=0.98, centre_distance_mm=49.5),
            },
            "others": {},
        }
        box = planetary_box(folder, stage)
        losses = box.losses(np.array([5.0]), np.array([0.05]))
        assert np.isnan(losses.efficiency()[0])
        assert "self_locking" in losses.validity[0]
        assert EXCEEDED in losses.validity[0]
        assert [one.code for one in losses.findings if one.code == "self_locking"]


class TestGearbox:
    def test_tables(self, folder: Path) -> None:
        box = planetary_box(folder, SIMPLE, {**SIMPLE, "planet_count": 4})
        losses, at = box.map(), box.at_cycle()
        table = map_table(losses)
        power = table["output_torque_Nm"] * table["output_speed_rpm"] * np.pi / 30
        assert power.to_numpy() == pytest.approx(table["output_power_W"].to_numpy(), rel=1e-9)
        assert box.ratio == pytest.approx((120 / 27) ** 2)
        made = planetary_tables(at)
        members = made["members"]
        assert members.groupby("stage")["torque_Nm"].sum().abs().max() < 1e-9 * members["torque_Nm"].abs().max()
        drives = made["rolling"]["driving"].tolist()
        assert drives == ["sun", "planet", "sun", "planet"]
        assert made["rolling"]["rolling_over_input"].to_numpy()[0] == pytest.approx(93 / 120, rel=1e-9)
        assert stage_table(at)["driving"].tolist() == ["sun", "sun"]
        assert breakdown_table(at)["law"].iloc[0] == "tallian_mixture"

    def test_the_cycle_of_a_mesh_has_its_mean_loss(self, folder: Path) -> None:
        box = planetary_box(folder, {**SIMPLE, "planets": {"planet": {"mass_kg": 0.0}}})
        at = box.at_cycle()
        cycles = mesh_cycles(box, at)
        assert [one.stage.name for one in cycles] == ["a.inner", "a.outer"]
        for one in cycles:
            origin = "a", "sliding", one.stage.name.partition(".")[2]
            assert 3 * one.sliding.mean() == pytest.approx(at.by_origin[origin][0], rel=0.01)

    def test_finishes_of_sun_planet_and_ring_are_tried_together(self, folder: Path) -> None:
        """Four combinations: a finish of the planet acts in both of its meshes, a finish of the ring in one."""
        rough = {"m0_um2": 0.04, "m2": 0.0015, "m4_per_um2": 0.0012}
        tried = {"pairings": {"planet": ["fine", "rough"], "ring": ["fine", "rough"]}}
        stage = {**SIMPLE, **tried, "finishes": {"fine": SMOOTH, "rough": rough}}
        box = planetary_box(folder, stage)
        table = planetary_tables(box.at_cycle())["pairings"].set_index("finishes")
        assert len(table) == 4
        assert table["stage_loss_W"].is_monotonic_increasing
        plain = box.stages[0].losses(np.array([200.0]), np.array([100.0 * np.pi]))[0]
        lost = sum(value[0] for value in plain.values())
        assert table["stage_loss_W"]["planet fine, ring fine"] == pytest.approx(lost, rel=1e-9)
        inner = table["inner_loss_W"]
        assert inner["planet rough, ring fine"] > inner["planet fine, ring fine"]
        assert inner["planet fine, ring rough"] == pytest.approx(inner["planet fine, ring fine"], rel=1e-3)

    def test_stages_of_both_kinds_need_their_order(self, folder: Path) -> None:
        file = {
            "schema": "mixedlub-efficiency/1",
            "conditions": {"torque_Nm": [50.0], "speed_rpm": [500.0]},
            "stages": {"pair": STAGE},
            "planetary": {"set": SIMPLE},
        }
        with pytest.raises(InputError, match="order is needed"):
            read_gearbox(written(folder, file))
        box = read_gearbox(written(folder, {"order": ["set", "pair"], **file}))[0]
        assert [stage.name for stage in box.stages] == ["set", "pair"]
        assert box.ratio == pytest.approx(120 / 27 * 24 / 16)
        losses = box.map()
        assert losses.efficiency(MESH)[0] < 1.0

    def test_a_map_of_two_stages_takes_less_than_ten_seconds(self, folder: Path) -> None:
        conditions = {
            "torque_Nm": np.linspace(0.0, 200.0, 50).tolist(),
            "speed_rpm": np.linspace(500.0, 5000.0, 50).tolist(),
        }
        box = planetary_box(folder, SIMPLE, {**SIMPLE, "planet_loads": [1.2, 0.9, 0.9]}, conditions=conditions)
        start = time.process_time()
        losses = box.map()
        assert losses.torque.size == 2500
        assert time.process_time() - start < 10.0

    @pytest.mark.parametrize(
        ("change", "rule"),
        [
            ({"fixed": "rink"}, "no member; nearest"),
            ({"fixed": "sun"}, "three members"),
            ({"pairings": {"sun": ["fine"]}}, "has no table finishes.NAME"),
            ({"pairings": {"son": []}}, "no such wheel; nearest"),
            ({"planet_count": 7}, r"\(27 \+ 93\)/7 = 17.1429 is not whole"),
            ({"planet_count": 6}, "overlap by"),
            ({"planet_loads": [1.0, 1.0]}, "planet_loads needs 3 entries, not 2"),
            ({"planet_loads": [1.5, 1.0, 1.0]}, "mean 1, not 1.167"),
            ({"planets": {"plant": {"mass_kg": 0.1}}}, "must have a table planets.NAME"),
            ({"others": {"x": {"law": "own_torque", "shaft": "ring"}}}, "stands still and loses nothing"),
            ({"meshes": {"inner": SIMPLE["meshes"]["inner"]}, "fixed": "carrier", "output": "sun"}, "three members"),
            (
                {"meshes": {**SIMPLE["meshes"], "outer": mesh("planet", "ring", teeth=(33, 93))}},
                "inner needs 60 mm and the mesh outer 126 mm",
            ),
            (
                {
                    "meshes": {
                        "inner": mesh("sun", "planet", teeth=(27, 33), profile_shift=[0.3, -0.3]),
                        "outer": mesh("planet", "ring", teeth=(33, -93), profile_shift=[0.3, -0.3]),
                    }
                },
                "planet is one wheel, but has profile_shift -0.3 in the mesh inner and 0.3 in the mesh outer",
            ),
            (
                {
                    "meshes": {
                        "inner": mesh("sun", "planet", teeth=(27, 33), tip_diameter_mm=[58.0, 70.0]),
                        "outer": mesh("planet", "ring", teeth=(33, -93), tip_diameter_mm=[69.8, 183.0]),
                    }
                },
                "planet is one wheel, but has tip_diameter_mm 70 in the mesh inner and 69.8 in the mesh outer",
            ),
            (
                {"planets": {"planet": {"mass_kg": 0.1, "bearings": {"n": {**NEEDLE, "shaft": "sun"}}}}},
                "key is not known",
            ),
        ],
    )
    def test_what_cannot_be_is_refused(self, folder: Path, change: dict[str, Any], rule: str) -> None:
        with pytest.raises(InputError, match=rule):
            planetary_box(folder, {**SIMPLE, **change})
