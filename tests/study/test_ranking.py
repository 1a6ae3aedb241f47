"""Ranking of pairings: its probabilities hold as often as they say, common flanks are drawn once, costs have a
frontier."""

import numpy as np
import pandas as pd
import pytest

from mixedlub.study import ranking, read_study, run_study
from mixedlub.study.costs import efficient
from mixedlub.study.draws import loss_draws
from mixedlub.study.rank import probabilities, ranking_tables
from profiles import Profile
from profiles.errors import InputError
from profiles.synthesise import from_spectrum
from tests.study.test_bands import POINTS, STEP, spectrum, true_moments

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
        return read_study(write_study(surfaces=surfaces, **{"options__bands": "traces"}, **LEVELS, **changes))

    return make


def synthetic(count, traces, seed, spread=0.15):
    """Surfaces of one spectrum and different roughness: their traces, and the moments of the spectrum."""
    random = np.random.default_rng(seed)
    heights = from_spectrum(spectrum, points=count * traces * POINTS, spacing=STEP, seed=seed).profile.heights
    cut = iter(np.split(heights, count * traces))
    m0, m2, m4 = true_moments()
    profiles, known = {}, {}
    for k, factor in enumerate(np.exp(random.uniform(-spread, spread, count))):
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
