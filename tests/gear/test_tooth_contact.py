"""What `mixedlub gear` computes, writes and refuses."""

import math

import numpy as np
import pandas as pd
import pytest

import mixedlub as ml
from mixedlub.cli import main
from mixedlub.gear import LdpSharing, RigidSharing, TableSharing, local_loss_factor, mesh
from mixedlub.gear.analysis import MeshConditions, tooth_contact
from mixedlub.gear.analysis.table import line_load_table, load_share_table
from profiles.errors import InputError
from tests.gear.pairs import HELICAL, HONG, relieved

FILE = """
schema = "mixedlub-gear/1"
title = "Gears"
[gears]
teeth = [17, 26]
normal_module_mm = 4.2333333
pressure_angle_deg = 22.5
face_width_mm = 14.0
load_sharing = { model = "ldp", tip_relief_um = [15, 15], relief_length_mm = [2, 2] }
[load]
torque_Nm = [50, 150]
[mesh]
positions = 16
slices = 5
"""


def run(tmp_path, capsys, text=FILE, *options):
    file = tmp_path / "gear.toml"
    file.write_text(text, encoding="utf-8")
    status = main(["gear", str(file), "--out", str(tmp_path / "out"), *options])
    return status, capsys.readouterr()


class TestPassage:
    """One tooth pair on its way through the mesh."""

    @pytest.mark.parametrize("sharing", [LdpSharing(misalignment=8e-6), RigidSharing()], ids=["elastic", "rigid"])
    @pytest.mark.parametrize("pair", [HONG, HELICAL], ids=["spur", "helical"])
    def test_shares_of_neighbours_add_up(self, pair, sharing):
        found = tooth_contact(pair, sharing, np.array([100.0, 900.0]), MeshConditions(positions=32))
        share = np.zeros((2, 32))
        for number in range(found.middle.size):
            share[:, number % 32] += found.load_share[:, number]
        # Rigid lines have their exact length, of which slices are whole or not at all.
        assert share == pytest.approx(1, abs=1e-9 if isinstance(sharing, LdpSharing) else 0.015)

    @pytest.mark.parametrize("pair", [HONG, HELICAL], ids=["spur", "helical"])
    def test_line_loads_are_those_of_the_share(self, pair):
        found = tooth_contact(pair, LdpSharing(), np.array([500.0]), MeshConditions(positions=8))
        table = line_load_table(found)
        per_angle = table.groupby("roll_angle_deg")["line_load_N_mm"].sum() * pair.face_width * 1e3 / found.face.size
        shares = load_share_table(found).set_index("roll_angle_deg")["load_share"]
        assert per_angle.to_numpy() == pytest.approx((shares * found.base_force[0]).to_numpy(), rel=1e-9)

    def test_load_over_the_face_is_the_force_over_the_width(self):
        for sharing in (LdpSharing(lead_crown=5e-6), RigidSharing()):
            found = tooth_contact(HELICAL, sharing, np.array([900.0]))
            assert found.face_load.mean() == pytest.approx(found.base_force[0] / HELICAL.face_width, rel=1e-9)

    def test_loss_factor_of_positions_is_that_of_the_quadrature(self):
        """Tip relief keeps the edges out of contact, so that both ways to the factor see the same loads."""
        sharing = relieved(HONG, 40e-6, 0.3)
        torque, fine = np.array([100.0]), MeshConditions(positions=400, edge_contact=True)
        found = tooth_contact(HONG, sharing, torque, fine)
        assert found.beyond_path == 0
        assert found.loss_factor == pytest.approx(local_loss_factor(mesh(HONG, sharing), torque), rel=1e-3)

    @pytest.mark.parametrize(("pair", "within"), [(HONG, 2e-3), (HELICAL, 0.03)], ids=["spur", "helical"])
    def test_its_load_share_table_is_read_again(self, pair, within):
        """The table of a helical pair spreads the load evenly over its line: the loss factor moves by some percent."""
        table = load_share_table(tooth_contact(pair, LdpSharing(), np.array([900.0])))
        sharing = TableSharing(table["torque_Nm"], np.radians(table["roll_angle_deg"]), table["load_share"])
        read, own = (float(local_loss_factor(mesh(pair, one), 900.0)) for one in (sharing, LdpSharing()))
        assert read == pytest.approx(own, rel=within)

    def test_a_late_pair_carries_less_on_its_whole_way(self):
        torque = np.array([100.0])
        even = tooth_contact(HONG, LdpSharing(), torque)
        late = tooth_contact(HONG, LdpSharing(), torque, MeshConditions(pitch_deviation=(6e-6, 0.0, 0.0)))
        assert late.middle == pytest.approx(even.middle)
        shared = even.load_share < 0.999
        assert np.all(late.load_share[shared] < even.load_share[shared] - 0.05)


