"""`mixedlub bevel`: losses, balance of power, what varies, files, and bad input."""

import json
import tomllib
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from mixedlub.cli import main
from mixedlub.friction.schlenk import schlenk
from mixedlub.schema.toml_file import toml_value
from mixedlub.skew_gears import EXAMPLE
from mixedlub.skew_gears.contact_lines import contact_lines, mean_contact
from mixedlub.skew_gears.prepare import read_pair

GIVEN = tomllib.loads(EXAMPLE.read_text(encoding="utf-8"))


FILES = ("map", "geometry", "contact", "mesh_cycle", "vary")


def changed(**tables):
    """The example without [vary], with some tables or keys changed; None takes a key out."""
    given = {name: dict(value) if isinstance(value, dict) else value for name, value in GIVEN.items() if name != "vary"}
    for name, value in tables.items():
        given[name] = {**given.get(name, {}), **value} if isinstance(value, dict) else value
        if isinstance(value, dict):
            given[name] = {key: own for key, own in given[name].items() if own is not None}
    return given


def written(folder, given):
    plain = [f"{name} = {toml_value(value)}" for name, value in given.items() if not isinstance(value, dict)]
    tables = [
        "\n".join([f"[{name}]", *(f"{key} = {toml_value(own)}" for key, own in value.items())])
        for name, value in given.items()
        if isinstance(value, dict)
    ]
    path = folder / "bevel.toml"
    path.write_text("\n".join([*plain, *tables]) + "\n", encoding="utf-8")
    return path


def constant(mu):
    return {"friction": "constant", "friction_coefficients": {"friction": mu}}


def losses(folder, **tables):
    return read_pair(written(folder, changed(**tables)))[0]


def test_power_is_balanced_at_the_wheel(tmp_path):
    """Output power follows from the forces on the wheel, normal and friction, without the loss."""
    pair = losses(tmp_path, options=constant(0.07))
    lines, mu = pair.mesh.lines, 0.07
    found = pair.map()
    contact = lines.contact
    slip = np.einsum("...i,...i->...", contact.sliding, contact.velocity[1]) / contact.sliding_speed
    pinion = lines.over_positions(lines.weight * (lines.drive_speed + mu * lines.pinion_slip))
    wheel = lines.over_positions(lines.weight * (lines.drive_speed + mu * slip))
    assert found["efficiency"] == pytest.approx(np.full(9, (wheel / pinion).mean()), rel=1e-12)
    assert found["mean_friction"] == pytest.approx(np.full(9, mu), rel=1e-12)
    assert found["power_loss"] == pytest.approx(found["input_power"] * (1.0 - found["efficiency"]), rel=1e-12)


def test_a_driving_wheel_loses_more(tmp_path):
    forth = losses(tmp_path, options=constant(0.1)).map()["efficiency"]
    back = losses(tmp_path, driving="gear", options=constant(0.1)).map()["efficiency"]
    assert np.all(back < forth - 1e-3)


def test_no_offset_has_no_sliding_along_the_teeth_at_the_mean_point(tmp_path):
    hypoid = losses(tmp_path, options=constant(0.05)).map()
    bevel = losses(tmp_path, gears={"offset_mm": 0.0}, options=constant(0.05)).map()
    assert np.all(bevel["lengthwise_share"] < 0.2)
    assert np.all(hypoid["lengthwise_share"] > 0.85)
    assert np.all(bevel["efficiency"] > hypoid["efficiency"] + 0.01)


def test_a_finer_grid_changes_the_loss_by_less_than_half_a_percent(tmp_path):
    pair = losses(tmp_path)
    fine = contact_lines(pair.blank, positions=48, points=161)
    found, other = (
        replace(pair.mesh, lines=lines).losses(*(np.array([v]) for v in (150.0, 200.0, 363.15)))
        for lines in (pair.mesh.lines, fine)
    )
    assert found["power_loss"] == pytest.approx(other["power_loss"], rel=5e-3)


@pytest.mark.parametrize("law", ["tallian_mixture", "benedict_kelley", "misharin", "schlenk", "iso_tc60"])
def test_friction_laws_by_name(tmp_path, law):
    found = losses(tmp_path, options={"friction": law}).map()
    assert found["power_loss"] == pytest.approx(
        found["mean_friction"] * found["loss_factor"] * found.torque * found.speed, rel=1e-12
    )
    assert np.all((found["mean_friction"] > 0.01) & (found["mean_friction"] < 0.2))
    assert np.all((found["loss_factor"] > 0.37) & (found["loss_factor"] < 0.47))


def test_a_traction_part_is_said_to_be_unread(tmp_path):
    """Friction is that of the constant Eyring stress of the part."""
    part = {"eyring_stress_MPa": {"value": 7.0}, "eyring_pressure_exponent": {"value": 0.7}}
    part |= {"pressure_GPa": [0.4, 1.2], "temperature_C": [40.0, 100.0], "source": "made up"}
    found, notes = read_pair(written(tmp_path, changed(lubricant={"traction": part})))
    other, none = read_pair(written(tmp_path, changed(lubricant={"eyring_stress_MPa": 7.0})))
    assert [one.text for one in notes if one.code == "traction_unread"] == [
        "bevel gears do not read the traction part of the oil; Eyring stress 7 MPa"
    ]
    assert not [one for one in none if one.code == "traction_unread"]
    assert found.map()["mean_friction"] == pytest.approx(other.map()["mean_friction"], rel=1e-12)


