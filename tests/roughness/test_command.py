"""`mixedlub profile` over every measured file and every shipped trace, as a user runs it."""

import json
from pathlib import Path

import numpy as np
import pytest

import profiles
from mixedlub.cli import main
from mixedlub.schema.findings import collected
from tests.profiles.test_manifest import FILES, SDF, X3P
from tests.profiles.test_shipped import TABLE_1
from tests.roughness.conftest import rig_of

TRACES = Path(profiles.__file__).parent / "traces"

# Mitutoyo SurfTest report: what the instrument printed, with the unit of the last printed digit
INSTRUMENT = {
    "Ra_um": (3.308, 1e-3),
    "Rq_um": (3.959, 1e-3),
    "Rz_um": (18.485, 1e-3),
    "Rp_um": (8.244, 1e-3),
    "Rv_um": (10.240, 1e-3),
    "Rt_um": (22.233, 1e-3),
    "Rz1max_um": (22.062, 1e-3),
    "Rsk": (-0.144, 1e-3),
    "Rku": (2.463, 1e-3),
    "Rdq": (0.157, 1e-3),
}


@pytest.mark.parametrize(
    "path", [*FILES, "stylus_misc/opdx-3.txt", *(f"format_samples/{name}" for name in (*SDF, *X3P))]
)
def test_every_measured_file(shared, evaluated, capsys, path):
    file = shared / "data" / "profiles" / path
    row = evaluated(file)
    assert row["file"] == str(file)
    assert 0 < row["parameters"]["Ra_um"] <= row["parameters"]["Rq_um"] <= row["parameters"]["Rz_um"]
    assert all(row["moments"][name] > 0 for name in ("m0_um2", "m2", "m4_per_um2", "spacing_um"))
    assert all(row["asperities"][name] > 0 for name in ("density_per_mm2", "radius_um", "sigma_um", "nayak"))
    assert row["gaussian"]["verdict"] in ("gaussian", "gaussian_bulk", "plateau", "not_gaussian")
    said = capsys.readouterr()
    assert all(word in said.out for word in ("Ra ", "m4 ", "radius ", "Gaussian"))
    assert said.err.count("note:") == len(row["warnings"])


@pytest.mark.parametrize("name", TABLE_1)
def test_shipped_traces_have_the_published_parameters(evaluated, name):
    row = evaluated(TRACES / f"{name}.txt", "--cutoff-mm", "0.8")["parameters"]
    assert tuple(round(row[key], 3) for key in ("Ra_um", "Rq_um", "Rz_um")) == TABLE_1[name]


@pytest.mark.parametrize("name", [n for n in TABLE_1 if n != "0036"])
def test_shipped_traces_ask_for_the_cutoff_of_the_table_by_themselves(evaluated, name):
    assert evaluated(TRACES / f"{name}.txt")["moments"]["cutoff_mm"] == pytest.approx(0.8)


def test_instruments_values_come_back_under_its_own_convention(shared, evaluated):
    row = evaluated(shared / "data" / "profiles" / "reference" / "mitutoyo_2_mock.xlsx")
    assert row["parameters"]["convention"] == "Mitutoyo"
    for name, (value, digit) in INSTRUMENT.items():
        # a tie between two last digits (18.48455) may fall either way in print
        assert row["parameters"][name] == pytest.approx(value, abs=0.501 * digit), name
    for name, value in {"Rk_um": 11.440, "Rpk_um": 2.912, "Rvk_um": 3.980}.items():
        assert row["parameters"][name] == pytest.approx(value, rel=0.08), name
    assert not any("the file states" in w for w in row["warnings"])


def test_figures_show_what_the_record_says(shared, tmp_path):
    file = shared / "data" / "profiles" / "reference" / "mitutoyo_2_mock.xlsx"
    assert main(["profile", str(file), "--out", str(tmp_path)]) == 0
    drawn = {p.stem.rpartition("_")[2]: p.read_text() for p in (tmp_path / "figures").iterdir()}
    assert set(drawn) == {"trace", "probability", "abbott", "spectrum"}
    assert "Rk 11.4, Rpk 2.73, Rvk 3.95" in drawn["abbott"]
    assert "Ra 3.31, Rq 3.96, Rz 18.5" in drawn["trace"]


def test_core_parameters_under_iso_lie_within_eight_percent_of_the_instrument(shared, evaluated):
    file = shared / "data" / "profiles" / "reference" / "mitutoyo_2_mock.xlsx"
    row = evaluated(file, "--convention", "ISO 4287:1997")["parameters"]
    assert row["Rk_um"] != pytest.approx(11.440, rel=0.02)
    for name, value in {"Rk_um": 11.440, "Rpk_um": 2.912, "Rvk_um": 3.980}.items():
        assert row[name] == pytest.approx(value, rel=0.08), name


