"""Factors beyond the conditions of a study: runs, designs, and what decides the loss."""

import tomllib

import numpy as np
import pandas as pd
import pytest

from mixedlub.cli import main
from mixedlub.study import factor_parts, read_study, run_study, sensitivity
from mixedlub.study.factor_file import read_factor_file
from mixedlub.study.factor_runs import read_experiment
from mixedlub.study.factor_tables import full_factorial, random_design
from tests.study.conftest import toml

LDP = {"model": "ldp", "tip_relief_um": [10, 10], "relief_length_mm": [2, 2]}
FEW = {"conditions": {"torque_Nm": [50, 150], "speed_rpm": [1500], "oil_temperature_C": [60]}}


@pytest.fixture
def write_factors(write_study, tmp_path):
    """Writes a file of factors beside a small study."""

    def write(factors, design=None, **changes):
        write_study("base", **{**FEW, **changes})
        path = tmp_path / "factors.toml"
        content = {"schema": "mixedlub-factors/1", "study": "base.toml", "factors": factors, "design": design or {}}
        path.write_text("\n".join(f"{key} = {toml(value)}" for key, value in content.items()) + "\n", encoding="utf-8")
        return path

    return write


def experiment(path):
    return read_experiment(path, read_factor_file(path))


def refused(path, capsys, tmp_path):
    """The message of a run that is refused, with nothing written."""
    assert main(["factors", str(path), "--out", str(tmp_path / "o")]) == 2
    assert not (tmp_path / "o").exists()
    return " ".join(capsys.readouterr().err.split())


def ishigami(points):
    x, y, z = (-np.pi + 2.0 * np.pi * points).T
    return np.sin(x) + 7.0 * np.sin(y) ** 2 + 0.1 * z**4 * np.sin(x)


@pytest.mark.literature("T. Ishigami and T. Homma, ISUMA (1990) 398, with a = 7, b = 0.1: indices in closed form")
@pytest.mark.parametrize(("kind", "runs"), [("sobol", 4096), ("latin_hypercube", 65536)])
def test_indices_of_the_ishigami_function(kind, runs):
    points = sensitivity.all_samples(sensitivity.base_samples(kind, runs, 3, seed=7))
    found = sensitivity.of_samples(ishigami(points), runs, seed=7)
    assert found.first == pytest.approx([0.3139, 0.4424, 0.0], abs=0.02)
    assert found.total == pytest.approx([0.5576, 0.4424, 0.2437], abs=0.02)
    assert (found.total_ends[0] <= found.total).all()
    assert (found.total <= found.total_ends[1]).all()


@pytest.mark.literature("T. Ishigami and T. Homma, ISUMA (1990) 398, with a = 7, b = 0.1: indices in closed form")
def test_indices_of_the_ishigami_function_on_a_grid():
    levels = (np.arange(48) + 0.5) / 48
    grid = np.stack([axis.ravel() for axis in np.meshgrid(levels, levels, levels, indexing="ij")], axis=1)
    response = ishigami(grid).reshape(48, 48, 48)
    found = sensitivity.of_grid(response)
    assert found.first == pytest.approx([0.3139, 0.4424, 0.0], abs=0.005)
    assert found.total == pytest.approx([0.5576, 0.4424, 0.2437], abs=0.005)
    assert sensitivity.interactions(response) == pytest.approx({(0, 1): 0.0, (0, 2): 0.2437, (1, 2): 0.0}, abs=0.005)


def test_nothing_decides_what_does_not_vary():
    found = sensitivity.of_grid(np.ones((2, 3)))
    assert not found.first.any()
    assert not found.total.any()


