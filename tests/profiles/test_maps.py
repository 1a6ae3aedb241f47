"""Areal files: text, x3p, SDF, and formats of the extra; units are never guessed."""

import json

import numpy as np
import pytest

from mixedlub.cli import main
from profiles import InputError, Profile, read
from profiles.maps import HeightMap, read_any, read_map

STEP = 0.5e-6


@pytest.fixture
def heights():
    """Ridges along y of 0.4 um, with a hole (m)."""
    y, x = np.mgrid[0:60, 0:80]
    z = 0.4e-6 * np.cos(2 * np.pi * x / 20) + 5e-8 * np.cos(2 * np.pi * y / 15)
    z[5:8, 10:14] = np.nan
    return z


def matrix(heights, head="", sep=" ", missing="nan"):
    rows = [[missing if np.isnan(v) else f"{v * 1e6:.6f}" for v in row] for row in heights]
    return head + "\n".join(sep.join(row) for row in rows) + "\n"


HEADS = {
    "settings": "unit: um\nspacing: 0.5 um\n",
    "gwyddion": "# Channel: Topography\n# Width: 40.0 µm\n# Height: 30.0 µm\n# Value units: um\n",
    "german": "# Kanal: Höhen\n# Breite: 0.040 mm\n# Höhe: 0.030 mm\n# Werteeinheiten: µm\n",
    "two steps": "z unit = um\ndx = 500 nm\ndy = 0.5 um\n",
}


@pytest.mark.parametrize("head", HEADS)
@pytest.mark.parametrize(("sep", "missing"), [(" ", "nan"), ("\t", "NaN"), (",", "nan"), (";", "---")])
def test_a_matrix_of_heights(tmp_path, heights, head, sep, missing):
    (tmp_path / "a.txt").write_text(matrix(heights, HEADS[head], sep, missing), encoding="utf-8")
    found = read_any(tmp_path / "a.txt")
    assert isinstance(found, HeightMap)
    assert found.heights == pytest.approx(heights, abs=1e-12, nan_ok=True)
    assert (found.spacing_x, found.spacing_y) == pytest.approx((STEP, STEP))
    assert found.holes == pytest.approx(12 / 4800)


def test_rows_that_begin_with_a_hole_belong_to_the_map(tmp_path, heights):
    heights[:3, :4] = np.nan
    (tmp_path / "a.txt").write_text(matrix(heights, HEADS["settings"]))
    assert read_map(tmp_path / "a.txt").heights.shape == heights.shape


@pytest.mark.parametrize("order", ["rows", "columns", "falling"])
def test_rows_of_places_and_heights(tmp_path, heights, order):
    y, x = np.mgrid[0:60, 0:80] * 0.5
    columns = [x, y, np.nan_to_num(heights, nan=0.0) * 1e6]
    if order == "columns":
        columns = [one.T for one in columns]
    if order == "falling":
        columns[1] = columns[1][::-1]
    np.savetxt(
        tmp_path / "a.txt", np.column_stack([one.ravel() for one in columns]), header="x_um y_um z_um", fmt="%.6f"
    )
    found = read_any(tmp_path / "a.txt")
    assert found.heights == pytest.approx(np.nan_to_num(heights, nan=0.0), abs=1e-12)
    assert (found.spacing_x, found.spacing_y) == pytest.approx((STEP, STEP))


@pytest.mark.parametrize(
    ("head", "keys", "rule"),
    [
        ("spacing: 0.5 um\n", {}, "give it as unit 'um'"),
        ("unit: um\n", {}, "give them as spacing '0.5 um'"),
        ("unit: V\nspacing: 0.5 um\n", {}, "no unit of its heights"),
        ("unit: um\nspacing: 0.5 um\n", {"spacing": "1 um"}, "steps of its own"),
    ],
)
def test_a_map_without_units_or_steps_is_refused_with_the_way_out(tmp_path, heights, head, keys, rule):
    (tmp_path / "a.txt").write_text(matrix(heights, head))
    with pytest.raises(InputError, match=rule):
        read_map(tmp_path / "a.txt", **keys)


