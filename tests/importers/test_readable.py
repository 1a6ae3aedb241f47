"""What an import leaves is what check reads; where it is not, nothing is left and the error says why."""

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.cli import main
from mixedlub.importers import import_files, write_case
from profiles.errors import InputError

GEARS = """[gears]
teeth = [17, 26]
normal_module_mm = 4.2333333
pressure_angle_deg = 22.5
tip_diameter_mm = [80.5, 118.4]
face_width_mm = 14.0
"""
SURFACE = "m0_um2 = 0.1\nm2 = 0.003\nm4_per_um2 = 0.002\n"
OIL = "[lubricant]\nbase = 'mineral'\n"
HEADER = "torque_Nm,speed_rpm,oil_temperature_C,pinion_surface,gear_surface,power_loss_W\n"
ROWS = "".join(f"{50 + 10 * i},{500 + i},40,ground,ground,{17 + i}\n" for i in range(6))
SHARES = "torque_Nm,roll_angle_deg,load_share\n" + "".join(f"50,{a},{s}\n" for a, s in ((10, 0.5), (20, 1), (35, 0.5)))


@pytest.fixture
def rig(tmp_path, monkeypatch):
    """A folder with readings and answers, to be written to."""
    monkeypatch.chdir(tmp_path)

    def write(**files):
        for name, text in files.items():
            path = tmp_path / name.replace("__", "/").replace("_dot_", ".")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return tmp_path

    write(t_dot_csv=HEADER + ROWS, answers_dot_toml=answers())
    return write


def answers(gears=GEARS, surface=SURFACE, share=""):
    return f'kind = "gear_pair"\n{gears}{share}{OIL}[surfaces.ground]\n{surface}'


def imported(*more):
    return main(["import", "t.csv", "--out", "rig", "--answers", "answers.toml", *more])


def test_what_is_imported_is_checked_and_diagnosable(rig, capsys):
    assert imported() == 0
    assert "diagnose cannot" not in capsys.readouterr().out
    assert main(["check", "rig"]) == 0
    assert "Cannot be diagnosed" not in capsys.readouterr().out


def test_a_value_that_a_case_cannot_have_is_named_where_it_stands(rig, tmp_path, capsys):
    rig(t_dot_csv=HEADER + ROWS.replace(",502,", ",-502,"))
    assert imported() == 2
    assert "t.csv: line 4, speed_rpm: '-502': speed_rpm must be above 0" in capsys.readouterr().err
    assert not (tmp_path / "rig").exists()


def test_a_surface_that_is_not_described_is_named_with_the_nearest(rig, tmp_path, capsys):
    rig(t_dot_csv=HEADER + ROWS.replace("ground,ground,19", "ground,grund,19"))
    assert imported() == 2
    assert "surfaces: 'grund': is named in the readings and not described; nearest known: 'ground'" in (
        capsys.readouterr().err
    )
    assert not (tmp_path / "rig").exists()


def test_what_check_refuses_is_refused_in_its_words(rig, tmp_path, capsys):
    rig(answers_dot_toml=answers(gears=GEARS.replace("[80.5, 118.4]", "[60.0, 90.0]")))
    assert imported() == 2
    said = capsys.readouterr().err
    assert "nothing was written" in said
    assert "rig/system.toml" in said
    assert ".writing" not in said
    assert not (tmp_path / "rig").exists()


def test_a_case_that_is_there_stays_where_the_new_one_is_refused(rig, tmp_path):
    imported()
    before = {p.name: p.read_bytes() for p in (tmp_path / "rig").iterdir()}
    rig(answers_dot_toml=answers(gears=GEARS.replace("[80.5, 118.4]", "[60.0, 90.0]")))
    assert imported("--overwrite") == 2
    assert {p.name: p.read_bytes() for p in (tmp_path / "rig").iterdir()} == before


def test_a_stuck_channel_is_refused(rig, capsys):
    rig(t_dot_csv=HEADER + "".join(f"{50 + i},500,40,ground,ground,17\n" for i in range(6)))
    assert imported() == 2
    assert "all readings are the same number" in capsys.readouterr().err


def test_what_diagnose_would_refuse_is_said(rig, capsys):
    rig(t_dot_csv=HEADER + "".join(ROWS.splitlines(keepends=True)[:3]))
    assert imported() == 0
    said = capsys.readouterr().out
    assert "caution: diagnose cannot use this case as it is: rig/recordings.csv: power_loss_W: 3: needs at" in said


def test_a_place_in_the_programme_outside_it_is_refused_of_a_case_that_lacks_sections_too(rig, capsys):
    rig(t_dot_csv="sequence," + HEADER + "1.5,50,500,40,a,b,17\n0.5,50,600,40,a,b,18\n")
    assert main(["import", "t.csv", "--out", "rig", "--set", "kind=gear_pair"]) == 2
    assert "t.csv: line 2, sequence: '1.5': sequence must lie between 0 and 1" in capsys.readouterr().err


def test_load_shares_come_with_the_case_from_beside_the_answers(rig, tmp_path):
    rig(
        d__load_share_dot_csv=SHARES,
        d__answers_dot_toml=answers(share='load_sharing = { table = "load_share.csv" }\n'),
    )
    assert main(["import", "t.csv", "--out", "rig", "--answers", "d/answers.toml"]) == 0
    assert (tmp_path / "rig/load_share.csv").read_text(encoding="utf-8") == SHARES
    assert main(["check", "rig"]) == 0