class TestCommand:
    def test_it_writes_tables_and_figures(self, tmp_path, capsys):
        status, said = run(tmp_path, capsys)
        assert status == 0
        assert "loss factor" in said.out
        out = tmp_path / "out"
        summary = pd.read_csv(out / "summary.csv")
        assert summary["torque_Nm"].tolist() == [50, 150]
        assert np.all(summary["peak_to_peak_transmission_error_um"] > 0)
        assert list(pd.read_csv(out / "load_share.csv")) == ["torque_Nm", "roll_angle_deg", "load_share"]
        assert len(pd.read_csv(out / "transmission_error.csv")) == 32
        factors = pd.read_csv(out / "loss_factors.csv")
        assert set(factors["loss_factor"]) >= {"ohlendorf", "niemann_winter", "buckingham", "iso_tr_14179_1", "local"}
        drawn = {"load_distribution.svg", "contact_pattern.svg", "loss_factors.svg"}
        assert {path.name for path in (out / "figures").iterdir()} == drawn

    def test_a_study_reads_its_load_share(self, tmp_path, capsys):
        run(tmp_path, capsys, FILE, "--no-figures")
        assert not (tmp_path / "out" / "figures").exists()
        shared = FILE.replace(
            '{ model = "ldp", tip_relief_um = [15, 15], relief_length_mm = [2, 2] }', "{ table = 'out/load_share.csv' }"
        )
        before = pd.read_csv(tmp_path / "out" / "summary.csv")["local_loss_factor"]
        (tmp_path / "gear.toml").write_text(shared, encoding="utf-8")
        assert main(["gear", str(tmp_path / "gear.toml"), "--out", str(tmp_path / "again"), "--no-figures"]) == 0
        after = pd.read_csv(tmp_path / "again" / "summary.csv")["local_loss_factor"]
        assert after.to_numpy() == pytest.approx(before.to_numpy(), rel=0.02)

    @pytest.mark.parametrize(
        ("old", "new", "said"),
        [
            (
                "teeth = [17, 26]",
                "teeth = [10, 26]\ntip_diameter_mm = [50.8, 117.0]",
                "gears.profile_shift: 0.0: undercut",
            ),
            ("teeth = [17, 26]", "teeth = [17, 26]\nprofile_shift = [1.6, 0.0]", "pointed teeth"),
            ("teeth = [17, 26]", "teeth = [6, 60]", "interference"),
            ("teeth = [17, 26]", "teeth = [17, 26]\ntip_diameter_mm = [74.0, 112.0]", "the contact ratio is 0.3974"),
            ("teeth = [17, 26]", "teeth = [17, 26]\ncentre_distance_mm = 89.0", "centre_distance_mm: 89"),
            ("[2, 2]", "[30, 2]", "relief_length_mm: 30"),
            ("slices = 5", "slices = 0", "mesh.slices"),
            ("torque_Nm = [50, 150]", "torque_Nm = [0]", "load.torque_Nm"),
            ("torque_Nm = [50, 150]", "torque_Nm = []", "load.torque_Nm"),
            ("slices = 5", "edge_contacts = true", "nearest known: 'edge_contact'"),
            ("slices = 5", "pitch_deviation_um = [nan]", "mesh.pitch_deviation_um"),
            ("[2, 2] }", '[2, 2], torque_end = ["front", "none"], body_diameter_mm = [0.0, 60] }', "body_diameter_mm"),
            ("[2, 2] }", "[2, 2], bore_diameter_mm = [20, 30] }", "acts only with foundation"),
        ],
    )
    def test_bad_input_is_refused_with_the_number_that_is_wrong(self, tmp_path, capsys, old, new, said):
        assert old in FILE
        status, written = run(tmp_path, capsys, FILE.replace(old, new), "--no-figures")
        assert status == 2
        assert said in written.err
        assert "Traceback" not in written.err
        assert not (tmp_path / "out").exists()

    @pytest.mark.parametrize("key", ["edge_contact = true", "pitch_deviation_um = [0, 5]"])
    def test_rigid_teeth_have_no_deviations(self, tmp_path, capsys, key):
        rigid = FILE.replace(
            '{ model = "ldp", tip_relief_um = [15, 15], relief_length_mm = [2, 2] }', '{ model = "rigid" }'
        )
        status, written = run(tmp_path, capsys, rigid.replace("slices = 5", key))
        assert status == 2
        assert f"mesh.{key.partition(' ')[0]}: acts only with" in written.err

    def test_template_runs(self, tmp_path, capsys):
        assert main(["new", "gear", "--out", str(tmp_path / "new")]) == 0
        out = str(tmp_path / "out")
        assert main(["gear", str(tmp_path / "new" / "gear.toml"), "--out", out, "--no-figures"]) == 0

    def test_format_is_told(self, capsys):
        assert main(["kinds", "gear"]) == 0
        assert "pitch_deviation_um" in capsys.readouterr().out