def test_units_and_steps_from_the_caller(tmp_path, heights):
    (tmp_path / "a.txt").write_text(matrix(heights))
    found = read_map(tmp_path / "a.txt", unit="um", spacing="0.5 um")
    assert found.heights == pytest.approx(heights, abs=1e-12, nan_ok=True)
    np.savetxt(
        tmp_path / "b.txt", np.column_stack([v.ravel() for v in (*np.mgrid[0:20, 0:20][::-1], heights[:20, 20:40])])
    )
    with pytest.raises(InputError, match=r"unit 'mm, um' \(place, height\)"):
        read_map(tmp_path / "b.txt")
    assert read_map(tmp_path / "b.txt", unit="um, m").spacing_x == pytest.approx(1e-6)


@pytest.mark.parametrize(("factor", "asked"), [(1e3, "are the heights in nm"), (1e6, "are the heights in um")])
def test_heights_in_another_unit_than_the_file_says_are_doubted(tmp_path, heights, factor, asked):
    """x3p is in metres by its standard; some programs write other units."""
    import x3pio

    x3pio.write(tmp_path / "a.x3p", heights * factor, x_scale=STEP, y_scale=STEP)
    found = read_map(tmp_path / "a.x3p")
    assert "unlike a measured map" in found.origin["units_doubtful"]
    if factor == 1e6:
        assert asked in found.origin["units_doubtful"]
        right = read_map(tmp_path / "a.x3p", unit="m, um")
        assert right.heights == pytest.approx(heights, abs=1e-12, nan_ok=True)
        assert "taken as place m, height um as told" in right.origin["units_overruled"]


@pytest.mark.parametrize("reader", [read_map, read_any])
def test_formats_of_the_extra(tmp_path, heights, reader):
    """A NumPy array has neither units nor steps; along x first, as the library has it."""
    pytest.importorskip("SurfaceTopography")
    np.save(tmp_path / "a.npy", heights.T * 1e6)
    with pytest.raises(InputError, match="give them as spacing"):
        reader(tmp_path / "a.npy")
    with pytest.raises(InputError, match="a NumPy array without units of length: give them as unit"):
        reader(tmp_path / "a.npy", spacing="0.5 um")
    found = reader(tmp_path / "a.npy", spacing="0.5 um", unit="um")
    assert found.heights.shape == heights.shape
    assert found.heights == pytest.approx(heights, abs=1e-12, nan_ok=True)


def test_a_map_of_the_extra_with_units_of_its_own(tmp_path, heights):
    topography = pytest.importorskip("SurfaceTopography")
    whole = np.nan_to_num(heights, nan=0.0)
    made = topography.Topography(whole.T * 1e9, (80 * 500.0, 60 * 500.0), unit="nm")
    made.to_netcdf(str(tmp_path / "a.nc"))
    found = read_any(tmp_path / "a.nc")
    assert found.heights == pytest.approx(whole, abs=1e-12)
    assert (found.spacing_x, found.spacing_y) == pytest.approx((STEP, STEP))
    with pytest.raises(InputError, match="areal map of 60 x 80 points"):
        read(tmp_path / "a.nc")


def test_a_table_of_few_columns_is_no_map(tmp_path):
    np.savetxt(tmp_path / "a.txt", np.random.default_rng(0).normal(size=(50, 5)))
    with pytest.raises(InputError, match="one or two columns are needed"):
        read_any(tmp_path / "a.txt")
    with pytest.raises(InputError, match="matrix of at least 16 columns"):
        read_map(tmp_path / "a.txt")


@pytest.fixture
def folder(tmp_path, heights):
    """A map with a hole, a trace, and a file that is neither."""
    rng = np.random.default_rng(2)
    tile = np.tile(heights, (4, 4)) + 2e-9 * rng.normal(size=(240, 320))
    (tmp_path / "map.txt").write_text(matrix(tile, HEADS["settings"]))
    x = np.arange(4000) * 0.5
    trace = 0.3 * np.sin(2 * np.pi * x / 40) + 0.01 * rng.normal(size=x.size)
    np.savetxt(tmp_path / "trace.csv", np.column_stack((x, trace)), delimiter=",", header="x_um,z_um", comments="")
    (tmp_path / "letter.txt").write_text("Dear colleague,\nthe traces follow.\n")
    return tmp_path


