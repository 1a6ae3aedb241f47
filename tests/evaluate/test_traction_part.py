"""Traction part of an oil: planted stresses found from two discs, read alike by study, case, efficiency and solver."""

import math
import tomllib
from pathlib import Path

import numpy as np
import pytest

import mixedlub as ml
from mixedlub import efficiency
from mixedlub.case.folder import case_of
from mixedlub.case.forward import Forward
from mixedlub.efficiency.prepare import read_gearbox
from mixedlub.ehl.oil.file import oil_of
from mixedlub.evaluate.traction_fit import fitted_traction
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.toml_file import parse, to_toml
from profiles.errors import InputError

TRUTH = {
    "eyring_stress_MPa": 7.0,
    "eyring_pressure_exponent": 0.7,
    "eyring_fall_per_K": 0.005,
    "limit_over_pressure": 0.05,
    "limit_sharpness": 3.0,
    "limit_fall_per_K": 0.002,
    "limit_offset": 0.1,
}
RANGES = {"pressure_GPa": [0.35, 1.2], "temperature_C": [40.0, 100.0], "source": "made up"}
PART = {**{name: {"value": value} for name, value in TRUTH.items()}, **RANGES}
OIL = {
    "name": "own",
    "temperature_C": [40.0, 100.0],
    "kinematic_viscosity_mm2_s": [68.0, 10.2],
    "pressure_viscosity_per_GPa": [18.0, 14.0],
    "density_15C_kg_m3": 850.0,
    "density_change_per_K": 6.5e-4,
    "thermal_conductivity_W_mK": 0.14,
    "specific_heat_J_kgK": 2000.0,
}
DISCS = {
    "kind": "disc",
    "boundary_friction": 0.1,
    "contact": {"geometry": "line", "radius_mm": [40.0, 40.0], "width_mm": 6.0},
    "lubricant": OIL,
    "surfaces": {"smooth": {"m0_um2": 1e-6, "m2": 1e-6, "m4_per_um2": 1e-5}},
    "recording": {"quantity": "friction_coefficient"},
}


def friction(load, speed, ratio, celsius, limited=True):
    """Friction of a smooth line contact with the stresses of TRUTH, by formulas of its own."""
    kelvin, steel, radius = celsius + 273.15, 206e9 / (1 - 0.3**2), 0.02
    line = load / 0.006
    pressure = math.sqrt(line * steel / (2 * math.pi * radius))
    ordinates = [math.log10(math.log10(nu + 0.7)) for nu in (68.0, 10.2)]
    slope = (ordinates[0] - ordinates[1]) / math.log10(373.15 / 313.15)
    nu = 10**10 ** (ordinates[0] - slope * math.log10(kelvin / 313.15)) - 0.7
    eta = nu * 1e-6 * 850.0 * (1 - 6.5e-4 * (celsius - 15.0))
    alpha = (18.0 - 4.0 * (celsius - 40.0) / 60.0) * 1e-9
    film = 3.06 * radius * (eta * speed / (steel * radius)) ** 0.69 * (alpha * steel) ** 0.56
    film *= (line / (steel * radius)) ** -0.1
    power = alpha * 1.96e8 / (math.log(eta) + 9.67)
    thick = math.exp((math.log(eta) + 9.67) * (1 + pressure / 1.96e8) ** power - 9.67)
    stress = 7e6 * (pressure / 1e9) ** 0.7 * math.exp(-0.005 * (celsius - 80.0))
    eyring = stress * math.asinh(thick * ratio * speed / (film * stress))
    if not limited:
        return eyring / pressure
    limit = 0.05 * (0.9 * pressure + 0.1e9) * math.exp(-0.002 * (celsius - 40.0))
    return eyring * (1 + (eyring / limit) ** 3) ** (-1 / 3) / pressure


