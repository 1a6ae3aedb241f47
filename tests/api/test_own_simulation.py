"""``ml.diagnose`` with a table and the function that simulates it."""

import numpy as np
import pandas as pd
import pytest

import mixedlub as ml
from mixedlub.api.own_simulation import case_with_simulation
from profiles.errors import InputError


def pump(at, friction, drag):
    """Made-up friction torque (N m) of a pump."""
    thinner = np.exp(-0.03 * (at["oil_temperature_C"] - 40.0))
    return friction * 0.4 * at["pressure_bar"] + drag * thinner * at["speed_rpm"] / 1000.0


def one_by_one(at, friction, drag):
    """The same model for single conditions."""
    return float(pump(at, friction, drag)) if at["speed_rpm"] > 0.0 else 0.0


def rows() -> pd.DataFrame:
    levels = [(p, n, t) for p in (20.0, 60.0, 120.0) for n in (500.0, 1000.0, 3000.0) for t in (40.0, 60.0, 80.0)]
    frame = pd.DataFrame(levels, columns=["pressure_bar", "speed_rpm", "oil_temperature_C"])
    noise = 1.0 + 0.01 * np.random.default_rng(4).standard_normal(len(frame))
    return frame.assign(pump_torque_Nm=(pump(frame, 0.085, 1.05) + 0.4) * noise)


INPUTS = {"friction": (0.08, 0.01), "drag": (1.0, 0.1)}


def test_a_function_is_diagnosed_and_corrected(tmp_path):
    at = {"pressure_bar": [90.0], "speed_rpm": [1500.0], "oil_temperature_C": [70.0]}
    answer = ml.diagnose(
        rows(), at, simulate=pump, inputs=INPUTS, noise={"relative": 0.01}, folder=tmp_path / "pump", name="pump"
    )
    assert answer.verdict == ["sensor_offset"]
    found = answer.parameters.set_index("name")
    assert found.loc["friction", "low90"] < 0.085 < found.loc["friction", "high90"]
    last = answer.predictions.iloc[-1]
    truth = pump(pd.DataFrame(at), 0.085, 1.05)[0] + 0.4
    assert last["run"] == 28
    assert last["predicted"] == pytest.approx(truth, rel=0.015)
    assert abs(last["base"] / truth - 1.0) > 0.1
    assert len(ml.case.read(tmp_path / "pump").recordings) == 27


def test_functions_of_single_conditions_are_called_row_by_row():
    whole, single = (case_with_simulation(rows(), f, inputs=INPUTS) for f in (pump, one_by_one))
    for name in ("simulated", "simulated_friction", "simulated_drag"):
        assert single.recordings[name] == pytest.approx(whole.recordings[name])


def test_differences_are_those_of_one_standard_deviation():
    case = case_with_simulation(rows(), pump, inputs=INPUTS)
    table = case.recordings
    assert table["simulated_friction"] - table["simulated"] == pytest.approx(0.01 * 0.4 * table["pressure_bar"])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"reading": "pump_torque"}, "nearest known: 'pump_torque_Nm'"),
        ({"units": {"presure": "bar"}}, "nearest known: 'pressure_bar'"),
        ({"inputs": {"friction": 0.08}}, "(value, sd)"),
        ({"inputs": {"friction": (np.inf, 0.1), "drag": (1.0, 0.1)}}, "not a finite number"),
        ({"predict": {"pressure_bar": [90.0]}}, "column is missing"),
        ({"table": rows().assign(preload=1.0), "reading": "pump_torque_Nm"}, 'units={"preload": "..."}'),
    ],
)
def test_bad_arguments_are_refused(change, message):
    arguments = {"table": rows(), "simulate": pump, "inputs": INPUTS, **change}
    with pytest.raises(InputError) as refused:
        case_with_simulation(**arguments)
    assert message in str(refused.value)


def test_options_of_a_table_need_a_simulation(tmp_path):
    with pytest.raises(InputError, match="acts only with simulate"):
        ml.diagnose(tmp_path, reading="drag")
