"""Added readings: what is refused, what is filled in, and the answers before and after."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import mixedlub as ml
from mixedlub.case.added import with_added
from mixedlub.case.folder import Case, case_of
from mixedlub.cli import main
from mixedlub.diagnosis.assessment.campaign import realised_bits
from mixedlub.effects import known_in as effects_in
from profiles.errors import InputError

DRIVE = """schema = "mixedlub-case/1"
kind = "friction_map"
[recording]
quantity = "friction_torque_Nm"
noise = { relative = 0.02 }
[rig]
speed_rpm = [5, 600]
"""


def torque(speed: np.ndarray, seed: int, share: float = 0.1) -> np.ndarray:
    """Coulomb and viscous torque with a weak Stribeck minimum and 2 % noise."""
    noise = np.random.default_rng(seed).standard_normal(speed.size)
    return np.asarray((0.5 + 2e-3 * speed + share * np.exp(-speed / 40.0)) * (1.0 + 0.02 * noise))


def drive(**more: Any) -> Case:
    speed = np.tile([20.0, 50.0, 100.0, 200.0, 300.0, 500.0], 3)
    system = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm"}, "rig": {"speed_rpm": [5, 600]}}
    return case_of(system, {"speed_rpm": speed, "friction_torque_Nm": torque(speed, 1), **more}, name="joint")


NEW = {"run": [19, 20], "speed_rpm": [30.0, 40.0], "friction_torque_Nm": [0.6, 0.61]}


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"colour": ["red", "blue"]}, "add: header: 'colour': is no column of recordings.csv"),
        ({"run": [18, 19]}, "add: run: 18: the recording has this run already; number new readings from 19 on"),
        ({"run": [19, 19]}, "run must be unique"),
        ({"friction_torque_Nm": ["", 0.6]}, "friction_torque_Nm: the reading is empty at run 19; fill it in, or leave"),
        ({"friction_torque_Nm": ["x", 0.6]}, "friction_torque_Nm must be a number"),
        ({"friction_torque_Nm": None, "friction_torque_mNm": [600.0, 610.0]}, "units are not converted here"),
        ({"speed_rpm": None}, "column 'speed_rpm' is missing"),
    ],
)
def test_wrong_files_are_refused_in_one_sentence(change: dict[str, Any], said: str) -> None:
    rows = {name: values for name, values in {**NEW, **change}.items() if values is not None}
    with pytest.raises(InputError) as refusal:
        with_added(drive(), rows)
    assert said in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_readings_outside_the_rig_are_said() -> None:
    joined, _ = with_added(drive(), {**NEW, "speed_rpm": [30.0, 900.0]})
    (said,) = [note for note in joined.notes if note.code == "added_beyond_rig"]
    assert "run 20: speed_rpm 900" in said.text


def test_added_readings_come_last_in_the_programme_and_the_case_is_unchanged() -> None:
    place = np.linspace(0.0, 1.0, 18)
    case = drive(sequence=place)
    joined, rows = with_added(case, NEW)
    assert case.recordings is not None
    assert joined.recordings is not None
    assert len(case.recordings) == 18
    assert case.recordings["sequence"].tolist() == place.tolist()
    after = joined.recordings["sequence"]
    assert np.all(np.diff(after) > 0.0)
    assert after[:18] == pytest.approx(place, abs=1e-5)
    assert after[-1] == 1.0
    assert rows["friction_torque_Nm"].tolist() == [0.6, 0.61]


def test_realised_information_averages_to_the_expected() -> None:
    """Of a reading that is a hit with 0.9 or 0.2, the expected information is that of the binary channel."""
    prior, hit = {("a",): 0.3, ("b",): 0.7}, {("a",): 0.9, ("b",): 0.2}
    expected, entropy = 0.0, lambda p: -p * np.log2(p) - (1.0 - p) * np.log2(1.0 - p)
    for seen in (True, False):
        joint = {key: p * (hit[key] if seen else 1.0 - hit[key]) for key, p in prior.items()}
        total = sum(joint.values())
        expected += total * realised_bits(prior, {key: p / total for key, p in joint.items()})
    chance = sum(p * hit[key] for key, p in prior.items())
    channel = entropy(chance) - sum(p * entropy(hit[key]) for key, p in prior.items())
    assert expected == pytest.approx(channel, abs=1e-4)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recorded drive with a weak minimum."""
    case = tmp_path_factory.mktemp("drive") / "joint"
    case.mkdir()
    (case / "system.toml").write_text(DRIVE, encoding="utf-8")
    speed = np.tile([20.0, 50.0, 100.0, 200.0, 300.0, 500.0], 3)
    rows = {"run": np.arange(1, 19), "speed_rpm": speed, "friction_torque_Nm": torque(speed, 1)}
    pd.DataFrame(rows).to_csv(case / "recordings.csv", index=False)
    return case


