"""The film law of line contacts against full solutions, inside the range that it states and beyond."""

import numpy as np
import pytest

from mixedlub.ehl.solve import CONVERGED, solved
from mixedlub.laws.film import ELASTIC, dowson_toyoda, moes_load
from tests.ehl.contacts import MODULUS, contacts, roelands_oil

RADIUS, VISCOSITY, COEFFICIENT, TEMPERATURE = 8e-3, 0.02, 18e-9, 333.15


def over_solution(speed_parameter: np.ndarray, load_parameter: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Film of Dowson and Toyoda over the solved one of an incompressible oil, and Moes' load parameter."""
    speed = speed_parameter * MODULUS * RADIUS / VISCOSITY
    load = load_parameter * MODULUS * RADIUS
    oil = roelands_oil(eta=VISCOSITY, alpha=COEFFICIENT, known=TEMPERATURE, compressible=False)
    found = solved(oil, contacts(RADIUS, load, speed, speed, TEMPERATURE), thermal=False)
    assert (found.status == CONVERGED).all()
    film = dowson_toyoda(RADIUS, speed, load, VISCOSITY, COEFFICIENT, MODULUS)
    return film / found.central_film.to_numpy(), moes_load(RADIUS, speed, load, VISCOSITY, MODULUS)


@pytest.mark.parametrize("load", [3e-5, 1e-4])
def test_films_hold_where_their_law_says_so_and_not_far_beyond(load: float) -> None:
    least = ELASTIC["moes_load"][0]
    limit = 0.5 * (load / least) ** 2
    inside, parameters = over_solution(np.geomspace(3e-13, 0.99 * limit, 6), np.full(6, load))
    assert (parameters > least).all()
    assert inside == pytest.approx(1.0, abs=0.14)
    (beyond,), _ = over_solution(np.array([2.5 * limit]), np.array([load]))
    assert beyond > 1.15
