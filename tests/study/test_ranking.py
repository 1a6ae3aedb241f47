"""Ranking of pairings: its probabilities hold as often as they say, common flanks are drawn once, costs have a
frontier."""

import numpy as np
import pandas as pd
import pytest

from mixedlub.report.page import ranking_rows
from mixedlub.report.ranking import ranking_drawn
from mixedlub.schema.findings import collected
from mixedlub.study import ranking, read_study, run_study
from mixedlub.study.bands import _tell_cut
from mixedlub.study.costs import efficient
from mixedlub.study.draws import loss_draws
from mixedlub.study.rank import probabilities, ranking_tables
from profiles import Profile
from profiles.errors import InputError
from profiles.synthesise import from_spectrum
from tests.study.conftest import BASE
from tests.study.test_bands import POINTS, SHORT, STEP, spectrum, true_moments

LEVELS = {"conditions__torque_Nm": [100], "conditions__oil_temperature_C": [80]}
FIRM = {"m0_um2": 0.02, "m2": 0.0025, "m4_per_um2": 0.0036}


@pytest.fixture
def of_profiles(monkeypatch, write_study):
    """A study of one torque and oil temperature whose surfaces have these profiles as traces."""

    def make(profiles, **changes):
        surfaces = {
            name: {"traces": [f"{name}_{k}" for k in range(len(p))], "cutoff_mm": 0.8, "short_cutoff_um": 2.5}
            for name, p in profiles.items()
        }
        monkeypatch.setattr("mixedlub.rig.build.traces", lambda name, *_: tuple(profiles[name]))
        return read_study(write_study(surfaces=surfaces, **{"options__bands": "traces", **LEVELS, **changes}))

    return make


def synthetic(count, traces, seed, short=SHORT):
    """Surfaces of one spectrum and different roughness: their traces, and the moments of the spectrum."""
    random = np.random.default_rng(seed)
    heights = from_spectrum(spectrum, points=count * traces * POINTS, spacing=STEP, seed=seed).profile.heights
    cut = iter(np.split(heights, count * traces))
    m0, m2, m4 = true_moments(short=short)
    profiles, known = {}, {}
    for k, factor in enumerate(np.exp(random.uniform(-0.15, 0.15, count))):
        profiles[f"s{k}"] = [Profile(next(cut) * factor, STEP) for _ in range(traces)]
        square = factor**2
        known[f"s{k}"] = {"m0_um2": m0 * square * 1e12, "m2": m2 * square, "m4_per_um2": m4 * square * 1e-12}
    return profiles, known


def reliability(predicted, held, bins):
    """Largest distance, over bins of predicted probability, of its mean from the share that held."""
    place = np.minimum((predicted * bins).astype(int), bins - 1)
    return max(abs(predicted[place == b].mean() - held[place == b].mean()) for b in np.unique(place))


def pairs_of(study, truth):
    """Predicted probability of every two pairings of a study, and whether the first truly loses less."""
    chance = probabilities(loss_draws(run_study(study)))
    loss = run_study(truth)["power_loss"].mean(axis=(1, 2, 3))
    first, second = np.triu_indices(len(loss), 1)
    return chance[first, second], loss[first] < loss[second]


def test_probabilities_of_a_ranking_hold_as_often_as_they_say(of_profiles, write_study):
    profiles, known = synthetic(count=60, traces=4, seed=11)
    names = list(profiles)
    which = {"pairings": {"pinion": names[2:], "gear": names[:2]}, "options__path_points": 12}
    study = of_profiles(profiles, **which)
    truth = read_study(write_study(name="truth", surfaces=known, **LEVELS, **which))
    predicted, held = pairs_of(study, truth)
    assert 0.2 < np.mean(np.abs(predicted - 0.5) < 0.4) < 0.9  # neither all certain nor all open
    assert reliability(predicted, held, 5) < 0.1


