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


@pytest.mark.parametrize("delimiter", ["\t", " ", ";"])
@pytest.mark.parametrize(("first", "second"), [("0.5", "1,500"), ("0,5", "1,500.0"), ("0,5", "2.5")])
def test_a_comma_and_a_point_as_decimal_marks_are_refused_with_both_cells(tmp_path, delimiter, first, second):
    text = (
        rows(np.arange(20), np.arange(20), delimiter, form="{:.0f}") + f"20{delimiter}{first}\n21{delimiter}{second}\n"
    )
    with pytest.raises(InputError) as error:
        read(written(tmp_path, text), unit="um")
    assert first in str(error.value)
    assert second in str(error.value)


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
        ("1 2\nnan 3\n3 4\n4 5\n", "line 2: 'nan': positions must be finite"),
        ("1 2\n2 3\n3 nan\n4 nan\n5 nan\n", "more than half of the points are missing"),
        ("1 2\n2 3\n2.5 inf\n4 5\n", "line 3: 'inf': heights must be finite"),
        ("1 2\n2 3\n3\n4 5\n", "line 3: '3': expected 2 numbers"),
        ("1 2\n2 3\n3 abc\n4 5\n", "line 3: 'abc': not a number"),
        ("1 2\n3 2\n2 3\n4 5\n5 6\n", "point 3: 2.0: positions must increase"),
        ("1 2\n2 2\n3 3\n4 5\n4 6\n9 7\n", "positions must be equally spaced"),
        ("1 2\n2 3\n", "at least three heights"),
        ("1 2 3\n2 3 4\n3 4 5\n", "one or two columns.*not 3: save each column of heights.*x3p and SDF"),
        ("1e400 2\n2 3\n3 4\n", "positions must be finite"),
    ],
)
def test_bad_text_gets_a_message_that_names_place_and_rule(tmp_path, text, message):
    with pytest.raises(InputError, match=message):
        read(written(tmp_path, text), unit="um")


@pytest.mark.parametrize("ending", [".x3p", ".xlsx", ".opdx", ".ZIP"])
@pytest.mark.parametrize("data", [b"hello world\n", bytes(range(1, 256))])
def test_what_is_not_of_the_format_of_its_name_is_said_not_to_be(tmp_path, ending, data):
    (tmp_path / f"trace{ending}").write_bytes(data)
    with pytest.raises(
        InputError, match=f"is no {ending.lower()} file although its name says so: damaged or of another format"
    ):
        read(tmp_path / f"trace{ending}")


def test_zero_bytes_are_not_an_empty_file(tmp_path):
    (tmp_path / "trace.opdx").write_bytes(bytes(100))
    with pytest.raises(InputError, match="holds nothing but zero bytes"):
        read(tmp_path / "trace.opdx")


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


SURFACE = 0.3 * np.sin(np.arange(400) / 3.0) + 0.05 * np.sin(np.arange(400) / 1.7)  # um, typical slope 0.15
ALONG = 0.5 * np.arange(400)  # um


def table_of(x, z):
    return "".join(f"{a:.12g},{b:.12g}\n" for a, b in zip(x, z))


@pytest.mark.parametrize(
    ("heading", "x", "z", "told"),
    [
        ("x,z [nm]", 1.0, 1e3, "the file names nm for the heights only; inferred from the numbers: position um"),
        ("x [mm],z", 1e-3, 1.0, "the file names mm for the positions only; inferred from the numbers: height um"),
        ("x_mm,Channel A", 1e-3, 1.0, "the file names mm for the positions only"),
        ("x_mm,trace_a", 1e-3, 1.0, "the file names mm for the positions only"),
        ("x_mm,probe_in", 1e-3, 1.0, "the file names mm for the positions only"),
        ("x_in,z_uin", 1 / 25400, 1 / 0.0254, "the file names uin for the heights only"),
        ("x,z", 1 / 25400, 1 / 0.0254, "inferred from the numbers: position in, height uin"),
    ],
)
def test_a_unit_of_one_column_stands_and_the_other_is_inferred(tmp_path, heading, x, z, told):
    """In `x,z [nm]` only the heights are in nm; `Channel A` is no angstrom, `probe_in` no inch."""
    profile = read(written(tmp_path, f"{heading}\n{table_of(ALONG * x, SURFACE * z)}"))
    assert profile.spacing == pytest.approx(0.5e-6)
    assert profile.heights == pytest.approx(SURFACE * 1e-6, rel=1e-6)
    assert profile.origin["units_inferred"].startswith(told) or profile.origin["units_inferred"].endswith(told)