def test_header_of_the_trap_disagrees(shared, evaluated, capsys):
    row = evaluated(shared / "data" / "profiles" / "reference" / "mitutoyo_mock.xlsx")
    for name in ("Ra 0.018", "Rq 0.027", "Rz 0.191"):
        assert any(f"the file states {name} um" in w for w in row["warnings"]), name
    assert "header and heights do not belong together" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["edm", "mill", "sine", "square"])
def test_softgauges_agree_with_what_nist_stored_in_them(shared, evaluated, name):
    row = evaluated(shared / "data" / "profiles" / "reference" / f"{name}.xml")
    assert not any("the file states" in w for w in row["warnings"])


def test_pit_is_masked_on_request(shared, evaluated):
    file = shared / "data" / "profiles" / "stylus_misc" / "xy-4.txt"
    plain, masked = evaluated(file), evaluated(file, "--outliers", "5", "--method", "robust")
    assert masked["parameters"]["Rq_um"] < 0.5 * plain["parameters"]["Rq_um"]
    assert any("outliers beyond 5 sigma masked" in step for step in masked["steps"])
    assert any("robust Gaussian" in step for step in masked["steps"])


@pytest.mark.parametrize(
    ("options", "named"),
    [
        (("--convention", "ISO 4287"), "'ISO 4287:1997'"),
        (("--method", "gauss"), "'gaussian'"),
        (("--form", "cirkle"), "'circle'"),
        (("--cutoff-mm", "80"), "shorter than the cut-off"),
        (("--short-cutoff-um", "900", "--cutoff-mm", "0.8"), "below the cut-off"),
        (("--trim", "9"), "no profile of"),
    ],
)
def test_option_that_cannot_be_is_told(tmp_path, capsys, options, named):
    assert main(["profile", str(TRACES / "0258.txt"), "--out", str(tmp_path / "o"), *options]) == 2
    said = capsys.readouterr().err
    assert named in said
    assert "Traceback" not in said
    assert not (tmp_path / "o").exists()


def test_study_and_profile_prepare_a_trace_alike(evaluated):
    """One preparation: the moments of a study's surface are those that the command prints."""

    row = evaluated(TRACES / "0450.txt")["moments"]
    made = rig_of(TRACES, rough={"profile": "0450.txt", "cutoff_mm": 0.8, "short_cutoff_um": 2.5}).surface("rough")
    assert made.m0 * 1e12 == pytest.approx(row["m0_um2"], rel=1e-12)
    assert made.m2 == pytest.approx(row["m2"], rel=1e-12)
    assert made.m4 * 1e-12 == pytest.approx(row["m4_per_um2"], rel=1e-12)


def test_what_is_cut_off_a_trace_is_told_by_command_and_study(tmp_path, evaluated, capsys):
    trace = profiles.shipped("0258")
    fallen = trace.heights - 0.5 * np.maximum(0.0, trace.positions - 4.4e-3)
    rows = "".join(f"{x * 1e6:.2f},{z * 1e6:.5f}\n" for x, z in zip(trace.positions, fallen))
    (tmp_path / "fallen.csv").write_text("x_um,z_um\n" + rows)
    cut = evaluated(tmp_path / "fallen.csv", "--cutoff-mm", "0.8")
    assert "note: " in (said := capsys.readouterr().err)
    assert "edges cut: 0 mm at the start, 0.4" in said
    whole = evaluated(tmp_path / "fallen.csv", "--cutoff-mm", "0.8", "--no-edges")
    assert whole["parameters"]["Rt_um"] > 2 * cut["parameters"]["Rt_um"]
    named = {"profile": "fallen.csv", "cutoff_mm": 0.8, "short_cutoff_um": 2.5}
    with collected() as found:
        made = rig_of(tmp_path, worn=named).surface("worn")
    assert [(note.code, note.place) for note in found] == [("trace_quality", "surfaces.worn")]
    assert made.m0 * 1e12 == pytest.approx(cut["moments"]["m0_um2"], rel=1e-9)
    made = rig_of(tmp_path, worn={**named, "edges": False}).surface("worn")
    assert made.m0 * 1e12 == pytest.approx(whole["moments"]["m0_um2"], rel=1e-9)