def test_rows_of_a_full_factorial_are_those_of_studies_altered_by_hand(write_factors, write_study):
    path = write_factors({"boundary_friction": [0.08, 0.12], "face_width_mm": [10, 20]})
    table, _ = full_factorial(experiment(path))
    assert len(table) == 4 * 6 * 2
    for friction in (0.08, 0.12):
        for width in (10.0, 20.0):
            by_hand = run_study(
                read_study(write_study("hand", boundary_friction=friction, gears__face_width_mm=width, **FEW))
            ).to_pandas()
            at = (table["factor_boundary_friction"] == friction) & (table["factor_face_width_mm"] == width)
            rows = table[at].drop(columns=["factor_boundary_friction", "factor_face_width_mm"])
            pd.testing.assert_frame_equal(rows.reset_index(drop=True), by_hand)


def test_shares_of_a_full_factorial_add_up_to_the_variance(write_factors):
    path = write_factors({"boundary_friction": [0.08, 0.12]}, pairings={"every": ["mid"]})
    table, decided = full_factorial(experiment(path))
    assert decided.names == ("boundary_friction", "torque_Nm")
    whole = decided.indices.first.sum() + sum(decided.interactions.values())
    assert whole == pytest.approx(1.0, rel=1e-12)
    effect = decided.main_effects["boundary_friction"]
    by_hand = table.groupby("factor_boundary_friction")["power_loss_W"].mean()
    assert effect.mean == pytest.approx(by_hand.to_numpy(), rel=1e-12)


def test_oils_relief_and_sharing_are_varied(write_factors):
    path = write_factors({"oil": ["n100", "pao100"], "tip_relief_um": [5, 30]}, gears__load_sharing=LDP)
    table, decided = full_factorial(experiment(path))
    assert set(table["factor_oil"]) == {"n100", "pao100"}
    by_relief = table.groupby("factor_tip_relief_um")["loss_factor_H_VL"].mean()
    assert by_relief[30.0] < by_relief[5.0]
    assert {"oil", "tip_relief_um"} <= set(decided.names)
    shared, _ = full_factorial(experiment(write_factors({"load_sharing": ["rigid", "ldp"]})))
    assert shared.groupby("factor_load_sharing")["loss_factor_H_VL"].mean().nunique() == 2


def test_geometry_errors_and_friction_laws_are_varied(write_factors):
    path = write_factors({"gears": ["fzg_a", "fzg_c"], "friction": ["tallian_mixture", "schlenk"]})
    table, _ = full_factorial(experiment(path))
    factors = table.groupby("factor_gears")["loss_factor_H_VL"].mean()
    assert factors["fzg_a"] > 1.5 * factors["fzg_c"]
    assert table.groupby("factor_friction")["mean_friction"].mean().nunique() == 2
    angles = {"pressure_angle_deg": [20, 25], "helix_angle_deg": [0, 15]}
    table, _ = full_factorial(experiment(write_factors(angles)))
    losses = table.groupby("factor_pressure_angle_deg")["mesh_loss_W"].mean()
    assert losses[25.0] < losses[20.0]
    errors = {"lead_crown_um": [0, 15], "misalignment_um": [0, 20], "profile_slope_deviation_um": [-8, 8]}
    table, _ = full_factorial(experiment(write_factors(errors, gears__load_sharing=LDP)))
    for name in errors:
        assert table.groupby(f"factor_{name}")["mesh_loss_W"].mean().nunique() == 2


TRACED = {"surfaces": {"t": {"profile": "shipped:0258", "cutoff_mm": 0.8, "short_cutoff_um": 2.5}}}


def test_cutoffs_and_replicates_change_the_moments_of_traces(write_factors):
    table, _ = full_factorial(experiment(write_factors({"short_cutoff_um": [2.5, 8.0]}, **TRACED)))
    areas = table.groupby("factor_short_cutoff_um")["boundary_area_ratio"].mean()
    assert areas[8.0] < areas[2.5]
    path = write_factors({"replicate": [1, 2, 3]}, **TRACED)
    table, _ = full_factorial(experiment(path))
    roughness = table.groupby("factor_replicate")["composite_roughness_um"].mean()
    assert roughness.nunique() == 3
    assert np.ptp(roughness) < 0.3 * roughness.mean()
    again, _ = full_factorial(experiment(path))
    pd.testing.assert_frame_equal(table, again)