@pytest.mark.long
def test_they_hold_where_oil_friction_and_cutoff_are_uncertain_too(of_profiles, write_study):
    every = []
    for seed, traces in enumerate((3, 4, 8, 3, 4, 8), start=1):
        random = np.random.default_rng(100 + seed)
        short = SHORT * 2.0 ** random.uniform(-1.0, 1.0)
        profiles, known = synthetic(count=60, traces=traces, seed=seed, short=short)
        names = list(profiles)
        which = {"pairings": {"pinion": names[2:], "gear": names[:2]}, "options__path_points": 12}
        uncertain = {"boundary_friction": 0.012, "viscosity": 0.06}
        study = of_profiles(profiles, **which, options__bands="both", uncertainty=uncertain)
        thick = np.exp(0.06 * random.standard_normal())
        oil = [nu * thick for nu in BASE["lubricant"]["kinematic_viscosity_mm2_s"]]
        touching = 0.1 + 0.012 * random.standard_normal()
        true = {"boundary_friction": touching, "lubricant__kinematic_viscosity_mm2_s": oil}
        # the root keys of a file stand before its tables
        truth = read_study(write_study(name="truth", surfaces=known, **LEVELS, **which, **true))
        every.append(pairs_of(study, truth))
    predicted, held = map(np.concatenate, zip(*every, strict=True))
    assert reliability(predicted, held, 10) < 0.1


def test_a_flank_common_to_two_pairings_does_not_decide_between_them(of_profiles):
    profiles, _ = synthetic(count=2, traces=40, seed=3)
    rough = from_spectrum(spectrum, points=3 * POINTS, spacing=STEP, seed=7).profile.heights
    profiles["c"] = [Profile(z * f, STEP) for z, f in zip(np.split(rough, 3), (1.0, 2.0, 3.0))]
    profiles["s1"] = [Profile(1.1 * one.heights, STEP) for one in profiles["s0"]]
    results = run_study(of_profiles(profiles, pairings={"pinion": ["s0", "s1"], "gear": ["c"]}))
    draws = loss_draws(results)
    low, high = np.quantile(draws[:, 0], [0.05, 0.95])
    assert high > 1.1 * low  # the common flank is hardly known,
    assert probabilities(draws)[0, 1] > 0.95  # and yet the smoother of the others is
    own = np.random.default_rng(1).permutation(draws[:, 1])
    assert (draws[:, 0] < own).mean() < 0.8  # drawn apart they would overlap


@pytest.mark.parametrize(
    ("name", "sd", "altered"),
    [
        ("boundary_friction", 0.012, lambda x: {"boundary_friction": 0.1 + x}),
        ("viscosity", 0.06, lambda x: {"lubricant__kinematic_viscosity_mm2_s": [18.05 * np.exp(x), 7.2 * np.exp(x)]}),
        (
            "pressure_viscosity",
            0.1,
            lambda x: {"lubricant__pressure_viscosity_per_GPa": [14.8 * np.exp(x), 13.0 * np.exp(x)]},
        ),
        ("eyring_stress", 0.15, lambda x: {"lubricant__eyring_stress_MPa": 5.0 * np.exp(x)}),
        ("roughness", 0.05, lambda x: {"surfaces": {"fine": {k: v * np.exp(2 * x) for k, v in FIRM.items()}}}),
    ],
)
def test_the_band_of_an_uncertain_input_ends_where_the_input_does(name, sd, altered, write_study):
    surfaces = {"surfaces": {"fine": FIRM}, "conditions__oil_temperature_C": [60]}
    found = run_study(read_study(write_study(**surfaces, uncertainty={name: sd})))
    ends = [
        run_study(read_study(write_study(name="end", **{**surfaces, **altered(sign * 1.6449 * sd)})))["power_loss"]
        for sign in (-1.0, 1.0)
    ]
    assert found["lowest_power_loss"] == pytest.approx(np.minimum(*ends), rel=1e-6)
    assert found["highest_power_loss"] == pytest.approx(np.maximum(*ends), rel=1e-6)


