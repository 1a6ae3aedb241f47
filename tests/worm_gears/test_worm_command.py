"""`mixedlub worm`: balance of power, self-locking, the user's numbers, bad input, and the law for friction maps."""

import tomllib

import numpy as np
import pandas as pd
import pytest

from mixedlub.cli import main
from mixedlub.effects.back_driving import back_driving
from mixedlub.expressions import parse
from mixedlub.schema.toml_file import toml_value
from mixedlub.worm_gears import EXAMPLE
from mixedlub.worm_gears.drive import read_drive
from mixedlub.worm_gears.mesh_law import mesh_law

GIVEN = tomllib.loads(EXAMPLE.read_text(encoding="utf-8"))
NUMBERS = {
    "law": "iso_tr_14521",
    **{"constant": 0.02, "gain": 0.02, "shift_m_s": 0.2, "exponent": 1.0, "largest": 0.08, "material": 1.1},
    "size": {"reference": 100.0, "exponent": -0.5},
    "geometry": {"reference": 0.07, "exponent": -0.5},
    "roughness": {"reference": 0.5, "exponent": 0.25},
}
FILM = {"film": {"parameter": 0.09, "coefficient": 20.0}, "lubricant": {"oil": "75w90"}}


def written(folder, **tables):
    """The example with some tables changed, in a file; None takes a key out."""
    given = {name: dict(value) if isinstance(value, dict) else value for name, value in GIVEN.items()}
    for name, value in tables.items():
        own = {**given.get(name, {}), **value}
        given[name] = {key: one for key, one in own.items() if one is not None}
    lines = [f"{name} = {toml_value(value)}" for name, value in given.items() if not isinstance(value, dict)]
    for name, value in given.items():
        if isinstance(value, dict):
            lines += [f"[{name}]", *(f"{key} = {toml_value(own)}" for key, own in value.items())]
    file = folder / "worm.toml"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return file


def test_power_is_kept_in_both_directions(tmp_path):
    assert main(["worm", str(written(tmp_path)), "--no-figures", "--out", str(tmp_path / "out")]) == 0
    table = pd.read_csv(tmp_path / "out" / "map.csv")
    found = {name: table[name].to_numpy() for name in table}
    worm = found["worm_speed_rpm"] * np.pi / 30
    output = found["wheel_torque_Nm"] * worm / 20.5
    assert found["worm_drives_torque_Nm"] * worm == pytest.approx(output + found["worm_drives_loss_W"], rel=1e-9)
    assert found["wheel_drives_torque_Nm"] * worm == pytest.approx(output - found["wheel_drives_loss_W"], rel=1e-9)
    assert set(found["state"]) == {"drives both ways"}


def test_self_locking_is_said_with_its_numbers(tmp_path, capsys):
    file = written(tmp_path, gears={"threads": 1}, friction={"law": "constant", "constant": 0.12})
    assert main(["worm", str(file), "--no-figures", "--out", str(tmp_path / "out")]) == 0
    said = " ".join(capsys.readouterr().err.split())
    assert (
        "self-locking at 12 of 12 conditions: the wheel drives only below a friction of 0.104, here up to 0.12" in said
    )
    found = pd.read_csv(tmp_path / "out" / "map.csv")
    assert found["wheel_drives_efficiency_percent"].isna().all()
    assert found["worm_drives_efficiency_percent"].between(40, 50).all()


def test_the_form_of_the_standard_with_own_numbers(tmp_path):
    file = written(tmp_path, friction=NUMBERS, gears={"worm_roughness_Ra_um": 1.0, "pressure_angle_deg": 0.0}, **FILM)
    drive, _ = read_drive(file)
    losses = drive.map()
    factor = 1.1 * 1.0 * (0.09 / 0.07) ** -0.5 * 2**0.25
    base = np.minimum(0.02 + 0.02 / (losses.sliding + 0.2), 0.08)
    assert losses.friction == pytest.approx(factor * base, rel=1e-12)
    assert losses.angle == pytest.approx(np.arctan(losses.friction), rel=1e-12)
    assert losses.film[0] > losses.film[6] > 0