def run(folder, *words):
    status = main(["profile", *(str(folder / word) for word in words), "--out", str(folder / "o"), "--xlsx"])
    return status, json.loads((folder / "o" / "profile.json").read_text())


def test_a_bad_file_among_several_is_one_sentence_and_the_others_are_one_table(folder, capsys):
    import openpyxl
    import pandas as pd

    status, rows = run(folder, "map.txt", "letter.txt", "trace.csv")
    said = capsys.readouterr().err.splitlines()[-1]
    assert status == 2
    assert "letter.txt: no column of numbers found in the text (2 other files evaluated)" in said
    assert [row["kind"] for row in rows] == ["map", "trace"]
    table = pd.read_csv(folder / "o" / "surfaces.csv")
    assert table["Sq_um"][0] == pytest.approx(rows[0]["areal"]["parameters"]["Sq_um"])
    assert np.isnan(table["Sq_um"][1])
    assert table["Rq_um"][1] == pytest.approx(rows[1]["parameters"]["Rq_um"])
    sheet = openpyxl.load_workbook(folder / "o" / "results.xlsx")["surfaces"]
    assert "Sq_um" in [cell.value for cell in sheet[1]]
    drawn = {path.stem for path in (folder / "o" / "figures").iterdir()}
    assert {"compared", "map_map", "map_texture", "map_material", "map_trace", "trace_trace"} <= drawn
    assert "map" in (folder / "o" / "figures" / "compared.svg").read_text()


def test_a_map_has_areal_parameters_lay_and_traces(folder, capsys):
    """Ridges of 0.4 um along y with ripples of 0.05 um along them; 2.5 um leaves 0.957 of waves of 10 um."""
    status, (row,) = run(folder, "map.txt")
    assert status == 0
    p = row["areal"]["parameters"]
    left = 2.0 ** -((2.5 / 10) ** 2), 2.0 ** -((2.5 / 7.5) ** 2)
    known = np.hypot(0.4 * left[0], 0.05 * left[1]) / np.sqrt(2)
    assert p["Sq_um"] == pytest.approx(known, rel=0.01)
    assert p["Std_deg"] == pytest.approx(90.0, abs=1.0)
    assert p["Str"] < 0.2
    assert row["areal"]["holes_percent"] == pytest.approx(0.25)
    assert row["areal"]["moments"]["m2"] == pytest.approx(0.5 * (0.4 * left[0] * 2 * np.pi / 10) ** 2, rel=0.05)
    assert row["parameters"]["Rq_um"] > 5 * row["along"]["parameters"]["Rq_um"]
    assert "192 of 76800 points (0.25 %) have no height and are left out" in capsys.readouterr().err
    for which in ("across", "along"):
        cut = read(folder / "o" / f"map_{which}.csv")
        assert isinstance(cut, Profile)
        assert cut.spacing == pytest.approx(STEP)


def test_holes_are_filled_on_request(folder, capsys):
    main(["profile", str(folder / "map.txt"), "--holes", "fill", "--no-figures", "--out", str(folder / "o")])
    assert "are filled from their rims" in capsys.readouterr().err
    assert main(["profile", str(folder / "map.txt"), "--holes", "drop", "--out", str(folder / "p")]) == 2
    assert "--holes: 'drop': must be mask or fill" in capsys.readouterr().err


def test_a_map_without_units_names_the_option(folder, heights, capsys):
    (folder / "bare.txt").write_text(matrix(heights))
    assert main(["profile", str(folder / "bare.txt"), "--out", str(folder / "o")]) == 2
    assert "as --unit 'um'" in capsys.readouterr().err
    words = ["--unit", "um", "--spacing", "0.5 um", "--no-figures"]
    assert main(["profile", str(folder / "bare.txt"), *words, "--out", str(folder / "o")]) == 0
