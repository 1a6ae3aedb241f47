"""The file of an oil: every law's slopes, what a law needs, and what it would ignore."""

from importlib.resources import files
from inspect import signature

import numpy as np
import pytest

from mixedlub.chain.slots import VISCOSITY
from mixedlub.cli import main
from mixedlub.ehl import EXAMPLE, example_oil, read_oil, solve
from mixedlub.ehl.file import read_problem
from mixedlub.ehl.oil.declared import DENSITY as DENSITIES
from mixedlub.ehl.oil.declared import SHEAR as SHEAR_LAWS
from mixedlub.ehl.oil.declared import VISCOSITY as VISCOSITIES
from mixedlub.laws.oil import roelands_viscosity
from mixedlub.rig.build import lubricant
from mixedlub.schema.findings import collected
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.oil_file import oil_names
from mixedlub.schema.toml_file import parse
from profiles.errors import InputError

TEXT = EXAMPLE.read_text(encoding="utf-8")
ROELANDS = TEXT[TEXT.index("[viscosity]") : TEXT.index("[shear]")]
SHEAR = TEXT[TEXT.index("[shear]") : TEXT.index("[density]")]
MODULUS = """[viscosity]
law = "modulus"
known_temperature_C = [40.0, 100.0]
kinematic_viscosity_mm2_s = [94.1, 14.0]
modulus_GPa = -0.0573
modulus_per_kelvin_MPa = 0.390
stiffening = -39.5e-3
stiffening_per_K = 23.54e-5

"""
TWO_SLOPE = ROELANDS.replace('"roelands"', '"two_slope"').rstrip() + (
    "\nsecond_pressure_viscosity_per_GPa = 8.0\ntransition_pressure_MPa = 600.0\n\n"
)
TAIT = """[density]
law = "tait"
density_kg_m3 = 850.0
temperature_C = 60.0
expansion_per_K = 8e-4
bulk_modulus_GPa = 1.2
bulk_modulus_slope = 11.0
bulk_modulus_fall_per_K = 6e-3

"""
DOOLITTLE = """[viscosity]
law = "doolittle"
temperature_C = 60.0
viscosity_mPa_s = 14.89
free_volume_factor = 4.5
occupied_share = 0.65
occupied_expansion_per_K = -7e-4

"""
DENSITY = TEXT[TEXT.index("[density]") : TEXT.index("[thermal]")]
SHEARS = {
    "newton": 'law = "newton"',
    "growing_eyring": 'law = "growing_eyring"\neyring_stress_MPa = 5\neyring_growth = 0.035\n'
    "growth_start_GPa = 0.5\ngrowth_end_GPa = 3.5",
    "carreau": 'law = "carreau"\nshear_modulus_MPa = 3\npower = 0.5',
    "limiting": 'law = "limiting"\nlimiting_stress_MPa = 1\nlimiting_growth = 0.04',
}


def written(folder, *changes):
    text = TEXT
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = folder / "oil.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("viscosity", [ROELANDS, ROELANDS.replace('"roelands"', '"barus"'), TWO_SLOPE, MODULUS])
def test_slopes_of_the_viscosity_are_those_of_small_changes(viscosity, tmp_path):
    check_slopes(read_oil(written(tmp_path, (ROELANDS, viscosity))).log_viscosity)


def check_slopes(law):
    """Slopes of a law of pressure and temperature against small changes."""
    p, t = 0.7e9, 350.0
    _, by_p, by_t = law(np.array(p), np.array(t))
    more, less = (law(p * (1 + s), t)[0] for s in (1e-5, -1e-5))
    warm, cold = (law(p, t + s)[0] for s in (1e-3, -1e-3))
    assert by_p == pytest.approx((more - less) / (2e-5 * p), rel=1e-6)
    assert by_t == pytest.approx((warm - cold) / 2e-3, rel=1e-5)


def test_two_slopes_join_without_a_step(tmp_path):
    law = read_oil(written(tmp_path, (ROELANDS, TWO_SLOPE))).log_viscosity
    base = float(law(np.array(0.0), np.array(333.15))[0])
    rise = [float(law(np.array(p), np.array(333.15))[0]) - base for p in (0.3e9, 1.2e9)]
    assert rise == pytest.approx([14.81 * 0.3, 14.81 * 0.6 + 8.0 * 0.6], rel=1e-9)
    slopes = law(np.array([0.42e9 - 1.0, 0.42e9 + 1.0, 0.84e9 - 1.0, 0.84e9 + 1.0]), np.array(333.15))[1]
    assert slopes == pytest.approx([14.81e-9, 14.81e-9, 8e-9, 8e-9], rel=1e-6)


