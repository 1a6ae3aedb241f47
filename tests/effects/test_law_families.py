"""Laws of the catalogue against the published laws that they become, written by the independent rigs."""

import numpy as np
import pytest
from scipy.special import erfc

from mixedlub.effects import catalogue
from mixedlub.laws.film import dowson_toyoda, moes
from mixedlub.validation.worlds import films

STEEL, RADIUS = 226.374e9, 8.3262e-3
SPEED, ALPHA, LOAD = (a.ravel() for a in np.meshgrid([0.3, 2.0, 10.0], [12e-9, 20e-9], [2e4, 2e5, 1e6]))
STATE = (RADIUS, SPEED, LOAD, 0.015, ALPHA, STEEL)
GROUPS = (0.015 * SPEED / (STEEL * RADIUS), ALPHA * STEEL, LOAD / (STEEL * RADIUS))


@pytest.mark.parametrize(
    ("name", "published"),
    [
        ("Dowson and Higginson", films.dowson_higginson_1968),
        ("Pan and Hamrock", films.pan_hamrock),
        ("Grubin", films.grubin),
        ("Moes", films.moes),
    ],
)
def test_the_film_becomes_every_published_regression(name, published):
    law = catalogue()["film_law"]
    found = law.law(dowson_toyoda(*STATE), SPEED, 0.015, LOAD, RADIUS, ALPHA, STEEL, **law.law_values(name))
    assert found == pytest.approx(RADIUS * published(*GROUPS), rel=2e-3)


def test_the_film_of_all_regimes_is_that_of_the_independent_rigs():
    assert moes(*STATE) == pytest.approx(RADIUS * films.moes(*GROUPS), rel=1e-12)


def _weight(ratio, share=0.5, **values):
    """Weight of boundary friction by the film over the roughness."""
    law = catalogue()["mixture_law"]
    given = {**law.law_values("Doleschel"), **values}
    return law.law(0.0 * ratio, 0.0, 1.0, 0.0, 0.0, ratio, 1.0, share, **given)


@pytest.mark.literature("Doleschel (2003), square of what is left to twice the mean roughness")
@pytest.mark.parametrize("share", [0.5, 0.9, 1.0])
def test_the_mixture_becomes_the_square_over_the_mean_roughness(share):
    ratio = np.linspace(0.0, 2.0, 21)
    mean = 0.5 * np.sqrt(2 / np.pi) * (np.sqrt(share) + np.sqrt(1 - share))
    assert _weight(ratio, share) == pytest.approx(np.maximum(1 - ratio / (2 * mean), 0) ** 2, abs=1e-4)


@pytest.mark.literature("Aihara (1987), weight of the film")
def test_the_mixture_becomes_an_exponential_of_the_film():
    ratio = np.linspace(0.0, 3.0, 31)
    aihara = catalogue()["mixture_law"].law_values("Aihara")
    assert _weight(ratio, **aihara) == pytest.approx(np.exp(-1.8 * ratio**1.2), abs=1e-12)


def test_the_mixture_is_near_an_error_function_of_the_film():
    ratio = np.linspace(0.0, 3.0, 31)
    near = _weight(ratio, rate=1.49, power=1.13, mean_roughness=0.0, end=0.234)
    assert near == pytest.approx(erfc(ratio), abs=0.008)


@pytest.mark.literature("Carreau (1972), power of the shear rate")
def test_the_shear_is_near_a_power_of_the_rate():
    rate = np.geomspace(0.05, 500.0, 60)
    values = {"pressure_exponent": 0.0, "fall": 0.0, "rate_exponent": 0.26, "rate_onset": 14.2}
    stress = catalogue()["shear_law"].law(0.7, 1.0, rate, 1.0, 1e9, 353.15, **values)
    assert stress * np.arcsinh(rate / stress) == pytest.approx(rate * (1 + rate**2) ** -0.3, rel=0.025)
