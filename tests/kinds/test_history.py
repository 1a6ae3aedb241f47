"""History coordinates of conditions, against a direct calculation."""

from __future__ import annotations

import numpy as np
import pytest

from mixedlub.diagnosis.discrepancy.past import fading_times
from mixedlub.kinds.history import assumed, histories, order_of, programme_of
from mixedlub.schema.past import BEFORE, DIRECTION, MEMORY, SINCE, Past
from mixedlub.schema.table import Table

LOAD = "load_N"
PASTS = [Past(LOAD, DIRECTION), Past(LOAD, BEFORE), Past(LOAD, SINCE, "s"), Past(LOAD, MEMORY, "s", 25.0)]


def log(values: np.ndarray, step: float = 10.0) -> Table:
    """A logged condition."""
    count = values.size
    return Table({"run": np.arange(1, count + 1), "time_s": step * np.arange(count), LOAD: values})


def later(*rows: tuple[int, float, float]) -> Table:
    """Conditions to predict: run, time and load."""
    run, time, load = (np.array(column) for column in zip(*rows, strict=True))
    return Table({"run": run, "time_s": time.astype(float), LOAD: load.astype(float)}, "conditions.csv")


STEPS = log(np.repeat([50.0, 100.0, 50.0, 150.0], 5))


def test_a_stepped_condition_has_the_step_behind_it() -> None:
    found = histories(PASTS, STEPS, STEPS)
    assert found["load_direction"].tolist() == [0.0] * 5 + [1.0] * 5 + [-1.0] * 5 + [1.0] * 5
    assert found["load_before_N"].tolist() == [50.0] * 10 + [100.0] * 5 + [50.0] * 5
    assert found["load_since_s"][5:].tolist() == [0.0, 10.0, 20.0, 30.0, 40.0] * 3
    assert found["load_since_s"][0] == STEPS["time_s"][-1]  # unchanged for as long as the recording lasts


def test_the_memory_is_the_exponential_mean_of_the_past() -> None:
    found = histories(PASTS, STEPS, STEPS)["load_memory_25s_N"]
    assert found[4] == 50.0
    assert found[9] == pytest.approx(100.0 - 50.0 * np.exp(-50.0 / 25.0), rel=1e-12)  # 50 s at 100 N
    assert found[14] == pytest.approx(50.0 + (found[9] - 50.0) * np.exp(-50.0 / 25.0), rel=1e-12)


def test_noise_about_a_set_point_is_no_change() -> None:
    rng = np.random.default_rng(3)
    noisy = log(np.repeat([50.0, 100.0, 50.0, 150.0], 40) + 0.2 * rng.standard_normal(160))
    programme = programme_of(noisy, LOAD)
    assert programme is not None
    assert programme.planned
    assert programme.stepped
    assert np.flatnonzero(np.diff(histories(PASTS, noisy, noisy)["load_direction"])).tolist() == [39, 79, 119]


