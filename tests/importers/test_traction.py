"""Steps of a traction rig that sweep the speed or the slip: the kinds of case that they make."""

from functools import partial

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.cli import main
from mixedlub.importers import import_files
from mixedlub.importers.input_file import open_file
from mixedlub.importers.wizard import read, run
from mixedlub.schema.findings import Severity, codes
from profiles.errors import InputError

from .test_importers import EHD

HEAD = (
    "Rolling Speed (mm/s)\tTraction Coeff (-)\t\tStep Time (s)\tPot RTD Temp (°C)\tLube RTD Temp (°C)\tBall Load (N)"
    "\t\tBall Speed 1\tDisc Speed 1\tRolling Speed (mm/s)\tSliding Speed (mm/s)\tSRR (%)\tTraction Coeff (-)"
)
SPEEDS = np.geomspace(3000.0, 10.0, 12)


def step(number, form, celsius, speeds=SPEEDS):
    rows = ""
    for i, u in enumerate(speeds, start=1):
        friction = 0.03 + 0.2 / (u + 10) + 1e-4 * i
        rows += f"{u:.1f}\t{friction:.3f}\t\t{12 * i}\t{celsius + 0.3}\t{celsius}\t30.1\t\t"
        rows += f"{1.25 * u:.1f}\t{0.75 * u:.1f}\t{u:.2f}\t{0.5 * u:.2f}\t50.0\t{friction:.4f}\n"
    begun = f"Step {number} started at 03/04/2021 09:{10 * number}:00\n"
    return f"{begun}Step type\t{form}\tStep description\tstep {number}\n{HEAD}\n{rows}\n"


STRIBECK = "MTM311 Test Data File\n\n" + step(1, "STRIBECK", 60.0) + step(2, "STRIBECK", 100.0)
RUN_IN = "MTM311 Test Data File\n\n" + step(1, "BOD_TIMED", 60.0, np.full(40, 100.0)) + step(2, "STRIBECK", 60.0)
BALL = {"radius_mm": [9.525, float("inf")], "youngs_modulus_GPa": [207.0, 207.0], "poisson_ratio": [0.3, 0.3]}
SURFACE = {"m0_um2": 1e-4, "m2": 1e-5, "m4_per_um2": 1e-5}
OIL = {"base": "pao", "temperature_C": [40.0, 100.0], "kinematic_viscosity_mm2_s": [31.0, 5.9]}
NAMES = {"import.surface_1": "ball", "import.surface_2": "disc"}


@pytest.fixture
def file(file):
    """Traction rigs write Latin-1."""
    return partial(file, name="mtm.txt", encoding="latin-1")


def said_of(path, out, settings=(), ask=None):
    lines = []
    run([path], out, settings, ask=ask, say=lines.append)
    return " ".join(lines)


def test_swept_steps_are_a_case_of_a_ball_on_a_disc(file, tmp_path):
    told = {"contact": BALL, "lubricant": OIL, "surfaces": {"ball": SURFACE, "disc": SURFACE}, **NAMES}
    case = read_case(import_files([file(STRIBECK)], tmp_path / "case", kind="disc", **told))
    assert case.kind.name == "disc"
    assert case.system.contact.geometry == "point"
    table = case.recordings
    assert np.allclose(table["entrainment_speed_m_s"], np.tile(SPEEDS, 2) * 1e-3, atol=1e-5)
    assert table["slide_roll_ratio"].tolist() == [0.5] * 24
    assert table["load_N"].tolist() == [30.1] * 24
    assert table["oil_temperature_C"].tolist() == [60.0] * 12 + [100.0] * 12
    assert set(table["surface_1"]) | set(table["surface_2"]) == {"ball", "disc"}
    assert main(["check", str(tmp_path / "case")]) == 0


def test_what_a_ball_on_a_disc_needs_beside_the_file_is_asked(file, tmp_path):
    with pytest.raises(InputError) as caught:
        import_files([file(STRIBECK)], tmp_path / "case", kind="disc")
    for key in ("import.surface_1", "import.surface_2", "contact.radius_mm", "contact.poisson_ratio"):
        assert f"--set '{key}=" in str(caught.value)


def test_a_described_contact_makes_swept_steps_a_ball_on_a_disc(file, tmp_path):
    assert read_kind(import_files([file(STRIBECK)], tmp_path / "swept", contact=BALL, **NAMES)) == "disc"
    held = file(step(1, "BOD_TIMED", 60.0, np.full(40, 100.0)))
    assert read_kind(import_files([held], tmp_path / "held", contact=BALL)) == "friction_history"


def read_kind(folder):
    return (folder / "system.toml").read_text(encoding="utf-8").split('kind = "')[1].split('"')[0]


def test_swept_steps_are_a_map_of_friction_against_sliding_speed(file, tmp_path):
    case = read_case(import_files([file(STRIBECK)], tmp_path / "case", kind="friction_map"))
    assert case.kind.name == "friction_map"
    assert case.quantity == "friction_coefficient"
    assert np.allclose(case.recordings["sliding_speed_m_s"], np.tile(SPEEDS, 2) * 0.5e-3, atol=1e-5)
    assert case.recordings["oil_temperature_C"].tolist() == [60.0] * 12 + [100.0] * 12


