"""What is printed as prediction is what the laws give, not their tangents."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.diagnosis.inference.map_fit import damped_update


def test_coordinates_go_no_farther_than_the_laws_gain(offset) -> None:
    """The tangent's place is made absurd: the fit stays where it was."""
    problem, fit = offset.search.problem, offset.search.null_fit
    absurd = fit.z + 4.0
    z, beside = damped_update(
        problem, NOTHING, fit.z, absurd, fit.common, lambda prediction: np.zeros((prediction.size, 0)), fit.weight
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


def test_a_part_of_the_way_is_taken_where_a_law_curves() -> None:
    """The tangent at 1 of exp(z) = e^1.5 leads to 1.65: all of the way is best; at -1 it leads to 10.2, too far."""
    for start, nearest in ((1.0, 1.65), (-1.0, 1.8)):
        tangent = start + np.exp(1.5 - start) - 1.0
        curved = SimpleNamespace(
            y=np.full(40, np.exp(1.5)), sd=np.full(40, 0.3), predict=lambda names, z: np.full(40, np.exp(z[0]))
        )
        z, _ = damped_update(
            curved,
            NOTHING,
            np.array([start]),
            np.array([tangent]),
            np.zeros(40),
            lambda p: np.zeros((40, 0)),
            np.ones(40),
        )
        assert z[0] == pytest.approx(nearest, abs=0.15)
