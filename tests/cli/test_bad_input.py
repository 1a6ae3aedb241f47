"""Whatever the input, a user reads one message, never a traceback."""

import random
import shutil
import tempfile
import warnings
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mixedlub.cli import main
from mixedlub.effects import catalogue
from tests.cli.test_commands import STUDY

CASE = Path(__file__).parents[2] / "examples" / "case"
CONVERTED = "units are not converted here; `mixedlub import` does"

QUIET = settings(max_examples=20, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])


def refused(capsys, *arguments):
    status = main(list(arguments))
    said = capsys.readouterr().err
    assert "Traceback" not in said
    assert "mixedlub: unexpected" not in said, said
    assert status in (0, 2)
    return status, said


def spoilt(tmp_path, file, old, new, times=-1):
    """A copy of the sound case with another text in one of its files."""
    case = shutil.copytree(CASE, tmp_path / "case")
    text = (case / file).read_text(encoding="utf-8")
    assert old in text
    (case / file).write_text(text.replace(old, new, times), encoding="utf-8")
    return case


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("torque_Nm = [50, 150]", "torque_Nm = [0, 150]", "torque_Nm"),
        ("torque_Nm", "torque_lbft", "torque_Nm"),
        ("normal_module_mm = 4.2333333", "normal_module_mm = -4", "normal_module_mm"),
        ("teeth = [17, 26]", "teeth = [5, 60]", "interference"),
        ("teeth", "teet", "teeth"),
        ("[60.0, 100.0]", "[60.0, 60.0]", "temperature_C"),
        ("fine = {", "fine = { colour = 1,", "colour"),
        ("[conditions]", "[condition", "TOML"),
        ("m0_um2 = 0.02", "m0_um2 = nan", "m0_um2"),
        ("m4_per_um2 = 0.0036", "m4 = 0.0036", "surfaces.fine.m4: key is not known; nearest known: 'm4_per_um2'"),
        ("[50, 150]", '["50"]', "conditions.torque_Nm, entry 1: '50': must be a number"),
        ("teeth = [17, 26]", 'teeth = ["17", 26]', "gears.teeth, entry 1: '17': must be a whole number"),
        ("[60]", "[333.15]", "conditions.oil_temperature_C: [333.15]: entry 1 must be from -60 to 300 °C; 333.15 K"),
        ("[18.05, 7.2]", "[18.05e-6, 7.2e-6]", "1.805e-05 m2/s would be 18.05 mm²/s: is it in that unit?"),
        (
            "face_width_mm = 14.0",
            "face_width_mm = 14.0\nload_sharing = { model = 'ldp', tip_relief_um = [15000, 15] }",
            "gears.load_sharing.tip_relief_um: [15000, 15]: entry 1 must be from 0 to 2000 µm; 15000 nm would be 15 µm",
        ),
    ],
)
def test_message_names_place_and_value(old, new, named, tmp_path, capsys):
    path = tmp_path / "trial.toml"
    path.write_text(STUDY.replace(old, new))
    status, said = refused(capsys, "study", str(path), "--no-figures", "--out", str(tmp_path / "o"))
    assert status == 2
    assert "trial.toml" in said
    assert named in said
    assert said.count("\n") == 1


@pytest.mark.parametrize(
    ("effect", "parameter"), [("inlet_shear_heating", "strength"), ("surface_defects", "inverse_height")]
)
def test_negative_value_of_a_positive_parameter_is_refused(effect, parameter, tmp_path, capsys):
    path = tmp_path / "trial.toml"
    path.write_text(STUDY + f"[effects]\n{effect} = {{ {parameter} = -5 }}\n")
    status, said = refused(capsys, "study", str(path), "--no-figures", "--out", str(tmp_path / "o"))
    assert status == 2
    assert f"effects.{effect}.{parameter}: -5" in said