def test_a_sliding_speed_that_is_not_recorded_follows_from_the_slip(file, tmp_path):
    text = STRIBECK.replace("Sliding Speed (mm/s)", "Other (mm/s)")
    case = read_case(import_files([file(text)], tmp_path / "case", kind="friction_map"))
    assert np.allclose(case.recordings["sliding_speed_m_s"], np.tile(SPEEDS, 2) * 0.5e-3, atol=1e-5)


def test_kinds_are_offered_where_speeds_are_swept(file, tmp_path):
    said = said_of(file(STRIBECK), tmp_path / "case")
    assert "--set 'kind=\"disc\"'" in said
    assert read_case(tmp_path / "case").kind.name == "friction_history"
    assert "kind=" not in said_of(file(step(1, "BOD_TIMED", 60.0, np.full(40, 100.0))), tmp_path / "held")


def test_the_wizard_asks_for_the_kind_and_what_it_needs(file, tmp_path, at_terminal):
    user = at_terminal(file(STRIBECK), tmp_path / "case", [], {"kind of recording": ["friction_map"]})
    assert read_case(tmp_path / "case").kind.name == "friction_map"
    assert any("a disc" in line and "b friction_map" in line for line in user.said)


def test_of_a_test_with_a_run_in_the_swept_steps_are_taken(file, tmp_path):
    case = read_case(import_files([file(RUN_IN)], tmp_path / "case", kind="friction_map"))
    assert len(case.recordings) == 12


@pytest.mark.parametrize(
    ("told", "message"),
    [
        ({"kind": "gear_pair"}, "kind: 'gear_pair': is no kind that files of this rig make; they make film"),
        ({"kind": "dics"}, "kind: 'dics': no such kind; nearest known: 'disc'"),
        ({"kind": "film"}, "no step with films"),
        ({"kind": "disc", "recording.quantity": "film_thickness_nm"}, "'disc' from this rig records friction_coeff"),
        ({"import.surface_1": "ball"}, "import.surface_1: key is not known for this file"),
    ],
)
def test_a_kind_that_the_file_cannot_make_is_refused_with_those_it_can(file, tmp_path, told, message):
    with pytest.raises(InputError, match=message):
        import_files([file(STRIBECK)], tmp_path / "case", **told)


def test_what_the_steps_lack_is_named(file, tmp_path):
    with pytest.raises(InputError, match=r"mtm\.txt: the steps hold no load_N, which a case of kind 'disc' needs"):
        import_files([file(STRIBECK.replace("Ball Load", "Other"))], tmp_path / "case", kind="disc")


def with_spread(text, header, value):
    """The steps with one more column behind the others."""
    lines = [
        f"{line}\t{header}" if line == HEAD else f"{line}\t{value}" if line[:1].isdigit() and "\t" in line else line
        for line in text.splitlines()
    ]
    return "\n".join(lines) + "\n"


SD = "import.columns.friction_coefficient_sd"


@pytest.mark.parametrize("header", ["Traction Coeff Std Dev (-)", "SD of Traction Coeff", "Standard Deviation (%)"])
def test_the_sd_beside_a_traction_is_offered_with_the_setting_that_takes_it(file, header):
    found = read([open_file(file(with_spread(STRIBECK, header, 0.2)), {})], {})
    assert [(q.example, q.needed) for q in found.questions if q.key == SD] == [(f'"{header}"', False)]
    assert "friction_coefficient_sd" not in found.columns
    (note,) = [note for note in found.notes if note.code == "column_not_taken"]
    assert note.place == "mtm.txt"
    assert f"{header!r} is not taken; if it is friction_coefficient_sd: --set " in note.text


def test_the_sd_of_a_film_is_offered(file):
    found = read([open_file(file(EHD.replace("\t0.00\t3", "\t0.4\t3")), {})], {})
    assert not any("sd" in q.key for q in read([open_file(file(EHD), {})], {}).questions)
    (question,) = [q for q in found.questions if q.key == "import.columns.film_thickness_nm_sd"]
    assert question.example == '"Standard Deviation (nm)"'


@pytest.mark.parametrize(
    ("header", "value"), [("Standard Deviation (nm)", 0.2), ("SD Repeat Number (-)", 1), ("Standard Deviation", 0.0)]
)
def test_the_sd_of_something_else_or_of_single_readings_is_not(file, header, value):
    found = read([open_file(file(with_spread(STRIBECK, header, value)), {})], {})
    assert SD not in {q.key for q in found.questions}
    assert "column_not_taken" not in codes(found.notes)


def test_an_sd_that_is_told_is_taken_in_its_unit(file):
    text = with_spread(STRIBECK, "Traction Coeff SD (%)", 0.2)
    found = read([open_file(file(text), {})], {SD: "Traction Coeff SD (%)"})
    assert found.columns["friction_coefficient_sd"].tolist() == [0.002] * 24
    assert not any(note.severity is Severity.CAUTION for note in found.notes)
    with pytest.raises(InputError, match=r"friction_coefficient_sd: 'SD': no such header; known: "):
        read([open_file(file(text), {})], {SD: "SD"})
