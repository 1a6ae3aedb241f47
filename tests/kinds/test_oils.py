"""Oils by name in the files of cases and studies: complete, in one piece, and overridden only where that is said."""

from __future__ import annotations

import math
import shutil
import tomllib
from pathlib import Path

import numpy as np
import pytest

import mixedlub as ml
from mixedlub.case.files import case_files
from mixedlub.case.folder import read_case
from mixedlub.laws.oil import modulus_viscosity, temperature_viscosity
from mixedlub.rig import build
from mixedlub.schema.findings import collected
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.oil_file import STATUSES, oil_names, shipped_oil
from mixedlub.schema.toml_file import to_toml
from mixedlub.study import read_study, run_study
from mixedlub.study.record import resolved
from profiles.errors import InputError

CASE = Path(__file__).parents[2] / "examples" / "case"
STUDY = """
schema = "mixedlub-study/1"
gears = { teeth = [16, 24], normal_module_mm = 4.5, face_width_mm = 14.0 }
surfaces = { ground = { m0_um2 = 0.1, m2 = 0.003, m4_per_um2 = 0.002 } }
conditions = { torque_Nm = [100], speed_rpm = [1000], oil_temperature_C = [80] }
"""
OWN = """
schema = "mixedlub-oil/1"
name = "oil of the rig"
base = "pao"

[properties]
temperature_C = { value = [40, 100], status = "stated", source = "data sheet" }
kinematic_viscosity_mm2_s = { value = [68, 10.5], status = "stated", source = "data sheet" }
"""


def lubricant(**keys: object) -> tuple[object, dict[str, str]]:
    """An oil as the chain takes it, and the texts of the findings by code."""
    with collected() as found:
        oil = build.lubricant(ml.oil(**keys))
    return oil, {one.code: "; ".join(str(each) for each in found if each.code == one.code) for one in found}


@pytest.mark.parametrize("name", oil_names())
def test_every_oil_is_complete_and_every_number_has_its_source(name: str) -> None:
    oil = shipped_oil(name)
    assert {"temperature_C", "kinematic_viscosity_mm2_s", "pressure_viscosity_per_GPa"} <= oil.properties.keys()
    for one in (*oil.properties.values(), *oil.further.values()):
        assert one.status in STATUSES
        assert len(one.source) > 3
    found, said = lubricant(oil=name)
    assert found.viscosity(np.array(373.15)) < found.viscosity(np.array(313.15)) < 2.0
    typical = [key for key, one in oil.properties.items() if one.status == "typical"]
    assert all(key in said["oil_typical"] for key in typical)


def test_pressure_viscosity_of_the_modulus_equation_is_its_slope_without_pressure() -> None:
    """alpha = 1/A, linear in temperature; at 60 °C 22.92, 19.05 and 13.77 per GPa."""
    for name, at_60 in (("n100", 22.92), ("m100", 19.05), ("pao_vg100", 13.77)):
        low, high = shipped_oil(name).properties["pressure_modulus_MPa"].value
        alpha = [1e3 / modulus for modulus in (low, low + (high - low) / 3, high)]
        assert alpha[1] == pytest.approx(at_60, abs=0.006)
        assert shipped_oil(name).properties["pressure_viscosity_per_GPa"].value == pytest.approx(
            [alpha[0], alpha[2]], abs=0.06
        )
        ratio = shipped_oil(name).further["limiting_stress"].values["Lambda"]
        stress = shipped_oil(name).properties["eyring_stress_MPa"].value
        assert stress == pytest.approx(2e3 * ratio / alpha[1], abs=0.06)


