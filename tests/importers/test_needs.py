"""What an imported case still needs is listed in full and stands in system.toml as comments that work."""

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.cli import main
from mixedlub.importers import import_files
from mixedlub.importers.missing_inputs import gaps
from mixedlub.schema import system_file, toml_file

TABLES = {
    "gear_pair": "torque_Nm,speed_rpm,oil_temperature_C,pinion_surface,gear_surface,power_loss_W\n"
    "50,500,40,ground,Ra 0.4,17\n100,500,40,ground,ground,30\n",
    "mesh_friction": "torque_Nm,speed_rpm,oil_temperature_C,pinion_surface,gear_surface,roll_angle_deg,"
    "friction_coefficient\n50,500,40,ground,Ra 0.4,20,0.05\n100,500,40,ground,ground,21,0.04\n",
    "disc": "load_N,entrainment_speed_m_s,slide_roll_ratio,oil_temperature_C,surface_1,surface_2,"
    "friction_coefficient\n20,1,0.1,40,ground,Ra 0.4,0.05\n40,1,0.1,40,ground,ground,0.04\n",
}
LINE = {"radius_mm": [20.0, 25.4], "width_mm": 6.0, "youngs_modulus_GPa": [206.0, 206.0], "poisson_ratio": [0.3, 0.3]}
GIVEN = {"gear_pair": {}, "mesh_friction": {}, "disc": {"contact": LINE}}


def imported(tmp_path, kind, **answers):
    path = tmp_path / "table.csv"
    path.write_text(TABLES[kind], encoding="utf-8")
    return import_files([path], tmp_path / "case", kind=kind, **{**GIVEN[kind], **answers})


def uncommented(folder, wanted):
    """The case with those comments that are wanted taken as they stand."""
    path = folder / "system.toml"
    lines = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join(s[2:] if s.startswith("# ") and wanted(s) else s for s in lines) + "\n", encoding="utf-8")


def recorded(system, **columns):
    """The gaps by table of a system and columns."""
    full = toml_file.parse(system_file.System, {"schema": "mixedlub-case/1", **system}, "answers")
    return {gap.table: gap for gap in gaps(full, {name: np.array(values) for name, values in columns.items()})}


@pytest.mark.parametrize("kind", TABLES)
def test_what_is_marked_as_needed_is_enough(tmp_path, kind):
    folder = imported(tmp_path, kind)
    with pytest.raises(ValueError, match="needs the section"):
        read_case(folder)
    uncommented(folder, lambda line: "# needed" in line)
    assert set(read_case(folder).system.surfaces) == {"ground", "Ra 0.4"}


@pytest.mark.parametrize("kind", TABLES)
def test_every_needed_line_is_needed(tmp_path, kind):
    folder = imported(tmp_path, kind)
    text = (folder / "system.toml").read_text(encoding="utf-8")
    needed = [line for line in text.splitlines() if "# needed:" in line]
    for left_out in dict.fromkeys(needed):
        (folder / "system.toml").write_text(text, encoding="utf-8")
        uncommented(folder, lambda line, out=left_out: "# needed" in line and line != out)
        with pytest.raises(ValueError, match=r"missing|needs"):
            read_case(folder)


@pytest.mark.parametrize("kind", TABLES)
def test_every_example_is_valid(tmp_path, kind):
    folder = imported(tmp_path, kind, lubricant={"name": "ours"})
    others = ("instead of", "the same from", "of a map", "a trace", "the lay", "second channel", "of a point contact")
    uncommented(folder, lambda line: not any(words in line for words in others))
    system = read_case(folder).system
    assert system.lubricant.name == "ours"
    assert system.uncertainty.roughness == 0.04
    assert system.recording.noise.absolute == 0.3


def test_the_list_after_an_import_is_complete(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "table.csv").write_text(TABLES["gear_pair"], encoding="utf-8")
    assert main(["import", "table.csv", "--out", "rig", "--set", "kind=gear_pair"]) == 0
    said = capsys.readouterr().out
    needed, rest = said.split("not given")
    assert "rig/system.toml" in needed
    for line in (
        "[gears] with preset; or with teeth, normal_module_mm, face_width_mm",
        '[lubricant] with what is known, if only base = "mineral"; the rest is taken as typical',
        "[surfaces.ground] with Ra_um or Rq_um or Rz_um or profile or traces or map; or with m0_um2, m2, m4_per_um2",
        '[surfaces."Ra 0.4"] with Ra_um or Rq_um or Rz_um or profile',
    ):
        assert f"\n  {line}" in needed
    for key in ("boundary_friction (0.1)", "gears.pressure_angle_deg (20.0)", "lubricant.kinematic_viscosity_mm2_s"):
        assert key in rest
    for key in ("uncertainty.viscosity", "uncertainty.roughness", "recording.noise", "recording.includes"):
        assert key in rest