class TestPython:
    def test_dataset_has_units_in_its_names(self):
        pair = ml.gear_pair(preset="h501", load_sharing={"model": "ldp"})
        found = ml.load_distribution(pair, [100, 300], positions=8, slices=5)
        assert found["transmission_error_um"].sizes == {"torque_Nm": 2, "base_pitches": 8}
        rigid = ml.load_distribution(ml.gear_pair(preset="h501"), 100, positions=8, slices=5)
        assert "transmission_error_um" not in rigid

    def test_gears_are_made_by_gear_pair(self):
        with pytest.raises(InputError, match=r"load_distribution: gears: must be made by ml\.gear_pair"):
            ml.load_distribution({"teeth": [17, 26]}, 100)
        with pytest.raises(InputError, match="torque"):
            ml.load_distribution(ml.gear_pair(preset="fzg_c"), 0.0)


def test_wide_helical_gears_share_between_all_lines():
    found = tooth_contact(HELICAL, LdpSharing(), np.array([9000.0]))
    assert found.load_share.max() < 0.75
    assert math.isclose(found.pattern[0], 1.0)


class TestDedendum:
    """One dedendum of the rack, read by elastic teeth and by the standard's stiffness."""

    def stiffness(self, tmp_path, capsys, text):
        status, said = run(tmp_path, capsys, text, "--no-figures")
        return said.err if status else pd.read_csv(tmp_path / "out" / "summary.csv").iloc[0].to_dict()

    def test_either_table_states_it_for_both(self, tmp_path, capsys):
        in_gears = FILE.replace("face_width", "dedendum = 1.4\nface_width")
        found = [self.stiffness(tmp_path, capsys, text) for text in (in_gears, FILE + "[iso_6336]\ndedendum = 1.4\n")]
        plain = self.stiffness(tmp_path, capsys, FILE)
        assert found[0] == found[1]
        softer = [name for name, value in plain.items() if "stiffness" in name and found[0][name] < 0.95 * value]
        assert len(softer) >= 2

    def test_two_that_differ_are_refused(self, tmp_path, capsys):
        text = FILE.replace("face_width", "dedendum = 1.3\nface_width") + "[iso_6336]\ndedendum = 1.4\n"
        assert "iso_6336.dedendum: 1.4: is not gears.dedendum = 1.3" in self.stiffness(tmp_path, capsys, text)
