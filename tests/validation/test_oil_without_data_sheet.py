"""Films of an oil that nobody names, by another film law: dealt in every class, judged with the freedom they leave."""

import math
import tomllib
from collections import Counter

import numpy as np
import pytest
from typer.testing import CliRunner

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.chain.priors import Normal
from mixedlub.cli import app
from mixedlub.validation.answers import read_truth
from mixedlub.validation.battery import MARK, plan
from mixedlub.validation.contact import Calibration, oil_of, start
from mixedlub.validation.disclosure import (
    MINERAL,
    NOT_GIVEN,
    OF_A_KNOWN_OIL,
    OF_AN_UNKNOWN_OIL,
    moved,
    with_data_sheet,
    without_data_sheet,
)
from mixedlub.validation.rigs import OTHERS, films
from mixedlub.validation.rigs.ball import SPEED_EXPONENT, lubricate_ball_in_any_regime
from mixedlub.validation.rivals import Target, best, nearest, sensitivity, visibility
from mixedlub.validation.run import judge

from .helpers import says_none, truth_of

pytestmark = pytest.mark.long

TOLD_AS = {
    "viscosity_level": "viscosity",
    "viscosity_steepness": "viscosity_slope",
    "pressure_viscosity_warmth": "pressure_viscosity_slope",
}


@pytest.fixture(scope="module")
def cases(others, named_orders):
    """Cases of films, most of them of oils without a data sheet, with their orders."""
    return [(folder, named_orders[name]) for name, folder in others.items() if named_orders[name].kind == "film"]


def by_hand(viscosity, coefficient, load, speed, radius, modulus):
    """Nijenbanning, Venner and Moes for a circle, their equations one by one, curvature ratio 1."""
    ratio = 1.0
    group = viscosity * 2 * speed / (modulus * radius)
    m, ell = load / (modulus * radius**2) / group**0.75, coefficient * modulus * group**0.25
    shape = 1 + 0.006 * math.log(ratio) + 0.63 * ratio ** (4 / 7)
    ri = 145 * (1 + 0.796 * ratio ** (14 / 15)) ** (-15 / 7) / ratio / m**2
    ei = 3.18 * shape ** (-14 / 25) * ratio ** (-1 / 15) * m ** (-2 / 15)
    rp = 1.29 * (1 + 0.691 * ratio) ** (-2 / 3) * ell ** (2 / 3)
    ep = 1.48 * shape ** (-7 / 20) * ratio ** (-1 / 24) * m ** (-1 / 12) * ell ** (3 / 4)
    s = 1.5 * (1 + math.exp(-1.2 * ei / ep))
    soft = (ri**1.5 + (ei**-4 + (1.8 / ratio) ** -4) ** (-3 / 8)) ** (2 * s / 3)
    return radius * math.sqrt(group) * (soft + (rp**-8 + ep**-8) ** (-s / 8)) ** (1 / s)


def contact(viscosity, coefficient, load, speed):
    """One contact point of a ball of 9.525 mm on glass."""
    rig = films._interferometer(np.random.default_rng(1))[0]
    one = np.ones((1, 1))
    c = start(rig, Calibration())
    whole = {"viscosity": viscosity, "pressure_viscosity": coefficient, "force": load, "entrainment": speed}
    return type(c)(**{**vars(c), **{name: value * one for name, value in whole.items()}})


def test_law_over_all_regimes_gives_the_numbers_of_its_equations():
    c = contact(0.03, 18e-9, 20.0, 1.0)
    radius, modulus = float(c.rig.radius[0, 0]), c.rig.solid.reduced
    expected = by_hand(0.03, 18e-9, 20.0, 1.0, radius, modulus)
    assert lubricate_ball_in_any_regime(c).film[0, 0] == pytest.approx(expected, rel=1e-12)
    glass = 2 / ((1 - 0.3**2) / 207e9 + (1 - 0.22**2) / 75e9)
    assert by_hand(0.03, 18e-9, 20.0, 1.0, 9.525e-3, glass) == pytest.approx(203.684e-9, rel=1e-5)