def rows(seed, loads=(400.0, 1000.0, 2200.0, 4500.0), temperatures=(40.0, 70.0, 100.0)):
    """Readings with noise of 0.4 % and 1e-4."""
    levels = [(f, u, s, t) for f in loads for t in temperatures for u in (2.0, 8.0) for s in (0.005, 0.02, 0.08, 0.3)]
    true = np.array([friction(*one) for one in levels])
    sd = 0.004 * true + 1e-4
    names = ("load_N", "entrainment_speed_m_s", "slide_roll_ratio", "oil_temperature_C")
    return {
        "run": list(range(1, len(levels) + 1)),
        **{name: list(column) for name, column in zip(names, zip(*levels, strict=True), strict=True)},
        "surface_1": ["smooth"] * len(levels),
        "surface_2": ["smooth"] * len(levels),
        "friction_coefficient": true + sd * np.random.default_rng(seed).normal(size=true.size),
        "friction_coefficient_sd": sd,
    }


def test_planted_stresses_lie_within_their_intervals():
    held = []
    for seed in range(5):
        found = fitted_traction(case_of(DISCS, rows(seed)), "discs").table
        assert list(found["parameter"]) == list(TRUTH)
        truth = np.array(list(TRUTH.values()))
        held += ((found["low90"] < truth) & (truth < found["high90"])).tolist()
        assert found["value"].to_numpy()[:4] == pytest.approx(truth[:4], rel=0.12)
    assert np.mean(held) >= 0.8  # 35 intervals of 90 %


def test_scatter_beyond_the_stated_noise_tells_no_limit():
    """Readings without a limit, with 8 times their noise: a limit lowers chi-square by 22.7, which 62 divides."""
    table = rows(2)
    names = ("load_N", "entrainment_speed_m_s", "slide_roll_ratio", "oil_temperature_C")
    true = np.array([friction(*one, limited=False) for one in zip(*(table[name] for name in names), strict=True)])
    table["friction_coefficient"] = true + 8.0 * table["friction_coefficient_sd"] * np.random.default_rng(2).normal(
        size=true.size
    )
    found = fitted_traction(case_of(DISCS, table), "discs")
    assert found.part.limit_over_pressure is None
    assert any("no limiting stress is told" in one.text for one in found.findings)


def test_the_written_oil_has_the_viscosity_of_the_fit():
    """Without the modulus equation the solver takes Roelands' law as the fit does: 18/GPa at 40 degC, 1 GPa."""
    from mixedlub.ehl.oil.lubricant import from_lubricant
    from mixedlub.rig.build import lubricant

    modulus = {"pressure_modulus_MPa": [55.6, 71.4], "pressure_modulus_slope": [0.03, 0.04]}
    case = case_of({**DISCS, "lubricant": {**OIL, **modulus}}, rows(1))
    written = tomllib.loads(fitted_traction(case, "discs").file)
    kept = {name: one["value"] for name, one in written["properties"].items()}
    assert kept == {name: OIL[name] for name in OIL if name != "name"}
    oil = from_lubricant(lubricant(parse(Lubricant, {**kept, "eyring_stress_MPa": 7.0}, "x")))
    eta = float(oil.log_viscosity(np.array(0.0), np.array(313.15))[0])
    thick = (eta + 9.67) * (1 + 1e9 / 1.96e8) ** (18e-9 * 1.96e8 / (eta + 9.67)) - 9.67
    assert float(oil.log_viscosity(np.array(1e9), np.array(313.15))[0]) == pytest.approx(thick, rel=1e-3)


def test_one_temperature_tells_no_fall():
    found = fitted_traction(case_of(DISCS, rows(1, temperatures=(70.0,))), "discs")
    told = found.table.set_index("parameter")["told"]
    assert told["eyring_stress_MPa"] == "yes"
    assert told["eyring_fall_per_K"] == "no"
    assert found.part.eyring_fall_per_K.status == "typical"
    assert any("do not tell eyring_fall_per_K" in one.text for one in found.findings)