def test_study_keeps_a_profile_that_the_instrument_filtered(shared):
    folder = shared / "data" / "profiles" / "reference"
    kept = rig_of(folder, turned={"profile": "mitutoyo_2_mock.xlsx"}).profile("turned")
    assert dict(kept.cutoffs) == pytest.approx({"cutoff": 2.5e-3, "short_cutoff": 8e-6})
    assert len(kept.steps) == 1


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--spacing", "0.5"], "--spacing: '0.5': a length is a number and a unit, as in '0.5 um'"),
        (["--unit", "furlong"], "--unit: 'furlong': not a unit of length"),
        (["--form", "cubic"], "--form: 'cubic': must be a known form"),
        (["--method", "median"], "--method: 'median': must be a known filter"),
        (["--convention", "DIN"], "--convention: 'DIN': must be a known convention"),
        (["--cutoff-mm", "0"], "'--cutoff-mm'"),
        (["--trim", "-1"], "'--trim'"),
    ],
)
def test_an_option_is_refused_by_its_name(options, said, tmp_path, capsys):
    assert main(["profile", str(TRACES / "0258.txt"), "--no-figures", "--out", str(tmp_path), *options]) == 2
    told = capsys.readouterr().err
    assert said in told
    assert "Input should" not in told


def test_a_trace_without_units_tells_the_options_that_give_them(tmp_path, capsys):
    (tmp_path / "heights.txt").write_text("1\n2\n1\n3\n")
    assert main(["profile", str(tmp_path / "heights.txt"), "--out", str(tmp_path / "out")]) == 2
    assert "--spacing '0.5 um'" in capsys.readouterr().err
    assert main(["profile", str(tmp_path / "heights.txt"), "--spacing", "1 um", "--out", str(tmp_path / "out")]) == 2
    assert "--unit 'um'" in capsys.readouterr().err


def test_inferred_units_are_a_warning_that_is_printed(tmp_path, evaluated, capsys):
    heights = [float(line) * 1e-3 for line in (TRACES / "0258.txt").read_text().splitlines()[7:]]
    (tmp_path / "bare.txt").write_text("".join(f"{i * 0.25:.2f} {z:.4f}\n" for i, z in enumerate(heights)))
    row = evaluated(tmp_path / "bare.txt")
    assert any("the file names no units; inferred from the numbers: position" in text for text in row["warnings"])
    assert "the file names no units" in capsys.readouterr().err
    assert not any("names no units" in text for text in evaluated(TRACES / "0258.txt")["warnings"])


def test_units_that_overrule_the_file_are_told_once_even_where_the_trace_is_then_refused(tmp_path, capsys):
    file = tmp_path / "trace.txt"
    trace = profiles.shipped("0258")
    heights = "".join(f"{z * 1e6:.6f}\n" for z in trace.heights[:8000])
    file.write_text(f"# unit: um\n# spacing: {trace.spacing * 1e6} um\n{heights}")
    told = f"note: {file}: units: the file names height um, taken as height mm as told"
    for options, status in (((), 0), (("--cutoff-mm", "100"), 2)):
        out = str(tmp_path / "o")
        assert main(["profile", str(file), "--unit", "mm", "--no-figures", "--out", out, *options]) == status
        assert capsys.readouterr().err.count(told) == 1


@pytest.mark.parametrize("command", ["check", "simulate", "study", "profile"])
def test_a_stuck_stylus_is_refused_by_every_command(command, tmp_path, capsys):
    trace = tmp_path / "stuck.csv"
    trace.write_text("x_um,z_um\n" + "".join(f"{i * 0.5},0.3\n" for i in range(4000)))
    moments = "m0_um2 = 0.13\nm2 = 0.0026\nm4_per_um2 = 0.0038"
    case = Path(__file__).parents[2] / "examples" / "case"
    text = (case / "system.toml").read_text(encoding="utf-8")
    assert moments in text
    (tmp_path / "system.toml").write_text(text.replace(moments, 'profile = "stuck.csv"'), encoding="utf-8")
    (tmp_path / "recordings.csv").write_bytes((case / "recordings.csv").read_bytes())
    levels = "[conditions]\ntorque_Nm = [50]\nspeed_rpm = [500]\noil_temperature_C = [60]\n"
    study = text.replace(moments, 'profile = "stuck.csv"').replace('"mixedlub-case/1"', '"mixedlub-study/1"')
    study = study.replace('kind = "gear_pair"\n', "").partition("[uncertainty]")[0] + levels
    (tmp_path / "study.toml").write_text(study, encoding="utf-8")
    named = {"study": tmp_path / "study.toml", "profile": trace}.get(command, tmp_path)
    assert main([command, str(named), *(["--out", str(tmp_path / "o")] if command != "check" else [])]) == 2
    said = capsys.readouterr().err
    assert "stuck.csv: '0.3 um': all heights are the same: a stuck stylus or an empty channel" in said
    assert command == "profile" or "surfaces.ground: " in said


