"""A sound case spoilt in one place: what the user reads names the place, the value and the rule."""

import os
import re
import shutil

import numpy as np
import pytest

from mixedlub.gear import GearPair, RigidSharing, at_roll_angle
from tests.cli.test_bad_input import CASE, refused, spoilt
from tests.cli.test_commands import STUDY

SPOILT = {
    "semicolons": ("recordings.csv", ",", ";", "recordings.csv: ';': columns are separated by commas"),
    "name of a column": ("recordings.csv", "speed_rpm", "speed", "'speed_rpm' is missing; the file has 'speed'"),
    "no number": ("recordings.csv", "2,50,", "2,x,", "recordings.csv: line 3, torque_Nm: 'x': torque_Nm must be"),
    "NaN": ("recordings.csv", "2,50,", "2,nan,", "line 3, torque_Nm: 'nan': torque_Nm must be a finite number"),
    "negative torque": ("recordings.csv", "2,50,", "2,-50,", "line 3, torque_Nm: -50.0: torque_Nm must be above 0"),
    "line behind blank ones": ("recordings.csv", "\n2,50,", "\n\n\n2,x,", "recordings.csv: line 5, torque_Nm"),
    "run twice": ("recordings.csv", "\n2,50,", "\n1,50,", "recordings.csv: line 3, run: 1: run must be unique"),
    "surface": ("recordings.csv", "d,ground,18.69", "d,grund,18.69", "line 3, gear_surface: 'grund': no such name in "
                "system.toml; nearest known: 'ground'"),
    "kind": ("system.toml", '"gear_pair"', '"gear_pear"', "system.toml: kind: 'gear_pear': must be 'gear_pair', "),
    "key": ("system.toml", "face_width_mm", "facewidth_mm", "gears.facewidth_mm: key is not known; nearest known: 'f"),
    "one of two": ("system.toml", "[17, 26]", "[17]", "system.toml: gears.teeth: [17]: needs 2 entries, not 1"),
    "three of two": ("system.toml", "[17, 26]", "[17, 26, 3]", "gears.teeth: [17, 26, 3]: needs 2 entries, not 3"),
    "entry": ("system.toml", "[17, 26]", '[17, "x"]', "gears.teeth, entry 2: 'x': must be a whole number"),
    "bound": ("system.toml", "module_mm = 4", "module_mm = -4", "normal_module_mm: -4.2333333: must be from 0.01 to 2"),
    "table": ("system.toml", '{ model = "rigid" }', '"rigid"', "gears.load_sharing: 'rigid': must be a table of keys"),
    "gears that do not mesh": ("system.toml", "[17, 26]", "[5, 60]", "system.toml: gears.tip_diameter_mm: "),
}  # fmt: skip
"""File of a sound case, a text in it, what takes its place, what the user reads."""


@pytest.mark.parametrize("name", SPOILT)
def test_what_is_wrong_with_a_case_is_said_in_its_own_words(name, tmp_path, capsys):
    file, old, new, said = SPOILT[name]
    case = spoilt(tmp_path, file, old, new, -1 if name == "semicolons" else 1)
    for command in ("simulate", "diagnose", "check"):
        out = [] if command == "check" else ["--out", str(tmp_path / "o")]
        status, message = refused(capsys, command, str(case), *out)
        assert status == 2
        assert said in message


UNIT_SLIPS = {
    "viscosity in m2/s": ("[100.0, 11.2]", "[100e-6, 11.2e-6]", "lubricant.kinematic_viscosity_mm2_s"),
    "module in m": ("4.2333333", "0.0042333", "gears.normal_module_mm"),
    "friction in percent": ("boundary_friction = 0.1", "boundary_friction = 10", "boundary_friction"),
    "stress in Pa": ("eyring_stress_MPa = 5.0", "eyring_stress_MPa = 5e6", "lubricant.eyring_stress_MPa"),
    "coefficient in 1/Pa": ("[18.8, 13.9]", "[18.8e-9, 13.9e-9]", "lubricant.pressure_viscosity_per_GPa"),
    "kelvin": ("[40.0, 100.0]", "[313.15, 373.15]", "lubricant.temperature_C"),
    "nm2": ("m0_um2 = 0.13", "m0_um2 = 130000", "surfaces.ground.m0_um2"),
}
"""What stands in a sound case, what takes its place, the key that is refused."""


@pytest.mark.parametrize("name", UNIT_SLIPS)
def test_a_slip_of_the_unit_is_refused_by_every_command(name, tmp_path, capsys):
    old, new, key = UNIT_SLIPS[name]
    case = spoilt(tmp_path, "system.toml", old, new, 1)
    for command in ("simulate", "diagnose", "check"):
        status, said = refused(
            capsys, command, str(case), *([] if command == "check" else ["--out", str(tmp_path / "o")])
        )
        assert status == 2
        assert said.startswith(f"mixedlub: {case}/system.toml: {key}: ")
        assert said.endswith("is it in that unit?\n")


SHARES = {
    "twice": (lambda rows: [*rows, rows[4]], 2, "share.csv: line 63, torque_Nm and roll_angle_deg: (50.0, "),
    "part": (lambda rows: rows[:3], 2, "share.csv: roll_angle_deg: the rows at 50 N m"),
    "halved": (
        lambda rows: [(t, a, s / 2) for t, a, s in rows],
        0,
        "carry together 0.47 to 0.57 of the load, 0.501 on average",
    ),
    "percent": (
        lambda rows: [(t, a, s * 100) for t, a, s in rows],
        2,
        "share.csv: line 2, load_share: 50.0: load_share must lie between 0 and 1.5; 50 % would be 0.5",
    ),
}
"""What is done to the rows of a load-share table, exit status, what is told."""