@pytest.mark.parametrize(
    ("values", "exponent"),
    [
        ((1e-4, 1e-14, 1e4, 1e-4), 0.6),
        ((1e-2, 1e-6, 1e9, 1e-1), 0.75),
        ((1e-2, 1e-3, 0.5, 1.0), 2 / 3),
        ((1e-1, 1e-14, 1e-6, 1.0), 2.0),
    ],
    ids=["elastic isoviscous", "elastic piezoviscous", "rigid piezoviscous", "rigid isoviscous"],
)
def test_each_regime_has_its_own_exponent_of_speed(values, exponent):
    slow, fast = (lubricate_ball_in_any_regime(contact(*values[:3], values[3] * f)).film[0, 0] for f in (1.0, 1.01))
    assert math.log(fast / slow) / math.log(1.01) == pytest.approx(exponent, abs=0.02)


def test_planted_films_are_those_of_the_true_oil_and_not_of_what_is_told():
    for seed in range(6):
        inputs, settings, columns, _ = films._interferometer(np.random.default_rng(seed))
        rig = films.draw_without_data_sheet(np.random.default_rng(seed))
        oil, celsius = oil_of(settings), columns["oil_temperature_C"]
        last = (oil.viscosity_at(celsius)[-1], oil.pressure_viscosity_at(celsius)[-1])
        at = (columns["load_N"][-1], columns["entrainment_speed_m_s"][-1])
        film_nm = 1e9 * by_hand(*last, *at, float(inputs.radius[0, 0]), inputs.solid.reduced)
        for z in (np.zeros(len(rig.names)), np.ones(len(rig.names))):
            assert rig.records(z, ())[-1] == pytest.approx(film_nm, rel=1e-9)


def test_a_case_tells_no_oil_or_viscosities_in_name_only():
    rng = np.random.default_rng(3)
    seen = Counter()
    off = []
    for _ in range(60):
        rig = films.draw_without_data_sheet(rng)
        assert rig.theta(np.zeros(len(rig.names))) == {}
        section = rig.settings.get("lubricant")
        seen[section is not None] += 1
        if section is None:
            assert "uncertainty" not in rig.settings
            continue
        assert set(section) == {"name", "temperature_C", "kinematic_viscosity_mm2_s"}
        assert rig.settings["uncertainty"] == {"viscosity": 0.3}
    for seed in range(60):
        rig = films._interferometer(np.random.default_rng(seed))[0]
        case = without_data_sheet(np.random.default_rng(seed), rig)[1]
        if case:
            first, _ = case["lubricant"]["kinematic_viscosity_mm2_s"]
            off.append(math.log(1e-6 * first / rig.oil.kinematic[0]))
    assert min(seen.values()) > 15
    assert np.std(off) == pytest.approx(0.3, abs=0.1)


def test_calibration_of_the_truth_is_as_free_as_that_of_the_tool(cases):
    """Names and spreads; the density, which the tool has in addition, is within the level and the steepness."""
    for folder, order in cases:
        case = read_case(folder)
        tool = {c.name: c.parameter.prior for c in Forward(case, case.recordings).calibrations}
        tool.pop("density", None)
        section = tomllib.loads((folder / "system.toml").read_text())
        law = OF_AN_UNKNOWN_OIL if order.no_data_sheet else OF_A_KNOWN_OIL
        stated = {**NOT_GIVEN, **section.get("uncertainty", {}), **law}
        free = {TOLD_AS.get(name, name): stated[name] for name in truth_of(folder)["z"]}
        assert free == {name: prior.sd if isinstance(prior, Normal) else prior.spread for name, prior in tool.items()}


def one_bath():
    """A rig at one temperature."""
    rigs = (films._interferometer(np.random.default_rng(seed))[0] for seed in range(40))
    return next(rig for rig in rigs if np.ptp(rig.temperature) == 0)


def test_what_is_not_told_is_free():
    rig = one_bath()
    seen = [set(without_data_sheet(np.random.default_rng(seed), rig)[0].names) for seed in range(8)]
    assert {"viscosity_level", "pressure_viscosity", "film_regime", "film_exponent"} in seen
    assert {"viscosity", "pressure_viscosity", "film_regime", "film_exponent"} in seen
    known = {"viscosity": 0.1, "pressure_viscosity": 0.06, "film_regime": 0.5, "film_exponent": 0.015}
    assert with_data_sheet(rig, 0.1, 0.06).spreads == known


def test_the_exponent_turns_films_about_the_middle_of_the_programme():
    free, spread = with_data_sheet(one_bath(), 0.1, 0.06), 0.015
    ratio = np.log(free.model(np.array([0.0, 0.0, 0.0, 1.0]), ()) / free.model(np.zeros(4), ()))
    speed = np.log(free.rig.conditions["entrainment_speed_m_s"])
    assert ratio.mean() == pytest.approx(0.0, abs=1e-12)
    assert np.polyfit(speed, ratio, 1)[0] == pytest.approx(SPEED_EXPONENT * math.expm1(spread), rel=1e-9)