def test_a_study_tells_of_inferred_units_and_an_overruled_step_is_told_by_the_command(tmp_path, capsys):

    trace = profiles.shipped("0258")
    rows = "".join(f"{x * 1e3:.6f},{z * 1e6:.4f}\n" for x, z in zip(trace.positions, trace.heights))
    (tmp_path / "bare.csv").write_text(rows)
    with collected() as found:
        rig_of(tmp_path, bare={"profile": "bare.csv", "cutoff_mm": 0.8, "short_cutoff_um": 2.5}).surface("bare")
    assert ("trace_quality", "surfaces.bare") in [(note.code, note.place) for note in found]
    out = str(tmp_path / "o")
    assert main(["profile", str(tmp_path / "bare.csv"), "--spacing", "0.3 um", "--no-figures", "--out", out]) == 0
    out += "2"
    (tmp_path / "named.csv").write_text("x_mm,z_um\n" + rows)
    assert main(["profile", str(tmp_path / "named.csv"), "--spacing", "0.3 um", "--no-figures", "--out", out]) == 0
    assert "spacing: the file has a step of 0.25 um, taken as 0.3 um as told" in capsys.readouterr().err


def test_a_bad_trace_is_named_by_its_path_and_its_points(tmp_path, capsys):
    (tmp_path / "a").mkdir()
    (tmp_path / "b").mkdir()
    good = "x_um,z_um\n" + "".join(f"{i * 0.5},{z:.4f}\n" for i, z in enumerate(np.sin(np.arange(400))))
    (tmp_path / "a" / "t.csv").write_text(good)
    (tmp_path / "b" / "t.csv").write_text("\n".join(good.splitlines()[:6]) + "\n")
    files = [str(tmp_path / folder / "t.csv") for folder in "ab"]
    assert main(["profile", *files, "--no-figures", "--out", str(tmp_path / "o")]) == 2
    assert f"{files[1]}: a trace needs at least 8 points, has 5" in capsys.readouterr().err
    assert main(["profile", *files[:1], "--cutoff-mm", "80", "--no-figures", "--out", str(tmp_path / "o")]) == 2
    assert f"{files[0]}: cut-off (mm): 80.0: the trace of" in capsys.readouterr().err


def test_a_unit_that_makes_the_steps_too_long_is_asked_about(tmp_path, capsys):
    """It said `number of sections: 5000`."""
    heights = "".join(f"{i * 0.5},{z:.4f}\n" for i, z in enumerate(np.sin(np.arange(8000))))
    (tmp_path / "t.csv").write_text("x_um,z_um\n" + heights)
    options = ["--unit", "mm", "--no-figures", "--out", str(tmp_path / "o")]
    assert main(["profile", str(tmp_path / "t.csv"), *options]) == 2
    told = capsys.readouterr().err
    assert "cut-off (mm): 0.8: each sampling length needs at least 8 points, the cut-off holds 1.6 of 500 um" in told


def test_positions_that_go_back_tell_the_option(tmp_path, capsys):
    (tmp_path / "t.csv").write_text("x_um,z_um\n" + "".join(f"{x},{x % 3}\n" for x in (0, 1, 2, 4, 3, 11, 12, 13, 20)))
    assert main(["profile", str(tmp_path / "t.csv"), "--no-figures", "--out", str(tmp_path / "o")]) == 2
    assert "if only their column is bad, give the step as --spacing '0.5 um'" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["iso4287", "iso 4287", "ISO-4287", "iso42871997"])
def test_a_convention_is_recognised_without_case_and_blanks(name, tmp_path, capsys):
    out = str(tmp_path / "o")
    assert main(["profile", str(TRACES / "0258.txt"), "--no-figures", "--out", out, "--convention", name]) == 2
    assert "nearest known: 'ISO 4287:1997'" in capsys.readouterr().err


def test_every_file_that_cannot_be_read_is_named_at_once(tmp_path, capsys):
    (tmp_path / "empty.csv").write_text("")
    rows = [f"{i * 0.5},{z:.4f}" for i, z in enumerate(np.sin(np.arange(400)))]
    rows[200] = rows[200].replace("100.0", "NaN")
    (tmp_path / "t.csv").write_text("x_um,z_um\n" + "\n".join(rows) + "\n")
    files = [str(tmp_path / name) for name in ("t.csv", "empty.csv", "none.csv")]
    assert main(["profile", *files, str(TRACES / "0258.txt"), "--no-figures", "--out", str(tmp_path / "o")]) == 2
    said = capsys.readouterr().err
    assert f"{files[0]}: line 202: 'NaN': positions must be finite numbers; and {files[1]}: the file is empty" in said
    assert f"{files[2]}: no such file" in said

    (row,) = json.loads((tmp_path / "o" / "profile.json").read_text())
    assert row["file"] == str(TRACES / "0258.txt")
    assert "1 other file evaluated" in said