@pytest.mark.parametrize("command", ["check", "simulate"])
def test_a_run_too_large_to_count_with_is_named_with_its_line(command, tmp_path, capsys):
    case = spoilt(tmp_path, "recordings.csv", "\n2,", "\n99999999999999999999,", 1)
    status, said = refused(capsys, command, str(case))
    assert status == 2
    assert "recordings.csv: line 3, run: '99999999999999999999': run must be a whole number below" in said


def test_a_folder_in_place_of_an_instrument_file_is_called_one(tmp_path, capsys):
    status, said = refused(capsys, "import", str(tmp_path), "--out", str(tmp_path / "out"))
    assert (status, said) == (2, f"mixedlub: {tmp_path}: is a folder; name the files in it\n")


@pytest.mark.parametrize("command", ["simulate", "check", "diagnose"])
def test_a_file_in_place_of_a_case_folder_is_called_one(command, tmp_path, capsys):
    status, said = refused(capsys, command, str(CASE / "system.toml"))
    assert status == 2
    assert "is a file; name the case folder" in said


def test_a_misspelt_command_gets_the_nearest(capsys):
    status, said = refused(capsys, "diagnos", str(CASE))
    assert status == 2
    assert "command: 'diagnos': no such command; nearest known: 'diagnose'" in said


def test_refused_case_leaves_no_folder(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    case = shutil.copytree(CASE, tmp_path / "case")
    (case / "recordings.csv").write_text("")
    assert refused(capsys, "diagnose", str(case))[0] == 2
    assert [p.name for p in tmp_path.iterdir()] == ["case"]


@pytest.mark.parametrize("command", ["study", "simulate", "check", "profile"])
def test_missing_input_is_named(command, tmp_path, capsys):
    status, said = refused(capsys, command, str(tmp_path / "absent"))
    assert status == 2
    assert "absent" in said


@QUIET
@given(st.binary(max_size=400))
def test_bytes_as_a_study_never_give_a_traceback(capsys, data):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "any.toml"
        path.write_bytes(data)
        assert refused(capsys, "study", str(path), "--no-figures", "--out", str(Path(folder) / "o"))[0] == 2


@QUIET
@given(st.binary(max_size=400))
def test_bytes_as_a_trace_never_give_a_traceback(capsys, data):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "any.csv"
        path.write_bytes(data)
        refused(capsys, "profile", str(path), "--no-figures", "--out", str(Path(folder) / "o"))


VALUES = ["-1", "0", "nan", "inf", "1e300", "1e-300", '"x"', "[]", "[1]", "[1, 2, 3]", "true", "{}", "1979-05-27", "''"]


@QUIET
@given(st.integers(0, 2**32 - 1))
def test_mangled_study_never_gives_a_traceback(capsys, seed):
    """One value of a good study replaced by another of odd type or size."""
    chance = random.Random(seed)
    lines = STUDY.strip().splitlines()
    place = chance.choice([i for i, line in enumerate(lines) if "=" in line])
    head, _, tail = lines[place].partition("=")
    if tail.strip().startswith("{"):
        parts = tail.split(",")
        at = chance.randrange(len(parts))
        key, _, rest = parts[at].rpartition("=")
        parts[at] = f"{key}= {chance.choice(VALUES)}{' }' if '}' in rest else ''}"
        tail = ",".join(parts)
    else:
        tail = chance.choice(VALUES)
    lines[place] = f"{head}= {tail}"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "mangled.toml"
        path.write_text("\n".join(lines))
        refused(capsys, "study", str(path), "--no-figures", "--out", str(Path(folder) / "o"))


@QUIET
@given(st.integers(0, 2**32 - 1), st.sampled_from(["check", "simulate"]))
def test_mangled_case_never_gives_a_traceback(capsys, seed, command):
    chance = random.Random(seed)
    lines = (CASE / "system.toml").read_text(encoding="utf-8").strip().splitlines()
    place = chance.choice([i for i, line in enumerate(lines) if "=" in line and not line.startswith("#")])
    lines[place] = f"{lines[place].partition('=')[0]}= {chance.choice(VALUES)}"
    with tempfile.TemporaryDirectory() as folder:
        case = shutil.copytree(CASE, Path(folder) / "case")
        (case / "system.toml").write_text("\n".join(lines), encoding="utf-8")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)
            refused(capsys, command, str(case), *(["--out", str(Path(folder) / "o")] if command == "simulate" else []))


