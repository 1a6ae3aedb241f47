"""Law files: the numbers of the catalogue from the same formula, taken by path everywhere, and one sentence else."""

from __future__ import annotations

import pickle
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import mixedlub as ml
from mixedlub.case import reference_rigs
from mixedlub.case.files import case_files
from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.cli import main
from mixedlub.effects import catalogue
from mixedlub.own_laws import EXAMPLE, as_hypothesis, check_usable, read_law
from profiles.errors import InputError
from tests.study.conftest import study_file

INLET = """
id = "inlet"
stage = "film"
acts_on = "film_thickness"
form = "factor"
expression = '''
exp(-13.2*c*(hertz_pressure/reduced_modulus)
  *(temperature_viscosity*viscosity*entrainment_speed^2/oil_conductivity)^0.42)
/(1 + 0.213*c*(1 + 2.23*d*slide_roll_ratio^0.83)
  *(temperature_viscosity*viscosity*entrainment_speed**2/oil_conductivity)^m
  *(hertz_pressure/reduced_modulus/0.005)^q)'''
[parameters]
c = { value = 1.0, sd = 0.5, null = 0.0 }
d = { value = 1.0 }
m = { value = 0.64 }
q = { value = 0.0 }
"""
BARE = """
id = "bare"
stage = "{stage}"
acts_on = "{acts_on}"
form = "{form}"
expression = "{expression}"
[parameters.a]
value = 0.1
sd = 0.2
"""
ONE = {"stage": "film", "acts_on": "film_thickness", "form": "factor", "expression": "(load/420 N)^a"}
DRIVE = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm"}}
ROWS = {"speed_rpm": [100.0, 200.0, 300.0], "friction_torque_Nm": [0.51, 0.62, 0.69]}


def written(folder: Path, text: str, name: str = "law") -> Path:
    path = folder / f"{name}.toml"
    path.write_text(text, encoding="utf-8")
    return path


def bare(folder: Path, more: str = "", **changes: str) -> Path:
    return written(folder, BARE.format(**{**ONE, **changes}) + more)


def with_law(kind: str, path: Path) -> Forward:
    """The reference rig of a kind with a law of the user beside the catalogue."""
    forward, law = reference_rigs.forward(kind), read_law(path)
    return Forward(replace(forward.case, laws={law.id: law}), forward.table)


def used_on_discs(path: Path) -> None:
    """Read a law and check it on the reference rig."""
    forward = reference_rigs.forward("disc")
    check_usable(read_law(path), forward.chain, forward.inputs, "reading", "disc")


@pytest.mark.parametrize("kind", ["disc", "gear_pair", "film"])
def test_a_file_that_repeats_an_effect_has_its_numbers(kind: str, tmp_path: Path) -> None:
    forward = with_law(kind, written(tmp_path, INLET))
    values = {"strength": 0.7, "sliding": 1.3, "loading_power": 0.6, "pressure_power": 0.3}
    known = forward.predict(None, {"inlet_shear_heating": values})
    own = forward.predict(None, {"inlet": dict(zip("cdmq", values.values(), strict=True))})
    assert np.ptp(known / forward.predict()) > 1e-3
    np.testing.assert_allclose(own, known, rtol=1e-12)


@pytest.mark.parametrize("kind", ["disc", "friction_map", "viscosity"])
def test_a_law_of_the_reading_is_the_gain_of_the_channel(kind: str, tmp_path: Path) -> None:
    path = bare(tmp_path, "null = 0.0", stage="measurement", acts_on="reading", expression="1 + a")
    forward = with_law(kind, path)
    known = forward.predict(None, {"sensor_gain": {"gain": 0.03}})
    np.testing.assert_allclose(forward.predict(None, {"bare": {"a": 0.03}}), known, rtol=1e-14)
    assert np.array_equal(forward.predict(None, {"bare": {"a": 0.0}}), forward.predict())