def test_a_trace_that_cannot_be_evaluated_stops_no_other(tmp_path, capsys):
    (tmp_path / "flat.csv").write_text("x_um,z_um\n" + "".join(f"{i * 0.5},0.1\n" for i in range(400)))
    out, files = tmp_path / "o", [str(tmp_path / "flat.csv"), str(TRACES / "0258.txt")]
    assert main(["profile", *files, "--no-figures", "--out", str(out)]) == 2
    assert len(json.loads((out / "profile.json").read_text())) == 1
    assert f"{tmp_path / 'flat.csv'}: " in capsys.readouterr().err


@pytest.mark.parametrize("name", ["ridges.x3p", "ridges.sdf"])
@pytest.mark.parametrize("degrees", [0.0, 30.0])
def test_of_a_height_map_a_trace_across_the_lay_is_evaluated_and_said(tmp_path, evaluated, name, degrees):
    """Ridges of 0.4 um and 20 um: across them m0 is A^2/2 and m2 k^2 A^2/2, along them nothing."""
    import sdfio
    import x3pio

    y, x = np.mgrid[0:200, 0:240]
    along = x * np.cos(np.radians(degrees)) + y * np.sin(np.radians(degrees))
    heights = 0.4e-6 * np.cos(2 * np.pi * along / 20.0) + 1e-8 * y
    heights[50, 60] = np.nan
    {"ridges.x3p": x3pio.write, "ridges.sdf": sdfio.write}[name](tmp_path / name, heights, x_scale=1e-6, y_scale=1e-6)
    row = evaluated(tmp_path / name)
    (said,) = (step for step in row["steps"] if "across the lay of a map" in step)
    assert float(said.split(" degrees")[0].rpartition(" ")[2]) == pytest.approx(degrees, abs=1.0)
    assert row["moments"]["m0_um2"] == pytest.approx(0.08, rel=0.05)
    assert row["moments"]["m2"] == pytest.approx(0.08 * (2 * np.pi / 20) ** 2, rel=0.05)


def test_a_height_map_has_no_step_to_tell(tmp_path, capsys):
    import sdfio

    sdfio.write(tmp_path / "a.sdf", np.random.default_rng(1).normal(size=(40, 40)) * 1e-7, x_scale=1e-6, y_scale=1e-6)
    words = ["profile", str(tmp_path / "a.sdf"), "--no-figures", "--out", str(tmp_path / "o"), "--spacing", "1 um"]
    assert main(words) == 2
    assert "--spacing" in capsys.readouterr().err
    with pytest.raises(
        profiles.InputError, match=r'map = "a\.sdf".*along_direction\(profiles\.maps\.read_map\("a\.sdf"\), angle\)'
    ):
        profiles.read(tmp_path / "a.sdf")


def test_limits_of_form_and_trim_are_told_in_plain_numbers(tmp_path, capsys):
    words = ["profile", str(TRACES / "0258.txt"), "--no-figures", "--out", str(tmp_path / "o")]
    assert main([*words, "--form", "polynomial-99"]) == 2
    assert "--form: 'polynomial-99': must be polynomial-0 to polynomial-20" in capsys.readouterr().err
    assert main([*words, "--trim", "3"]) == 2
    assert "trimmed lengths (mm): (2.4, 2.4)" in capsys.readouterr().err


def test_figures_of_an_earlier_run_are_named_where_none_are_drawn(tmp_path, capsys):
    words = ["profile", str(TRACES / "0258.txt"), "--out", str(tmp_path / "o")]
    assert main(words) == 0
    assert main([*words, "--no-figures"]) == 0
    assert f"note: {tmp_path / 'o' / 'figures'} is of an earlier run" in capsys.readouterr().err


def test_two_numbers_of_one_kind_have_folders_of_their_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for text in ("Ra:0.4um", "Ra:0.8 um"):
        assert main(["profile", text, "--no-figures"]) == 0
    found = {file.parent.name: json.loads(file.read_text())[0] for file in tmp_path.rglob("profile.json")}
    assert {name: row["assumed"]["Ra_um"] for name, row in found.items()} == {
        "Ra_0.4um": pytest.approx(0.4),
        "Ra_0.8um": pytest.approx(0.8),
    }