def test_contacts_of_an_oil_of_two_slopes_rub_less(tmp_path):
    contact = {"radius": 8.69e-3, "line_load": 2.15e5, "speed": 2.24, "sliding_speed": 0.762, "oil_temperature": 333.15}
    straight, bent = (TWO_SLOPE.replace("= 8.0", f"= {slope}") for slope in ("14.0", "8.0"))
    found = [solve(read_oil(written(tmp_path, (ROELANDS, law))), **contact) for law in (straight, bent)]
    assert all(one.status[0] == "converged" for one in found)
    high, low = (float(one.friction_coefficient[0]) for one in found)
    assert 0.0 < low < high
    films = [float(one.flow_film[0]) for one in found]
    assert films[1] == pytest.approx(films[0], rel=0.02)


def test_free_volume_has_its_limits_and_slopes(tmp_path):
    oil = read_oil(written(tmp_path, (ROELANDS, DOOLITTLE), (DENSITY, TAIT)))
    check_slopes(oil.log_viscosity)
    check_slopes(oil.density_ratio)
    viscosity, coefficient = oil.at_ambient(np.array(333.15))
    assert viscosity == pytest.approx(0.01489, rel=1e-12)
    # a film that loses 1/K of its volume a Pa: B R0/(1 - R0)^2/K
    assert coefficient == pytest.approx(4.5 * 0.65 / 0.35**2 / 1.2e9, rel=1e-12)
    assert oil.density_ratio(np.array(0.0), np.array(343.15))[0] == pytest.approx(1.0 / 1.008, rel=1e-12)
    far = oil.log_viscosity(np.array([1e9, 1e11]), np.array(280.0))[0]
    assert np.isfinite(far).all()


def test_contacts_of_a_free_volume_oil_are_solved(tmp_path):
    oil = read_oil(written(tmp_path, (ROELANDS, DOOLITTLE), (DENSITY, TAIT)))
    contact = {"radius": 8.69e-3, "line_load": 1e5, "speed": 2.24, "sliding_speed": 0.224, "oil_temperature": 333.15}
    found, other = solve(oil, **contact), solve(example_oil(), **contact)
    assert found.status[0] == "converged"
    # the film grows with the pressure-viscosity coefficient to the power 0.56
    ratio = oil.at_ambient(np.array(333.15))[1] / 14.81e-9
    assert float(found.flow_film[0] / other.flow_film[0]) == pytest.approx(ratio**0.56, rel=0.1)


@pytest.mark.parametrize("name", oil_names())
@pytest.mark.parametrize("kelvin", [323.0, 370.0])
def test_an_oil_by_name_has_the_viscosity_that_studies_take(name, kelvin):
    with collected():
        own, of = read_oil(name), lubricant(parse(Lubricant, {"oil": name}, "oil"))
    p, t = np.array(0.7e9), np.array(kelvin)
    state = {**of.inputs(t), "hertz_pressure": p}
    law = VISCOSITY.choices["modulus" if "pressure_modulus" in state else "roelands"].law
    log, by_p, by_t = own.log_viscosity(p, t)
    assert np.exp(log) == pytest.approx(law(*(state[n] for n in signature(law).parameters)), rel=1e-9)
    more, less = (own.log_viscosity(p * (1 + s), t)[0] for s in (1e-5, -1e-5))
    warm, cold = (own.log_viscosity(p, t + s)[0] for s in (1e-3, -1e-3))
    assert by_p == pytest.approx((more - less) / (2e-5 * p), rel=1e-6)
    assert by_t == pytest.approx((warm - cold) / 2e-3, rel=1e-5)


CONTACTS = """schema = "mixedlub-ehl/1"
oil = "{oil}"
[contacts]
radius_mm = 8.69
line_load_N_mm = 100.0
entrainment_speed_m_s = 2.24
slide_roll_ratio = 0.1
oil_temperature_C = 60.0
"""


def test_contacts_take_an_oil_by_name_and_say_what_it_lacks(tmp_path, capsys):
    file = tmp_path / "contacts.toml"
    file.write_text(CONTACTS.format(oil="mil_prf_23699"), encoding="utf-8")
    assert main(["ehl", str(file), "--no-figures", "--out", str(tmp_path / "o")]) == 0
    said = capsys.readouterr()
    assert "1 of 1 contacts solved" in said.out
    assert "taken as typical of base ester" in said.err
    contact = {"radius": 8.69e-3, "line_load": 1e5, "speed": 2.24, "sliding_speed": 0.224, "oil_temperature": 333.15}
    assert f"friction {float(solve(read_oil('mil_prf_23699'), **contact).friction_coefficient[0]):.4f}" in said.out


def test_contacts_take_the_oil_file_of_a_study(tmp_path):
    file, oil = tmp_path / "contacts.toml", tmp_path / "own.toml"
    oil.write_bytes(files("mixedlub").joinpath("rig", "oils", "m100.toml").read_bytes())
    file.write_text(CONTACTS.format(oil="own.toml"), encoding="utf-8")
    assert read_problem(file).oil.name == read_oil("m100").name


