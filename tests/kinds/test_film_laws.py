"""Films of another film law than the base model's: its exponent of speed is no physics that was left out.

The films are those of G. Nijenbanning, C. H. Venner, H. Moes, Wear 176 (1994) 217, written down here for a ball.
"""

import numpy as np
import pytest

from mixedlub.case.forward import Forward
from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.laws.film import POINT_EXPONENT, nijenbanning

from .conftest import BALL, OIL, noisy, system

RADIUS, MODULUS = 9.525e-3, 2.0 / ((1 - 0.3**2) / 207e9 + (1 - 0.22**2) / 75e9)
SPEED = np.geomspace(0.01, 3.0, 26)
OILS = {"thin": (0.01, 14e-9), "usual": (0.03, 18e-9), "cold": (0.1, 20e-9)}


def moes_film(speed, viscosity, coefficient, load, radius=RADIUS, modulus=MODULUS):
    """Central film of a ball (m), over all regimes."""
    group = viscosity * 2.0 * speed / (modulus * radius)
    m, ell = load / (modulus * radius**2) * group**-0.75, coefficient * modulus * group**0.25
    round_contact = 1.63
    rigid, soft = 145.0 * 1.796 ** (-15 / 7) / m**2, 3.18 * round_contact ** (-14 / 25) * m ** (-2 / 15)
    stiff = 1.48 * round_contact ** (-7 / 20) * m ** (-1 / 12) * ell**0.75
    rolled = 1.29 * 1.691 ** (-2 / 3) * ell ** (2 / 3)
    s = 1.5 * (1.0 + np.exp(-1.2 * soft / stiff))
    isoviscous = (rigid**1.5 + (soft**-4 + 1.8**-4) ** (-3 / 8)) ** (2 * s / 3)
    return radius * np.sqrt(group) * (isoviscous + (rolled**-8 + stiff**-8) ** (-s / 8)) ** (1 / s)


def films(oil, heated, loads=(20.0,)):
    """Columns of a speed sweep, with the loss of H. Murch, W. R. D. Wilson, J. Lubr. Technol. 97 (1975) 212."""
    viscosity, coefficient = OILS[oil]
    speed, load = np.tile(SPEED, len(loads)), np.repeat(loads, SPEED.size)
    film = moes_film(speed, viscosity, coefficient, load)
    loading = 0.045 * viscosity * speed**2 / 0.14
    if heated:
        film = film * 3.94 / (3.94 + loading**0.62)
    held = {"slide_roll_ratio": 0.0, "oil_temperature_C": 31.0}
    columns = {name: np.full(speed.size, value) for name, value in held.items()}
    return {**columns, "load_N": load, "entrainment_speed_m_s": speed, "film_thickness_nm": noisy(1e9 * film, 0.015)}


def unnamed():
    sections = system("film", "film_thickness_nm", contact=BALL)
    sections["recording"]["noise"] = {"relative": 0.015}
    return sections


def test_formula_for_all_regimes_is_that_of_nijenbanning_venner_and_moes():
    for viscosity, coefficient in OILS.values():
        law = nijenbanning(RADIUS, RADIUS, SPEED, 20.0, viscosity, coefficient, MODULUS)
        assert np.allclose(law, moes_film(SPEED, viscosity, coefficient, 20.0), rtol=1e-12)


SOFT = {"viscosity": 0.01, "pressure_viscosity": 1e-13, "reduced_modulus": 1e7}
STIFF = {"viscosity": 1.0, "pressure_viscosity": 1e-6, "reduced_modulus": 2e11}


@pytest.mark.parametrize(("rig", "load", "exponent"), [(SOFT, 1e7, 0.5 + 1 / 10), (STIFF, 1e14, 0.5 + 1 / 16 + 3 / 16)])
def test_formula_for_all_regimes_ends_in_the_exponents_of_its_asymptotes(rig, load, exponent):
    speed = np.array([1.0, 1.01])
    film = nijenbanning(RADIUS, RADIUS, speed, load, **rig)
    assert np.diff(np.log(film))[0] / np.diff(np.log(speed))[0] == pytest.approx(exponent, abs=0.005)


@pytest.mark.long
@pytest.mark.parametrize("oil", ["usual", *(pytest.param(o, marks=pytest.mark.long) for o in OILS if o != "usual")])
def test_films_of_another_film_law_lack_nothing(make, oil):
    d = diagnose_case(make(unnamed(), films(oil, heated=False)).folder)
    assert list(d.posterior.verdict.ids) == ["none"]
    assert not d.test.detected