def test_parameters_and_quantities_have_units(tmp_path: Path) -> None:
    """30 mN m at 955 rpm, 100 rad/s, are 3 W; a column is read as recorded, a quantity with a unit in that unit."""
    text = BARE.format(stage="loss", acts_on="power_loss", form="add", expression="a*pinion_speed_rad_s")
    law = read_law(written(tmp_path, text.replace("0.1\n", '30\nunit = "mNm"\n').replace("sd = 0.2", "")))
    assert float(law.law(10.0, 100.0, a=30.0)) == pytest.approx(13.0, rel=1e-12)
    warm = read_law(bare(tmp_path, expression="a*(oil_temperature_C - 60)"))
    assert float(warm.law(2.0, 343.15, a=1.0)) == pytest.approx(20.0, rel=1e-12)
    columns = read_law(bare(tmp_path, acts_on="reading", expression="a*speed_rpm"), ["speed_rpm"])
    assert columns.reads == ("speed_rpm",)


def test_a_range_is_in_si_and_outside_it_the_rows_say_so(tmp_path: Path) -> None:
    path = bare(tmp_path, "[range]\noil_temperature_C = [0, 60]\nload_N = [1, 1e5]")
    assert read_law(path).valid == {"oil_temperature": (273.15, 333.15), "load": (1.0, 1e5)}
    from mixedlub.case.validity import judge_rows

    judged = judge_rows(with_law("disc", path), {"bare": {"a": 0.1}})
    warm = reference_rigs.forward("disc").table["oil_temperature_C"] > 60.0
    assert np.array_equal(["law_extrapolated:bare" in words for words in judged.words], warm)


def test_the_range_of_a_column_that_the_expression_reads_is_in_its_unit(tmp_path: Path) -> None:
    """The model of a drive has the signed speed of the recording and no pinion speed."""
    changes = {"stage": "loss", "acts_on": "reading", "expression": "exp(a*tanh(abs(speed_rpm)/900))"}
    law = read_law(bare(tmp_path, "[range]\nspeed_rpm = [-1500, 1500]", **changes), ["speed_rpm"])
    assert law.valid == {"speed_rpm": (-1500.0, 1500.0)}
    forward = reference_rigs.forward("friction_map")
    check_usable(law, forward.chain, {**forward.inputs, **forward.columns_of([law])}, "reading", "friction_map")
    assert law.facts()["valid"] == "speed_rpm -1500 to 1500"


def test_the_law_travels_to_other_processes(tmp_path: Path) -> None:
    law = pickle.loads(pickle.dumps(read_law(bare(tmp_path))))
    assert float(law.law(1e-6, 840.0, a=1.0)) == pytest.approx(2e-6, rel=1e-14)


def test_the_shipped_example_is_a_law() -> None:
    assert read_law(EXAMPLE).reads == ("load",)


@pytest.mark.parametrize(
    ("changes", "more", "said"),
    [
        ({"expression": "__import__('os')"}, "", "expression, character 1: '__import__': no such function"),
        ({"expression": "a.real"}, "", "character 2: '.': an operator is missing"),
        ({"expression": "open(a)"}, "", "'open': no such function"),
        ({"expression": "a*lod"}, "", "'lod': no such quantity or parameter; nearest known: 'load'"),
        ({"expression": "a*load_mNm"}, "", "'load_mNm': no such quantity"),
        ({"expression": "load"}, "", "parameters: 'a': is not in the expression"),
        ({"expression": "a*friction"}, "", "is cyclic: friction exists only after film_thickness is used"),
        ({"expression": "a*log(load - load)"}, "", "is not finite in its range, at load = "),
        ({"expression": "a*time"}, "", "the model of a disc has no such quantity"),
        ({"expression": "1 + a"}, "null = 0.5", "must leave film_thickness as it is at a = 0.5"),
        ({"acts_on": "film"}, "", "acts_on: 'film': no such quantity"),
        ({"acts_on": "torque"}, "", "acts_on: 'torque': the model of a disc has no such quantity"),
        ({"acts_on": "oil_density"}, "", "acts_on: 'oil_density': the reading of a disc does not depend on it"),
        ({"acts_on": "reduced_modulus"}, "kind = 1", "key is not known"),
        ({"form": "times"}, "", "form: 'times': must be 'factor', 'add' or 'replace'"),
        ({"stage": "flm"}, "", "nearest known: 'film'"),
        ({}, 'unit = "apples"', "parameters.a.unit: 'apples': no such unit"),
        ({}, "prior = { normal = [0, 1] }", "say the same twice"),
        ({}, "[range]\nlod_N = [1, 2]", "range: 'lod_N': no such quantity"),
        ({}, "[parameters.load]\nvalue = 1", "'load': is a quantity too"),
        ({}, "[parameters.exp]\nvalue = 1", "'exp' is no name of a parameter"),
    ],
)
def test_a_bad_file_is_one_sentence(changes: dict[str, str], more: str, said: str, tmp_path: Path) -> None:
    path = bare(tmp_path, more, **changes)
    with pytest.raises(InputError) as caught:
        used_on_discs(path)
    assert said in str(caught.value)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("end", ["", "[parameters]\n"])