@pytest.mark.parametrize("name", SHARES)
def test_a_table_of_load_shares_that_cannot_be_is_told(name, tmp_path, capsys):
    change, expected, told = SHARES[name]
    pair = GearPair((17, 26), 4.2333333e-3, np.radians(22.5), 14e-3)
    angles = np.degrees(np.linspace(pair.path_start, pair.path_end, 61) / pair.base_radius[0])
    shares = at_roll_angle(pair, RigidSharing(), np.radians(angles)).load_share(50.0)
    case = spoilt(tmp_path, "system.toml", '{ model = "rigid" }', '{ table = "share.csv" }')
    rows = change(list(zip([50.0] * 61, angles.tolist(), shares.tolist(), strict=True)))
    lines = ["torque_Nm,roll_angle_deg,load_share", *(",".join(map(repr, row)) for row in rows)]
    (case / "share.csv").write_text("\n".join(lines) + "\n")
    status, said = refused(capsys, "simulate", str(case), "--out", str(tmp_path / "o"))
    assert status == expected
    assert told in said


def test_a_roll_angle_off_the_path_is_refused_with_its_line(tmp_path, capsys):
    case = CASE.parent / "published" / "nasa_rig"
    at = tmp_path / "at.csv"
    head = "run,torque_Nm,speed_rpm,oil_temperature_C,pinion_surface,gear_surface,roll_angle_deg"
    at.write_text(f"{head}\n1,50,1000,60,ground,ground,20\n2,50,1000,60,ground,ground,60\n")
    status, said = refused(capsys, "simulate", str(case), "--at", str(at), "--out", str(tmp_path / "o"))
    assert status == 2
    assert f"{at}: line 3, roll_angle_deg: 60.0: roll_angle_deg must lie between 10.2" in said


BROKEN = {
    "no table": ("recordings.csv", lambda text: "", "recordings.csv: needs a header line"),
    "cell": ("recordings.csv", lambda text: text.replace("2,50,", "2,x,", 1), "recordings.csv: line 3, torque_Nm"),
    "column": ("recordings.csv", lambda text: text.replace("speed_rpm", "sped"), "recordings.csv: header"),
    "stuck": (
        "recordings.csv",
        lambda text: re.sub(r",[\d.]+$", ",5", text, flags=re.M),
        "recordings.csv: power_loss_W",
    ),
    "not TOML": ("system.toml", lambda text: "[[", "system.toml: is not readable as TOML"),
    "key": ("system.toml", lambda text: text.replace("teeth", "teet"), "system.toml: gears.teet"),
    "geometry": ("system.toml", lambda text: text.replace("[17, 26]", "[5, 60]"), "system.toml: gears.tip_diameter_mm"),
    "section": (
        "system.toml",
        lambda text: re.sub(r"\[lubricant\].*?\n\n", "", text, flags=re.S),
        "system.toml: a case",
    ),
    "oil": ("system.toml", lambda text: text.replace("[100.0, 11.2]", "[1.0, 11.2]"), "system.toml: lubricant.kin"),
}
"""File of the case, how it is broken, place that is told behind the folder."""


@pytest.mark.parametrize("name", BROKEN)
def test_every_error_in_a_case_names_the_whole_path_of_its_file(name, tmp_path, capsys):
    file, change, place = BROKEN[name]
    case = shutil.copytree(CASE, tmp_path / "case")
    (case / file).write_text(change((case / file).read_text(encoding="utf-8")), encoding="utf-8")
    status, said = refused(capsys, "diagnose", str(case), "--out", str(tmp_path / "o"))
    assert status == 2
    assert said.startswith(f"mixedlub: {case}/{place}"), said


@pytest.mark.parametrize(("old", "new"), [("teeth =", "teet ="), ("teeth = [17, 26]", "teeth = [5, 60]")])
def test_every_error_in_a_study_names_the_whole_path_of_its_file(old, new, tmp_path, capsys):
    path = tmp_path / "trial.toml"
    path.write_text(STUDY.replace(old, new))
    said = refused(capsys, "study", str(path), "--no-figures", "--out", str(tmp_path / "o"))[1]
    assert said.startswith(f"mixedlub: {path}: gears.te") or said.startswith(f"mixedlub: {path}: gears.tip")


@pytest.mark.parametrize("name", ["recordings.csv", "system.toml"])
@pytest.mark.parametrize("special", ["pipe", "device"])
def test_a_pipe_or_a_device_in_place_of_a_file_is_refused(name, special, tmp_path, capsys):
    """Reading a pipe never ends, and a device is read until the memory is full."""
    case = spoilt(tmp_path, "system.toml", "", "", 0)
    (case / name).unlink()
    os.mkfifo(case / name) if special == "pipe" else (case / name).symlink_to("/dev/zero")
    status, said = refused(capsys, "check", str(case))
    assert status == 2
    assert f"{name}: is a special file" in said


def test_a_whole_number_of_thousands_of_digits_is_refused_in_one_sentence(tmp_path, capsys):
    case = spoilt(tmp_path, "system.toml", "[17, 26]", f"[{'9' * 5001}, 26]", 1)
    status, said = refused(capsys, "check", str(case))
    assert (status, said) == (2, f"mixedlub: {case}/system.toml: holds a whole number with too many digits\n")


@pytest.mark.parametrize("change", [lambda t: t.replace(",", ";").encode(), lambda t: t.encode("utf-16")])
def test_a_recording_in_another_form_is_sent_to_the_import(change, tmp_path, capsys):
    case = spoilt(tmp_path, "system.toml", "", "", 0)
    path = case / "recordings.csv"
    path.write_bytes(change(path.read_text(encoding="utf-8")))
    status, said = refused(capsys, "check", str(case))
    assert status == 2
    assert "use `mixedlub import`" in said
