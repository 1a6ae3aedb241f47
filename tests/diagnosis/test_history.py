"""Unknowns that depend on the history of a condition, in recordings made here from their own formulas."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import curve_fit

from mixedlub.api.diagnosis import Answer
from mixedlub.case.files import case_files
from mixedlub.case.folder import conditions_for, read_case
from mixedlub.case.forward import Forward
from mixedlub.case.simulation import simulate
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.discrepancy.past import remembered_in
from mixedlub.diagnosis.report.files import write
from mixedlub.own_laws import pasts_read
from mixedlub.recording.conditions import coordinates
from mixedlub.schema.findings import collected
from mixedlub.schema.past import DIRECTION, MEMORY, SINCE

SYSTEM = """schema = "mixedlub-case/1"
kind = "{kind}"
[recording]
quantity = "{quantity}"
noise = {{ relative = 0.005, absolute = {absolute} }}
"""


def written(
    folder: Path, kind: str, quantity: str, columns: Mapping[str, np.ndarray], value: np.ndarray, absolute: float = 0.0
) -> Path:
    """A case of these columns, with noise."""
    noise = np.random.default_rng(11).standard_normal(value.size)
    value = value + np.hypot(0.005 * value, absolute) * noise
    rows = zip(range(1, value.size + 1), *(c.tolist() for c in columns.values()), value.tolist(), strict=True)
    folder.mkdir(parents=True, exist_ok=True)
    system = SYSTEM.format(kind=kind, quantity=quantity, absolute=absolute)
    (folder / "system.toml").write_text(system, encoding="utf-8")
    lines = [",".join(("run", *columns, quantity)), *(",".join(f"{cell:.7g}" for cell in row) for row in rows)]
    (folder / "recordings.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return folder


def relaxing(folder: Path, share: float) -> Path:
    """Friction that falls by a share after each change of load and comes back with a time constant of 40 s."""
    time = np.arange(0.0, 1800.0, 10.0)
    load = np.array([50.0, 100.0, 50.0, 150.0, 100.0, 150.0, 50.0, 100.0, 150.0])[(time // 200.0).astype(int)]
    since = np.where(time < 200.0, np.inf, time % 200.0)
    friction = 0.1 * (1.0 - share * np.exp(-since / 40.0))
    return written(folder, "friction_history", "friction_coefficient", {"time_s": time, "load_N": load}, friction)


def swept(folder: Path, share: float) -> Path:
    """A drive swept up and down four times, with a share more friction on the way up and less on the way down."""
    there_and_back = np.concatenate([np.arange(100.0, 1001.0, 100.0), np.arange(900.0, 199.0, -100.0)])
    speed = np.tile(there_and_back, 4)
    up = np.tile(np.where(np.arange(18) < 10, 1.0, -1.0), 4)
    up[18::18] = -1.0  # the lowest speed is reached on the way down
    torque = (0.5 + 1e-3 * speed) * (1.0 + share * up)
    columns = {"time_s": 30.0 * np.arange(speed.size), "speed_rpm": speed}
    return written(folder, "friction_map", "friction_torque_Nm", columns, torque, 0.002)


def remembering(folder: Path) -> Path:
    """Friction that falls with the temperature of a body that follows the recorded one with 300 s."""
    time = np.arange(0.0, 7200.0, 30.0)
    celsius = np.array([40.0, 70.0, 50.0, 90.0, 60.0, 80.0, 40.0, 90.0])[(time // 900.0).astype(int)]
    load = np.array([50.0, 100.0, 150.0])[np.arange(time.size) // 5 % 3]
    body = np.empty(time.size)
    body[0] = celsius[0]
    for i in range(1, time.size):
        body[i] = celsius[i] + (body[i - 1] - celsius[i]) * np.exp(-30.0 / 300.0)
    columns = {"time_s": time, "load_N": load, "oil_temperature_C": celsius}
    friction = 0.1 * np.exp(-0.006 * (body - 40.0))
    return written(folder, "friction_history", "friction_coefficient", columns, friction)


def fitted_time(time: np.ndarray, friction: np.ndarray) -> tuple[float, float]:
    """Time constant by least squares on the right formula, and its standard deviation."""

    def formula(time: np.ndarray, level: float, share: float, constant: float) -> np.ndarray:
        since = np.where(time < 200.0, np.inf, time % 200.0)
        return np.asarray(level * (1.0 - share * np.exp(-since / constant)))

    best, spread = curve_fit(formula, time, friction, (0.1, 0.1, 30.0))
    return float(best[2]), float(np.sqrt(spread[2, 2]))


@pytest.fixture(scope="module")
def relaxed(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    """Friction that relaxes after each change of load, with two conditions to predict after the recording."""
    folder = relaxing(tmp_path_factory.mktemp("relaxed"), 0.12)
    (folder / "conditions.csv").write_text("run,time_s,load_N\n201,1800,50\n202,1840,50\n", encoding="utf-8")
    return diagnose_case(folder)


def test_a_relaxation_is_unknown_and_its_time_constant_found(relaxed: Diagnosis) -> None:
    assert relaxed.posterior.verdict.is_discrepancy
    past = relaxed.search.discrepancy.best.past
    assert past is not None
    assert (past.past.column, past.past.what) == ("load_N", SINCE)
    law = Answer(relaxed).record["law"]
    assert "exp(-load_since_s/t)" in law["expression"]
    (time,) = (p for p in law["parameters"] if p["name"] == "t")
    assert time["unit"] == "s"
    rows = relaxed.search.problem.rows
    value, sd = fitted_time(rows["time_s"], rows["friction_coefficient"])
    assert time["low90"] < value < time["high90"]
    assert time["high90"] - time["low90"] == pytest.approx(2.0 * 1.645 * sd, rel=0.6)
    assert abs(time["value"] - 40.0) < 3.0 * sd
    assert law["heldout_after"] < 1.2 < 6.0 < law["heldout_before"]


def test_the_report_names_the_history(relaxed: Diagnosis) -> None:
    answer = Answer(relaxed)
    assert "It begins at each change of load and is gone after 1" in answer.record["location"]["text"]
    text = " ".join(str(answer).split())
    assert "load_since_s is the time since the last change of load, in s." in text
    assert "Change load up and down between the same levels" in text


def test_the_improved_model_relaxes_at_conditions_of_its_own_time(relaxed: Diagnosis, tmp_path: Path) -> None:
    write(case_files(Answer(relaxed).improved), tmp_path / "improved")
    case = read_case(tmp_path / "improved")
    time = np.array([1800.0, 1840.0, 1880.0, 2100.0])
    after = {"time_s": time, "load_N": np.full(4, 50.0)}
    with collected() as notes:
        found = simulate(case, conditions_for(case, after))["friction_coefficient"].to_numpy()
    expected = 0.1 * (1.0 - 0.12 * np.exp(-(time - 1800.0) / 40.0))
    assert found == pytest.approx(expected, rel=0.005)
    assert any("goes on from the reading before it" in note.text for note in notes)


def test_a_prediction_says_which_history_it_assumes(relaxed: Diagnosis) -> None:
    assert relaxed.wanted is not None
    assert relaxed.wanted.predicted == pytest.approx([0.088, 0.1 * (1.0 - 0.12 * np.exp(-1.0))], rel=0.01)
    (note,) = (w for w in relaxed.warnings if w.code == "history_assumed")
    assert "the history of load: each row goes on from the reading before it, by time_s" in note.text


def test_the_same_programme_without_a_relaxation_is_complete(tmp_path: Path) -> None:
    found = diagnose_case(relaxing(tmp_path, 0.0))
    assert not found.test.detected
    assert found.posterior.verdict.ids == ("none",)


@pytest.mark.parametrize("kind", ["gear_pair", "disc", "mesh_friction", "viscosity"])
def test_a_sorted_matrix_shows_no_history(kind: str, make_case: Callable[..., Path], tmp_path: Path) -> None:
    case = read_case(make_case(tmp_path, kind))
    assert case.recordings is not None
    forward = Forward(case, case.recordings)
    space = coordinates(forward)
    assert remembered_in(space, space.values(forward), forward) == {}


@pytest.mark.long
def test_hysteresis_between_sweeps_is_the_direction_of_the_last_change(tmp_path: Path) -> None:
    found = diagnose_case(swept(tmp_path, 0.05))
    assert found.posterior.verdict.is_discrepancy
    past = found.search.discrepancy.best.past
    assert past is not None
    assert (past.past.column, past.past.what) == ("speed_rpm", DIRECTION)
    answer = Answer(found)
    assert "more after a rise than after a fall" in answer.record["location"]["text"]
    law = answer.record["law"]
    assert law["expression"] == "exp(a*speed_direction)"
    (a,) = law["parameters"]
    assert a["low90"] < 0.5 * np.log(1.05 / 0.95) < a["high90"]
    assert law["heldout_after"] < 1.3 < 10.0 < law["heldout_before"]


@pytest.mark.long
def test_a_memory_of_temperature_has_its_fading_time(tmp_path: Path) -> None:
    found = diagnose_case(remembering(tmp_path))
    assert found.posterior.verdict.is_discrepancy
    past = found.search.discrepancy.best.past
    assert past is not None
    assert (past.past.column, past.past.what) == ("oil_temperature_C", MEMORY)
    law = Answer(found).record["law"]
    assert found.law is not None
    read = pasts_read([found.law.effect], found.case.kind.numbers)
    assert [p.what for p in read] == [MEMORY]
    assert 240.0 <= read[0].fading <= 375.0  # by steps of 1.25 about 300 s
    assert law["heldout_after"] < 1.2 < 4.0 < law["heldout_before"]