@pytest.mark.parametrize(("sd", "cut"), [(0.05, True), (0.01, False)])
def test_a_low_end_cut_at_no_friction_is_told_and_drawn_where_it_is(sd, cut, write_study):
    """A standard deviation of 0.05 about 0.05: friction 0 is one below, and no draw is beyond."""
    rough = {"surfaces": {"fine": FIRM}, **LEVELS, "conditions__speed_rpm": [500], "boundary_friction": 0.05}
    found = run_study(read_study(write_study(**rough, uncertainty={"boundary_friction": sd})))
    told = [one for one in found.findings if one.code == "band_end_cut"]
    assert [(one.place, "61 %" in one.text) for one in told] == [("uncertainty.boundary_friction", True)] * cut
    draws = loss_draws(found)[:, 0]
    least = found["lowest_power_loss"].mean()
    assert np.quantile(draws, 0.159 if cut else 0.05) == pytest.approx(least, rel=5e-3)
    assert (draws.min() == pytest.approx(least, rel=1e-9)) == cut


@pytest.mark.parametrize(("sd", "said"), [(0.05, "begin at -0.032, below 0"), (0.0304, "99 % of the way down")])
def test_a_cut_end_is_told_as_the_way_down_from_the_stated_value(sd, said):
    with collected() as told:
        _tell_cut({"boundary_friction": sd}, {"boundary_friction": 0.05})
    assert said in told[0].text


def test_no_draw_goes_below_no_friction_where_the_band_ends_just_above_it(write_study):
    """The least draw moves by 2 % between the bands that end 1 % below and above no friction."""
    rough = {"surfaces": {"fine": FIRM}, **LEVELS, "conditions__speed_rpm": [500], "boundary_friction": 0.05}
    least = []
    for reach in (0.99, 1.01):
        sd = 0.05 / (1.6449 * reach)
        found = run_study(read_study(write_study(**rough, name=f"at_{reach}", uncertainty={"boundary_friction": sd})))
        least.append(loss_draws(found).min())
    assert least[1] == pytest.approx(least[0], rel=0.02)


def test_a_ranking_has_intervals_with_bands_and_none_without(write_study):
    plain = ranking(run_study(read_study(write_study())))
    assert "place_low90" not in plain
    results = run_study(read_study(write_study(uncertainty={"viscosity": 0.06}, name="uncertain")))
    found = ranking(results)
    of_table = ranking(results.to_pandas())
    assert found["pinion_surface"].tolist() == of_table["pinion_surface"].tolist() == plain["pinion_surface"].tolist()
    for name in ("mean_loss_W", "over_best_percent", "best_at_percent", "quantitative_percent"):
        assert found[name].to_numpy() == pytest.approx(of_table[name].to_numpy(), abs=0.051)
    assert ((found["place_low90"] <= found["place"]) & (found["place"] <= found["place_high90"])).all()
    assert found["best_probability"].sum() == pytest.approx(1.0)
    assert found["as_good_as_best"].iloc[0] == "yes"
    inside = found["mean_loss_W"].between(found["mean_loss_W_low90"], found["mean_loss_W_high90"])
    assert inside.all()


def test_two_pairings_drawn_alike_are_as_good(write_study):
    same = {"a": FIRM, "b": {**FIRM, "m0_um2": 0.02 * 1.0001}, "c": {**FIRM, "m0_um2": 0.4}}
    which = {"surfaces": same, "pairings": {"pinion": ["a", "b", "c"], "gear": ["a"]}}
    tables = ranking_tables(run_study(read_study(write_study(**which, uncertainty={"viscosity": 0.1}))))
    found = tables["ranking"].set_index("pinion_surface")
    assert found.loc["c", "as_good_as_best"] == "no"
    assert found.loc["c", ["place_low90", "place_high90"]].tolist() == [3, 3]
    pair = tables["comparisons"].set_index(["pinion_surface", "other_pinion_surface"])
    assert pair.loc[("a", "c"), "less_probability"] == 1.0
    assert pair.loc[("a", "c"), "saved_W_low90"] > 0.0
    assert len(pair) == 3