@pytest.mark.parametrize("command", ["simulate", "diagnose", "check"])
def test_ignored_columns_are_told_on_stderr(command, tmp_path, capsys):
    case = shutil.copytree(CASE, tmp_path / "case")
    lines = (case / "recordings.csv").read_text(encoding="utf-8").splitlines()
    (case / "recordings.csv").write_text("\n".join(f"{line},colour" for line in lines), encoding="utf-8")
    options = [] if command == "check" else ["--out", str(tmp_path / "o")]
    options += [f"--exclude={name}" for name in catalogue() if command == "diagnose"]
    status, said = refused(capsys, command, str(case), *options)
    assert status == 0
    assert "note: recordings.csv: columns ignored because they are not known: colour" in said


def test_windows_files_are_read(tmp_path, capsys):
    """Line ends of two characters, and a byte order mark."""
    case = shutil.copytree(CASE, tmp_path / "case")
    for file in ("recordings.csv", "system.toml"):
        text = (case / file).read_text(encoding="utf-8")
        (case / file).write_bytes(b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode())
    assert refused(capsys, "simulate", str(case), "--out", str(tmp_path / "o"))[0] == 0


@QUIET
@given(st.binary(max_size=300))
def test_bytes_as_a_recording_never_give_a_traceback(capsys, data):
    with tempfile.TemporaryDirectory() as folder:
        case = shutil.copytree(CASE, Path(folder) / "case")
        (case / "recordings.csv").write_bytes(data)
        assert refused(capsys, "simulate", str(case), "--out", str(Path(folder) / "o"))[0] == 2


MISSING = {
    "misspelt": ("oil_temprature_C", "column 'oil_temperature_C' is missing; the file has 'oil_temprature_C'"),
    "kelvin": ("oil_temperature_K", "'oil_temperature_C' is missing; the file has 'oil_temperature_K': " + CONVERTED),
    "far": ("oil", "'oil_temperature_C' is missing; the file has 'oil', not known here"),
}
"""What stands in place of oil_temperature_C, what the user reads."""


@pytest.mark.parametrize("name", MISSING)
def test_what_the_file_has_in_place_of_a_column_is_said(name, tmp_path, capsys):
    header, said = MISSING[name]
    case = spoilt(tmp_path, "recordings.csv", "oil_temperature_C", header)
    message = refused(capsys, "check", str(case))[1]
    assert said in message
    assert "known:" not in message


@pytest.mark.parametrize(
    ("column", "other"), [("speed_rpm", "speed_rad_s"), ("power_loss_W", "power_loss_kW"), ("torque_Nm", "torque_mNm")]
)
def test_a_column_in_another_unit_is_said_to_be_one(column, other, tmp_path, capsys):
    case = spoilt(tmp_path, "recordings.csv", column, other)
    assert (
        f"column {column!r} is missing; the file has {other!r}: {CONVERTED}" in refused(capsys, "check", str(case))[1]
    )


def test_an_optional_column_in_another_unit_is_said_to_be_one(tmp_path, capsys):
    case = tmp_path / "case"
    case.mkdir()
    (case / "system.toml").write_text(
        'schema = "mixedlub-case/1"\nkind = "viscosity"\n[recording]\nquantity = "viscosity_mPa_s"\n', encoding="utf-8"
    )
    (case / "recordings.csv").write_text(
        "run,temperature_C,pressure_GPa,viscosity_mPa_s\n1,40,0.1,90\n2,60,0.2,95\n", encoding="utf-8"
    )
    status, said = refused(capsys, "check", str(case))
    assert status == 0
    assert f"recordings.csv, pressure_GPa: column ignored: {CONVERTED}" in said