@pytest.mark.parametrize(
    ("heading", "x", "z"),
    [
        ("x [in],z/in", 0.0254, 0.0254),
        ("x_m,z (m)", 1.0, 1.0),
        ("x [mm],z [A]", 1e-3, 1e-10),
        ("x [mm],z Å", 1e-3, 1e-10),
        ("x_inch,z_mil", 0.0254, 2.54e-5),
    ],
)
def test_short_names_of_units_count_where_they_are_marked(tmp_path, heading, x, z):
    profile = read(written(tmp_path, f"{heading}\n{table_of(ALONG * 1e-6, SURFACE * 1e-6)}"))
    assert (profile.spacing, profile.heights[1]) == pytest.approx((0.5e-6 * x, SURFACE[1] * 1e-6 * z), rel=1e-6)
    assert "units_inferred" not in profile.origin


def test_a_known_unit_that_leaves_nothing_plausible_is_refused(tmp_path):
    heights = SURFACE * 1e6  # as nm a slope of 150 at the largest step there is
    with pytest.raises(InputError, match=r"names nm for the heights only, and none can be inferred: .* as unit '"):
        read(written(tmp_path, "x,z [nm]\n" + table_of(ALONG * 1e-9, heights)))


@pytest.mark.parametrize(
    ("x", "z", "pairs"),
    [
        (1e-3, 0.002, "'mm, mm' and 'mm, um'"),  # superfinished, slope 3e-4: read as 1000 times rougher
        (1 / 25.4, 1 / 0.0254, "'mil, uin' and 'mm, um'"),
    ],
)
def test_two_plausible_pairs_are_both_named_and_refused(tmp_path, x, z, pairs):
    with pytest.raises(InputError, match=pairs) as refused:
        read(written(tmp_path, table_of(ALONG * x, SURFACE * z)))
    assert "about as plausible" in str(refused.value)
    assert "as unit '" in str(refused.value)


@pytest.mark.parametrize(
    "text", ["x_um,z_um\n" + rows(POSITIONS, HEIGHTS, ","), "spacing: 0.5 um\nunit: um\n" + "0.1\n0.2\n0.1\n0.3\n"]
)
def test_a_step_that_overrules_the_file_is_told(tmp_path, text):
    file = written(tmp_path, text)
    profile = read(file, spacing="1 um")
    assert profile.spacing == 1e-6
    assert profile.origin["spacing_overruled"] == "the file has a step of 0.5 um, taken as 1 um as told"
    assert "spacing_overruled" not in read(file, spacing="0.5 um").origin


def test_bad_positions_are_replaced_by_the_step_that_is_told(tmp_path):
    text = "x_um,z_um\n" + "".join(f"{x:.3f},{z:.6f}\n" for x, z in zip((0, 1, 3, 2, 9, 10), HEIGHTS))
    with pytest.raises(InputError, match=r"give the step as spacing '0\.5 um'"):
        read(written(tmp_path, text))
    told = read(written(tmp_path, text), spacing="0.5 um")
    assert told.spacing == 0.5e-6
    assert "positions must increase" in told.origin["spacing_overruled"]


def test_positions_that_fall_by_whole_numbers_are_not_taken_for_a_decimal_comma(tmp_path):
    """7999,142 is two columns, not the number 7999.142."""
    falling = "".join(f"{50 - i},{abs(round(1000 * z))}\n" for i, z in enumerate(HEIGHTS))
    for heading in ("x_um,z_nm\n", ""):
        trace = read(written(tmp_path, heading + falling), unit="um, nm", spacing=None)
        assert trace.spacing == pytest.approx(1e-6)
        assert trace.heights[-1] == pytest.approx(abs(HEIGHTS[0]) * 1e-6, abs=1e-9)


def test_a_heading_of_two_names_parts_two_columns_at_their_comma(tmp_path):
    steps = "".join(f"{i // 2},{i}\n" for i in range(50))
    with pytest.raises(InputError, match="positions must be equally spaced"):
        read(written(tmp_path, "x_um,z_nm\n" + steps))
    one = read(written(tmp_path, "Height, um\n" + steps), unit="um", spacing="1 um")
    assert one.heights[3] == pytest.approx(1.3e-6)
    one = read(written(tmp_path, "# unit: um\n# taken: in 3,5 s\n" + steps), spacing="1 um")
    assert one.heights[3] == pytest.approx(1.3e-6)