@pytest.mark.long
def test_film_that_heating_takes_is_found_under_another_film_law(make):
    d = diagnose_case(make(unnamed(), films("cold", heated=True)).folder)
    assert list(d.posterior.verdict.ids) == ["inlet_shear_heating"]


@pytest.mark.long
def test_films_of_another_film_law_under_three_loads_lack_nothing_and_show_what_they_lack(make):
    found = [
        diagnose_case(make(unnamed(), films("cold", heated, (10.0, 30.0, 90.0))).folder) for heated in (False, True)
    ]
    assert list(found[0].posterior.verdict.ids) == ["none"]
    assert ["inlet_shear_heating"] in [list(key.ids) for key in found[1].posterior.tied]


@pytest.mark.parametrize(
    "disc", ["glass", *(pytest.param(one, marks=pytest.mark.long) for one in ("sapphire", "steel"))]
)
def test_known_oil_of_another_film_law_lacks_nothing_on_any_disc(make, disc):
    young, poisson = {"glass": (75.0, 0.22), "sapphire": (430.0, 0.27), "steel": (207.0, 0.3)}[disc]
    modulus = 2.0 / ((1 - 0.3**2) / 207e9 + (1 - poisson**2) / (young * 1e9))
    contact = {**BALL, "youngs_modulus_GPa": [207.0, young], "poisson_ratio": [0.3, poisson]}
    columns = films("usual", heated=False, loads=(10.0, 40.0))
    film = moes_film(columns["entrainment_speed_m_s"], *OILS["usual"], columns["load_N"], modulus=modulus)
    sheet = {**OIL, "temperature_C": [31.0, 100.0], "pressure_viscosity_per_GPa": [18.0, 14.0]}
    sheet["kinematic_viscosity_mm2_s"] = [0.03 / 858.7 * 1e6, 5.5]
    sections = system("film", "film_thickness_nm", contact=contact, lubricant=sheet)
    sections["uncertainty"] = {"viscosity": 0.05, "pressure_viscosity": 0.1}
    sections["recording"]["noise"] = {"relative": 0.015}
    d = diagnose_case(make(sections, {**columns, "film_thickness_nm": noisy(1e9 * film, 0.015)}).folder)
    assert ["none"] in [list(key.ids) for key in d.posterior.tied]
    assert not d.test.detected


def test_exponent_turns_films_about_the_middle_of_the_recording(make):
    case = make(system("film", "film_thickness_nm", contact=BALL, lubricant=OIL), films("usual", heated=False))
    forward = Forward(case, case.recordings)
    assert [c.name for c in forward.calibrations] == ["film_regime", "film_exponent"]
    ratio = forward.predict({"film_exponent": 1.03}) / forward.predict()
    assert np.exp(np.mean(np.log(ratio))) == pytest.approx(1.0, abs=1e-12)
    assert np.polyfit(np.log(SPEED), np.log(ratio), 1)[0] == pytest.approx(0.03 * POINT_EXPONENT, rel=1e-9)


@pytest.mark.long
def test_pressure_viscosity_that_goes_with_a_power_of_viscosity_lacks_nothing(make):
    """That of mineral oils by P. W. Gold and others, J. Synth. Lubr. 18 (2001) 51, is no line in temperature."""
    celsius, speed = (grid.ravel() for grid in np.meshgrid([20.0, 60.0, 100.0, 140.0], np.geomspace(0.02, 3.0, 16)))
    known = {"temperature_C": [40.0, 100.0], "kinematic_viscosity_mm2_s": [35.0, 6.2]}
    line = np.polyfit(np.log10(np.array([313.15, 373.15])), np.log10(np.log10(np.array([35.7, 6.9]))), 1)
    kinematic = 10.0**10.0 ** np.polyval(line, np.log10(celsius + 273.15)) - 0.7
    density = 870.0 * (1.0 - 7e-4 * (celsius - 15.0))
    film = moes_film(speed, 1e-6 * kinematic * density, 9.904e-9 * kinematic**0.139, 20.0)
    columns = {"slide_roll_ratio": np.zeros(speed.size), "load_N": np.full(speed.size, 20.0)}
    columns |= {"oil_temperature_C": celsius, "entrainment_speed_m_s": speed}
    sections = system("film", "film_thickness_nm", contact=BALL, lubricant=known)
    sections |= {"uncertainty": {"viscosity": 0.3}}
    sections["recording"]["noise"] = {"relative": 0.004}
    d = diagnose_case(make(sections, {**columns, "film_thickness_nm": noisy(1e9 * film, 0.004)}).folder)
    assert list(d.posterior.verdict.ids) == ["none"]
