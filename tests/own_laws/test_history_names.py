"""Laws of the user that read the history of a condition."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mixedlub.case.folder import conditions_for, read_case
from mixedlub.case.simulation import simulate
from mixedlub.schema.findings import collected
from profiles.errors import InputError

SYSTEM = """schema = "mixedlub-case/1"
kind = "friction_history"
[recording]
quantity = "friction_coefficient"
noise = { relative = 0.01, absolute = 0.0 }
[calibration]
boundary_friction = 0.1
[effects]
"law.toml" = { }
"""
LAW = """id = "settling"
stage = "boundary"
acts_on = "boundary_friction"
form = "factor"
expression = "{expression}"
[parameters.a]
value = 0.2
[parameters.t]
unit = "min"
value = 1.0
"""
RELAXATION = "1 - a*load_direction*exp(-load_since_s/t)"


def case_with(folder: Path, expression: str) -> Path:
    """A history of a load that steps from 50 to 100 N after 120 s and back after 240 s, with a law."""
    (folder / "system.toml").write_text(SYSTEM, encoding="utf-8")
    (folder / "law.toml").write_text(LAW.format(expression=expression), encoding="utf-8")
    load = np.repeat([50.0, 100.0, 50.0], 4)
    rows = [f"{i + 1},{30.0 * i},{x:g},{0.1 + 0.001 * i:g}" for i, x in enumerate(load)]
    text = "\n".join(["run,time_s,load_N,friction_coefficient", *rows]) + "\n"
    (folder / "recordings.csv").write_text(text, encoding="utf-8")
    return folder


def test_a_law_reads_the_time_since_a_change_in_si(tmp_path: Path) -> None:
    case = read_case(case_with(tmp_path, RELAXATION))
    found = simulate(case)["friction_coefficient"].to_numpy()
    decay = 0.2 * np.exp(-np.arange(4) * 30.0 / 60.0)
    assert found == pytest.approx(0.1 * np.concatenate([np.ones(4), 1.0 - decay, 1.0 + decay]), rel=1e-12)


def test_a_law_reads_level_before_and_memory_in_the_unit_of_the_column(tmp_path: Path) -> None:
    case = read_case(case_with(tmp_path, "1 + a*(load_before_N - load_memory_60s_N)/50 + 0*t"))
    memory = 100.0 - 50.0 * np.exp(-120.0 / 60.0)
    found = simulate(case)["friction_coefficient"].to_numpy()
    assert found[7] == pytest.approx(0.1 * (1.0 + 0.2 * (50.0 - memory) / 50.0), rel=1e-12)


def test_rows_without_a_time_of_their_own_are_long_after_any_change(tmp_path: Path) -> None:
    case = read_case(case_with(tmp_path, RELAXATION))
    with collected() as notes:
        found = simulate(case, conditions_for(case, {"time_s": np.full(2, 500.0), "load_N": np.array([50.0, 100.0])}))
    assert found["friction_coefficient"].tolist() == [0.1, 0.1]
    assert [n.text for n in notes if n.code == "history_assumed"] == [
        "the result depends on the history of load: 2 of 2 rows have no place in the recording by time_s: long after "
        "any change"
    ]


@pytest.mark.parametrize(
    ("expression", "said"),
    [
        ("1 - a*exp(-load_since_share/t)", "has no such quantity"),  # the recording has times
        ("1 - a*exp(-lod_since_s/t)", "no such"),
        ("1 - a*exp(-load_memory_N/t)", "no such"),  # a memory needs its fading time
    ],
)
def test_a_history_that_does_not_exist_is_refused(expression: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=said):
        simulate(read_case(case_with(tmp_path, expression)))
