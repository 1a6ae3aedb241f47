"""Files that were cut off, files in UTF-16, and files of very many readings."""

import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers import import_files
from mixedlub.importers.wizard import run
from mixedlub.schema.findings import FindingWarning
from profiles.errors import InputError

BALL = ["contact.radius_mm=[9.525, inf]", "contact.youngs_modulus_GPa=[207, 75]", "contact.poisson_ratio=[0.3, 0.22]"]
HEAD = "Rolling Speed (mm/s)\tAverage Film (nm)\tStep Time (s)\tLube Temp (degC)\tBall Load (N)\tSRR (%)\tOrder"
FILM = "EHD Test Data File\nNumber of steps in profile:\t4\nNumber of steps completed:\t3\n\n" + "".join(
    f'Step {n} "film" started at 01/02/2017 16:0{n}\nStep type\tFILM\tStep description\tfilm\n{HEAD}\n'
    + "".join(f"{n}0.{i}\t{20 * n + 3 * i}.5\t{i}\t40.4\t20.0\t0.0\t3\n" for i in range(4))
    + "\n"
    for n in (1, 2, 3)
)
TABLE = "temperature_C,viscosity_mPa_s\n40,30\n60,12\n"


def said_of(path, settings, out):
    lines = []
    run([path], out, settings, say=lines.append)
    return lines


@pytest.fixture
def file(tmp_path):
    def write(text, encoding="utf-8"):
        path = tmp_path / "data.txt"
        path.write_bytes(text.encode(encoding))
        return path

    return write


def test_a_whole_file_is_not_warned_of(file, tmp_path):
    assert not any("caution" in line for line in said_of(file(FILM), BALL, tmp_path / "case"))
    assert len(read_case(tmp_path / "case").recordings) == 12


def test_a_file_cut_amid_a_line_says_what_is_lost(file, tmp_path):
    cut = FILM[: FILM.index("20.2\t") + 12]
    said = said_of(file(cut), BALL, tmp_path / "case")
    number = cut.count("\n") + 1
    assert "caution: data.txt: holds 2 of the 3 steps that its header counts; the rest is missing" in said
    assert f"caution: data.txt: line {number} breaks off at the end of the file and is left out" in said
    table = read_case(tmp_path / "case").recordings
    assert table["film_thickness_nm"].tolist() == [20.5, 23.5, 26.5, 29.5, 40.5, 43.5]
    assert table["oil_temperature_C"].tolist() == [40.4] * 6


def test_a_file_cut_between_steps_says_so(file, tmp_path):
    said = said_of(file(FILM[: FILM.index("Step 2")]), BALL, tmp_path / "case")
    assert "caution: data.txt: holds 1 of the 3 steps that its header counts; the rest is missing" in said


def test_a_file_without_a_line_end_that_ends_with_a_whole_row_keeps_it(file, tmp_path):
    assert not any("caution" in line for line in said_of(file(FILM.rstrip("\n")), BALL, tmp_path / "case"))
    assert len(read_case(tmp_path / "case").recordings) == 12


def test_from_python_a_cut_file_is_a_warning(file, tmp_path):
    contact = {"radius_mm": [9.525, 20.0], "youngs_modulus_GPa": [207.0, 75.0], "poisson_ratio": [0.3, 0.22]}
    with pytest.warns(FindingWarning, match="holds 1 of the 3 steps"):
        import_files([file(FILM[: FILM.index("Step 2")])], tmp_path / "case", contact=contact)


def test_a_file_cut_before_its_first_reading_says_so(file, tmp_path):
    with pytest.raises(InputError, match=r"no step with films.*holds 1 of the 3 steps"):
        said_of(file(FILM[: FILM.index(HEAD)]), BALL, tmp_path / "case")


@pytest.mark.parametrize("encoding", ["utf-16", "utf-8-sig", "latin-1"])
def test_every_usual_encoding_is_read(file, tmp_path, encoding):
    text = TABLE.replace("temperature_C", "Temp (°C)")
    run([file(text, encoding)], tmp_path / "case", ["kind=viscosity"], say=lambda line: None)
    assert read_case(tmp_path / "case").recordings["temperature_C"].tolist() == [40.0, 60.0]


def test_big_endian_is_read(file, tmp_path):
    path = file("\ufeff" + TABLE, "utf-16-be")
    run([path], tmp_path / "case", ["kind=viscosity"], say=lambda line: None)
    assert len(read_case(tmp_path / "case").recordings) == 2


def series(rows):
    return "time_s,friction_coefficient\n" + "".join(f"{i},{0.1 + 0.001 * (i % 7)}\n" for i in range(rows))


def test_very_many_readings_in_time_bring_a_hint(file, tmp_path):
    settings = ["kind=friction_history"]
    (hint,) = (s for s in said_of(file(series(2500)), settings, tmp_path / "raw") if "import.every" in s)
    assert hint.startswith("2500 readings in time: --set import.every=10 would keep one of ten")
    said = said_of(file(series(2500)), [*settings, "import.every=10"], tmp_path / "thin")
    assert not any("one of ten" in line for line in said)


def test_a_short_series_brings_no_hint(file, tmp_path):
    assert not any("import.every" in s for s in said_of(file(series(200)), ["kind=friction_history"], tmp_path / "c"))
