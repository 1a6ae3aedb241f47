"""Plain text in its wild forms, and the message each fault gets."""

import numpy as np
import pytest

from profiles import InputError, read
from profiles.read import read_source
from profiles.readers.base import Source

HEIGHTS = 0.2 * np.sin(np.arange(50) / 3.0)  # um
POSITIONS = 0.5 * np.arange(50)  # um


def written(tmp_path, text, name="trace.txt", encoding="utf-8"):
    file = tmp_path / name
    file.write_bytes(text.encode(encoding))
    return file


def rows(x, z, delimiter="\t", end="\n", form="{:.6f}"):
    return "".join(form.format(a) + delimiter + form.format(b) + end for a, b in zip(x, z))


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r", "\r\r\n"])
def test_line_ends_of_every_system(tmp_path, end):
    profile = read(written(tmp_path, "x_um\tz_um" + end + rows(POSITIONS, HEIGHTS, end=end)))
    assert profile.heights == pytest.approx(HEIGHTS * 1e-6, abs=1e-12)
    assert profile.spacing == pytest.approx(0.5e-6)


@pytest.mark.parametrize("delimiter", ["\t", " ", "   ", ";", ",", ", "])
def test_delimiters(tmp_path, delimiter):
    profile = read(written(tmp_path, rows(POSITIONS, HEIGHTS, delimiter)), unit="um")
    assert profile.heights == pytest.approx(HEIGHTS * 1e-6, abs=1e-12)


@pytest.mark.parametrize("delimiter", ["\t", " ", ";"])
def test_decimal_comma(tmp_path, delimiter):
    text = rows(POSITIONS, HEIGHTS, delimiter).replace(".", ",")
    profile = read(written(tmp_path, text), unit="um")
    assert profile.heights == pytest.approx(HEIGHTS * 1e-6, abs=1e-12)


def test_decimal_comma_in_one_column(tmp_path):
    text = "".join(f"{z:.6f}\n" for z in HEIGHTS).replace(".", ",")
    profile = read(written(tmp_path, text), unit="um", spacing="0.5 um")
    assert profile.heights == pytest.approx(HEIGHTS * 1e-6, abs=1e-12)


@pytest.mark.parametrize(
    ("header", "x", "z"),
    [
        ("X [mm];Z [µm]\n", 1e-3, 1e-6),
        ("position_mm;height_nm\n", 1e-3, 1e-9),
        ("Lateral um;Raw Micrometer\n", 1e-6, 1e-6),
        ("X;Z\n[mm];[mm]\n", 1e-3, 1e-3),
        ("distance (microns);height/nm\n", 1e-6, 1e-9),
        ("# x unit: mm\n# z unit: um\n", 1e-3, 1e-6),
        ("unit = um\n", 1e-6, 1e-6),
    ],
)
def test_units_from_the_header(tmp_path, header, x, z):
    profile = read(written(tmp_path, header + rows(POSITIONS, HEIGHTS, ";")))
    assert profile.spacing == pytest.approx(0.5 * x)
    assert profile.heights[1] == pytest.approx(HEIGHTS[1] * z, rel=1e-4)
    assert profile.steps == ()


def test_encodings(tmp_path):
    text = "x [µm]\tz [µm]\n" + rows(POSITIONS, HEIGHTS)
    for encoding in ("utf-8", "utf-8-sig", "utf-16", "latin-1"):
        profile = read(written(tmp_path, text, encoding=encoding))
        assert profile.heights == pytest.approx(HEIGHTS * 1e-6, abs=1e-12)


def test_units_are_inferred_only_when_there_is_one_answer_and_said(tmp_path):
    heights = HEIGHTS * 0.2
    profile = read(written(tmp_path, rows(POSITIONS / 1e3, heights)))
    assert profile.spacing == pytest.approx(0.5e-6)
    assert profile.heights[1] == pytest.approx(heights[1] * 1e-6, rel=1e-3)
    assert any("units inferred" in step for step in profile.steps)
    with pytest.raises(InputError, match="as unit '"):
        read(written(tmp_path, rows(POSITIONS / 1e3, HEIGHTS * 4e-3, form="{:.9f}")))


def test_one_column_with_spacing_and_unit_in_the_header(tmp_path):
    text = "# spacing: 0.25 um\n# unit: nm\n" + "".join(f"{z * 1e3:.1f}\n" for z in HEIGHTS)
    profile = read(written(tmp_path, text))
    assert profile.spacing == pytest.approx(0.25e-6)
    assert profile.heights == pytest.approx(HEIGHTS * 1e-6, abs=1e-10)