def test_simulate_writes_no_number_that_is_not_finite(tmp_path, capsys):
    case = spoilt(tmp_path, "system.toml", "[100.0, 11.2]", "[1e8, 0.31]")
    at = tmp_path / "cold.csv"
    at.write_text("run,torque_Nm,speed_rpm,oil_temperature_C,pinion_surface,gear_surface\n8,50,500,-60,ground,ground\n")
    status, said = refused(capsys, "simulate", str(case), "--at", str(at), "--out", str(tmp_path / "o"))
    assert status == 2
    assert "cold.csv: power_loss_W, run: 8: the base model has no finite answer" in said
    assert not (tmp_path / "o").exists()


def test_a_doubtful_number_is_told_by_check_and_simulate(tmp_path, capsys):
    case = spoilt(tmp_path, "system.toml", "face_width_mm = 14.0", "face_width_mm = 0.014")
    doubt = "gears.face_width_mm: 0.014, where rigs have 0.1 to 2000 mm: 0.014 m would be 14 mm"
    assert main(["check", str(case)]) == 0
    assert f"Doubtful:\n  {doubt}." in capsys.readouterr().out
    assert f"doubt: {doubt}\n" in refused(capsys, "simulate", str(case), "--out", str(tmp_path / "o"))[1]


def test_a_run_that_stands_in_both_tables_keeps_its_reading(tmp_path, capsys):
    """Its row of conditions is told by simulate and check, and takes the place of no other."""
    case = shutil.copytree(CASE, tmp_path / "case")
    (case / "conditions.csv").unlink(missing_ok=True)
    assert main(["simulate", str(case), "--out", str(tmp_path / "alone")]) == 0
    head = "run,torque_Nm,speed_rpm,oil_temperature_C,pinion_surface,gear_surface\n"
    (case / "conditions.csv").write_text(head + "3,150,4000,70,ground,ground\n500,150,4000,70,ground,ground\n")
    capsys.readouterr()
    status, said = refused(capsys, "simulate", str(case), "--out", str(tmp_path / "both"))
    assert status == 0
    told = "conditions.csv: not predicted, as readings at other conditions have the same run numbers: 3"
    assert told in said
    alone, both = ((tmp_path / d / "simulation.csv").read_text().splitlines() for d in ("alone", "both"))
    assert both[:-1] == alone
    assert both[-1].startswith("500,")
    assert main(["check", str(case)]) == 0
    assert told in capsys.readouterr().out


def test_traces_that_are_not_shipped_are_said_to_come_from_elsewhere(tmp_path, capsys):
    example = Path(__file__).parents[2] / "examples" / "study_bearing_steel.toml"
    path = shutil.copy(example, tmp_path / "study.toml")
    status, said = refused(capsys, "study", str(path), "--out", str(tmp_path / "o"))
    assert status == 2
    assert "no such file in" in said
    assert "the file that names it may say where it comes from" in said
    head = [line for line in example.read_text(encoding="utf-8").splitlines() if line.startswith("#")]
    assert any("github.com/moritzploss/tribology" in line for line in head)


def test_a_second_channel_that_no_column_holds_is_told(tmp_path, capsys):
    case = shutil.copytree(CASE, tmp_path / "case")
    head, *rows = (case / "recordings.csv").read_text(encoding="utf-8").splitlines()
    lines = [f"{head},coverage_percent", *(f"{row},50" for row in rows)]
    (case / "recordings.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    told = (case / "system.toml").read_text(encoding="utf-8")
    for name in ("coverge_percent", "coverage_percent"):
        (case / "system.toml").write_text(told + f'check = "{name}"\n', encoding="utf-8")
        assert main(["check", str(case)]) == 0
        said = " ".join("".join(capsys.readouterr()).split())
        missing = "recording.check: 'coverge_percent': no such column in recordings.csv"
        assert (missing in said) == (name == "coverge_percent")
        assert ("nearest known: 'coverage_percent'" in said) == (name == "coverge_percent")
