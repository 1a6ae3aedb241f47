"""Oils under pressure: one known coefficient at other temperatures, and doubts of an oil by name."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest

import mixedlub as ml
from mixedlub.case.folder import read_case
from mixedlub.ehl.oil.file import oil_of
from mixedlub.laws.oil import modulus_viscosity
from mixedlub.rig import build
from mixedlub.rig.lubricant import Lubricant
from mixedlub.schema import system_file
from mixedlub.schema.findings import Severity, collected, registered
from mixedlub.schema.oil_file import oil_names, shipped_oil
from mixedlub.schema.toml_file import to_toml
from mixedlub.study import read_study, run_study
from mixedlub.study.factor_file import Factors
from mixedlub.study.record import resolved
from profiles.errors import InputError

DATA_SHEET = {"base": "mineral", "temperature_C": (40, 100), "kinematic_viscosity_mm2_s": (46, 6.8)}
STUDY = """
schema = "mixedlub-study/1"
gears = { teeth = [17, 26], normal_module_mm = 4.2333333, pressure_angle_deg = 22.5, face_width_mm = 14.0 }
surfaces = { fine = { m0_um2 = 0.02, m2 = 0.0005, m4_per_um2 = 0.0004 } }
conditions = { torque_Nm = [100], speed_rpm = [3000], oil_temperature_C = [60] }
"""
DOUBTS = {
    "oil_fahrenheit": DATA_SHEET | {"temperature_C": (104, 212)},
    "oil_coefficient_rises": DATA_SHEET | {"pressure_viscosity_per_GPa": (14, 18)},
    "oil_thickens": DATA_SHEET | {"pressure_viscosity_per_GPa": (18, 17.9)},
    "oil_viscosity_implausible": DATA_SHEET | {"pressure_viscosity_per_GPa": (34, 20)},
}
EHL_OIL = """
schema = "mixedlub-ehl-oil/1"
name = "oil of a rheometer"
viscosity = { law = "roelands", temperature_C = 60.0, viscosity_mPa_s = 14.9, pressure_viscosity_per_GPa = ALPHA, \
temperature_viscosity_per_K = 0.03 }
shear = { law = "ree_eyring", eyring_stress_MPa = 5.0 }
density = { law = "dowson_higginson", density_kg_m3 = 850.0, temperature_C = 60.0, expansion_per_K = 6.5e-4 }
thermal = { thermal_conductivity_W_mK = 0.14, specific_heat_J_kgK = 2000.0 }
"""


def built(**keys: object) -> tuple[Lubricant, list[str]]:
    """An oil, and the codes of its findings."""
    with collected() as found:
        oil = build.lubricant(system_file.Lubricant.model_validate(keys))
    return oil, [one.code for one in found]


def study(folder: Path, keys: dict[str, object]) -> Path:
    path = folder / "study.toml"
    path.write_text(STUDY + to_toml({"lubricant": keys}), encoding="utf-8")
    return path


@pytest.mark.parametrize("name", oil_names())
def test_viscosity_under_pressure_of_a_shipped_oil_falls_with_temperature(name: str) -> None:
    oil, codes = built(oil=name)
    kelvin, pressure = np.linspace(40.0, 150.0, 111) + 273.15, np.linspace(0.0, 2e9, 21)[:, None]
    assert (np.diff(oil.log_under_pressure(pressure, kelvin), axis=1) < 0.0).all()
    if oil.pressure_modulus is not None:
        known = oil.inputs(kelvin)
        found = modulus_viscosity(known["viscosity"], known["pressure_modulus"], known["modulus_slope"], pressure)
        assert (np.diff(np.log(found), axis=1) < 0.0).all()
    doubted = [code for code in codes if registered()[code].severity is Severity.DOUBT]
    assert doubted == (["oil_viscosity_implausible"] * 2 if name == "n100" else [])
    assert ("coefficient_carried" in codes) == isinstance(
        shipped_oil(name).properties["pressure_viscosity_per_GPa"].value, float
    )


def test_oils_of_the_example_of_factors_are_shipped_and_not_doubted() -> None:
    (names,) = Factors.model_fields["oil"].examples or []
    assert set(names) <= set(oil_names())
    for name in names:
        assert not [code for code in built(oil=name)[1] if registered()[code].severity is Severity.DOUBT]


@pytest.mark.literature("Roelands' law with the constants of an automatic transmission fluid, computed independently")
def test_transmission_fluid_at_1_gpa() -> None:
    found = np.exp(built(oil="atf")[0].log_under_pressure(1e9, np.array([40.0, 80.0, 120.0]) + 273.15))
    assert found == pytest.approx([392.0, 49.0, 6.2], rel=0.01)


@pytest.mark.literature("Rebbechi, Oswald and Townsend (1996), NASA TM-107279, table 1: 14.2 1/GPa at 54 °C")
def test_coefficient_of_the_turbine_oil_is_the_printed_one_at_its_temperature() -> None:
    oil, _ = built(oil="mil_prf_23699")
    found = oil.pressure_coefficient(np.array([54.0, 40.0, 100.0]) + 273.15) * 1e9
    assert found == pytest.approx([14.2, 15.5, 11.3], rel=0.008)
    assert oil.inputs(np.array(327.15))["coefficient_fall"] == pytest.approx(
        -np.log(oil.pressure_coefficient(327.65) / oil.pressure_coefficient(326.65)), rel=1e-4
    )


def test_coefficient_carried_by_gold_is_a_power_of_the_viscosity() -> None:
    known = {"coefficient_per_GPa": 15.0, "temperature_C": 60.0, "carried": "gold"}
    oil, codes = built(**DATA_SHEET, known_pressure_viscosity=known)
    kelvin = np.array([333.15, 313.15, 353.15, 373.15])
    nu = oil.viscosity(kelvin) / oil.density(kelvin)
    assert oil.pressure_coefficient(kelvin) == pytest.approx(15e-9 * (nu / nu[0]) ** 0.139, rel=1e-9)
    assert oil.coefficient_change(kelvin) == pytest.approx(
        oil.pressure_coefficient(kelvin + 0.5) - oil.pressure_coefficient(kelvin - 0.5), rel=1e-4
    )
    assert "coefficient_carried" in codes
    with pytest.raises(InputError, match="needs base"):
        ml.oil(known_pressure_viscosity=known)
    with pytest.raises(InputError, match="give one"):
        ml.oil(**DATA_SHEET, known_pressure_viscosity=known, pressure_viscosity_per_GPa=(18, 14))


@pytest.mark.parametrize("carried", ["roelands", "gold"])
def test_record_of_a_study_has_the_known_coefficient(tmp_path: Path, carried: str) -> None:
    known = {"coefficient_per_GPa": 14.2, "temperature_C": 54.0, "carried": carried}
    first = read_study(study(tmp_path, {**DATA_SHEET, "known_pressure_viscosity": known}))
    again = tmp_path / "again.toml"
    again.write_text(to_toml(resolved(first)["inputs"]), encoding="utf-8")
    assert run_study(read_study(again))["mesh_loss"] == pytest.approx(run_study(first)["mesh_loss"], rel=1e-12)


@pytest.mark.parametrize(("code", "keys"), DOUBTS.items(), ids=list(DOUBTS))
def test_doubtful_oil_is_named_where_it_is_used(tmp_path: Path, code: str, keys: dict[str, object]) -> None:
    assert code in built(**keys)[1]
    assert code in {one.code for one in read_study(study(tmp_path, keys)).notes}
    with pytest.warns(UserWarning, match="doubt: lubricant"):
        ml.oil(**keys)


@pytest.mark.parametrize("sheet", [(100, 210), (100, 212), (210, 100)])
def test_old_data_sheets_in_fahrenheit(sheet: tuple[float, float]) -> None:
    viscosity = (46, 6.8) if sheet[0] < sheet[1] else (6.8, 46)
    assert "oil_fahrenheit" in built(base="mineral", temperature_C=sheet, kinematic_viscosity_mm2_s=viscosity)[1]


def test_viscosity_of_no_lubricant_is_doubted() -> None:
    thick = {"temperature_C": (40, 100), "kinematic_viscosity_mm2_s": (4e5, 3e3)}
    assert "oil_viscosity_implausible" in built(base="mineral", **thick)[1]


def test_case_with_a_doubtful_oil_says_so(tmp_path: Path) -> None:
    text = (Path(__file__).parents[2] / "examples" / "published" / "two_discs" / "fluid_a" / "system.toml").read_text(
        encoding="utf-8"
    )
    text = text.replace('oil = "atf_two_disc"', to_toml(DOUBTS["oil_thickens"]))
    (tmp_path / "system.toml").write_text(text, encoding="utf-8")
    with collected() as found:
        read_case(tmp_path, need_recordings=False).rig.oil()
    assert "oil_thickens" in {one.code for one in found}


@pytest.mark.parametrize(("alpha", "doubted"), [("14.8", False), ("34.0", True)])
def test_oil_of_the_solver_is_doubted_alike(tmp_path: Path, alpha: str, doubted: bool) -> None:
    (tmp_path / "oil.toml").write_text(EHL_OIL.replace("ALPHA", alpha), encoding="utf-8")
    with collected() as found:
        oil_of("oil.toml", tmp_path, "oil")
    assert ("oil_viscosity_implausible" in {one.code for one in found}) == doubted


@pytest.mark.parametrize("base", ["mineral", "pao", "ester", "pag"])
@pytest.mark.parametrize("cold", [3.0, 10.0, 100.0, 1000.0, 3000.0])
@pytest.mark.parametrize("hot_C", [42.0, 100.0])
def test_typical_oils_are_not_doubted(base: str, cold: float, hot_C: float) -> None:
    """Gold's relation at any viscosity at 40 °C, and the fall of an oil with a viscosity index near 100."""
    from mixedlub.laws.oil import from_d341, to_d341

    hot = from_d341(to_d341(np.array(cold * 1e-6)) - 3.5 * np.log10((hot_C + 273.15) / 313.15)) * 1e6
    keys = {"base": base, "temperature_C": (40.0, hot_C), "kinematic_viscosity_mm2_s": (cold, float(hot))}
    oil, codes = built(**keys)
    assert not any(registered()[code].severity is Severity.DOUBT for code in codes)
    assert oil.pressure_viscosity[1] < oil.pressure_viscosity[0]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ml.oil(**keys)