@pytest.fixture
def ran(capsys: pytest.CaptureFixture[str]) -> Callable[..., str]:
    """Run the command line and return its output."""

    def run(*arguments: object, status: int = 0) -> str:
        found = main([str(one) for one in arguments])
        said = "".join(capsys.readouterr())
        assert found == status, said
        return said

    return run


def record(path: Path) -> dict[str, Any]:
    return dict(json.loads(path.read_text(encoding="utf-8")))


def test_a_campaign_goes_on_from_the_earlier_answer(ran: Callable[..., str], folder: Path, tmp_path: Path) -> None:
    out, given = tmp_path / "out", (folder / "recordings.csv").read_bytes()
    ran("diagnose", folder, "--out", out)
    before = record(out / "diagnosis.json")
    batch = pd.read_csv(out / "next_tests.csv")
    assert batch["run"].tolist() == list(range(19, 19 + len(batch)))
    assert batch["friction_torque_Nm"].isna().all()
    assert batch["speed_rpm"].between(5.0, 600.0).all()
    assert "the reading is empty" in str(
        ran("diagnose", folder, "--add", out / "next_tests.csv", "--out", out, status=2)
    )
    assert not (out / "campaign.json").exists()
    batch["friction_torque_Nm"] = torque(batch["speed_rpm"].to_numpy(dtype=float), 2)
    batch.to_csv(out / "next_tests.csv", index=False)
    said = ran("diagnose", folder, "--add", out / "next_tests.csv", "--out", out)
    assert "WHAT DID THE ADDED READINGS CHANGE?" in said
    told = record(out / "campaign.json")
    assert told["before"]["verdict"] == before["verdict"]
    assert told["before"]["probabilities"] == before["probabilities"]
    assert told["expected_bits"] == before["next_batch"]["expected_bits"]
    assert told["after"]["verdict"] == record(out / "diagnosis.json")["verdict"]
    assert told["realised_bits"] >= 0.0
    assert (folder / "recordings.csv").read_bytes() == given
    assert len(pd.read_csv(out / "campaign" / "recordings.csv")) == 18 + len(batch)
    assert "has this run already" in ran(
        "diagnose", folder, "--add", out / "campaign" / "recordings.csv", "--out", out, status=2
    )
    assert "holds added readings" in ran("diagnose", folder, "--out", out, status=2)
    again = pd.read_csv(out / "next_tests.csv")
    assert again["run"].min() == 19 + len(batch)


def test_readings_are_added_from_python(folder: Path) -> None:
    """Other conditions than the proposed ones: the case is diagnosed without them first."""
    few = ("stribeck", "seal_drag", "direction_dependence", "sensor_gain")
    left_out = [e.id for e in effects_in("friction_map").values() if e.id not in few]
    answer = ml.diagnose(ml.case.read_case(folder), exclude=left_out, add={**NEW, "speed_rpm": [25.0, 600.0]})
    told = answer.campaign
    assert told is not None
    assert told["added_runs"] == [19, 20]
    assert told["readings"] == 20
    assert told["expected_bits"] >= 0.0
    assert set(told["before"]["probabilities"]) == set(told["after"]["probabilities"])
    assert len(answer.predictions) == 20