def test_a_law_needs_a_parameter(end: str, tmp_path: Path) -> None:
    path = written(tmp_path, BARE.format(**ONE).partition("[parameters")[0] + end)
    with pytest.raises(InputError, match=r"parameters: (is missing|needs at least one table)"):
        read_law(path)


def test_an_id_of_the_catalogue_is_refused(tmp_path: Path) -> None:
    path = written(tmp_path, BARE.format(**ONE).replace('"bare"', '"starvation"'))
    with pytest.raises(InputError, match="'starvation': is the id of an effect of the catalogue"):
        read_law(path)


def test_a_hypothesis_needs_a_free_number_and_keeps_its_known_ones(tmp_path: Path) -> None:
    assert [p.name for p in as_hypothesis(read_law(written(tmp_path, INLET))).parameters] == ["c"]
    with pytest.raises(InputError, match="a hypothesis needs a parameter with sd or prior"):
        as_hypothesis(read_law(written(tmp_path, BARE.format(**ONE).replace("sd = 0.2", ""))))


def test_two_hypotheses_of_one_id_are_refused(tmp_path: Path) -> None:
    text = BARE.format(stage="boundary", acts_on="reading", form="factor", expression="1 + a*speed_rpm/1000")
    paths = [written(tmp_path, text, name) for name in ("one", "two")]
    with pytest.raises(InputError, match=r"'bare': is the id of .*one.toml too"):
        ml.case.case_of(DRIVE, ROWS, hypotheses=paths)


def test_a_case_takes_a_law_by_path_and_a_written_case_carries_it(tmp_path: Path) -> None:
    bare(tmp_path, acts_on="reading", form="add", expression="a*speed_rpm/1000")
    plain = ml.case.case_of(DRIVE, ROWS)
    case = ml.case.case_of({**DRIVE, "effects": {"law.toml": {"a": 2.0}}}, ROWS, folder=tmp_path)
    more = ml.simulate(case)["friction_torque_Nm"] - ml.simulate(plain)["friction_torque_Nm"]
    np.testing.assert_allclose(more, 2e-3 * np.array(ROWS["speed_rpm"]), rtol=1e-9)
    files = case_files(case)
    assert '"laws/bare.toml"' in str(files["system.toml"])
    for name, content in files.items():
        path = tmp_path / "again" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
    pd.testing.assert_frame_equal(ml.simulate(read_case(tmp_path / "again")), ml.simulate(case))


def test_a_study_takes_a_law_by_path(tmp_path: Path) -> None:
    written(tmp_path, INLET)
    known = {"inlet_shear_heating": {"strength": 0.7, "sliding": 1.0, "loading_power": 0.64, "pressure_power": 0.0}}
    losses = []
    for name, effects in (("known", known), ("own", {"law.toml": {"c": 0.7}})):
        path = study_file(tmp_path, name, effects=effects)
        study = ml.study.read_study(path, ml.study.read_study(path).file)
        losses.append(ml.study.run_study(study)["power_loss"])
    np.testing.assert_allclose(losses[1], losses[0], rtol=1e-12)


def test_a_study_refuses_a_law_that_cannot_act(tmp_path: Path) -> None:
    bare(tmp_path)
    with pytest.raises(InputError, match="the model of a study has no such quantity"):
        ml.study.read_study(study_file(tmp_path, effects={"law.toml": {}}))


def test_the_catalogue_shows_a_law_by_path(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["effects", str(bare(tmp_path))]) == 0
    shown = capsys.readouterr().out
    assert "film_thickness times (load/420 N)^a" in shown
    assert "cannot act" in shown
    assert main(["effects", str(bare(tmp_path, expression="a*friction"))]) == 2
    assert main(["kinds", "law"]) == 0
    assert "[parameters.NAME]" in capsys.readouterr().out


def test_no_law_of_a_user_enters_the_catalogue(tmp_path: Path) -> None:
    read_law(bare(tmp_path))
    assert "bare" not in catalogue()