@pytest.mark.parametrize(
    ("given", "law", "angle"),
    [
        (None, NUMBERS, 0.0),
        (20.0, NUMBERS, 20.0),
        (None, {}, 20.0),
        (None, {"law": "constant", "constant": 0.06}, 20.0),
    ],
)
def test_the_standard_s_friction_contains_the_pressure_angle(tmp_path, given, law, angle):
    needs = {"worm_roughness_Ra_um": 0.5, "pressure_angle_deg": given}
    losses = read_drive(written(tmp_path, friction=law, gears=needs, **FILM))[0].map()
    assert np.tan(losses.angle) == pytest.approx(losses.friction / np.cos(np.radians(angle)), rel=1e-12)


def test_oil_far_from_its_viscosities_is_said(tmp_path, capsys):
    """The oil is given by 40 and 100 degC: 140 is beyond by more than 30 K."""
    file = written(tmp_path, conditions={"oil_temperature_C": [60.0, 140.0]}, **FILM)
    assert main(["worm", str(file), "--no-figures", "--out", str(tmp_path / "out")]) == 0
    said = " ".join(capsys.readouterr().err.split())
    assert "of 24 conditions 12 extrapolated a little: the viscosity is extrapolated far from the two" in said
    assert "here up to 140 °C" in said


def test_what_was_taken_for_the_oil_and_unusual_numbers_are_said(tmp_path):
    film = {"film": FILM["film"], "lubricant": {"base": "mineral"}}
    _, notes = read_drive(written(tmp_path, gears={"youngs_modulus_GPa": [206.0, 0.2]}, **film))
    assert {"oil_typical", "value_unusual"} <= {one.code for one in notes}
    assert any("0.2, where rigs have 0.3 to 1300 GPa" in one.text for one in notes)


@pytest.mark.parametrize(
    ("tables", "said"),
    [
        (
            {"friction": {**NUMBERS, "gain": None, "largest": None, "geometry": None, "roughness": None}},
            "law 'iso_tr_14521' needs gain, largest: no public source confirms the numbers of the standard",
        ),
        ({"friction": {"law": "constant"}}, "law 'constant' needs constant"),
        ({"friction": {"constant": 0.1}}, "law 'agma_6034' does not take constant"),
        ({"friction": {"size": NUMBERS["size"]}}, "size: only law 'iso_tr_14521' has factors"),
        ({"friction": NUMBERS}, "geometry: its value is parameter of [film]"),
        ({"film": FILM["film"]}, "needs the oil; add [lubricant]"),
        (
            {"gears": {"centre_distance_mm": 120.0}},
            "profile shift of 5 modules; from -2 to 2, that is from 92 to 108 mm",
        ),
        ({"gears": {"worm_diameter_mm": 8.0, "centre_distance_mm": None}}, "no body below 2.5 modules, 10 mm"),
        ({"conditions": {"worm_speed_rpm": [0.0, 10.0]}}, "worm_speed_rpm 0: above 0"),
        (
            {"conditions": {"oil_temperature_C": [60.0, -300.0]}},
            "oil_temperature_C: [60.0, -300.0]: entry 2 must be from -60",
        ),
        ({"conditions": {"oil_temperature_C": [1000.0]}}, "entry 1 must be from -60 to 300 °C"),
        ({"gears": {"youngs_modulus_GPa": [-1.0, 0.0]}}, "entry 1 must be from 0.1 to 2000 GPa"),
        ({"gears": {"poisson_ratio": [0.3, -2.0]}}, "entry 2 must be from 0 to 0.4999"),
        (
            {"friction": {"law": "constant", "constant": 0.99}, "gears": {"threads": 10, "pressure_angle_deg": 30.0}},
            "the worm jams: no torque turns the wheel from a friction of 0.779 on, here up to 0.99",
        ),
    ],
)
def test_bad_input_is_one_sentence(tmp_path, capsys, tables, said):
    assert main(["worm", str(written(tmp_path, **tables)), "--out", str(tmp_path / "out")]) == 2
    assert said in " ".join(capsys.readouterr().err.split())


SPEED = np.array([-2000.0, -400.0, -20.0, 20.0, 400.0, 2000.0])
TORQUE = np.array([-300.0, -150.0, 0.0, 150.0, 300.0])