def test_modulus_equation_of_an_oil_is_a_law_of_its_own(tmp_path: Path) -> None:
    """At 1 GPa and 60 °C viscosity rises by exp(23.51), exp(13.07) and exp(8.96)."""
    for name, rise in (("n100", 23.51), ("m100", 13.07), ("pao_vg100", 8.96)):
        inputs = lubricant(oil=name)[0].inputs(np.array(333.15))
        found = modulus_viscosity(1.0, inputs["pressure_modulus"], inputs["modulus_slope"], 1e9)
        assert np.log(found) == pytest.approx(rise, abs=0.006)
    modulus = tmp_path / "modulus.toml"
    modulus.write_text(
        STUDY + 'lubricant = { oil = "m100" }\noptions = { viscosity_law = "modulus" }\n', encoding="utf-8"
    )
    first = read_study(modulus)
    assert "oil_law_unread" not in {one.code for one in first.notes}
    again = tmp_path / "again.toml"
    again.write_text(to_toml(resolved(first)["inputs"]), encoding="utf-8")
    assert run_study(read_study(again))["mesh_loss"] == pytest.approx(run_study(first)["mesh_loss"], rel=1e-12)
    plain = read_study(study(tmp_path, 'oil = "m100"'))
    assert "oil_law_unread" in {one.code for one in plain.notes}
    assert not np.allclose(run_study(plain)["mesh_loss"], run_study(first)["mesh_loss"], rtol=0.01)


def test_modulus_equation_without_its_constants_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "modulus.toml"
    path.write_text(STUDY + 'options = { viscosity_law = "modulus" }\n', encoding="utf-8")
    with pytest.raises(InputError, match="needs pressure_modulus_MPa and pressure_modulus_slope in"):
        read_study(path)
    with pytest.raises(InputError, match="needs both pressure_modulus_MPa and pressure_modulus_slope"):
        ml.oil("mineral", pressure_modulus_MPa=(50.0, 60.0))


def test_turbine_oil_has_the_viscosity_that_the_gear_tests_print() -> None:
    """8.7 mPa s at 70 °C and a relative fall of 0.029 per kelvin, from a fluid at the limits of its specification."""
    oil, _ = lubricant(oil="mil_prf_23699")
    assert oil.viscosity(np.array(343.15)) == pytest.approx(8.7e-3, rel=0.03)
    fall = temperature_viscosity(np.array(343.15), oil.temperature, oil.kinematic_viscosity, oil.density_change)
    assert fall == pytest.approx(0.029, rel=0.15)


def test_gear_oil_has_its_viscosity_and_density_at_the_stated_temperature() -> None:
    oil, _ = lubricant(oil="75w90")
    assert oil.density(np.array(373.15)) == pytest.approx(799.3, rel=1e-3)
    assert oil.viscosity(np.array(373.15)) == pytest.approx(10.6e-3, rel=1e-3)


def test_eyring_stress_under_pressure_has_the_values_of_its_law() -> None:
    law = shipped_oil("75w90").further["eyring_stress_under_pressure"].values
    rise = law["kappa"] * (law["p_e"] - law["p_s"])
    tau_e = law["tau_a"] + rise

    def stress(p: float) -> float:
        return law["tau_a"] + tau_e / 2 * (1 + math.tanh(rise / tau_e * (2 * p / (law["p_s"] + law["p_e"]) - 1)))

    assert [stress(p) for p in (500, 1000, 1500, 2000)] == pytest.approx([26.2, 35.6, 47.1, 60.0], abs=0.06)


def test_what_the_section_states_wins_and_is_said() -> None:
    oil, said = lubricant(oil="n100", eyring_stress_MPa=6.5, name="mine")
    assert oil.eyring_stress == pytest.approx(6.5e6)
    assert oil.name == "mine"
    assert "eyring_stress_MPa = 6.5 in place of 4.6 of oil n100" in said["oil_overridden"]
    assert "oil_overridden" not in lubricant(oil="n100", eyring_stress_MPa=4.6)[1]
    assert lubricant(oil="n100", density_change_per_K=6e-4)[0].density_change == 6e-4


def test_a_stock_still_names_typical_oils() -> None:
    with collected():
        assert build.lubricant(ml.oil("pao")).kinematic_viscosity[0] == pytest.approx(64e-6)
        assert build.lubricant(ml.oil(base="pao")).density_15 == 845.0
    assert ml.oil("n100", base="ester").base == "ester"


def test_values_at_other_temperatures_are_not_mixed() -> None:
    with pytest.raises(InputError, match=r"the oil has its values at \[40.0, 100.0\] °C"):
        ml.oil("n100", temperature_C=[20.0, 80.0], kinematic_viscosity_mm2_s=[300.0, 15.0])
    own = {"kinematic_viscosity_mm2_s": [300.0, 15.0], "pressure_viscosity_per_GPa": [28.0, 18.0]}
    moved, said = lubricant(oil="n100", temperature_C=[20.0, 80.0], **own)
    assert moved.pressure_modulus is None
    assert "pressure_modulus_slope (-0.00073064, -0.00182865) left out of oil n100" in said["oil_overridden"]