@pytest.mark.parametrize(("oil", "said"), [("pao44", "nearest known: 'pao4'"), ("none.toml", "no such file")])
def test_an_oil_that_is_not_there_is_refused(oil, said, tmp_path):
    file = tmp_path / "contacts.toml"
    file.write_text(CONTACTS.format(oil=oil), encoding="utf-8")
    with pytest.raises(InputError, match=said) as error:
        read_problem(file)
    assert f"{file}: oil" in str(error.value)


@pytest.mark.parametrize("law", SHEARS)
@pytest.mark.parametrize("stress", [-42e6, 0.3e6, 20e6])
def test_slopes_of_the_shear_are_those_of_small_changes(law, stress, tmp_path):
    oil = read_oil(written(tmp_path, (SHEAR, f"[shear]\n{SHEARS[law]}\n\n")))
    p, tau = np.array(1e9), np.array(stress)
    _, by_stress, by_p = oil.shear(tau, p)
    more, less = (oil.shear(tau + s, p)[0] for s in (10.0, -10.0))
    denser, thinner = (oil.shear(tau, p * (1 + s))[0] for s in (1e-6, -1e-6))
    assert by_stress == pytest.approx((more - less) / 20.0, rel=1e-4)
    assert by_p == pytest.approx((denser - thinner) / (2e-6 * p), rel=1e-4, abs=1e-6 * abs(by_stress))


def test_roelands_is_that_of_the_other_chains():
    pressure = np.array([0.0, 0.5e9, 1.2e9])
    own = np.exp(example_oil().log_viscosity(pressure, 333.15)[0])
    assert own == pytest.approx(roelands_viscosity(0.01489, 14.81e-9, pressure), rel=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("eyring_stress_MPa = 5.0\n", "", 'law = "ree_eyring" needs eyring_stress_MPa'),
        ("eyring_stress_MPa = 5.0", "eyring_stress_MPa = 5.0\npower = 0.5", "power acts only with law"),
        ("eyring_stress_MPa = 5.0", "eyring_stress_MPa = -5.0", "-5.0: must be above 0"),
        ("viscosity_mPa_s = 14.89", "viscosity_mPa_s = 0.05", "0.05: must be above 0.0631 for Roelands' law"),
        ("temperature_C = [20.0, 150.0]", "temperature_C = [150.0, 20.0]", "20: must be above 150"),
        ("eyring_stress_MPa", "eyring_stres_MPa", "nearest known: 'eyring_stress_MPa'"),
        ("temperature_viscosity_per_K = 0.030\n", "", 'law = "roelands" needs temperature_viscosity_per_K'),
        ('law = "dowson_higginson"', 'law = "incompressible"', "expansion_per_K acts only with"),
        ('"ree_eyring"', '"eyring"', "eyring"),
    ],
)
def test_a_file_that_is_wrong_is_refused(old, new, said, tmp_path):
    with pytest.raises(InputError) as error:
        read_oil(written(tmp_path, (old, new)))
    assert said in str(error.value)
    assert "oil.toml" in str(error.value)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (((ROELANDS, DOOLITTLE),), 'needs density.law = "tait"'),
        (((ROELANDS, DOOLITTLE), (DENSITY, TAIT.replace("60.0", "40.0"))), "one temperature"),
        (((ROELANDS, DOOLITTLE.replace("0.65", "1.1")), (DENSITY, TAIT)), "must be below 1"),
        (((DENSITY, TAIT.replace("bulk_modulus_slope = 11.0\n", "")),), "needs bulk_modulus_slope"),
    ],
)
def test_free_volume_without_what_it_needs_is_refused(changes, said, tmp_path):
    with pytest.raises(InputError) as error:
        read_oil(written(tmp_path, *changes))
    assert said in str(error.value)


def test_the_expansion_that_compression_heats_is_that_of_the_density(tmp_path):
    oil = read_oil(written(tmp_path, (DENSITY, TAIT)))
    pressure, temperature = np.array(1e9), np.array(350.0)
    warm, cold = (oil.density_ratio(pressure, temperature + step)[0] for step in (0.01, -0.01))
    assert oil.expansion(pressure, temperature) == pytest.approx(-np.log(warm / cold) / 0.02, rel=1e-6)
    assert oil.expansion(pressure, temperature) < 0.7 * oil.expansion(0.0 * pressure, temperature)


@pytest.mark.parametrize("law", SHEARS)
def test_only_a_constant_eyring_stress_is_one(law, tmp_path):
    assert read_oil(written(tmp_path, (SHEAR, f"[shear]\n{SHEARS[law]}\n\n"))).eyring_stress == (
        pytest.approx(5e6) if 'law = "ree_eyring"' in SHEARS[law] else 0.0
    )


@pytest.mark.parametrize("law", [law for laws in (VISCOSITIES, SHEAR_LAWS, DENSITIES) for law in laws.all.values()])
def test_every_law_of_the_solver_names_its_equation_and_source(law):
    assert law.equation
    assert law.source
    assert law.name in repr(law)
