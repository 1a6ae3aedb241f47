"""What is printed as prediction is what the laws give, not their tangents."""

from __future__ import annotations

import numpy as np
import pytest

from mixedlub.diagnosis.fit import settled


def test_coordinates_go_no_farther_than_the_laws_gain(offset) -> None:
    """The tangent's place is made absurd: the fit stays where it was."""
    problem, fit = offset.found.problem, offset.found.none
    absurd = fit.z + 4.0
    z, beside = settled(
        problem, (), fit.z, absurd, fit.common, lambda prediction: np.zeros((prediction.size, 0)), fit.weight
    )
    assert z == pytest.approx(fit.z)
    assert beside.residual == pytest.approx(fit.residual, abs=1e-9)


@pytest.mark.parametrize("name", ["offset", "unnamed", "complete"])
def test_predictions_fit_no_worse_than_calibration_alone(name, request) -> None:
    d = request.getfixturevalue(name)
    good = d.outlier_chance < 0.5
    off = {
        what: np.sqrt(np.mean(((d.readings - value) / d.recorded.sd)[good] ** 2))
        for what, value in (("answer", d.recorded.predicted), ("calibrated", d.recorded.calibrated))
    }
    assert off["answer"] < 1.05 * off["calibrated"]
    assert off["answer"] < 1.3