def study(tmp_path: Path, lubricant: str) -> Path:
    path = tmp_path / "study.toml"
    path.write_text(STUDY + f"lubricant = {{ {lubricant} }}\n", encoding="utf-8")
    return path


def test_a_study_runs_with_a_named_oil_as_with_its_numbers(tmp_path: Path) -> None:
    named = run_study(read_study(study(tmp_path, 'oil = "m100"')))
    oil = shipped_oil("m100")
    typed = ", ".join(f"{key} = {list(one.value) if isinstance(one.value, tuple) else one.value}"
                      for key, one in oil.properties.items())  # fmt: skip
    same = run_study(read_study(study(tmp_path, f'base = "mineral", {typed}')))
    assert np.array_equal(named["power_loss"], same["power_loss"])
    other = run_study(read_study(study(tmp_path, 'oil = "n100"')))
    assert not np.allclose(named["power_loss"], other["power_loss"], rtol=1e-3)


@pytest.mark.parametrize(
    ("lubricant", "said"),
    [
        ('oil = "n10"', "no such oil; nearest known: 'n100'"),
        ('oil = "own.tml"', "no such oil"),
        ('oil = "mineral"', "base stocks are mineral, pao, ester, pag, by the key base"),
        ('oil = "nowhere.toml"', "nowhere.toml: no such file"),
        ("oil = 3", "must be text"),
        ('oil = "broken.toml"', "broken.toml: properties.eyring_stress_MPa.status"),
        ('oil = "unknown.toml"', "key is not known; nearest known: 'eyring_stress_MPa'"),
        ('oil = "far.toml"', "must be from 0.02 to 500 MPa"),
    ],
)
def test_a_wrong_oil_is_refused(tmp_path: Path, lubricant: str, said: str) -> None:
    spoilt = {
        "broken": 'eyring_stress_MPa = { value = 5, status = "guessed", source = "data sheet" }',
        "unknown": 'eyring_stres_MPa = { value = 5, status = "stated", source = "data sheet" }',
        "far": 'eyring_stress_MPa = { value = 5000, status = "stated", source = "data sheet" }',
    }
    for name, line in spoilt.items():
        (tmp_path / f"{name}.toml").write_text(OWN + line + "\n", encoding="utf-8")
    with pytest.raises(InputError) as error:
        read_study(study(tmp_path, lubricant))
    assert said in str(error.value)
    assert "study.toml: lubricant" in str(error.value)


def test_an_oil_of_ones_own_is_read_beside_the_study(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "own.toml").write_text(OWN, encoding="utf-8")
    read = read_study(study(tmp_path, 'oil = "own.toml"'))
    assert read.oil.name == "oil of the rig"
    assert read.oil.kinematic_viscosity[0] == pytest.approx(68e-6)
    assert any("pressure_viscosity_per_GPa" in str(one) for one in read.notes if one.code == "oil_typical")
    monkeypatch.chdir(tmp_path)
    assert ml.oil("own.toml").kinematic_viscosity_mm2_s == (68.0, 10.5)


def test_a_case_takes_an_oil_and_is_written_with_its_numbers(tmp_path: Path) -> None:
    folder = shutil.copytree(CASE, tmp_path / "case")
    system = tomllib.loads((folder / "system.toml").read_text(encoding="utf-8"))
    text = (folder / "system.toml").read_text(encoding="utf-8")
    head, _, rest = text.partition("[lubricant]")
    _, mark, below = rest.partition("\n[")
    assert system["lubricant"]
    (folder / "system.toml").write_text(f'{head}[lubricant]\noil = "own.toml"\n{mark}{below}', encoding="utf-8")
    (folder / "own.toml").write_text(OWN, encoding="utf-8")
    case = read_case(folder)
    assert case.system.lubricant is not None
    assert case.system.lubricant.kinematic_viscosity_mm2_s == (68.0, 10.5)
    written = tomllib.loads(str(case_files(case)["system.toml"]))["lubricant"]
    assert written["kinematic_viscosity_mm2_s"] == [68.0, 10.5]
    assert "oil" not in written
    assert Lubricant.model_validate(written).base == "pao"
