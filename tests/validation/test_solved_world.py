"""Rigs of full physics: tables of solutions, what is concealed in them, and their battery."""

from dataclasses import replace

import numpy as np
import pytest

from mixedlub.validation.answers import Answer, Truth
from mixedlub.validation.contact import calibrated, press, shear, start
from mixedlub.validation.measures import false_physics, right, tied
from mixedlub.validation.rig import FILM, SHEAR, play
from mixedlub.validation.rigs import discs, gears
from mixedlub.validation.rivals import descend
from mixedlub.validation.solved import table as tables
from mixedlub.validation.solved import world
from mixedlub.validation.solved.deal import plan_solved
from mixedlub.validation.solved.solver import Place, UnsolvedError
from mixedlub.validation.solved.table import Physics, Table, between, grid_of, ratios, shares, slip_of
from mixedlub.validation.solved.world import SWITCHES, draw, laws_of, switched
from profiles.errors import InputError


@pytest.fixture(scope="module")
def disc():
    case = discs.draw_case(np.random.default_rng(5), coated=False)
    return discs.inputs_of(case), calibrated(case.settings, np.zeros(5))


def made(grid, film, stress):
    """A table of given ratios (logarithms) of the temperature, slip, load and speed of its nodes."""
    t, _, slip, load, speed = np.meshgrid(
        grid.temperatures, grid.sides, grid.slips, grid.loads, grid.speeds, indexing="ij"
    )
    return Table(grid, film(t, slip, load, speed), stress(t, slip, load, speed), np.ones(grid.shape))


def test_nodes_are_joined_by_polynomials():
    nodes = between(0.02, 1.0, 4)
    x = np.linspace(nodes[0], nodes[-1], 7)
    assert shares(nodes, x) @ nodes**3 == pytest.approx(x**3, rel=1e-9)
    assert shares(nodes, np.array([nodes[0] - 1.0])) @ nodes == pytest.approx(nodes[:1])
    assert len(between(1.0, 1.0, 3)) == 1


def test_a_table_gives_the_ratios_of_each_contact(disc):
    rig, calibration = disc
    c = press(start(rig, calibration))
    solved = made(grid_of(rig), lambda t, s, w, u: 0.1 * s * u, lambda t, s, w, u: 0.01 * t + 0.1 * w**2)
    film, stress = solved.at(c)
    slip = np.log(slip_of(c))
    assert film == pytest.approx(0.1 * slip * np.log(c.entrainment))
    assert stress == pytest.approx(0.01 * c.temperature + 0.1 * np.log(c.line_load) ** 2 + 0 * slip)
    assert solved.at(c)[0] is film


def test_radii_of_gears_follow_the_slip_on_both_sides_of_the_pitch_point():
    case = gears.draw_case(np.random.default_rng(5), coated=False)
    rig = gears.inputs_of(case, gears.COARSE)
    grid = grid_of(rig)
    slip = (rig.speed_1 - rig.speed_2)[0] / (0.5 * (rig.speed_1 + rig.speed_2))[0]
    for side, radii in zip(grid.sides, grid.radii):
        there = np.argmin(np.abs(slip - side * np.exp(grid.slips[2])))
        assert radii[2] == pytest.approx(rig.radius[0, there], rel=0.05)


def test_a_table_of_discs_is_near_left_out_solutions(disc):
    """Isothermal; film within 0.3 %, stress within 2 %."""
    rig, calibration = disc
    rig = replace(rig, temperature=np.full_like(rig.temperature, 70.0))
    c = press(start(rig, calibration))
    solved = tables.table(rig, calibration, Physics())
    film, stress = solved.at(c)
    rows = np.flatnonzero(slip_of(c)[:, 0] > 0.03)[::40]
    one, two, load, radius = rig.speed_1[:, 0], rig.speed_2[:, 0], c.line_load[:, 0], float(rig.radius[0, 0])
    places = [Place(radius, float(load[i]), (float(one[i]), float(two[i])), 70.0) for i in rows]
    other_film, other_stress, friction = ratios(rig, calibration, Physics(), places)
    assert film[rows, 0] == pytest.approx(other_film, abs=0.003)
    assert stress[rows, 0] == pytest.approx(other_stress, abs=0.02)
    assert np.all((friction > 0) & (friction < 0.1))


def test_a_rig_follows_its_solutions_and_what_is_switched_on(disc):
    rig, calibration = disc
    grid = grid_of(rig)
    base = made(grid, lambda *_: np.full(grid.shape, np.log(0.9)), lambda *_: np.full(grid.shape, np.log(0.8)))
    hot = made(grid, lambda *_: np.full(grid.shape, np.log(0.6)), lambda *_: np.full(grid.shape, np.log(0.4)))
    laws = [one.act for one in laws_of(base, "full solution")]
    formula, solved, warm = (
        play(discs.FRICTION, start(rig, calibration), acts)
        for acts in ([], laws, [*laws, switched("film_heating", base, hot).hide({"strength": 1.0})])
    )
    assert solved.film == pytest.approx(0.9 * formula.film)
    assert warm.film == pytest.approx(0.6 * formula.film)
    thinner = replace(formula, film=0.6 * formula.film)
    assert warm.stress == pytest.approx(0.4 * shear(thinner).stress)


