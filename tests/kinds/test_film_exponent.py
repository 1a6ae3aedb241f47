"""Films of another film law than the base model's: its exponent of speed is no physics that was left out.

The films are those of G. Nijenbanning, C. H. Venner, H. Moes, Wear 176 (1994) 217, written down here for a ball.
"""

import numpy as np
import pytest

from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.forward import Forward
from mixedlub.kinds.film import KNOWN_OIL, UNNAMED_OIL
from mixedlub.laws.film import POINT_EXPONENT, POINT_LOAD_EXPONENT

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


def test_solutions_over_oils_and_rigs_in_use_lie_within_two_spreads_of_the_regression():
    rng = np.random.default_rng(5)
    exponents = []
    for _ in range(400):
        viscosity, coefficient = np.exp(rng.uniform(np.log(0.004), np.log(0.3))), rng.uniform(10e-9, 28e-9)
        film = moes_film(SPEED, viscosity, coefficient, rng.uniform(10.0, 50.0))
        seen = (film > 5e-9) & (film < 1.2e-6)
        exponents.append(np.polyfit(np.log(SPEED[seen]), np.log(film[seen]), 1)[0])
    off = np.abs(np.log(np.array(exponents) / POINT_EXPONENT))
    assert np.mean(off < 2.0 * UNNAMED_OIL[0]) > 0.9
    assert np.mean(off < 2.0 * KNOWN_OIL[0]) < 0.7


def test_solutions_over_loads_lie_within_two_spreads_of_the_regression():
    rng = np.random.default_rng(6)
    load = np.geomspace(10.0, 100.0, 5)
    flow, loaded = np.log(SPEED / 0.17)[:, None], np.log(load / 31.6)[None, :]
    off = []
    for _ in range(200):
        viscosity, coefficient = np.exp(rng.uniform(np.log(0.004), np.log(0.3))), rng.uniform(10e-9, 28e-9)
        film = moes_film(SPEED[:, None], viscosity, coefficient, load[None, :])
        parts = np.broadcast_arrays(np.ones_like(film), flow, loaded, flow * loaded, flow**2)
        seen = (film > 5e-9) & (film < 1.2e-6)
        found = np.linalg.lstsq(np.array([p[seen] for p in parts]).T, np.log(film[seen]), rcond=None)[0]
        off.append([np.log(found[2] / POINT_LOAD_EXPONENT), found[3]])
    assert (np.mean(np.abs(off) < 2.0 * np.array(UNNAMED_OIL[1:]), axis=0) > 0.9).all()
    assert np.mean(np.array(off)[:, 1] > KNOWN_OIL[2]) > 0.9


@pytest.mark.parametrize("oil", OILS)
def test_films_of_another_film_law_lack_nothing(make, oil):
    d = diagnose_case(make(unnamed(), films(oil, heated=False)).folder)
    assert d.posterior.names(d.posterior.verdict) == ["none"]
    assert not d.test.detected


def test_film_that_heating_takes_is_found_under_another_film_law(make):
    d = diagnose_case(make(unnamed(), films("cold", heated=True)).folder)
    assert d.posterior.names(d.posterior.verdict) == ["inlet_shear_heating"]


def test_films_of_another_film_law_under_three_loads_lack_nothing_and_show_what_they_lack(make):
    found = [
        diagnose_case(make(unnamed(), films("cold", heated, (10.0, 30.0, 90.0))).folder) for heated in (False, True)
    ]
    verdicts = [d.posterior.names(d.posterior.verdict) for d in found]
    assert verdicts == [["none"], ["inlet_shear_heating"]]


def test_exponent_turns_films_about_the_middle_of_the_recording(make):
    case = make(system("film", "film_thickness_nm", contact=BALL, lubricant=OIL), films("usual", heated=False))
    forward = Forward(case, case.recordings)
    (exponent,) = forward.calibrations
    assert exponent.name == "film_exponent"
    ratio = forward.predict({"film_exponent": 1.03}) / forward.predict()
    assert np.exp(np.mean(np.log(ratio))) == pytest.approx(1.0, abs=1e-12)
    assert np.polyfit(np.log(SPEED), np.log(ratio), 1)[0] == pytest.approx(0.03 * POINT_EXPONENT, rel=1e-9)
