"""Synchronous averages: intervals from the scatter between turns hold whatever the number of turns."""

import numpy as np
import pytest

from mixedlub.evaluate.synchronous import cycle_average, errors_of_mean, few_turns, synchronous_average
from mixedlub.evaluate.uncertainty import NORMAL_90
from profiles.errors import InputError

TEETH, SAMPLES = 12, 8
KEPT = 0.85
"""Share of the drifting noise that the next sample keeps: it reaches into the next tooth."""


def recorded(random, turns):
    """Turn, angle and signal of a mesh cycle with run-out, white noise and noise that drifts."""
    angle = np.arange(turns * TEETH * SAMPLES) * 360.0 / (TEETH * SAMPLES)
    white, pushed = 0.3 * random.standard_normal((2, angle.size))
    drift = np.empty_like(pushed)
    drift[0] = pushed[0] / np.sqrt(1.0 - KEPT**2)
    for n in range(1, drift.size):
        drift[n] = KEPT * drift[n - 1] + pushed[n]
    run_out = 5.0 * np.sin(np.radians(angle) + random.random()) + np.sin(np.radians(3.0 * angle))
    cycle = np.cos(np.radians(TEETH * angle))
    return np.floor(angle / 360.0), angle % 360.0, 1.0 + cycle + run_out + white + drift, run_out


def share_held(turns, runs, average):
    """Share of runs whose 90 % interval holds a constant, and what some angles show beside run-out."""
    held = []
    for seed in range(runs):
        turn, angle, signal, run_out = recorded(np.random.default_rng([turns, seed]), turns)
        if average == "cycle":
            found = cycle_average(turn, angle, signal, TEETH, SAMPLES, source="x.csv")
            real = 1.0 + np.cos(np.radians(TEETH * found.angle))
        else:
            found = synchronous_average(turn, angle, signal[:, None], 360.0 / (TEETH * SAMPLES), source="x.csv")
            real = (1.0 + np.cos(np.radians(TEETH * angle)) + run_out)[: found.angle.size]
        away, errors = found.mean[:, 0] - real, found.errors[:, :, 0]
        ends = [away.mean(), *away[1:8:2]]
        widths = [errors.mean(axis=1), *errors.T[1:8:2]]
        wide = NORMAL_90 * few_turns(turns)
        held.append([abs(a) < wide * np.sqrt((w**2).sum()) for a, w in zip(ends, widths, strict=True)])
    return np.mean(held, axis=0)


@pytest.mark.parametrize("average", ["cycle", "turn"])
def test_intervals_of_three_turns_hold_nine_times_in_ten(average):
    held = share_held(3, 120, average)
    assert 0.82 <= held[0] <= 0.97
    assert 0.85 <= held.mean() <= 0.95


@pytest.mark.long
@pytest.mark.parametrize("average", ["cycle", "turn"])
@pytest.mark.parametrize("turns", [3, 5, 10, 50])
def test_intervals_hold_nine_times_in_ten(turns, average):
    held = share_held(turns, 1000, average)
    assert np.all((held >= 0.865) & (held <= 0.935)), held


@pytest.mark.parametrize("turns", [2, 3, 5])
def test_errors_of_the_mean_are_as_large_as_the_mean_scatters(turns):
    """Not wider for few turns: a column of standard deviations says by how much, an interval is wider."""
    each = np.random.default_rng(turns).standard_normal((turns, 20_000))
    stated, real = (errors_of_mean(each) ** 2).sum(axis=0).mean(), each.mean(axis=0).var()
    assert stated / real == pytest.approx(1.0, rel=0.05)


def test_run_out_is_no_error_of_a_mesh_cycle():
    angle = np.arange(3 * TEETH * SAMPLES) * 360.0 / (TEETH * SAMPLES)
    signal = np.sin(np.radians(angle)) + np.cos(np.radians(TEETH * angle))
    found = cycle_average(np.floor(angle / 360.0), angle % 360.0, signal, TEETH, SAMPLES, source="x.csv")
    assert np.sqrt((found.errors.mean(axis=1) ** 2).sum()) < 1e-3


def test_one_turn_has_no_scatter():
    angle = np.arange(TEETH * SAMPLES) * 360.0 / (TEETH * SAMPLES)
    with pytest.raises(InputError, match="revolution: 1: needs two whole revolutions or more"):
        cycle_average(np.zeros_like(angle), angle, np.sin(angle), TEETH, SAMPLES, source="x.csv")