def test_schlenk_reads_the_mean_point(tmp_path):
    """Whole force at the mean point over the mean length of contact lines; speed and curvature of the mean point."""
    pair = losses(tmp_path, options={"friction": "schlenk"})
    found, lines, mean = pair.map(), pair.mesh.lines, mean_contact(pair.blank)
    force = found.torque / abs(float((mean.normal * mean.velocity[0]).sum()))
    line_load = force / lines.over_positions(lines.length).mean()
    viscosity = float(pair.mesh.oil.viscosity(np.array(363.15)))
    ra = 0.4e-6 * np.sqrt(2.0 / np.pi)  # of both flanks, with normal heights of 0.16 um2
    wanted = schlenk(line_load, mean.entrainment[0] * found.speed, mean.radius[0], viscosity, ra, lubricant_factor=1.0)
    assert found["mean_friction"] == pytest.approx(wanted, rel=1e-9)


def test_files_of_the_template(tmp_path, capsys):
    assert main(["new", "bevel", "--out", str(tmp_path / "new")]) == 0
    assert main(["bevel", str(tmp_path / "new" / "bevel.toml"), "--out", str(tmp_path / "out")]) == 0
    shown = capsys.readouterr().out
    assert shown.count("tooth efficiency") == 9
    tables = {name: pd.read_csv(tmp_path / "out" / f"{name}.csv") for name in FILES}
    assert {path.stem for path in (tmp_path / "out" / "figures").iterdir()} == {
        "efficiency",
        "contact",
        "mesh_cycle",
        "vary",
    }
    vary = tables["vary"]
    over_offset = vary[vary["varied"] == "offset_mm"]["tooth_efficiency_percent"].to_numpy()
    assert np.all(np.diff(over_offset) < 0.0)
    over_roughness = vary[vary["varied"] == "roughness_factor"]["tooth_efficiency_percent"].to_numpy()
    assert np.all(np.diff(over_roughness) < 0.0)
    geometry = tables["geometry"].set_index("quantity")
    assert geometry.loc["pitch_angle_deg"].tolist() == pytest.approx([21.288, 68.324], abs=0.02)
    largest = tables["map"].iloc[-1]
    assert tables["mesh_cycle"]["power_loss_W"].mean() == pytest.approx(largest["power_loss_W"], rel=1e-9)
    assert tables["contact"]["hertz_pressure_MPa"].max() == pytest.approx(largest["largest_hertz_pressure_MPa"])
    found = json.loads((tmp_path / "out" / "bevel.json").read_text(encoding="utf-8"))
    assert found["schema"] == "mixedlub-bevel-result/1"
    assert [row["torque_Nm"] for row in found["map"]] == tables["map"]["torque_Nm"].tolist()
    assert found["geometry"][-1]["wheel"] is None
    speeds = tables["contact"]
    both = (speeds["lengthwise_sliding_mm_rad"] ** 2 + speeds["profile_sliding_mm_rad"] ** 2).to_numpy()
    assert np.sqrt(both) == pytest.approx(speeds["sliding_mm_rad"].to_numpy(), rel=1e-9)


def test_values_that_give_no_gears_are_said_in_their_row(tmp_path):
    given = changed() | {"vary": {"offset_mm": [15.0, 95.0]}}
    assert main(["bevel", str(written(tmp_path, given)), "--no-figures", "--out", str(tmp_path / "out")]) == 0
    rows = pd.read_csv(tmp_path / "out" / "vary.csv")
    assert rows["status"][0] == "computed"
    assert "the largest that has them is 75" in rows["status"][1]
    assert np.isnan(rows["tooth_efficiency_percent"][1])


BAD = {
    "offset": ({"gears": {"offset_mm": 95.0}}, "gears.offset_mm", "no pitch cones with this offset"),
    "offset of method 0": ({"gears": {"method": 0}}, "gears", "method 0 is of gears without offset"),
    "undercut": (
        {"gears": {"teeth": [6, 42], "profile_shift": -0.4}},
        "gears.profile_shift",
        "undercut at the inner end",
    ),
    "diameter": ({"gears": {"method": 2}}, "gears", "method 2 needs wheel_mean_diameter_mm"),
    "blades": ({"gears": {"cutting": "face_hobbed"}}, "gears", "face_hobbed teeth need it"),
    "unknown key": ({"gears": {"offset": 15.0}}, "gears.offset", "offset_mm"),
    "teeth": ({"gears": {"teeth": [42, 13]}}, "gears", "no more teeth than the wheel"),
    "parallel": ({"gears": {"shaft_angle_deg": 0.0, "offset_mm": 0.0}}, "gears", "`mixedlub gear` has parallel axes"),
    "law": ({"options": {"friction": "mishrin"}}, "options.friction", "misharin"),
    "option": ({"options": {"path_points": 96}}, "options.path_points", "no meaning for bevel gears"),
    "locked": ({"driving": "gear", "options": constant(0.95)}, "driving", "only below"),
    "torque": ({"conditions": {"torque_Nm": [0.0]}}, "conditions.torque_Nm", "must be from 1e-09"),
    "modulus": (
        {"gears": {"youngs_modulus_GPa": [206e3, 206.0]}},
        "gears.youngs_modulus_GPa",
        "entry 1 must be from 0.1 to 2000 GPa; 206000 MPa would be 206 GPa",
    ),
    "ratio of Poisson": (
        {"gears": {"poisson_ratio": [0.3, 0.5]}},
        "gears.poisson_ratio",
        "entry 2 must be from 0 to 0.4999",
    ),
    "cutter": ({"gears": {"cutter_radius_mm": 2.0}}, "gears", ""),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_one_sentence(tmp_path, capsys, name):
    tables, place, words = BAD[name]
    path = written(tmp_path, changed(**tables))
    assert main(["bevel", str(path), "--no-figures", "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert place in said
    assert words in said
    assert "Traceback" not in said
    assert len(said.strip().splitlines()) == 1