def test_several_traces_are_drawn_anew_and_traces_along_the_lay_are_refused(write_factors, tmp_path, capsys):
    several = {"t": {"traces": ["shipped:0258", "shipped:0302"], "cutoff_mm": 0.8, "short_cutoff_um": 2.5}}
    table, _ = full_factorial(experiment(write_factors({"replicate": [1, 2]}, surfaces=several)))
    assert table.groupby("factor_replicate")["composite_roughness_um"].mean().nunique() == 2
    along = {"t": several["t"] | {"traces_along": ["shipped:0122"]}}
    message = refused(write_factors({"replicate": [1, 2]}, surfaces=along), capsys, tmp_path)
    assert "takes traces in one direction" in message


@pytest.mark.long
def test_a_random_design_finds_what_the_grid_finds(write_factors):
    """Friction of the mesh hangs on the boundary friction far more than on the face width."""
    wide = {"boundary_friction": [0.05, 0.15], "face_width_mm": [13, 15], "torque_Nm": [90, 110]}
    path = write_factors(wide, {"kind": "sobol", "runs": 32, "response": "mean_friction"})
    runs, decided = random_design(experiment(path))
    assert len(runs) == 32 * 5
    assert runs["factor_boundary_friction"].between(0.05, 0.15).all()
    assert decided.names[int(np.argmax(decided.indices.total))] == "boundary_friction"
    assert runs["share_out_of_range"].between(0.1, 1.0).all()
    assert decided.indices.first[0] == pytest.approx(1.0, abs=0.1)
    again, _ = random_design(experiment(path))
    pd.testing.assert_frame_equal(runs, again)


@pytest.mark.parametrize("design", [{}, {"kind": "latin_hypercube", "runs": 4}])
def test_the_command_writes_tables_and_figures(write_factors, tmp_path, capsys, design):
    path = write_factors({"boundary_friction": [0.08, 0.12], "face_width_mm": [10, 20]}, design)
    assert main(["factors", str(path), "--out", str(tmp_path / "o")]) == 0
    assert "% of all conditions are outside the model's range" in capsys.readouterr().err
    files = {file.name for file in (tmp_path / "o").iterdir()}
    tables = {"indices", "main_effects"} | ({"runs"} if design else {"results", "interactions"})
    both = {f"{table}.{ending}" for table in tables for ending in ("csv", "parquet")}
    assert files == both | {"figures", "factors.toml", "study.toml", "origin.json"}
    figures = {file.name for file in (tmp_path / "o" / "figures").iterdir()}
    drawn = {"indices.svg", "main_effects.svg", "captions.txt"}
    assert figures == drawn | (set() if design else {"interactions.svg"})
    assert tomllib.loads((tmp_path / "o" / "factors.toml").read_text())["study"] == "base.toml"