def test_a_sweep_changes_where_it_turns_back() -> None:
    rng = np.random.default_rng(4)
    triangle = 500.0 * (1.0 - np.abs(np.arange(400) / 100.0 % 2.0 - 1.0))
    swept = log(triangle + 0.5 * rng.standard_normal(400))
    programme = programme_of(swept, LOAD)
    assert programme is not None
    assert programme.planned
    assert not programme.stepped
    found = histories(PASTS, swept, swept)
    assert (found["load_direction"] == np.where(np.arange(400) // 100 % 2 == 0, 1.0, -1.0)).mean() > 0.97
    assert found["load_before_N"][150] == pytest.approx(500.0, abs=6.0)
    assert found["load_since_s"][150] == pytest.approx(500.0, abs=20.0)


def test_a_random_order_is_no_programme() -> None:
    rng = np.random.default_rng(5)
    planned = []
    for levels in ([50.0, 100.0], [50.0, 100.0, 150.0], [50.0, 100.0, 150.0, 200.0, 300.0]):
        for _ in range(20):
            programme = programme_of(log(rng.permutation(np.repeat(levels, 60 // len(levels)))), LOAD)
            planned.append(programme is not None and programme.planned)
    assert sum(planned) == 0


def test_new_rows_go_on_from_the_reading_before_them() -> None:
    new = later((30, 200.0, 50.0), (31, 205.0, 50.0), (32, 72.0, 100.0))
    found = histories(PASTS, new, STEPS)
    assert found["load_direction"].tolist() == [-1.0, -1.0, 1.0]
    assert found["load_since_s"].tolist() == [0.0, 5.0, 22.0]
    assert found["load_before_N"].tolist() == [150.0, 150.0, 50.0]
    note = assumed(PASTS, new, STEPS)
    assert note is not None
    assert "each row goes on from the reading before it" in note.text


def test_rows_from_the_start_on_are_a_programme_of_their_own() -> None:
    new = later((30, 0.0, 150.0), (31, 10.0, 100.0), (32, 20.0, 100.0))
    found = histories(PASTS, new, STEPS)
    assert found["load_direction"].tolist() == [0.0, -1.0, -1.0]
    assert found["load_before_N"].tolist() == [150.0, 150.0, 150.0]
    note = assumed(PASTS, new, STEPS)
    assert note is not None
    assert "a programme of their own" in note.text


def test_rows_without_an_order_are_long_after_any_change() -> None:
    new = Table({"run": np.array([30, 31]), LOAD: np.array([50.0, 100.0])}, "conditions.csv")
    found = histories(PASTS, new, STEPS)
    assert found["load_direction"].tolist() == [0.0, 0.0]
    assert found["load_before_N"].tolist() == found["load_memory_25s_N"].tolist() == [50.0, 100.0]
    assert found["load_since_s"].min() > STEPS["time_s"][-1]
    note = assumed(PASTS, new, STEPS)
    assert note is not None
    assert "2 of 2 rows have no place in the recording by time_s: long after any change" in note.text


def test_recorded_rows_keep_their_history_in_any_selection() -> None:
    some = np.array([17, 3, 8, 12])
    whole, part = histories(PASTS, STEPS, STEPS), histories(PASTS, STEPS.take(some), STEPS)
    for name, values in whole.items():
        assert part[name].tolist() == values[some].tolist()
    assert assumed(PASTS, STEPS.take(some), STEPS) is None


def test_set_ups_have_histories_of_their_own() -> None:
    twice = {"run": np.arange(1, 41), "time_s": np.tile(STEPS["time_s"], 2), LOAD: np.tile(STEPS[LOAD], 2)}
    both = Table({**twice, "setup": np.repeat(["a", "b"], 20)})
    once = histories(PASTS, STEPS, STEPS)["load_before_N"].tolist()
    assert histories(PASTS, both, both)["load_before_N"].tolist() == once * 2


def test_durations_are_told_in_the_unit_of_the_order() -> None:
    by_place = Table({"run": STEPS["run"], "sequence": np.linspace(0.0, 1.0, 20), LOAD: STEPS[LOAD]})
    asked = [Past(LOAD, SINCE, "s"), Past(LOAD, SINCE, "share")]
    assert list(histories(asked, by_place, by_place)) == ["load_since_share"]
    unordered = Table({"run": STEPS["run"], LOAD: STEPS[LOAD]})
    by_run = histories([Past(LOAD, SINCE, "readings")], unordered, unordered, by_run=True)
    assert by_run["load_since_readings"][5:10].tolist() == [0.0, 1.0, 2.0, 3.0, 4.0]


def ten_set_ups(clock: str) -> Table:
    """Ten set-ups of eight readings, each with two levels of load; the time of each starts at zero."""
    own = np.tile(10.0 * np.arange(8), 10)
    place = own if clock == "time_s" else np.linspace(0.0, 1.0, 80)
    names = np.repeat([f"s{i}" for i in range(10)], 8)
    return Table(
        {"run": np.arange(1, 81), clock: place, "setup": names, LOAD: np.tile(np.repeat([50.0, 100.0], 4), 10)}
    )


@pytest.mark.parametrize("clock", ["time_s", "sequence"])
def test_many_short_set_ups_are_not_mixed(clock: str) -> None:
    table = ten_set_ups(clock)
    order = order_of(table)
    assert order is not None
    assert order.part.tolist() == np.repeat(np.arange(10), 8).tolist()
    found = histories([Past(LOAD, DIRECTION)], table, table)["load_direction"]
    assert found.tolist() == [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0] * 10


def test_set_ups_of_a_sequence_are_told_in_its_order() -> None:
    table = ten_set_ups("sequence")
    mixed = np.random.default_rng(0).permutation(80)
    order = order_of(table.take(mixed))
    assert order is not None
    assert order.part.tolist() == (mixed // 8).tolist()


def test_time_constants_are_told_by_steps_within_a_set_up() -> None:
    table = ten_set_ups("time_s")
    late = Table({**table.columns, "time_s": table["time_s"] + np.repeat(0.7 * np.arange(10), 8)})
    order = order_of(late)
    assert order is not None
    assert fading_times(order)[0] == 20.0  # two readings 10 s apart, not 0.7 s


def test_new_rows_go_on_from_the_last_restart_or_their_own_set_up() -> None:
    clock = np.concatenate([20.0 * np.arange(20), STEPS["time_s"]])
    load = np.concatenate([np.repeat([50.0, 100.0, 50.0, 100.0], 5), STEPS[LOAD]])
    columns = {"run": np.arange(1, 41), "time_s": clock, LOAD: load}
    new = later((51, 200.0, 100.0), (52, 220.0, 100.0))
    found = histories(PASTS, new, Table(columns))
    assert found["load_since_s"].tolist() == [0.0, 20.0]  # together, from 150 N at 190 s on
    assert found["load_before_N"].tolist() == [150.0, 150.0]
    named = Table({**columns, "setup": np.repeat(["a", "b"], 20)})
    of_a = Table({**later((51, 400.0, 100.0), (52, 410.0, 100.0)).columns, "setup": np.array(["a", "b"])})
    found = histories(PASTS, of_a, named)
    assert found["load_since_s"].tolist() == [100.0, 0.0]
    assert found["load_before_N"].tolist() == [50.0, 150.0]