def test_written_oil_gives_the_friction_in_a_case_a_study_a_stage_and_the_solver(tmp_path):
    """The file of one fit, read at four doors: friction of a case is the independent one, others have its effects."""
    system = {**DISCS, "lubricant": {**OIL, "traction": PART}}
    table = {name: values for name, values in rows(1).items() if not name.endswith("_sd")}
    given = np.array([friction(*one) for one in zip(*list(table.values())[1:5], strict=True)])
    case = case_of(system, table)
    assert Forward(case, case.recordings).base_prediction() == pytest.approx(given, rel=2e-3)
    assert set(case.system.effects) == {"shear_law", "limiting_shear_stress"}

    text = fitted_traction(case_of(DISCS, rows(1)), "discs").file
    (tmp_path / "oil.toml").write_text(text, encoding="utf-8")
    part = tomllib.loads(text)["traction"]
    loaded = oil_of("oil.toml", tmp_path, str(tmp_path / "contacts.toml"))
    stress, scale = np.array([3e7]), loaded.stress_scale(np.array([1e9]))
    assert scale[0] == pytest.approx(part["eyring_stress_MPa"]["value"] * 1e6, rel=1e-4)
    cold, hot = (loaded.sheared(stress, np.array([1e9]), np.array([kelvin]))[0][0] for kelvin in (313.15, 373.15))
    assert hot > 2.0 * cold

    section = parse(Lubricant, {"oil": "oil.toml"}, str(tmp_path / "rig.toml"))
    assert section.eyring_stress_MPa == part["eyring_stress_MPa"]["value"]
    with pytest.raises(InputError, match="Eyring stress of its own"):
        parse(Lubricant, {**OIL, "eyring_stress_MPa": 5.0, "traction": PART}, "x")


def test_stage_of_a_gearbox_reads_the_part(tmp_path):
    given = tomllib.loads(Path(efficiency.__file__).with_name("example.toml").read_text(encoding="utf-8"))
    for stage in given["stages"].values():
        stage["lubricant"] = {**OIL, "traction": PART}
        stage.pop("effects", None)
    path = tmp_path / "gearbox.toml"
    path.write_text(to_toml(given), encoding="utf-8")
    gearbox, _ = read_gearbox(path)
    for stage in gearbox.stages:
        assert {"shear_law", "limiting_shear_stress"} <= {one.id for one in stage.study.effects}


def test_solver_shears_as_the_effects_of_the_chain():
    from mixedlub.effects.limiting_shear_stress import limiting_shear_stress
    from mixedlub.effects.shear_law import shear_law
    from mixedlub.ehl.oil.lubricant import from_lubricant
    from mixedlub.laws.shear import ree_eyring
    from mixedlub.rig.build import lubricant

    section = parse(Lubricant, {**OIL, "traction": PART}, "x")
    oil, effects = from_lubricant(lubricant(section)), section.traction.effects(uncertain=False)
    pressure, kelvin, film = np.array(1.1e9), np.array(370.0), 3e-7
    thick = np.exp(oil.log_viscosity(pressure, kelvin)[0])
    for sliding in (0.01, 0.1, 1.0, 10.0):
        own = shear_law(7e6, thick, sliding, film, pressure, kelvin, **effects["shear_law"])
        stress = ree_eyring(thick, sliding, film, own)
        stress = limiting_shear_stress(stress, pressure, kelvin, **effects["limiting_shear_stress"])
        rate, *slopes = oil.sheared(stress, pressure, kelvin)
        assert rate == pytest.approx(thick * sliding / film, rel=1e-9)
        for number, (place, step) in enumerate(((0, 1e-6 * stress), (1, 1e3), (2, 1e-4))):
            near = [[stress, pressure, kelvin] for _ in range(2)]
            near[0][place], near[1][place] = near[0][place] + step, near[1][place] - step
            numeric = (oil.sheared(*near[0])[0] - oil.sheared(*near[1])[0]) / (2.0 * step)
            assert slopes[number] == pytest.approx(numeric, rel=1e-5)


def test_a_part_without_pressure_and_temperature_is_the_constant_stress():
    from mixedlub.ehl.oil.lubricant import from_lubricant
    from mixedlub.rig.build import lubricant

    flat = {"eyring_stress_MPa": {"value": 5.0}, **RANGES}
    sections = {**OIL, "traction": flat}, {**OIL, "eyring_stress_MPa": 5.0}
    part, constant = (from_lubricant(lubricant(parse(Lubricant, one, "x"))) for one in sections)
    stress, pressure, kelvin = np.array([-3e7, 1e5, 2e7]), np.array([0.0, 5e8, 1.5e9]), np.array([310.0, 350.0, 400.0])
    for own, other in zip(part.sheared(stress, pressure, kelvin), constant.sheared(stress, pressure, kelvin)):
        assert own == pytest.approx(other, rel=1e-12)