def test_an_oil_is_moved_along_the_chart_of_astm_d341():
    thick = moved(MINERAL, 60.0, 3.0, 1.2)
    assert thick.kinematic_at(60.0) == pytest.approx(3.0 * MINERAL.kinematic_at(60.0))
    chart = [np.diff(np.log10(np.log10(1e6 * np.array(oil.kinematic) + 0.7)))[0] for oil in (MINERAL, thick)]
    assert chart[1] == pytest.approx(1.2 * chart[0])
    assert min(moved(MINERAL, 60.0, 1e-6, 1.0).kinematic) == pytest.approx(0.4e-6)


def test_a_level_hardly_shows_in_films_of_an_unnamed_oil():
    """What is identifiable is worked out with that freedom: visibility of a gain of 10 %."""
    rig = one_bath()
    seen = []
    for who in (with_data_sheet(rig, 0.05, 0.06), without_data_sheet(np.random.default_rng(0), rig)[0]):
        z = np.zeros(len(who.names))
        base = who.model(z, ())
        moves = np.array([(who.model(z + 1e-4 * e, ()) - base) / 1e-4 for e in np.eye(len(z))]).T
        seen.append(visibility(0.1 * base, 0.01 * base, moves))
    assert seen[1] < 0.4 < 1.0 < seen[0]


def test_truth_is_weighed_against_films_that_the_regression_does_not_quite_give():
    rig = films.draw_without_data_sheet(np.random.default_rng(7))
    z = nearest(rig)
    values = rig.records(z, ())
    target = Target(rig, np.arange(len(values)), values, 0.01 * values)
    fit = best(target, (), np.zeros(len(z)))
    assert fit.z == pytest.approx(z, abs=1e-6)
    off = (rig.model(z, ()) - values) / target.sd
    assert fit.chi_square == pytest.approx(off @ off + z @ z)
    assert off @ off > 0
    assert sensitivity(rig, z).shape == (len(values), len(z))


def test_every_class_has_about_a_third_of_unnamed_oils():
    counts = Counter(
        (o.label, o.no_data_sheet) for seed in range(10) for o in plan(seed, 200, OTHERS) if o.kind == "film"
    )
    for label in ("none", "single", "pair", "measurement", "unknown"):
        share = counts[label, True] / (counts[label, True] + counts[label, False])
        assert 0.15 < share < 0.45
    one = [o for o in plan(3, 200, OTHERS) if o.kind == "film"]
    assert 11 <= sum(o.no_data_sheet for o in one) <= 13
    assert not [
        o for seed in range(10) for o in plan(seed, 200, OTHERS) if o.no_data_sheet and "sensor_gain" in o.effects
    ]
    assert not [o for o in plan(3, 200, OTHERS) if o.no_data_sheet and o.kind != "film"]


def test_check_accepts_every_case(cases):
    for folder, _ in cases:
        done = CliRunner().invoke(app, ["check", str(folder)])
        assert done.exit_code == 0, done.output


def test_planted_effects_are_told_as_of_any_case(cases):
    for folder, order in cases:
        found, truth = truth_of(folder), read_truth(folder)
        assert found["unnamed_oil"] == order.no_data_sheet
        assert truth.group == order.label
        assert bool(found["theta"]) != order.no_data_sheet
        if order.label in ("single", "measurement", "pair"):
            assert found["own"] < found["alternatives"]["none"]
        elif order.label == "none":
            assert np.array_equal(truth.values, truth.base)
            assert found["own"] == found["alternatives"]["none"]


def test_their_answers_are_counted_beside_all_films(cases, tmp_path):
    for folder, _ in cases:
        place = tmp_path / "answers" / folder.name
        place.mkdir(parents=True)
        says_none(folder, place)
    (cases[0][0].parent / MARK).write_text('{"dealt_by": "plan"}')
    judge(tmp_path, [folder for folder, _ in cases])
    text = (tmp_path / "score.txt").read_text()
    (head,) = (line for line in text.splitlines() if line.startswith("by kind"))
    assert head.split()[-2:] == ["film,", "unnamed"]
    (none,) = (line for line in text.splitlines() if line.startswith("right or tied, one effect, all"))
    assert none.split()[-1].endswith("/3")
