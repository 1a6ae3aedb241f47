"""Friction after steps of speed: a direct effect and a state that follows with slip."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.report.text.answer import effect_records
from mixedlub.effects.rate_and_state import rate_and_state
from mixedlub.effects.rate_and_state_slip import rate_and_state_slip
from mixedlub.importers import write_case
from mixedlub.kinds.steps import held_speeds, steps
from mixedlub.schema.table import Table

DIRECT, EVOLUTION, LENGTH = 0.009, 0.014, 1.2e-5
SPEEDS, EACH = (4e-6, 2e-5, 4e-6, 1e-6), 70


def ageing(speed, theta):
    return 1.0 - speed * theta / LENGTH


def slipping(speed, theta):
    x = speed * theta / LENGTH
    return -x * np.log(x)


def solved(rate, times, speeds):
    """Friction by numerical solution of the law of the state; each speed begins at its first reading."""
    theta, found = LENGTH / speeds[0], []
    for now, time in enumerate(times):
        if now:
            held = speeds[now - 1]
            step = solve_ivp(
                lambda t, y, held=held: [rate(held, y[0])],
                (times[now - 1], time),
                [theta],
                rtol=1e-9,
                atol=1e-12,
            )
            theta = float(step.y[0, -1])
        age = np.log(speeds[0] * theta / LENGTH)
        found.append(0.5 + DIRECT * np.log(speeds[now] / speeds[0]) + EVOLUTION * age)
    return np.array(found)


def programme():
    speeds = np.repeat(SPEEDS, EACH)
    return np.arange(speeds.size) * 1.0, speeds


@pytest.mark.parametrize(("rate", "law"), [(ageing, rate_and_state), (slipping, rate_and_state_slip)])
def test_the_closed_form_is_the_numerical_solution(rate, law):
    times, speeds = programme()
    table = Table({"time_s": times, "entrainment_speed_m_s": speeds / 2.0, "run": np.arange(times.size)})
    held = held_speeds(table, table, "entrainment_speed_m_s", 2.0)
    found = law(
        0.5,
        speeds[:, None],
        speeds[0],
        held.speed,
        held.slip,
        held.early,
        direct=DIRECT,
        evolution=EVOLUTION,
        slip_length=LENGTH,
        onset=0.0,
    )
    assert found[:, 0] == pytest.approx(solved(rate, times, speeds), abs=2e-6)


def test_rows_between_readings_and_of_another_set_up_have_their_own_slip():
    times, speeds = programme()
    two = {"time_s": np.tile(times, 2), "setup": np.repeat(["a", "b"], times.size), "run": np.arange(2 * times.size)}
    recorded = Table({**two, "entrainment_speed_m_s": np.concatenate([speeds, speeds[::-1]]) / 2.0})
    asked = Table({"time_s": np.array([80.5, 80.5]), "setup": np.array(["a", "b"]), "run": np.array([1, 2])})
    held = held_speeds(asked, recorded, "entrainment_speed_m_s", 2.0)
    assert held.slip[0, 1] == pytest.approx(10.5 * 2e-5)
    assert held.slip[1, 1] == pytest.approx(10.5 * 4e-6)
    assert held.early[1, 1] == pytest.approx(11.5 * 4e-6)
    assert held.slip[0, 2] == 0.0


def test_a_sweep_and_a_constant_speed_have_no_steps():
    assert steps(np.geomspace(0.1, 10.0, 60)).size == 0
    assert steps(np.full(60, 0.3)).size == 0
    assert steps(np.repeat([0.1, 0.1004, 0.4], 20)).tolist() == [40]


@pytest.mark.parametrize(
    ("rate", "named"),
    [(ageing, "rate_and_state"), pytest.param(slipping, "rate_and_state_slip", marks=pytest.mark.long)],
)
def test_steps_of_speed_give_both_strengths_and_the_slip_and_say_where_it_begins(tmp_path, rate, named):
    times, speeds = programme()
    read = solved(rate, times, speeds) + np.random.default_rng(6).normal(0.0, 6e-4, times.size)
    system = {"kind": "friction_history", "boundary_friction": 0.5, "uncertainty": {"boundary_friction": 0.1}}
    system["recording"] = {"quantity": "friction_coefficient"}
    columns = {"time_s": times, "entrainment_speed_m_s": speeds / 2.0, "slide_roll_ratio": np.full(times.size, 2.0)}
    d = diagnose_case(write_case(tmp_path, system, {**columns, "friction_coefficient": read}))
    assert d.posterior.verdict.ids == (named,)
    (record,) = effect_records(d)
    fitted = {p["name"]: p for p in record["parameters"]}
    for name, value in (("direct", DIRECT), ("evolution", EVOLUTION), ("slip_length", LENGTH)):
        assert fitted[name]["value"] == pytest.approx(value, rel=0.25), name
    apart = fitted["evolution"]["value"] - fitted["direct"]["value"]
    assert apart == pytest.approx(EVOLUTION - DIRECT, abs=5e-4)
    assert d.heldout.after < 1.5 < d.heldout.before
    assert len(d.outlier_runs) <= 2
    (told,) = (one.text for one in d.warnings if one.code == "mismatch_at_step")
    assert "3 of 3 steps of entrainment speed (runs 71, 141, 211)" in told
    assert "relaxes" in told
