"""Batteries whose rigs follow other laws: what they deal, what their truth says, and how answers are scored."""

import json
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.cli import main
from mixedlub.validation.answers import read_truth
from mixedlub.validation.battery import MARK, make
from mixedlub.validation.planted import NAMED, OUTSIDE
from mixedlub.validation.rig import LAWS
from mixedlub.validation.rigs import CLASSES, discs
from mixedlub.validation.run import judge
from mixedlub.validation.sample_case import Order, sample_case
from mixedlub.validation.score import score
from mixedlub.validation.worlds.catalogue import OF_KIND, TOGETHER, Followed, following, laws_on
from mixedlub.validation.worlds.deal import plan_worlds
from mixedlub.validation.worlds.figures import WORLD_FIGURES
from mixedlub.validation.worlds.misfit import Seen
from profiles.errors import InputError

from .test_score import answer_of, truth_of

pytestmark = pytest.mark.long

KIND_OF = {
    "film_law": "disc",
    "asperity_law": "gear_pair",
    "load_balance": "disc",
    "mixture_law": "disc",
    "shear_law": "friction_history",
    "load_sharing_law": "mesh_friction",
    "pressure_viscosity_law": "viscosity",
    "viscosity_temperature_law": "film",
}
EFFECT = {
    "disc": ("film_heating",),
    "gear_pair": ("churning",),
    "friction_history": ("inlet_shear_heating",),
    "mesh_friction": ("film_heating",),
    "viscosity": ("viscosity_drift",),
    "film": ("starvation",),
}


@pytest.fixture(scope="module")
def orders():
    return plan_worlds(5, 240)


@pytest.fixture(scope="module")
def dealt(tmp_path_factory):
    """A case of every law, with an effect."""
    folder = tmp_path_factory.mktemp("worlds")
    made = {}
    for place, (law, kind) in enumerate(KIND_OF.items()):
        order = Order(f"case_{place:03d}", kind, "single", EFFECT[kind], "clear", laws=(law,), strong=True)
        made[law] = folder / make(3, place, order, folder)
    return made


def test_every_rig_follows_another_law_and_half_are_gears_and_discs(orders):
    assert all(order.laws and set(order.laws) <= LAWS for order in orders)
    assert {name for order in orders for name in order.laws} == LAWS
    kinds = Counter(order.kind for order in orders)
    assert set(kinds) == set(OF_KIND)
    assert 0.4 < (kinds["gear_pair"] + kinds["disc"]) / 240 < 0.6
    assert set(Counter(len(order.laws) for order in orders)) >= {1, 2, 3, 4}
    assert not any(order.no_data_sheet for order in orders)


def test_each_group_with_a_goal_has_sixty_cases(orders):
    classes = Counter(order.label for order in orders)
    assert min(classes[name] for name in ("none", "single", "unknown")) >= 60
    assert set(classes) == set(CLASSES)
    assert sum(order.strong for order in orders) > 0.6 * 240


def test_laws_are_followed_and_never_planted(orders):
    assert not LAWS & {name for order in orders for name in order.effects}
    for order in orders:
        barred = {"skewed_heights", "asperity_plasticity"} & set(order.effects)
        assert not (barred and {"asperity_law", "load_balance", "mixture_law"} & set(order.laws))
    together = [order for order in orders if set(order.laws) >= set(TOGETHER)]
    assert {order.label for order in together} == {"none", "single"}


@pytest.mark.long
def test_the_same_seed_deals_the_same_worlds(orders):
    assert plan_worlds(5, 240) == orders
    assert plan_worlds(6, 240) != orders


def test_kinds_without_laws_and_too_few_cases_are_refused():
    with pytest.raises(InputError, match="are dealt for gear_pair, disc"):
        plan_worlds(1, 40, ("disc", "friction_map"))
    with pytest.raises(InputError, match="at least 25"):
        plan_worlds(1, 24)


@pytest.mark.parametrize("law", KIND_OF)
def test_a_case_of_every_law_is_read_and_checked(dealt, law, capsys):
    assert read_case(dealt[law]).kind.name == KIND_OF[law]
    assert main(["check", str(dealt[law])]) == 0
    assert capsys.readouterr().out


@pytest.mark.parametrize("law", KIND_OF)
def test_the_case_says_nothing_of_its_law(dealt, law):
    words = {*LAWS, *NAMED, *OUTSIDE}
    for file in dealt[law].iterdir():
        if file.name != "truth.json":
            assert not [word for word in words if word in file.read_text()]


@pytest.mark.parametrize("law", KIND_OF)
def test_nominal_readings_are_those_of_the_base_model(dealt, law):
    """The case describes a rig of the base model; only nature follows another law."""
    truth = json.loads((dealt[law] / "truth.json").read_text())
    if "lubricant" not in (dealt[law] / "system.toml").read_text():
        pytest.skip("the oil is unnamed: nominal readings rest on priors")
    case = read_case(dealt[law])
    nominal = dict(zip(truth["rows"]["run"], truth["rows"]["nominal"]))
    expected = [nominal[int(run)] for run in case.recordings["run"]]
    assert Forward(case, case.recordings).predict() == pytest.approx(expected, rel=5e-4)


