"""Mixed contacts: film and asperities carry the whole load, and the limits are those of each alone."""

from pathlib import Path

import numpy as np
import pytest
import xarray
from scipy.integrate import quad

from mixedlub.base_model.balanced import balanced_film
from mixedlub.cli import main
from mixedlub.ehl import contacts, example_oil
from mixedlub.ehl.file import read_problem
from mixedlub.ehl.mixed import Asperities, laws, solve_mixed, yielding
from mixedlub.ehl.solve import CONVERGED, Way, solved
from mixedlub.laws.contact import mean_hertz_pressure
from profiles.errors import InputError

MOMENTS = {"m0": 0.0157e-12, "m2": 0.001, "m4": 0.001e12}
"""Superfinished flanks."""
SPEED = np.array([0.2, 1.0, 4.0])
PLACE = contacts(radius=8.69e-3, line_load=215e3, speed=SPEED, sliding_speed=-0.1 * SPEED, oil_temperature=333.15)
GREENWOOD = Asperities(**MOMENTS, law="greenwood_williamson", boundary_friction=0.1)


@pytest.fixture(scope="module")
def mixed() -> xarray.Dataset:
    return solve_mixed(example_oil(), PLACE, GREENWOOD, thermal=False, way=Way())


def elastic_pressure(film: float) -> float:
    """Pressure of McCool's asperities by Greenwood and Williamson, with the integral over heights done numerically."""
    m0, m2, m4 = MOMENTS["m0"], MOMENTS["m2"], MOMENTS["m4"]
    alpha = m0 * m4 / m2**2
    density, radius = m4 / (m2 * 6.0 * np.pi * np.sqrt(3.0)), 0.375 * np.sqrt(np.pi / m4)
    sigma, offset = np.sqrt((1.0 - 0.8968 / alpha) * m0), 4.0 * np.sqrt(m0 / (np.pi * alpha))
    t = (film - offset) / sigma
    heights = quad(lambda z: (z - t) ** 1.5 * np.exp(-0.5 * z * z) / np.sqrt(2.0 * np.pi), t, max(t, 0.0) + 12.0)[0]
    return float(2.0 / 3.0 * PLACE.modulus[0] * density * np.sqrt(radius) * sigma**1.5 * heights)


def test_film_and_asperities_carry_the_whole_load(mixed: xarray.Dataset) -> None:
    assert set(mixed["status"].to_numpy()) == {CONVERGED}
    place, pressure = mixed["position"].to_numpy(), mixed["pressure"].to_numpy()
    by_film = np.trapezoid(pressure, place, axis=1)
    asperities = np.array([elastic_pressure(h) for h in mixed["central_film"].to_numpy()]) * 2.0 * PLACE.half_width
    assert (by_film + asperities) / PLACE.line_load == pytest.approx(1.0, abs=1e-6)
    assert asperities / PLACE.line_load == pytest.approx(mixed["asperity_load_share"].to_numpy(), abs=1e-6)
    assert (np.diff(mixed["asperity_load_share"]) < 0.0).all()
    assert 0.1 < float(mixed["asperity_load_share"][0]) < 0.9


def test_friction_is_that_of_both_by_what_they_carry(mixed: xarray.Dataset) -> None:
    share = mixed["asperity_load_share"].to_numpy()
    film = mixed["friction_coefficient"].to_numpy()
    assert (film < 0.0).all()
    assert mixed["mixed_friction_coefficient"].to_numpy() == pytest.approx(film * (1.0 - share) - 0.1 * share)


def test_the_balance_of_film_laws_is_close_to_it(mixed: xarray.Dataset) -> None:
    full = solved(example_oil(), PLACE, thermal=False)["central_film"].to_numpy()
    mean = mean_hertz_pressure(PLACE.pressure)
    film = balanced_film(full, mean, 0.13, lambda h: GREENWOOD.carried(h, PLACE.modulus)[0])
    own = mixed["central_film"].to_numpy()
    assert own[-1] == pytest.approx(film[-1], rel=0.01)
    # the film of a compressible oil grows faster than a film law's as it gives way
    assert (own >= 0.999 * film).all()
    assert own == pytest.approx(film, rel=0.25)


def test_smooth_surfaces_have_the_film_of_a_smooth_contact() -> None:
    one = PLACE.take(np.array([2]))
    smooth = Asperities(1e-18, 1e-5, 1e8, "greenwood_williamson", 0.1)
    found = solve_mixed(example_oil(), one, smooth, thermal=False, way=Way())
    alone = solved(example_oil(), one, thermal=False)
    assert float(found["asperity_load_share"][0]) < 1e-12
    assert float(found["central_film"][0]) == pytest.approx(float(alone["central_film"][0]), rel=1e-6)


CONTACTS = """schema = "mixedlub-ehl/1"
oil = "pao4"
thermal = false
[contacts]
radius_mm = 8.69
line_load_N_mm = 100.0
entrainment_speed_m_s = 0.5
oil_temperature_C = 60.0
[asperities]
m0_um2 = 0.0157
m2 = 0.001
m4_per_um2 = 0.001
"""


def test_a_file_has_asperities_and_the_table_what_they_carry(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "contacts.toml"
    path.write_text(CONTACTS + 'law = "kogut_etsion"\nhardness_GPa = 6.0\n')
    assert main(["ehl", str(path), "--no-figures", "--out", str(tmp_path / "out")]) == 0
    assert "asperities carry" in capsys.readouterr().out
    head, row = (line.split(",") for line in (tmp_path / "out" / "contacts.csv").read_text().splitlines())
    assert abs(float(row[head.index("load_missed")])) < 1e-6
    assert not list((tmp_path / "out").glob(".parts-*"))


@pytest.mark.parametrize(
    ("added", "said"),
    [
        ('law = "jackson_green"\n', "needs hardness_GPa"),
        ("hardness_GPa = 6.0\n", "acts only with asperities that yield"),
        ('law = "greenwood_trip"\n', "greenwood_williamson"),
        ("boundary_friction = 0.0\n", "must be above 0"),
    ],
)
def test_asperities_without_what_their_law_needs_are_refused(added: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "contacts.toml"
    path.write_text(CONTACTS + added)
    with pytest.raises(InputError) as error:
        read_problem(path)
    assert said in str(error.value)


def test_laws_of_asperities_are_those_that_read_moments_and_hardness() -> None:
    assert laws()[0] == "greenwood_williamson"
    assert set(yielding()) == set(laws()) - {"greenwood_williamson"}