def friction_map(drive):
    """Speeds, wheel torques and the friction torque of the mesh on the worm, from both efficiencies."""
    speed, torque = (axis.ravel() for axis in np.meshgrid(SPEED, TORQUE, indexing="ij"))
    found = drive.losses(np.maximum(np.abs(torque), 1e-9), np.abs(speed) * np.pi / 30, np.full(speed.shape, 333.0))
    ideal = np.abs(torque) / found.ratio
    return speed, torque, np.where(speed * torque > 0, ideal / found.driving - ideal, ideal - ideal * found.driven)


@pytest.mark.parametrize("friction", [{}, {"material": 1.5}, NUMBERS, {"law": "constant", "constant": 0.06}])
def test_the_law_for_friction_maps_is_the_mesh_s_loss(tmp_path, friction):
    needs = {"gears": {"worm_roughness_Ra_um": 0.5}, **FILM} if friction is NUMBERS else {}
    drive, _ = read_drive(written(tmp_path, friction=friction, **needs))
    speed, torque, lost = friction_map(drive)
    text = tomllib.loads(mesh_law(drive))["expression"]
    found = parse(text).evaluate({"factor": 1.0, "speed_rpm": speed, "torque_Nm": torque})
    assert found == pytest.approx(lost, rel=1e-6, abs=1e-9)


def test_the_mesh_is_back_driving_with_the_product_of_both_tangents(tmp_path):
    """Losses over load are 1/eta - 1 and 1 - eta': their asymmetry is -tan(lead) tan(friction angle)."""
    drive, _ = read_drive(written(tmp_path, friction={"law": "constant", "constant": 0.06}))
    speed, torque, lost = friction_map(drive)
    t, r = np.tan(drive.lead), 0.06 / np.cos(drive.pressure_angle)
    mean = 300.0 / 20.5 * r * (1 + t**2) / t / (1 - (t * r) ** 2)
    found = back_driving(1.0, np.abs(torque) / 300.0, np.sign(speed * torque), growth=mean, asymmetry=-t * r)
    assert found - 1.0 == pytest.approx(lost, rel=1e-9, abs=1e-9)


@pytest.mark.long
def test_a_friction_map_of_a_worm_drive_is_explained_by_its_mesh(tmp_path):
    """Dry and viscous friction and a mesh of 1.15 times AGMA's friction, with noise of 0.02 N m."""
    from mixedlub.diagnosis.diagnose import diagnose_case
    from mixedlub.diagnosis.report.text.answer import as_json

    drive, _ = read_drive(written(tmp_path))
    speed, torque, _ = friction_map(drive)
    text = tomllib.loads(mesh_law(drive))["expression"]
    mesh = parse(text).evaluate({"factor": 1.15, "speed_rpm": speed, "torque_Nm": torque})
    noise = 0.02 * np.random.default_rng(1).standard_normal(speed.size)
    case = tmp_path / "case"
    (case / "hypotheses").mkdir(parents=True)
    (case / "hypotheses" / "worm_mesh.toml").write_text(mesh_law(drive), encoding="utf-8")
    (case / "system.toml").write_text(
        'schema = "mixedlub-case/1"\nkind = "friction_map"\n[recording]\nquantity = "friction_torque_Nm"\n'
        "noise = { absolute = 0.02 }\n",
        encoding="utf-8",
    )
    reading = np.sign(speed) * (0.4 + 2e-4 * np.abs(speed) + mesh) + noise
    columns = {"run": np.arange(1, speed.size + 1), "speed_rpm": speed, "torque_Nm": torque}
    pd.DataFrame({**columns, "friction_torque_Nm": reading}).to_csv(case / "recordings.csv", index=False)
    answer = diagnose_case(case)
    assert [key.ids for key in answer.posterior.tied] == [("worm_mesh",)]
    found = as_json(answer)
    assert max(found["probabilities"].get(name, 0.0) for name in ("back_driving", "load_dependent_friction")) < 0.01
    (effect,) = found["effects"]
    assert effect["parameters"][0]["value"] == pytest.approx(1.15, abs=0.02)