@pytest.mark.parametrize(
    ("factors", "design", "words"),
    [
        ({}, {}, "names no factor"),
        ({"face_width_mm": [14]}, {}, "face_width_mm has one level"),
        ({"face_width_mm": [14, 14]}, {}, "each level once"),
        ({"face_widht_mm": [14, 15]}, {}, "face_width_mm"),
        ({"face_width_mm": [10, 20]}, {"kind": "sobol", "runs": 0}, "runs"),
        ({"face_width_mm": [10, 20]}, {"kind": "sobol", "runs": 12}, "power of 2"),
        ({"face_width_mm": [10, 20]}, {"kind": "sobol"}, "needs runs"),
        ({"face_width_mm": [10, 20]}, {"runs": 8}, "leave it out"),
        ({"face_width_mm": [10, 20]}, {"response": "power_los_W"}, "power_loss_W"),
        ({"face_width_mm": [10, 20]}, {"response": "mean_asperity_load_share"}, "no such column"),
        ({"face_width_mm": [-1, 20]}, {}, "face_width_mm"),
        ({"tip_relief_um": [10, 20]}, {}, 'acts only with model = "ldp"'),
        ({"load_sharing": ["rigid", "ldpp"]}, {}, "ldp"),
        ({"oil": ["n100", "n1000"]}, {}, "n100"),
        ({"gears": ["fzg_a", "fzg_aa"]}, {}, "fzg_a"),
        ({"gears": ["fzg_a", "base.tml"]}, {}, "ends in .toml"),
        ({"gears": ["fzg_a", "none.toml"]}, {}, "none.toml"),
        ({"normal_module_mm": [4, 0]}, {}, "normal_module_mm"),
        ({"cutoff_mm": [0.25, 0.8]}, {}, "no surface of the study has a trace"),
        ({"replicate": [1, 2]}, {}, "no surface of the study has a trace"),
        ({"torque_Nm": [50, 100]}, {}, "[conditions]"),
        ({"torque_Nm": [0, 100]}, {"kind": "sobol", "runs": 4}, "torque_Nm"),
    ],
)
def test_wrong_factors_are_refused_with_place_and_rule(write_factors, tmp_path, capsys, factors, design, words):
    message = refused(write_factors(factors, design), capsys, tmp_path)
    assert "factors.toml" in message
    assert words in message


def test_a_factor_named_twice_is_refused(write_factors, tmp_path, capsys):
    path = write_factors({"face_width_mm": [10, 20]})
    twice = "face_width_mm = [10, 20], face_width_mm = [1, 2]"
    text = path.read_text(encoding="utf-8").replace('"face_width_mm" = [10, 20]', twice)
    assert twice in text
    path.write_text(text, encoding="utf-8")
    assert "not readable as TOML" in refused(path, capsys, tmp_path)


def test_a_friction_that_the_law_does_not_read_is_no_factor(write_factors, tmp_path, capsys):
    path = write_factors({"boundary_friction": [0.08, 0.12]}, options={"friction": "benedict_kelley"})
    assert "does not read it" in refused(path, capsys, tmp_path)


def test_a_study_that_is_not_there_is_refused(write_factors, tmp_path, capsys):
    path = write_factors({"face_width_mm": [10, 20]})
    path.write_text(path.read_text(encoding="utf-8").replace("base.toml", "bases.toml"), encoding="utf-8")
    assert "bases.toml" in refused(path, capsys, tmp_path)


def test_the_result_of_other_factors_stays(write_factors, tmp_path, capsys):
    out = str(tmp_path / "o")
    first = write_factors({"face_width_mm": [10, 20]})
    assert main(["factors", str(first), "--out", out]) == 0
    other = first.with_name("other.toml")
    other.write_text(first.read_text(encoding="utf-8").replace("20", "25"), encoding="utf-8")
    capsys.readouterr()
    assert main(["factors", str(other), "--out", out]) == 2
    assert "another file of factors" in " ".join(capsys.readouterr().err.split())
    assert main(["factors", str(other), "--replace", "--out", out]) == 0


def test_gears_by_name_and_file_take_the_place_of_those_of_the_study(write_factors, write_study, tmp_path):
    own = {"teeth": [20, 30], "normal_module_mm": 4.0, "face_width_mm": 15.0}
    (tmp_path / "own.toml").write_text(f"gears = {toml(own)}\n", encoding="utf-8")
    table, decided = full_factorial(experiment(write_factors({"gears": ["fzg_c", "own.toml"]})))
    assert "gears" in decided.names
    for name, gears in (("fzg_c", {"preset": "fzg_c"}), ("own.toml", own)):
        by_hand = run_study(read_study(write_study("hand", gears=gears, **FEW)))["power_loss"]
        rows = table[table["factor_gears"] == name]
        assert rows["power_loss_W"].to_numpy() == pytest.approx(by_hand.ravel(), rel=1e-12)