def test_rounded_positions_keep_the_measured_step(tmp_path):
    step = 0.156
    x = np.round(np.arange(2000) * step, 1)
    text = "x_um,z_um\n" + "".join(f"{a:.1f},{b:.5f}\n" for a, b in zip(x, np.sin(x)))
    assert read(written(tmp_path, text)).spacing == pytest.approx(step * 1e-6, rel=1e-3)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "empty"),
        ("no numbers here\n", "no column of numbers"),
        ("1 2\n2 nan\n3 4\n4 5\n", "line 2: 'nan': heights must be finite"),
        ("1 2\n2 3\n2.5 inf\n4 5\n", "line 3: 'inf': heights must be finite"),
        ("1 2\n2 3\n3\n4 5\n", "line 3: '3': expected 2 numbers"),
        ("1 2\n2 3\n3 abc\n4 5\n", "line 3: 'abc': not a number"),
        ("1 2\n3 2\n2 3\n4 5\n5 6\n", "point 3: 2.0: positions must increase"),
        ("1 2\n2 2\n3 3\n4 5\n9 6\n", "positions must be equally spaced"),
        ("1 2\n2 3\n", "at least three heights"),
        ("1 2 3\n2 3 4\n3 4 5\n", "one or two columns"),
        ("1e400 2\n2 3\n3 4\n", "heights must be finite"),
    ],
)
def test_bad_text_gets_a_message_that_names_place_and_rule(tmp_path, text, message):
    with pytest.raises(InputError, match=message):
        read(written(tmp_path, text), unit="um")


def test_one_column_needs_its_step_and_unit(tmp_path):
    file = written(tmp_path, "1\n2\n1\n3\n")
    with pytest.raises(InputError, match="as spacing '"):
        read(file, unit="um")
    with pytest.raises(InputError, match="as unit '"):
        read(file, spacing=1e-6)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"unit": "umm"}, "not a unit of length; nearest known"),
        ({"unit": "mm um nm"}, "one unit, or two"),
        ({"spacing": "half"}, "a number and a unit"),
        ({"spacing": -1.0}, "above zero"),
        ({"spacing": float("nan")}, "above zero"),
    ],
)
def test_wrong_arguments(tmp_path, arguments, message):
    with pytest.raises(InputError, match=message):
        read(written(tmp_path, rows(POSITIONS, HEIGHTS)), **arguments)


def test_missing_file_and_folder(tmp_path):
    with pytest.raises(InputError, match=r"absent\.txt: no such file"):
        read(tmp_path / "absent.txt")
    with pytest.raises(InputError, match="is a folder"):
        read(tmp_path)


def test_whole_numbers_count_as_equal_steps():
    """Positions 0, 1, 2 are as good as their steps are equal, though written to no more than the step itself."""
    rows = "x_um z_um\n" + "".join(f"{i} {z}\n" for i, z in enumerate((0.1, 0.3, -0.2, 0.4, 0.0)))
    assert read_source(Source("whole.txt", rows.encode())).spacing == pytest.approx(1e-6)


@pytest.mark.parametrize("heading", ["x_um,z_volt", "x [mm],signal [mV]"])
def test_heading_that_names_no_length_is_not_guessed(heading):
    rows = "".join(f"{i * 0.001:.3f},{0.01 * (i % 7)}\n" for i in range(50))
    with pytest.raises(InputError, match="names no unit of length"):
        read_source(Source("volt.csv", f"{heading}\n{rows}".encode()))
    assert read_source(Source("volt.csv", f"{heading}\n{rows}".encode(), ("mm", "um"))).spacing == pytest.approx(1e-6)


@pytest.mark.parametrize(
    ("head", "unit", "said"),
    [
        ("x_um\tz_um\n", "mm", "the file names position um, height um, taken as position mm, height mm as told"),
        ("x_mm\tz_um\n", "mm, nm", "the file names position mm, height um, taken as position mm, height nm as told"),
        ("x_um\tz_um\n", "um", None),
        ("x_um\tz_um\n", "micron", None),
        ("x_um\tz_mV\n", "um", None),
        ("", "mm", None),
        ("x_um\tz_um\n", None, None),
    ],
)
def test_units_that_overrule_those_of_the_file_are_told(tmp_path, head, unit, said):
    profile = read(written(tmp_path, head + rows(POSITIONS, HEIGHTS)), unit=unit)
    assert profile.origin.get("units_overruled") == said


def test_the_unit_of_one_column_is_that_of_its_heights(tmp_path):
    text = "# unit: um\n# spacing: 0.5 um\n" + "".join(f"{z:.6f}\n" for z in HEIGHTS)
    profile = read(written(tmp_path, text), unit="nm")
    assert profile.origin["units_overruled"] == "the file names height um, taken as height nm as told"
    assert "units_overruled" not in read(written(tmp_path, text), unit="mm, um").origin