def test_load_shares_may_be_one_of_the_files(rig, tmp_path):
    rig(d__shares_dot_csv=SHARES)
    assert imported("d/shares.csv") == 0
    case = read_case(tmp_path / "rig")
    assert case.system.gears.load_sharing.table == "shares.csv"
    assert len(case.recordings) == 6


def test_load_shares_without_gears_are_refused(rig, tmp_path, capsys):
    rig(load_share_dot_csv=SHARES)
    assert main(["import", "t.csv", "load_share.csv", "--out", "rig", "--set", "kind=gear_pair"]) == 2
    assert "load_share.csv: is a table of load shares, which belongs to [gears]" in capsys.readouterr().err
    assert not (tmp_path / "rig").exists()


def test_load_shares_against_another_answer_are_refused(rig, capsys):
    rig(load_share_dot_csv=SHARES, answers_dot_toml=answers(share='load_sharing = { model = "rigid" }\n'))
    assert imported("load_share.csv") == 2
    assert "gears.load_sharing.model: 'rigid': contradicts load_share.csv" in capsys.readouterr().err


def test_bad_load_shares_are_refused(rig, tmp_path, capsys):
    rig(load_share_dot_csv=SHARES.replace("35,0.5", "35,5"))
    assert imported("load_share.csv") == 2
    assert "rig/load_share.csv: line 4, load_share: 5.0" in capsys.readouterr().err
    assert not (tmp_path / "rig").exists()


@pytest.fixture
def trace():
    heights = np.convolve(np.random.default_rng(2).normal(size=12000), np.ones(30) / 30, "same")
    return "x (um),z (um)\n" + "".join(f"{0.5 * i},{z:.6f}\n" for i, z in enumerate(heights))


@pytest.mark.parametrize("place", ["profiles__ground_dot_txt", "d__profiles__ground_dot_txt"])
def test_traces_come_with_the_case(rig, tmp_path, trace, place):
    surface = 'profile = "profiles/ground.txt"\ncutoff_mm = 0.8\n'
    rig(**{place: trace, "d__answers_dot_toml": answers(surface=surface)})
    table = ["import", "t.csv", "--out", "rig", "--answers", "d/answers.toml"]
    assert main(table) == 0
    assert (tmp_path / "rig/profiles/ground.txt").read_text(encoding="utf-8") == trace
    assert main(["check", "rig"]) == 0
    assert main([*table, "--set", 'description="again"', "--overwrite"]) == 0


def test_a_trace_from_elsewhere_gets_a_place_in_the_case(rig, tmp_path, trace):
    path = tmp_path / "elsewhere" / "ground.txt"
    rig(elsewhere__ground_dot_txt=trace, answers_dot_toml=answers(surface=f'profile = "{path}"\ncutoff_mm = 0.8\n'))
    assert imported() == 0
    assert read_case(tmp_path / "rig").system.surfaces["ground"].profile == "profiles/ground.txt"


def test_other_traces_of_a_case_stay(rig, tmp_path, trace):
    surface = 'profile = "profiles/ground.txt"\ncutoff_mm = 0.8\n'
    rig(profiles__ground_dot_txt=trace, answers_dot_toml=answers(surface=surface), rig__profiles__other_dot_txt="mine")
    rig(rig__system_dot_toml="")
    assert imported("--overwrite") == 0
    assert sorted(p.name for p in (tmp_path / "rig/profiles").iterdir()) == ["ground.txt", "other.txt"]


def test_a_trace_that_is_nowhere_is_refused_by_name(rig, tmp_path, trace, capsys):
    rig(profiles__grund_dot_txt=trace, answers_dot_toml=answers(surface='profile = "profiles/ground.txt"\n'))
    assert imported() == 2
    said = capsys.readouterr().err
    assert "surfaces.ground.profile: 'profiles/ground.txt': no such file" in said
    assert "nearest known: 'grund.txt'" in said
    assert not (tmp_path / "rig").exists()


def test_a_shipped_trace_is_not_looked_for(rig, tmp_path):
    rig(answers_dot_toml=answers(surface='profile = "shipped:0036"\ncutoff_mm = 0.8\nshort_cutoff_um = 2.5\n'))
    assert imported() == 0
    assert not (tmp_path / "rig/profiles").exists()


def test_a_carried_file_never_takes_the_place_of_the_readings(rig, tmp_path):
    rig(recordings_dot_csv=SHARES)
    told = {"kind": "gear_pair", "gears": {"teeth": [17, 26], "load_sharing": {"table": "recordings.csv"}}}
    with pytest.raises(InputError, match="is a name that the case needs for another file"):
        import_files([tmp_path / "t.csv"], tmp_path / "rig", **told)


def test_a_carried_file_that_differs_is_not_replaced_unsaid(tmp_path):
    system = {"kind": "viscosity", "recording": {"quantity": "viscosity_mPa_s"}}
    columns = {"temperature_C": np.array([20.0, 40.0]), "viscosity_mPa_s": np.array([9.0, 5.0])}
    folder = write_case(tmp_path / "case", system, columns, attachments={"note.txt": b"one"})
    with pytest.raises(InputError, match=r"note\.txt: exists and differs"):
        write_case(folder, system, columns, attachments={"note.txt": b"two"}, overwrite=False)
    assert (folder / "note.txt").read_bytes() == b"one"