STUDY = """schema = "mixedlub-study/1"
boundary_friction = 0.1
[gears]
preset = "fzg_c"
[lubricant]
oil = "{oil}"
{more}
[surfaces.flank]
m0_um2 = 0.09
m2 = 0.003
m4_per_um2 = 0.002
[conditions]
torque_Nm = [100.0]
speed_rpm = [1500.0]
oil_temperature_C = [80.0]
[options]
{options}
"""


def test_study_reads_the_part_with_the_base_friction_alone(tmp_path):
    oil = {"schema": "mixedlub-oil/1", "name": "own", "base": "mineral"}
    names = [name for name in OIL if name != "name"]
    oil["properties"] = {name: {"value": OIL[name], "status": "stated", "source": "x"} for name in names}
    (tmp_path / "own.toml").write_text(to_toml({**oil, "traction": PART}), encoding="utf-8")
    found = {}
    for name, more, options in (
        ("part", "", ""),
        ("constant", "eyring_stress_MPa = 7.0", ""),
        ("law", "", 'friction = "schlenk"'),
        ("stated", "", "[effects.shear_law]\npressure_exponent = 0.5\nrate_exponent = 0.0"),
    ):
        path = tmp_path / f"{name}.toml"
        path.write_text(STUDY.format(oil="own.toml", more=more, options=options), encoding="utf-8")
        found[name] = ml.study.read_study(path)
    assert {one.id for one in found["part"].effects} == {"shear_law", "limiting_shear_stress"}
    assert not found["constant"].effects
    assert not found["law"].effects
    assert any(one.code == "traction_unread" for one in found["law"].notes)
    told = {one.code: one for one in found["stated"].notes if one.code.startswith("traction")}
    assert told["traction_unread"].place == "effects.shear_law"
    assert told["traction_read"].text.startswith("limiting stress by the traction part")
    assert not any(one.code == "traction_unread" for one in found["part"].notes)


def test_a_case_says_which_effects_take_the_place_of_the_part():
    table = {name: values for name, values in rows(1).items() if not name.endswith("_sd")}
    own = {"shear_law": {"pressure_exponent": 0.5, "rate_exponent": 0.0}, "limiting_shear_stress": {"coefficient": 0.1}}
    case = case_of({**DISCS, "lubricant": {**OIL, "traction": PART}, "effects": own}, table)
    told = [(one.code, one.place) for one in case.notes if one.code.startswith("traction")]
    assert told == [("traction_unread", f"effects.{name}") for name in own]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"eyring_stress_MPa": {"value": -1.0}}, "eyring_stress_MPa: -1.0: must be from"),
        ({"limit_over_pressure": {"value": 50.0}}, "must be between 0 and 1"),
        ({"limit_over_pressure": None}, "limit_fall_per_K needs limit_over_pressure"),
        ({"pressure_GPa": [1.2, 0.4]}, "must be at least 1.2"),
        ({"limit_over_presure": {"value": 0.05}}, "nearest known: 'limit_over_pressure'"),
    ],
)
def test_a_part_that_is_wrong_is_refused(change, said):
    part = {name: value for name, value in {**PART, **change}.items() if value is not None}
    with pytest.raises(InputError) as error:
        parse(Lubricant, {**OIL, "traction": part}, "rig.toml")
    assert said in str(error.value)


def test_readings_that_tell_nothing_are_refused():
    few = {name: values[:5] for name, values in rows(1).items()}
    with pytest.raises(InputError, match="needs 8 readings"):
        fitted_traction(case_of(DISCS, few), "discs")
    bare = {name: value for name, value in OIL.items() if name != "pressure_viscosity_per_GPa"}
    with pytest.raises(InputError, match="needs an oil with pressure-viscosity"):
        fitted_traction(case_of({**DISCS, "lubricant": bare}, rows(1)), "discs")