@pytest.mark.parametrize(
    ("kind", "switch", "lowered"),
    [("disc", "starved", "film"), ("disc", "limited", "stress"), ("disc", "rheology", ""), ("disc", "balance", ""),
     ("gear_pair", "windage", "")],
)  # fmt: skip
def test_each_switch_changes_the_readings_of_a_rig(monkeypatch, kind, switch, lowered):
    """On tables of two nodes a condition."""
    for name in ("SLIPS", "LOADS", "SPEEDS"):
        monkeypatch.setattr(tables, name, 2)
    rig, world, forms, z = draw(np.random.default_rng(2), kind, switch, full_base=False)
    assert {FILM, SHEAR} <= {one.law.id for one in world}
    assert [form.id for form in forms] == [name for name in (SWITCHES[switch].effect,) if name]
    plain = rig.records(z, ())
    seen = rig.records(z, [form.hide({k.name: 0.5 * sum(k.typical) for k in form.knobs}) for form in forms])
    assert np.all(np.isfinite(seen))
    assert np.max(np.abs(seen / plain - 1)) > 0.02 or not forms
    formula = rig.model(z, ())
    assert np.max(np.abs(plain / formula - 1)) > 0.02
    if lowered == "stress":
        assert np.all(seen <= plain * (1 + 1e-9))


def test_every_case_conceals_one_thing_and_none_of_the_full_base():
    orders = plan_solved(3, 60)
    assert len(orders) == 60
    assert sum(order.kind == "disc" for order in orders) == 40
    assert {order.solved for order in orders if order.kind == "gear_pair"} == set(SWITCHES)
    for order in orders:
        switch = SWITCHES[order.solved]
        assert order.kind in switch.kinds
        assert order.effects == ((switch.effect,) if switch.effect else ())
        assert not (order.full_base and switch.contained)
    assert any(order.full_base for order in orders)


def test_films_have_no_full_physics():
    with pytest.raises(InputError, match="gear_pair and disc alone"):
        plan_solved(3, 60, ("film",))


def _truth(label, beside=()):
    nothing, none = np.zeros(0), frozenset()
    return Truth(
        "case", "disc", "single", (), frozenset(label), 20.0, True, False, False, none, {}, nothing, nothing, nothing,
        nothing, nothing, laws=frozenset({FILM, SHEAR}), beside=frozenset(beside), solved="thermal",
    )  # fmt: skip


def _answer(verdict, *ties, **probabilities):
    nothing, none = np.zeros(0), frozenset()
    sets = tuple(frozenset(one) for one in (verdict, *ties))
    return Answer("case", sets[0], sets, probabilities, True, none, {}, {}, nothing, nothing, nothing, nothing, nothing)


def test_heat_in_the_inlet_belongs_to_heat_in_the_film():
    """Laws are true of such a rig too; heat of the inlet alone is not what was switched on."""
    truth = _truth({"film_heating"}, {"inlet_shear_heating"})
    assert right(truth, _answer({"film_heating", "inlet_shear_heating", FILM}))
    assert right(truth, _answer({"film_heating"}))
    assert not right(truth, _answer({"inlet_shear_heating"}))
    assert tied(truth, _answer({"starvation"}, {"film_heating", SHEAR}))
    assert not false_physics(truth, _answer({"film_heating"}, inlet_shear_heating=0.95))
    assert false_physics(truth, _answer({"film_heating"}, starvation=0.95))
    assert right(_truth({"none"}), _answer({FILM}))


def test_a_rig_with_a_contact_without_solution_is_drawn_again(monkeypatch):
    tried = []

    def first_fails(*order):
        tried.append(order)
        if len(tried) == 1:
            raise UnsolvedError("the contact has no solution")
        return "second"

    monkeypatch.setattr(world, "_drawn", first_fails)
    assert draw(np.random.default_rng(0), "disc", "nothing", False) == "second"
    monkeypatch.setattr(world, "MOST_RIGS", 0)
    with pytest.raises(InputError, match="every rig has a contact without solution"):
        draw(np.random.default_rng(0), "disc", "nothing", False)


def test_a_fit_of_a_rival_starts_only_where_the_model_has_a_number():
    x, cost = descend(lambda x: np.full(2, np.nan), np.zeros(1), -np.ones(1), np.ones(1))
    assert (x.tolist(), cost) == ([0.0], np.inf)