def test_a_module_scales_the_gears_and_leaves_their_loss_factor(write_factors):
    tips = {"gears__tip_diameter_mm": [80.5, 118.4], "gears__centre_distance_mm": 91.2}
    table, _ = full_factorial(experiment(write_factors({"normal_module_mm": [2.0, 4.0]}, **tips)))
    small, large = (table[table["factor_normal_module_mm"] == module] for module in (2.0, 4.0))
    assert small["loss_factor_H_V"].to_numpy() == pytest.approx(large["loss_factor_H_V"].to_numpy(), rel=1e-9)
    assert (small["hertz_pressure_MPa"].to_numpy() / large["hertz_pressure_MPa"].to_numpy()) == pytest.approx(2.0)


@pytest.mark.parametrize("factor", [{"gears": ["fzg_a", "fzg_c"]}, {"normal_module_mm": [3, 4]}])
def test_a_share_table_belongs_to_its_gears(factor, write_factors, tmp_path, capsys):
    (tmp_path / "share.csv").write_text("torque_Nm,roll_angle_deg,load_share\n100,0,1\n100,90,1\n", encoding="utf-8")
    path = write_factors(factor, gears__load_sharing={"table": "share.csv"})
    assert "belongs to its gears" in refused(path, capsys, tmp_path)


@pytest.mark.parametrize(("design", "run"), [({}, full_factorial), ({"kind": "sobol", "runs": 2}, random_design)])
def test_an_interrupted_run_resumes(design, run, write_factors, tmp_path, monkeypatch):
    monkeypatch.setattr(factor_parts, "MOST_RUNS", 2)
    varied = experiment(write_factors({"boundary_friction": [0.08, 0.1, 0.12], "face_width_mm": [10, 20]}, design))
    uninterrupted, _ = run(varied)
    parts, seen = factor_parts.parts_folder(tmp_path, varied), []

    def stop(done, of):
        if done == 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(varied, stop, parts)
    (parts / "runs_0.parquet").write_bytes(b"half")
    resumed, _ = run(varied, lambda done, of: seen.append((done, of)), parts)
    assert seen[0] == (2, len(varied.runs)), "the runs of the chunk that was kept whole"
    assert seen[-1] == (len(varied.runs), len(varied.runs))
    pd.testing.assert_frame_equal(resumed, uninterrupted)


def test_a_factor_named_twice_is_named(tmp_path, capsys, write_factors):
    path = write_factors({"face_width_mm": [10, 20]})
    path.write_text('schema = "mixedlub-factors/1"\nstudy = "trial.toml"\n[factors]\noil = ["a"]\noil = ["b"]\n')
    assert "line 5 gives 'oil' a second time" in refused(path, capsys, tmp_path)


def test_a_resumed_command_says_how_many_runs_are_kept(write_factors, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(factor_parts, "MOST_RUNS", 1)
    path, out = write_factors({"boundary_friction": [0.08, 0.1, 0.12]}, {}), tmp_path / "o"
    varied = experiment(path)

    def stop(done, of):
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        full_factorial(varied, stop, factor_parts.parts_folder(out, varied))
    assert main(["factors", str(path), "--out", str(out)]) == 0
    assert "runs kept from an earlier start: 2 of 3; to compute: 1" in capsys.readouterr().out


def test_parts_are_gone_when_the_command_is_done(write_factors, tmp_path, monkeypatch):
    monkeypatch.setattr(factor_parts, "MOST_RUNS", 1)
    path = write_factors({"face_width_mm": [10, 20]}, pairings={"every": ["mid"]})
    assert main(["factors", str(path), "--out", str(tmp_path / "o")]) == 0
    assert not list((tmp_path / "o").glob(".parts-*"))


def test_parts_of_other_inputs_are_left(write_factors):
    first = experiment(write_factors({"face_width_mm": [10, 20]})).fingerprint
    assert experiment(write_factors({"face_width_mm": [10, 20]})).fingerprint == first
    assert experiment(write_factors({"face_width_mm": [10, 20]}, boundary_friction=0.11)).fingerprint != first
