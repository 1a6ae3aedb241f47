"""Losses and efficiencies of gear stages: balances, limits, and the same numbers by two ways."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

import mixedlub as ml
from mixedlub.chain.ranges import GRADES, VALID
from mixedlub.efficiency import Gearbox, Losses, read_gearbox
from mixedlub.efficiency.gearbox import EXCEEDED, MESH
from mixedlub.efficiency.mesh_cycle import mesh_cycle, mesh_cycles
from mixedlub.efficiency.meshes import MOST_SOLVED, load_shares
from mixedlub.efficiency.table import breakdown_table, duty_summary, duty_table, loss_map, map_table, part_table
from mixedlub.study import read_study, run_study
from tests.efficiency.gearboxes import AFTER, PARTS, STAGE, gearbox, gearbox_file, written

SECOND = STAGE | {"gears": {"preset": "h501"}, "lubricant": {"oil": "pao40"}, "oil_temperature_C": 60.0}
ELASTIC = {"preset": "fzg_c", "load_sharing": {"model": "ldp", "tip_relief_um": [20, 20], "relief_length_mm": [2, 2]}}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("gearboxes")


@pytest.fixture(scope="module")
def box(folder: Path) -> Gearbox:
    return gearbox(folder, STAGE | PARTS)


@pytest.fixture(scope="module")
def two(folder: Path) -> Gearbox:
    return gearbox(folder, STAGE | PARTS, SECOND | AFTER)


@pytest.fixture(scope="module")
def losses(two: Gearbox) -> Losses:
    return two.map()


class TestBalance:
    def test_parts_add_up_to_the_total(self, losses: Losses) -> None:
        table = part_table(losses)
        parts = table.drop(columns=["torque_Nm", "speed_rpm", "total_loss_W"]).sum(axis=1)
        assert parts.to_numpy() == pytest.approx(table["total_loss_W"].to_numpy(), rel=1e-9)

    def test_origins_add_up_to_what_the_output_lacks(self, losses: Losses) -> None:
        table = map_table(losses)
        origins = [name for name in table if name.endswith("_loss_W") and name != "total_loss_W"]
        assert {"sliding_loss_W", "rolling_loss_W", "bearings_loss_W", "jets_loss_W", "others_loss_W"} <= set(origins)
        lacking = table["input_power_W"] - table["output_power_W"]
        assert table[origins].sum(axis=1).to_numpy() == pytest.approx(lacking.to_numpy(), rel=1e-9)
        power = table["output_torque_Nm"] * table["output_speed_rpm"] * np.pi / 30
        assert power.to_numpy() == pytest.approx(table["output_power_W"].to_numpy(), rel=1e-9)

    def test_the_breakdown_adds_up(self, two: Gearbox) -> None:
        table = breakdown_table(two.at_cycle())
        assert table["loss_W"].iloc[:-1].sum() == pytest.approx(table["loss_W"].iloc[-1], rel=1e-9)
        assert table["share_percent"].iloc[:-1].sum() == pytest.approx(100.0, rel=1e-9)
        assert set(table["stage"]) == {"a", "b", "all"}

    def test_every_part_loses_power(self, losses: Losses) -> None:
        loaded = losses.torque == 200.0
        assert all(np.all(value[loaded] > 0.0) for value in losses.by_origin.values())


class TestHeat:
    """Teeth warm by the loss of each condition: rises of a study with the same mesh."""

    def test_the_losses_are_those_of_a_study_at_every_condition(self, folder: Path) -> None:
        warm = gearbox(folder, STAGE | {"effects": {"bulk_temperature": {}}})
        stage = warm.stages[0]
        at = {"torque_Nm": (20.0, 120.0), "speed_rpm": (100.0, 3000.0)}
        file = stage.study.file
        levels = file.conditions.model_copy(update=at)
        study = read_study(folder / "efficiency.toml", file.model_copy(update={"conditions": levels}))
        wanted = run_study(study)
        torque, speed = (g.ravel() for g in np.meshgrid(at["torque_Nm"], np.array(at["speed_rpm"]) * np.pi / 30.0))
        losses, _ = stage.losses(torque, speed)
        expected = wanted["mesh_loss"][0, 0].T.ravel()
        assert losses["a", "sliding", ""] == pytest.approx(expected, rel=1e-9)
        cold = gearbox(folder, STAGE | {"effects": {}}).stages[0].losses(torque, speed)[0]["a", "sliding", ""]
        assert abs(losses["a", "sliding", ""] / cold - 1.0).max() > 3e-3
        cycle = mesh_cycle(stage, 120.0, speed[-1], 64)
        assert cycle.sliding.mean() == pytest.approx(expected[-1], rel=2e-3)


class TestTorque:
    def test_without_torque_watts_are_there_and_efficiencies_are_empty(self, losses: Losses) -> None:
        table = map_table(losses)
        idle = table[table["torque_Nm"] == 0.0]
        assert np.all(idle["total_loss_W"] > 0.0)
        assert np.all(idle["sliding_loss_W"] == 0.0)
        assert idle[["tooth_efficiency_percent", "gearbox_efficiency_percent"]].isna().all(axis=None)
        assert table[table["torque_Nm"] > 0.0]["gearbox_efficiency_percent"].notna().all()

    def test_losses_without_torque_are_the_limit_of_small_ones(self, box: Gearbox) -> None:
        none, little = (box.losses(np.array([torque, 200.0]), np.full(2, 100.0)).total()[0] for torque in (0.0, 0.25))
        assert none == pytest.approx(little, rel=0.02)

    def test_more_lost_than_taken_in_is_told(self, box: Gearbox) -> None:
        found = box.losses(np.array([0.1]), np.array([300.0]))
        assert EXCEEDED in found.validity[0]
        assert found.output_power[0] < 0.0
        assert np.isnan(found.efficiency()[0])

    def test_tooth_efficiency_is_above_that_of_the_gearbox(self, losses: Losses) -> None:
        loaded = losses.torque > 0.0
        assert np.all(losses.efficiency(MESH)[loaded] > losses.efficiency()[loaded])

    def test_shares_between_solved_torques(self, folder: Path) -> None:
        stage = gearbox(folder, STAGE | {"gears": ELASTIC}).stages[0]
        torque = np.geomspace(5.0, 300.0, MOST_SOLVED + 21)
        between, direct = load_shares(stage.study, torque)(torque), stage.study.mesh.load_share(torque)
        assert between == pytest.approx(direct, abs=2e-3)


class TestValidity:
    ROUGH: ClassVar = {"m0_um2": 0.3, "m2": 0.003, "m4_per_um2": 0.004}

    def test_it_is_that_of_a_study(self, folder: Path) -> None:
        rough = gearbox(folder, STAGE | {"surfaces": {"pinion": self.ROUGH, "gear": self.ROUGH}})
        found = rough.map()
        assert all("asperities_overloaded" in w for w, t in zip(found.validity, found.torque, strict=True) if t > 0.0)

    def test_without_torque_nothing_of_the_contact_is_judged(self, folder: Path) -> None:
        rough = gearbox(folder, STAGE | {"surfaces": {"pinion": self.ROUGH, "gear": self.ROUGH}})
        assert rough.losses(np.array([0.0]), np.array([300.0])).validity == (VALID,)

    def test_of_several_stages_each_word_names_its_stage(self, folder: Path) -> None:
        surfaces = {"pinion": self.ROUGH, "gear": self.ROUGH}
        box = gearbox(folder, STAGE | {"surfaces": surfaces}, SECOND | {"surfaces": surfaces})
        for words in box.map().validity:
            grade, *codes = words.split("; ")
            assert grade in (*GRADES, EXCEEDED)
            assert all(word.startswith(("a:", "b:")) or word == EXCEEDED for word in codes)

    def test_flags_of_asperities_are_left_out_where_friction_does_not_read_them(self, folder: Path) -> None:
        surfaces = {"pinion": self.ROUGH, "gear": self.ROUGH}
        schlenk = gearbox(folder, STAGE | {"surfaces": surfaces, "options": {"friction": "schlenk"}})
        assert set(schlenk.map().validity) == {VALID}

    def test_a_law_of_friction_beyond_its_range_is_flagged(self, folder: Path) -> None:
        options = {"friction": "drozdov_gavrikov"}
        found = gearbox(folder, STAGE | {"options": options}).losses(np.array([400.0]), np.array([900.0]))
        assert "law_extrapolated:drozdov_gavrikov" in found.validity[0]


class TestSeries:
    def test_a_stage_takes_in_what_the_one_before_leaves(self, folder: Path, box: Gearbox, two: Gearbox) -> None:
        torque, speed = np.array([150.0]), np.array([200.0])
        first, both = box.losses(torque, speed), two.losses(torque, speed)
        alone = gearbox(folder, SECOND | AFTER)
        turning = speed / 1.5
        second = alone.losses(first.output_power / turning, turning)
        assert both.total(stage="a") == pytest.approx(first.total(), rel=1e-12)
        assert both.total(stage="b") == pytest.approx(second.total(), rel=1e-12)
        assert both.output_power == pytest.approx(second.output_power, rel=1e-12)

    def test_each_stage_has_its_own_oil(self, folder: Path, two: Gearbox) -> None:
        warmer = gearbox(folder, STAGE | PARTS, SECOND | AFTER | {"oil_temperature_C": 90.0})
        found, other = two.at_cycle(), warmer.at_cycle()
        assert other.total(stage="a") == pytest.approx(found.total(stage="a"), rel=1e-12)
        assert other.total(stage="b", origins=("rolling",)) < 0.8 * found.total(stage="b", origins=("rolling",))

    def test_either_side_drives(self, folder: Path, box: Gearbox) -> None:
        back = gearbox(folder, STAGE | PARTS | {"driving": "gear"})
        given = box.losses(np.array([100.0]), np.array([300.0]))
        found = back.losses(np.array([150.0]), np.array([200.0]))
        assert (back.stages[0].driven, back.ratio) == ("pinion", pytest.approx(1 / 1.5))
        assert found.total() == pytest.approx(given.total(), rel=1e-12)


class TestMeshCycle:
    @pytest.mark.parametrize("gears", [{"preset": "fzg_c"}, ELASTIC], ids=["rigid", "elastic"])
    def test_its_mean_is_the_loss_of_the_map(self, folder: Path, gears: dict[str, object]) -> None:
        box = gearbox(folder, STAGE | {"gears": gears}, cycle={"positions": 400})
        at = box.at_cycle()
        (cycle,) = mesh_cycles(box, at)
        assert cycle.sliding.mean() == pytest.approx(at.total(origins=("sliding",))[0], rel=2e-3)
        assert cycle.rolling.mean() == pytest.approx(at.total(origins=("rolling",))[0], rel=2e-3)
        assert cycle.efficiency.mean() == pytest.approx(at.efficiency(MESH)[0], abs=2e-5)

    @pytest.mark.parametrize("everywhere", [0.0, 1.0])
    def test_it_has_the_force_that_vibration_adds(self, folder: Path, everywhere: float) -> None:
        shaken = {"amplitude": 0.05, "resonance": 900.0, "damping": 0.1, "phase": 0.5, "second": 0.3, "power": 2.0}
        shaken |= {"fade": 0.0, "in_phase": everywhere, "everywhere": everywhere}
        box = gearbox(folder, STAGE | {"effects": {"dynamic_load": shaken}}, cycle={"positions": 400})
        at = box.at_cycle()
        (cycle,) = mesh_cycles(box, at)
        assert cycle.sliding.mean() == pytest.approx(at.total(origins=("sliding",))[0], rel=5e-3)

    def test_of_a_helical_pair_it_has_no_steps(self, folder: Path) -> None:
        """Oblique lines come into contact slice by slice; a spur tooth takes its load at once."""
        steps = {}
        for helix in (0.0, 15.0):
            gears = {"teeth": [20, 30], "normal_module_mm": 3.5, "helix_angle_deg": helix, "face_width_mm": 23.0}
            box = gearbox(folder, STAGE | {"gears": gears})
            at = box.at_cycle()
            (cycle,) = mesh_cycles(box, at)
            assert cycle.sliding.mean() == pytest.approx(at.total(origins=("sliding",))[0], rel=0.02)
            steps[helix] = np.abs(np.diff(cycle.sliding, append=cycle.sliding[0])).max() / cycle.sliding.mean()
        assert steps[15.0] < 0.1 * steps[0.0]

    def test_a_narrow_helix_becomes_a_spur_pair(self, folder: Path) -> None:
        gears = {"teeth": [20, 30], "normal_module_mm": 4.0, "face_width_mm": 14.0}
        spur, helical = (
            mesh_cycle(gearbox(folder, STAGE | {"gears": gears | helix}).stages[0], 100.0, 200.0, 200).sliding
            for helix in ({}, {"helix_angle_deg": 0.01})
        )
        assert helical.mean() == pytest.approx(spur.mean(), rel=1e-3)


class TestForces:
    @pytest.mark.parametrize("helix", [0.0, 15.0])
    def test_normal_forces_of_all_pairs_are_the_force_of_the_torque(self, folder: Path, helix: float) -> None:
        gears = {"teeth": [20, 30], "normal_module_mm": 3.5, "helix_angle_deg": helix, "face_width_mm": 23.0}
        stage = gearbox(folder, STAGE | {"gears": gears}).stages[0]
        positions = 200
        cycle = mesh_cycle(stage, 100.0, 200.0, positions)
        count = -(-cycle.pair.normal_force.size // positions) * positions
        folded = np.zeros(count)
        folded[: cycle.pair.normal_force.size] = cycle.pair.normal_force
        total = folded.reshape(-1, positions).sum(axis=0)
        whole = 100.0 / stage.pair.base_radius[0] / np.cos(stage.pair.base_helix_angle)
        assert total == pytest.approx(np.full(positions, whole), rel=0.02 if helix else 1e-6)

    def test_constant_friction_is_that_of_the_mesh_and_turns_round_at_the_pitch_point(self, folder: Path) -> None:
        law = {"friction": "constant", "friction_coefficients": {"friction": 0.05}}
        stage = gearbox(folder, STAGE | {"options": law}).stages[0]
        cycle = mesh_cycle(stage, 100.0, 200.0, 200)
        assert cycle.friction == pytest.approx(np.full(200, 0.05), rel=1e-9)
        one = cycle.pair
        side = np.sign(one.roll_angle - stage.pair.pitch_point / stage.pair.base_radius[0])
        assert one.friction_force == pytest.approx(0.05 * side * one.normal_force, rel=1e-9)


class TestDuty:
    def test_energies_are_power_times_time(self, box: Gearbox) -> None:
        torque, speed, hours = np.array([200.0, 0.0]), np.array([100.0, 300.0]), np.array([2.0, 10.0])
        found = box.losses(torque, speed)
        row = duty_summary(found, hours).iloc[0]
        lost = found.total()
        assert row["input_energy_kWh"] == pytest.approx(2.0 * 200.0 * 100.0 / 1000.0)
        assert row["loss_energy_kWh"] == pytest.approx((2.0 * lost[0] + 10.0 * lost[1]) / 1000.0)
        mean = 100.0 * (1.0 - row["loss_energy_kWh"] / row["input_energy_kWh"])
        assert row["mean_gearbox_efficiency_percent"] == pytest.approx(mean)
        assert row["mean_gearbox_efficiency_percent"] < 100.0 * found.efficiency()[0]
        origins = [name for name in row.index if name.removesuffix("_energy_kWh") in {o for _, o, _ in found.by_origin}]
        assert row[origins].sum() == pytest.approx(row["loss_energy_kWh"], rel=1e-9)
        assert duty_table(found, hours)["loss_energy_kWh"].sum() == pytest.approx(row["loss_energy_kWh"], rel=1e-9)

    def test_one_point_has_the_efficiency_of_the_map(self, box: Gearbox) -> None:
        found = box.losses(np.array([200.0]), np.array([100.0]))
        row = duty_summary(found, np.array([5.0])).iloc[0]
        assert row["mean_gearbox_efficiency_percent"] == pytest.approx(100.0 * found.efficiency()[0])


def test_the_loss_map_has_torque_lost_at_every_speed_and_torque(losses: Losses) -> None:
    table = loss_map(losses)
    assert len(table) == losses.torque.size
    assert np.all(np.diff(table["input_speed_rpm"]) >= 0.0)
    power = table["torque_loss_Nm"] * table["input_speed_rpm"] * np.pi / 30
    assert power.to_numpy() == pytest.approx(table["power_loss_W"].to_numpy())
    assert np.all(table["torque_loss_Nm"] > 0.0)


def test_python_has_the_numbers_of_the_command(folder: Path) -> None:
    path = written(folder, gearbox_file(STAGE | PARTS))
    found = ml.gearbox_efficiency(path)
    table = map_table(read_gearbox(path)[0].map()).set_index(["torque_Nm", "speed_rpm"])
    here = found.sel(torque_Nm=200.0, speed_rpm=3000.0)
    row = table.iloc[-1]
    for name in ("total_loss_W", "bearings_loss_W", "gearbox_efficiency_percent"):
        assert here[name].item() == pytest.approx(row[name], rel=1e-12)
    assert here["part_loss_W"].sum().item() == pytest.approx(row["total_loss_W"], rel=1e-9)
    assert "a bearings front" in found["part"].values
