"""An answer that takes more readings for outliers than instruments have names nothing."""

import numpy as np
import pytest

from mixedlub.diagnosis.assessment.step_evidence import outliers_after_steps
from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.importers import write_case
from mixedlub.schema.table import Table


def history(folder, y, sd):
    system = {"kind": "friction_history", "boundary_friction": 0.2, "uncertainty": {"boundary_friction": 0.05}}
    system["recording"] = {"quantity": "friction_coefficient", "noise": {"absolute": sd}}
    time = np.arange(y.size) * 10.0
    return write_case(folder, system, {"time_s": time, "friction_coefficient": y})


@pytest.mark.long
def test_two_thirds_that_run_in_and_a_third_that_does_not_get_no_name(tmp_path):
    rng, share = np.random.default_rng(1), np.linspace(0.0, 1.0, 150)
    y = 0.16 + 0.05 * np.exp(-share / 0.12) + rng.normal(0.0, 0.002, 150)
    apart = np.arange(150) % 5 < 2
    y[apart] += 0.06 * rng.choice([-1.0, 1.0], int(apart.sum())) * rng.uniform(0.7, 1.6, int(apart.sum()))
    d = diagnose_case(history(tmp_path / "wild", y, 0.002))
    assert not d.posterior.verdict.effects
    few = y.copy()
    few[apart] = 0.16 + 0.05 * np.exp(-share[apart] / 0.12) + rng.normal(0.0, 0.002, int(apart.sum()))
    few[::9] += 0.05
    d = diagnose_case(history(tmp_path / "few", few, 0.002))
    assert "friction_run_in" in d.posterior.verdict.effects
    assert "model_failed" not in {one.code for one in d.warnings}


def test_readings_after_steps_on_one_side_are_no_outliers_of_an_instrument():
    rows = Table({"run": np.arange(90), "time_s": np.arange(90.0), "load_N": np.repeat([9.0, 20.0, 9.0], 30)})
    wrong = np.isin(np.arange(90), [30, 31, 32, 33, 60, 61, 62])
    assert outliers_after_steps(rows, ["load_N"], wrong, np.where(np.arange(90) < 50, 1.0, -1.0))
    assert not outliers_after_steps(rows, ["load_N"], wrong, (-1.0) ** np.arange(90))
    assert not outliers_after_steps(rows, ["load_N"], wrong & (np.arange(90) < 50), np.ones(90))
    assert not outliers_after_steps(rows, ["oil_temperature_C"], wrong, np.ones(90))
