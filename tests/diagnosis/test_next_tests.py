"""Proposed tests can be run on the rig, and their stated information is that of their joint distribution."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

from mixedlub.case.folder import Case, read_case
from mixedlub.case.reach import Reach
from mixedlub.diagnosis.assessment.candidates import inside, outside
from mixedlub.diagnosis.assessment.experiment_design import chosen_batch, played
from mixedlub.diagnosis.assessment.joint_prediction import Joint
from mixedlub.recording.readings import rows_of
from mixedlub.schema.table import Table

EQUAL = np.array([0.5, 0.5])


def two(means: np.ndarray, offset: float, noise: float = 1.0) -> list[Joint]:
    """Readings at zero or at other means, with an offset that all share."""
    shared, alone = np.full((means.size, 1), offset), np.full(means.size, noise**2)
    return [Joint(np.zeros(means.size), shared, alone), Joint(means, shared, alone)]


def bits_between(distance: float) -> float:
    """Information of one reading about two equally probable normal distributions, by quadrature."""

    def gain(x: float) -> float:
        p, q = norm.pdf(x), norm.pdf(x - distance)
        return float(p * np.log2(p / (0.5 * p + 0.5 * q)))

    return float(quad(gain, -9.0, 9.0)[0])


@pytest.mark.parametrize(("offset", "count"), [(0.0, 1), (0.0, 6), (1.5, 6), (4.0, 12)])
def test_information_is_that_of_the_mean_less_the_shared_offset(offset: float, count: int) -> None:
    """The mean of n readings is sufficient: two normal distributions 1.5 apart, of variance offset² + 1/n."""
    outcome = played(EQUAL, two(np.full(count, 1.5), offset))
    distance = 1.5 / np.sqrt(offset**2 + 1.0 / count)
    assert outcome.bits[-1] == pytest.approx(bits_between(distance), abs=0.02)
    # The log odds of the truth are normal, of mean d²/2 and variance d²; settled is ten to one either way.
    settled = norm.sf((np.log(10.0) - 0.5 * distance**2) / distance)
    settled += norm.cdf((-np.log(10.0) - 0.5 * distance**2) / distance)
    assert outcome.settled[-1] == pytest.approx(settled, abs=0.04)


def test_a_batch_is_chosen_jointly() -> None:
    """Two places share one offset, so that their difference tells more than the two best readings together."""
    means = np.array([3.0, 2.9, 0.0])
    offset = np.array([[3.0], [3.0], [3.0]])
    predictions = [Joint(m, offset, np.full(3, 0.25)) for m in (np.zeros(3), means)]
    assert 2 in chosen_batch(EQUAL, predictions, np.ones(3, dtype=bool), 2)
    assert 2 not in chosen_batch(EQUAL, predictions, np.ones(3, dtype=bool), 1)


def test_a_place_that_cannot_be_computed_is_not_chosen() -> None:
    assert chosen_batch(EQUAL, two(np.array([9.0, 1.0]), 0.0), np.array([False, True]), 2) == [1, 1]


def case(make_case: Callable[..., Path], folder: Path, kind: str) -> Case:
    return read_case(make_case(folder / "case", kind, lambda conditions, base: 1.06 * base))


def levels(found: Case, **reach: Mapping[str, object]) -> dict[str, list[object]]:
    found = replace(found, reach=Reach(**reach))
    table = proposed_on(found)
    return {name: np.unique(column).tolist() for name, column in table.columns.items() if name != "run"}


def proposed_on(found: Case) -> Table:
    columns = [c for c in found.kind.columns if c.name in rows_of(found)]
    return inside(found, rows_of(found), columns, [c.name for c in columns])


def test_tests_are_at_recorded_levels_and_between_them(make_case: Callable[..., Path], tmp_path: Path) -> None:
    found = levels(case(make_case, tmp_path, "gear_pair"))
    assert found["torque_Nm"] == [50.0, 75.0, 100.0, 125.0, 150.0]
    assert found["oil_temperature_C"] == [60.0, 75.0, 90.0]
    assert found["speed_rpm"][0] == 500.0
    assert found["speed_rpm"][-1] == 2500.0


def test_tests_stay_inside_the_reach_of_the_rig(make_case: Callable[..., Path], tmp_path: Path) -> None:
    gears = case(make_case, tmp_path, "gear_pair")
    ranges, steps = {"torque_Nm": (20.0, 300.0)}, {"speed_rpm": (800.0, 900.0)}
    found = levels(gears, ranges=ranges, steps=steps, pairings=(("ground", "ground"),))
    assert (found["torque_Nm"][0], found["torque_Nm"][-1]) == (20.0, 300.0)
    assert found["speed_rpm"] == [800.0, 900.0]
    assert found["pinion_surface"] == found["gear_surface"] == ["ground"]


def test_torques_are_those_of_the_load_share_table(make_case: Callable[..., Path], tmp_path: Path) -> None:
    """Between its rows the model takes the nearest, so a reading there would be compared with another load."""
    folder = make_case(tmp_path / "case", "gear_pair", lambda conditions, base: 1.06 * base)
    angles = np.linspace(5.0, 45.0, 80)
    rows = [f"{torque},{angle:.4f},0.5" for torque in (50.0, 150.0) for angle in angles]
    (folder / "load_share.csv").write_text("torque_Nm,roll_angle_deg,load_share\n" + "\n".join(rows), encoding="utf-8")
    text = (folder / "system.toml").read_text(encoding="utf-8")
    text = text.replace('load_sharing = { model = "rigid" }', 'load_sharing = { table = "load_share.csv" }')
    (folder / "system.toml").write_text(text, encoding="utf-8")
    found = read_case(folder)
    assert levels(found)["torque_Nm"] == [50.0, 150.0]
    columns = [c for c in found.kind.columns if c.name in rows_of(found)]
    table, needs = outside(found, rows_of(found), columns, [c.name for c in columns])
    untold = [need for torque, need in zip(table["torque_Nm"], needs, strict=True) if torque not in (50.0, 150.0)]
    assert untold
    assert all(any("load-share table" in text for text in need) for need in untold)


def test_tests_beyond_say_their_needs_and_keep_to_the_limits_of_the_rig(
    make_case: Callable[..., Path], tmp_path: Path
) -> None:
    found = case(make_case, tmp_path, "mesh_friction")
    columns = [c for c in found.kind.columns if c.name in rows_of(found)]
    table, needs = outside(found, rows_of(found), columns, [c.name for c in columns])
    first, last = found.kind.column_limits(found.system)["roll_angle_deg"]
    assert len(table) == len(needs) > 0
    assert all(needs)
    assert table["roll_angle_deg"].min() >= first
    assert table["roll_angle_deg"].max() <= last
    narrow = replace(found, reach=Reach({"speed_rpm": (1.0, float(rows_of(found)["speed_rpm"].max()))}))
    within = outside(narrow, rows_of(found), columns, [c.name for c in columns])[0]["speed_rpm"]
    assert within.max() <= rows_of(found)["speed_rpm"].max()


def test_candidates_thinned_out_keep_the_ends_of_every_level(make_case: Callable[..., Path], tmp_path: Path) -> None:
    gears = case(make_case, tmp_path, "gear_pair")
    sizes = {"torque_Nm": 5, "speed_rpm": 5, "oil_temperature_C": 4}
    columns = {name: np.arange(1.0, 1.0 + n) * 10.0 for name, n in sizes.items()}
    columns |= {"pinion_surface": np.array(["a", "b", "c"]), "gear_surface": np.array(["ground", "polished"])}
    grid = np.meshgrid(*columns.values(), indexing="ij")
    rows = {name: column.ravel() for name, column in zip(columns, grid, strict=True)}
    many = replace(gears, recordings=Table({"run": np.arange(grid[0].size), **rows}, ""))
    found = proposed_on(many)
    assert len(found) == 600
    for name, column in columns.items():
        assert set(np.unique(found[name])) >= set(column[[0, -1]].tolist()), name


def test_conditions_that_only_jitter_stay_at_their_set_point(make_case: Callable[..., Path], tmp_path: Path) -> None:
    """A start-up of a few readings at other loads is no set-point, and repeats of rounded numbers are no levels."""
    jitter = np.tile(np.linspace(-1.0, 1.0, 21), 5)
    columns = {
        "load_N": np.concatenate([[4.948, 12.0], 50.0 + 0.2 * jitter]),
        "slide_roll_ratio": np.concatenate([[0.82, 0.37], 1.0 + 0.002 * jitter]),
        "oil_temperature_C": np.concatenate([[115.2, 118.0], 120.0 + jitter]),
        "entrainment_speed_m_s": np.linspace(0.5, 5.0, 107),
        "surface_1": np.full(107, "ground"),
        "surface_2": np.full(107, "ground"),
    }
    discs = case(make_case, tmp_path, "disc")
    found = proposed_on(replace(discs, recordings=Table({"run": np.arange(107), **columns}, "")))
    assert {
        name: np.unique(found[name]).tolist() for name in columns if "surface" not in name and "speed" not in name
    } == {
        "load_N": [50.0],
        "slide_roll_ratio": [1.0],
        "oil_temperature_C": [120.0],
    }
    assert np.unique(found["entrainment_speed_m_s"]).size > 3