def test_the_frontier_is_that_of_a_search_over_all():
    random = np.random.default_rng(4)
    for _ in range(200):
        cost, loss = random.integers(1, 5, 8).astype(float), random.integers(1, 7, 8).astype(float)
        found = efficient(cost, loss)
        for i in range(8):
            beaten = ((cost <= cost[i]) & (loss < loss[i])) | ((cost < cost[i]) & (loss <= loss[i]))
            assert found[i] == (not beaten.any())


def test_costs_give_a_saving_over_the_cheapest_pairing(write_study):
    costs = {"fine": 3.0, "mid": 1.5, "coarse": 1.0}
    found = ranking(run_study(read_study(write_study(costs=costs, uncertainty={"viscosity": 0.06}))))
    cheapest = found.set_index("relative_cost").loc[2.0]
    assert (cheapest["pinion_surface"], cheapest["saving_percent"], cheapest["efficient"]) == ("coarse", 0.0, "yes")
    best = found.iloc[0]
    assert best["saving_percent"] == pytest.approx(100 * (1 - best["mean_loss_W"] / cheapest["mean_loss_W"]))
    assert best["efficient"] == "yes"
    assert ((found["efficient_probability"] > 0.5) == (found["efficient"] == "yes")).all()


def test_the_page_has_the_ranking_and_the_saving(write_study):
    costs = {"fine": 3.0, "mid": 1.5, "coarse": 1.0}
    tables = ranking_tables(run_study(read_study(write_study(costs=costs, uncertainty={"viscosity": 0.06}))))
    shown = ranking_rows(tables)
    of_loss, of_cost = shown["tables"]
    first = tables["ranking"].iloc[0]
    good, cells = of_loss["rows"][0]
    assert good
    assert cells[:3] == ["1", "fine / fine", f"{first['mean_loss_W']:.4g}"]
    assert of_cost["rows"][0][1][2] == "6"
    names = [one.name for one in ranking_drawn(tables)]
    assert names == ["ranking", "ranking_probabilities", "saving_over_cost"]
    alone = ranking_tables(run_study(read_study(write_study(name="alone", surfaces={"fine": FIRM}))))
    assert ranking_rows(alone) is None
    assert not list(ranking_drawn(alone))


@pytest.mark.parametrize(
    ("changes", "rule"),
    [
        ({"costs": {"fine": 1.0, "mid": 2.0}}, r"costs.*missing: coarse"),
        (
            {"costs": {"fine": 1.0, "mid": 2.0, "coarse": 1.0, "corse": 1.0}},
            r"costs\.corse: no such surface.*coarse",
        ),
        ({"costs": {"fine": -1.0, "mid": 2.0, "coarse": 1.0}}, r"costs\.fine: -1.*0 or above"),
        ({"uncertainty": {"viscosty": 0.1}}, r"uncertainty\.viscosty.*'viscosity'"),
        ({"uncertainty": {"viscosity": -0.1}}, r"uncertainty\.viscosity: -0.1: must be from 0"),
        (
            {"uncertainty": {"viscosity": 0.1}, "options__base": "full_solution"},
            r"uncertainty\.viscosity: 0.1.*takes the oil as known",
        ),
    ],
)
def test_wrong_costs_and_uncertainties_are_refused_in_one_sentence(changes, rule, write_study):
    with pytest.raises(InputError, match=rule):
        read_study(write_study(**changes))


def test_the_ranking_of_a_table_alone_needs_its_columns():
    with pytest.raises(InputError, match="a column is missing"):
        ranking(pd.DataFrame({"power_loss_W": [1.0]}))