@pytest.mark.parametrize("law", KIND_OF)
def test_the_truth_names_the_law_and_how_far_off_it_is(dealt, law):
    told, truth = json.loads((dealt[law] / "truth.json").read_text()), read_truth(dealt[law])
    names = {one.name for one in OF_KIND[KIND_OF[law]] if one.id == law}
    assert told["laws"].keys() == {law}
    assert told["laws"][law] in names
    assert told["effects"] == list(EFFECT[KIND_OF[law]])
    assert truth.laws == {law}
    assert told["law_misfit"][law]["alone"] > 0
    assert (truth.clear_laws == {law}) == (told["law_misfit"][law]["alone"] > 100)
    assert law not in told["alternatives"]


def test_most_ordered_laws_are_off_the_base_model(dealt):
    clear = [law for law, folder in dealt.items() if read_truth(folder).clear_laws]
    assert len(clear) >= 6


def test_misfit_is_none_of_the_base_model_and_that_of_the_law_otherwise():
    rig = discs.draw(np.random.default_rng(5))
    z = np.zeros(len(rig.names))
    seen = Seen(rig, np.arange(len(rig.columns["run"])), z, 0.01 * rig.model(z, ()))
    assert seen.misfit((), ()) == pytest.approx(0.0, abs=1e-6)
    law = next(one for one in laws_on(rig)["asperity_law"] if "Tripp" in one.name)
    followed = Followed(law, {})
    assert seen.alone((followed,), followed) > 100
    assert seen.beside((followed,), followed) == seen.alone((followed,), followed)


@pytest.mark.parametrize("kind", OF_KIND)
def test_every_law_gives_finite_readings_and_leaves_the_model_alone(kind):
    from mixedlub.validation.rigs import KINDS

    rng = np.random.default_rng(14)
    rigs = [rig for rig in (KINDS[kind].draw(rng) for _ in range(12)) if laws_on(rig)][:2]
    for rig in rigs:
        z = np.zeros(len(rig.names))
        for laws in laws_on(rig).values():
            for law in laws:
                other = following(rig, (Followed(law, law.middle),))
                assert np.isfinite(other.records(z, ())).all(), law.name
                assert np.array_equal(other.model(z, ()), rig.model(z, ())), law.name


def test_effects_act_in_the_world_of_the_laws():
    order = Order("", "disc", "single", ("film_heating",), "clear", laws=("shear_law", "pressure_viscosity_law"))
    sample = sample_case(np.random.default_rng(4), order)
    heated = sample.rig.records(sample.z, sample.acts)
    cold = sample.rig.records(sample.z, ())
    assert (heated < cold).mean() > 0.9
    assert np.isfinite(heated).all()
    assert 9.0 < sample.visibility < 40.0


LAWFUL = {"laws": frozenset({"film_law"}), "clear_laws": frozenset({"film_law"}), "sole_laws": frozenset()}


def _answer(*verdict, tied=(), **probabilities):
    label = frozenset(verdict)
    others = tuple(frozenset(one) for one in tied)
    return replace(answer_of(), verdict=label, tied=(label, *others), probabilities=probabilities)


def _scored(*pairs):
    return score(pairs, figures=WORLD_FIGURES)


def test_an_answer_of_laws_alone_is_right_where_nothing_is_missing():
    truth = truth_of("none", "none", **LAWFUL)
    found = _scored((truth, _answer("film_law", film_law=0.95)), (truth, _answer("none", none=0.9)))
    assert found["none"].value == 1.0
    assert found["law"].value == 0.5
    assert found["false_physics"].value == 0.0
    assert found["claims"].value == 1.0


def test_a_false_effect_counts_only_where_it_is_claimed():
    truth = truth_of("none", "none", **LAWFUL)
    bold, shy = _answer("windage", windage=0.95, shear_law=0.99), _answer("windage", windage=0.8, unknown=0.6)
    found = _scored((truth, bold), (truth, shy))
    assert found["false_physics"].value == 0.5
    assert found["unknown_false"].value == 0.5
    assert found["none"].value == 0.0
    assert found["claims"].value == 0.0


def test_a_false_law_spoils_the_law_and_not_the_effect():
    truth = truth_of(**LAWFUL)
    found = _scored((truth, _answer("starvation", "film_law", "shear_law")))
    assert found["right"].value == found["tied"].value == 1.0
    assert found["law"].value == 0.0
    assert found["law_false"].value == 1.0


def test_a_law_among_ties_is_named():
    truth = truth_of(**LAWFUL)
    found = _scored((truth, _answer("starvation", tied=[("starvation", "film_law")])))
    assert found["law"].value == 1.0
    assert found["law_false"].value == 0.0


def test_a_law_that_nothing_shows_may_be_left_out():
    truth = truth_of(laws=frozenset({"film_law", "shear_law"}), clear_laws=frozenset({"shear_law"}))
    found = _scored((truth, _answer("starvation", "shear_law")))
    assert found["law"].value == 1.0
    assert found["laws_all"].value == 1.0


def test_judged_folders_have_the_figures_of_worlds(dealt, tmp_path):
    from .helpers import says_none

    cases = [dealt["film_law"], dealt["viscosity_temperature_law"]]
    for folder in cases:
        (tmp_path / "answers" / folder.name).mkdir(parents=True)
        says_none(folder, tmp_path / "answers" / folder.name)
    (cases[0].parent / MARK).write_text('{"dealt_by": "plan_worlds"}')
    found = judge(tmp_path, cases)["all"]
    assert {row.key for row in found.rows} >= {figure.key for figure in WORLD_FIGURES}
    assert found["tied"].value == 0.0
    assert "follows film_law" in (tmp_path / "score.txt").read_text()