def test_a_complete_case_needs_nothing(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    folder = imported(tmp_path, "gear_pair")
    uncommented(folder, lambda line: "# needed" in line)
    words = ["import", "table.csv", "--out", "case", "--answers", "case/system.toml", "--overwrite"]
    assert main(words) == 0
    assert "needed before" not in capsys.readouterr().out
    assert "# needed" not in (folder / "system.toml").read_text(encoding="utf-8")
    assert read_case(folder).system.gears.teeth == (17, 26)


def test_a_contact_needs_a_width_unless_it_is_a_point():
    discs = {"kind": "disc", "recording": {"quantity": "friction_coefficient"}}
    columns = {"surface_1": ["a"], "surface_2": ["a"]}
    assert recorded(discs, **columns)["contact"].needed == ("radius_mm", "width_mm")
    ball = {**discs, "contact": {"geometry": "point", "radius_mm": [9.5, 20.0]}}
    assert recorded(ball, **columns)["contact"].needed == ()


@pytest.mark.parametrize(
    ("kind", "quantity", "uncertain"),
    [
        ("viscosity", "viscosity_mPa_s", {"viscosity", "pressure_viscosity"}),
        ("film", "film_thickness_nm", {"viscosity", "pressure_viscosity"}),
        ("friction_history", "friction_coefficient", {"boundary_friction"}),
        ("friction_map", "friction_torque_Nm", set()),
    ],
)
def test_only_what_the_laws_of_the_kind_read_may_be_uncertain(kind, quantity, uncertain):
    found = recorded({"kind": kind, "recording": {"quantity": quantity}}, time_s=[0.0, 1.0])
    assert set(found["uncertainty"].assumed if "uncertainty" in found else ()) == uncertain
    assert ("lubricant" in found) == (kind in ("viscosity", "film"))
    assert ("boundary_friction" in found[""].assumed) == (kind == "friction_history")


def test_noise_in_a_column_of_its_own_is_not_asked_again():
    system = {"kind": "viscosity", "recording": {"quantity": "viscosity_mPa_s"}}
    assert "noise" in recorded(system, viscosity_mPa_s=[1.0])["recording"].assumed
    assert "noise" not in recorded(system, viscosity_mPa_s_sd=[1.0])["recording"].assumed


def test_units_stand_beside_the_examples(tmp_path):
    text = (imported(tmp_path, "gear_pair") / "system.toml").read_text(encoding="utf-8")
    for key, unit in (("normal_module_mm", "mm"), ("pressure_angle_deg", "°"), ("kinematic_viscosity_mm2_s", "mm²/s")):
        (line,) = (line for line in text.splitlines() if line.startswith(f"# {key} = "))
        assert f"({unit})" in line


def test_what_is_derived_is_told_with_its_value(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    folder = imported(tmp_path, "gear_pair")
    uncommented(folder, lambda line: "# needed" in line)
    main(["import", "table.csv", "--out", "case", "--answers", "case/system.toml", "--overwrite"])
    rest = capsys.readouterr().out.split("not given")[1]
    assert "gears.tip_diameter_mm ([80.4333, 118.533], standard addendum)" in rest
    assert "gears.load_sharing (rigid: the pairs in contact share equally)" in rest
    assert "lubricant.kinematic_viscosity_mm2_s ([100, 11.2])" in rest
    assert "uncertainty.viscosity (treated as exact)" in rest


def test_a_viscosity_case_lists_no_property_of_the_oil_that_it_never_reads():
    found = recorded({"kind": "viscosity", "recording": {"quantity": "viscosity_mPa_s"}}, temperature_C=[40.0])
    assert "density_15C_kg_m3" in found["lubricant"].assumed
    assert not {"eyring_stress_MPa", "thermal_conductivity_W_mK", "specific_heat_J_kgK"} & set(
        found["lubricant"].assumed
    )


def test_an_oil_of_which_nothing_is_said_is_fitted_and_not_known():
    columns = {"load_N": [20.0], "entrainment_speed_m_s": [1.0], "slide_roll_ratio": [0.0], "oil_temperature_C": [40.0]}
    ball = {"geometry": "point", "radius_mm": [9.5, 20.0]}
    found = recorded({"kind": "film", "contact": ball, "recording": {"quantity": "film_thickness_nm"}}, **columns)
    assert set(found["uncertainty"].assumed.values()) == {"fitted with a broad prior"}