@pytest.mark.parametrize("delimiter", [";", ",", "\t", " "])
@pytest.mark.parametrize("missing", ["NaN", "n/a", "---", "***", "BAD", ""])
def test_a_missing_height_is_masked_and_bridged(tmp_path, delimiter, missing):
    if delimiter == " " and not missing:
        pytest.skip("between blanks an empty cell is none")
    lines = rows(POSITIONS, HEIGHTS, delimiter).splitlines()
    lines[9] = lines[9].split(delimiter)[0] + delimiter + missing
    profile = read(written(tmp_path, "\n".join(lines)), unit="um")
    whole = read(written(tmp_path, rows(POSITIONS, HEIGHTS, delimiter)), unit="um")
    assert np.flatnonzero(~profile.valid).tolist() == [9]
    assert np.isclose(profile.heights[9], (whole.heights[8] + whole.heights[10]) / 2)
    assert np.array_equal(profile.heights[profile.valid], whole.heights[profile.valid])
    assert profile.spacing == whole.spacing
    assert "1 missing points bridged and masked" in profile.steps


def test_a_missing_height_puts_no_doubt_on_the_units(tmp_path):
    lines = rows(ALONG, SURFACE).splitlines()
    lines[20] = f"{ALONG[20]}\tNaN"
    trace = read(written(tmp_path, "x_um\tz_um\n" + "\n".join(lines)))
    assert not trace.valid.all()
    assert "units_doubtful" not in trace.origin


def test_a_missing_height_among_heights_alone_is_masked(tmp_path):
    profile = read(written(tmp_path, "# spacing: 0.25 um\n# unit: nm\n1\n2\nnan\n4\n5\n"))
    assert profile.valid.tolist() == [True, True, False, True, True]
    assert profile.heights[2] == pytest.approx(3e-9)


def workbook(tmp_path, *sheets):
    import openpyxl

    book = openpyxl.Workbook()
    book.remove(book.active)
    for name, lines in sheets:
        sheet = book.create_sheet(name)
        for line in lines:
            sheet.append(line)
    book.save(tmp_path / "trace.xlsx")
    return tmp_path / "trace.xlsx"


PAIRS = [list(pair) for pair in zip(POSITIONS.tolist(), HEIGHTS.tolist())]


@pytest.mark.parametrize("heading", [["x [µm]", "z [µm]"], ["position um", "height um"]])
def test_a_workbook_of_two_columns_is_a_trace(tmp_path, heading):
    path = workbook(tmp_path, ("About", [["Operator", "Meyer"], [1, 2]]), ("Trace", [heading, *PAIRS]))
    profile = read(path)
    assert profile.spacing == pytest.approx(0.5e-6)
    assert profile.heights == pytest.approx(HEIGHTS * 1e-6, rel=1e-12)
    assert profile.origin["sheet"] == "Trace"
    assert any("sheet 'Trace' of 2" in step for step in profile.steps)


def test_a_workbook_of_heights_takes_its_step_from_a_line_or_the_caller(tmp_path):
    heights = [[z] for z in HEIGHTS.tolist()]
    profile = read(workbook(tmp_path, ("S", [["spacing: 0.25 um"], ["unit: um"], *heights])))
    assert profile.spacing == pytest.approx(0.25e-6)
    told = read(workbook(tmp_path, ("S", [["z"], *heights])), unit="um", spacing="0.25 um")
    assert np.array_equal(told.heights, profile.heights)
    assert told.spacing == pytest.approx(0.25e-6)


def test_empty_columns_and_cells_of_a_workbook(tmp_path):
    lines = [[None, "x [um]", None, "z [um]"], *([None, x, None, z] for x, z in PAIRS)]
    lines[5][3] = None
    profile = read(workbook(tmp_path, ("S", lines)))
    assert profile.heights.size == HEIGHTS.size
    assert np.flatnonzero(~profile.valid).tolist() == [4]


@pytest.mark.parametrize(
    ("lines", "rule"),
    [([["no", "numbers"]], "no sheet of the workbook holds numbers"), ([[1, 2, 3]] * 4, "not 3: save")],
)
def test_a_workbook_that_is_no_trace(tmp_path, lines, rule):
    with pytest.raises(InputError, match=rule):
        read(workbook(tmp_path, ("S", lines)), unit="um")
