"""Contacts that Newton's method does not solve at once: thick oils with little sliding, and oil that nearly stands."""

import numpy as np
import pytest

import mixedlub as ml
from mixedlub.ehl import levels, newton

from .contacts import TEMPERATURE, contacts, roelands_oil

pytestmark = pytest.mark.filterwarnings("ignore::mixedlub.schema.findings.FindingWarning")
STICKY = {"radius": 12.64e-3, "line_load": 80.56e3, "speed": 0.4473, "oil_temperature": 313.8}


def solved(oil, **given):
    return ml.ehl.solve(ml.ehl.read_oil(oil), **given)


@pytest.fixture(scope="module")
def sticky():
    """Little sliding both ways, none, and ten times as much."""
    ratios = np.array([0.03776, -0.03776, 0.0, 0.3776])
    return solved("pao40", **STICKY, sliding_speed=ratios * STICKY["speed"], thermal=False)


def test_little_sliding_is_reached_from_larger(sticky):
    assert set(sticky["status"].values) == {"converged"}
    assert np.all(sticky["mass_imbalance"] < 1e-6)
    film, friction = sticky["central_film"].values, sticky["friction_coefficient"].values
    assert film == pytest.approx(film[-1], rel=0.05)
    assert friction[0] == pytest.approx(-friction[1], rel=1e-6)
    assert abs(friction[2]) < 1e-9
    assert 0.0 < friction[0] < friction[3]


def test_newtons_method_alone_does_not_reach_it(monkeypatch):
    monkeypatch.setattr(levels, "again", lambda *given, **_: (given[3], np.zeros(1, dtype=bool)))
    found = solved("pao40", **STICKY, sliding_speed=0.03776 * STICKY["speed"], thermal=False)
    assert found["status"].values[0] == "no solution"


def test_a_layer_that_nearly_stands_in_the_inlet_does_not_keep_the_steps_from_ending(monkeypatch):
    monkeypatch.setattr(levels, "again", lambda *given, **_: (given[3], np.zeros(1, dtype=bool)))
    given = {"radius": 14.67e-3, "line_load": 436.1e3, "speed": 11.22, "sliding_speed": 9.035}
    assert solved("75w90", **given, oil_temperature=331.2)["status"].values[0] == "converged"


@pytest.mark.parametrize(("far", "steps"), [(False, newton.STALLED), (True, newton.QUICK.steps)])
def test_a_near_start_whose_steps_are_all_cut_short_is_given_up(
    monkeypatch: pytest.MonkeyPatch, far: bool, steps: int
) -> None:
    calls: list[int] = []

    def cut_short(oil, contacts, mesh, state):
        calls.append(len(contacts.radius))
        return state, np.full(len(contacts.radius), np.inf)

    monkeypatch.setattr(newton, "film_step", cut_short)
    oil, one = roelands_oil(), contacts(8e-3, 2e5, 2.0, 2.0, TEMPERATURE)
    film = levels.central_film(oil, one)
    mesh = levels.grid(levels.flooded_inlet(film), film, 61)
    start = levels._guess(one, mesh, film, 1)
    _, converged = newton.converge(oil, one, mesh, start, thermal=False, far=np.array([far]))
    assert not converged[0]
    assert len(calls) == steps


def test_a_contact_given_up_has_more_time_at_last(monkeypatch: pytest.MonkeyPatch) -> None:
    """The continuation fails here; a contact that fails three times has no solution."""
    starts: list[bool] = []

    def failing(oil, given, mesh, start, *, thermal, far):
        starts.extend(far.tolist())
        return start, np.full(len(far), mesh.x.shape[1] == 61)

    monkeypatch.setattr(levels, "converge", failing)
    monkeypatch.setattr(levels, "again", lambda *given, **_: (given[3], np.zeros(1, dtype=bool)))
    found = levels.solve_levels(roelands_oil(), contacts(8e-3, 2e5, 2.0, 2.0, TEMPERATURE), thermal=False)
    assert starts[:3] == [True, False, True]
    assert found.stopped_at.tolist() == [121]
    assert not len(found.index)
