"""Effects on the load against the integrals and equations of motion behind them."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import integrate

from mixedlub.case import reference_rigs
from mixedlub.effects.dynamic_load import dynamic_load
from mixedlub.effects.misalignment import misalignment
from mixedlub.effects.tip_relief import tip_relief


@pytest.mark.parametrize("uneven", [1e-4, 9.9e-3, 0.3, 0.999, 1.0, 1.7, 12.0])
@pytest.mark.parametrize("power", [0.05, 0.17, 0.6])
def test_misaligned_face_loses_what_its_linear_load_does(uneven: float, power: float) -> None:
    """A rigid gap on an even bed of springs: the load is linear along the part of the face that touches."""
    touching = min(1.0, uneven**-0.5)
    highest = 1.0 + uneven if uneven <= 1.0 else 2.0 * uneven**0.5
    lowest = max(1.0 - uneven, 0.0)

    def lost(y: float) -> float:
        return (highest + (lowest - highest) * y / touching) ** (1.0 + power)

    excess = integrate.quad(lambda y: lost(y) - 1.0, 0.0, touching, epsabs=1e-14, epsrel=1e-12)[0] - 1.0 + touching
    gap = uneven * 2.0 * 1e5 / 2e10
    found = misalignment(1.0, 1e5, 1.0, misalignment=gap, relief=1.0, loss_power=power)
    assert np.log(found) == pytest.approx(np.log1p(excess) / power, rel=1e-5)


def test_misalignment_has_a_limit_for_a_coefficient_that_load_does_not_change() -> None:
    """ln w goes to the mean of (1 + xs) ln(1 + xs) over s from -1 to 1."""
    limit = integrate.quad(lambda s: 0.5 * (1.0 + 0.7 * s) * np.log1p(0.7 * s), -1.0, 1.0)[0]
    found = misalignment(1.0, 1e5, 1.0, misalignment=7e-6, relief=1.0, loss_power=0.0)
    assert np.log(found) == pytest.approx(limit, rel=1e-4)


@pytest.mark.parametrize("ratio", [0.4, 0.95, 1.3])
@pytest.mark.parametrize("phase", [-1.2, 0.0, 0.9])
def test_dynamic_load_is_the_steady_vibration_where_the_teeth_slide(ratio: float, phase: float) -> None:
    """Driven by cos(r t), the phase of the sliding being pi/2 - phase after the peak of the drive."""
    damping = 0.1

    def motion(t: float, state: np.ndarray) -> list[float]:
        return [state[1], np.cos(ratio * t) - state[0] - 2.0 * damping * state[1]]

    moment = (np.pi / 2 - phase + 2.0 * np.pi * 30) / ratio
    steady = integrate.solve_ivp(motion, (0.0, moment), [0.0, 0.0], rtol=1e-9, atol=1e-11).y[0, -1]
    pair = {"amplitude": 0.02, "resonance": 1.0 / (2.0 * np.pi), "damping": damping, "phase": phase, "second": 0.0}
    assert dynamic_load(1.0, ratio, 1.0, **pair, fade=0.0) == pytest.approx(1.0 + 0.02 * ratio * steady, abs=1e-6)


def test_force_added_by_errors_of_the_teeth_is_the_same_at_any_load() -> None:
    pair = {"amplitude": 0.02, "resonance": 800.0, "damping": 0.1, "phase": 0.3, "second": 0.2}
    load = np.array([600.0, 3000.0, 9000.0])
    added = dynamic_load(load, 200.0, 20.0, **pair, fade=1.0) - load
    np.testing.assert_allclose(added, added[1])


@pytest.mark.parametrize("relief", [5e-6, 30e-6])
def test_relief_hands_load_on_without_losing_any(relief: float) -> None:
    inputs = reference_rigs.forward("gear_pair").inputs
    words = ("load_share", "path_fraction", "contact_ratio", "transmitted_force", "contact_width", "face_width")
    before = inputs["load_share"]
    after = tip_relief(*(inputs[w] for w in words), relief=relief, length=0.2, fade=1.0)
    total = ((after - before) * inputs["path_weight"]).sum(axis=-1)
    moved = (np.abs(after - before) * inputs["path_weight"]).sum(axis=-1)
    assert (np.abs(total) < 0.01 * moved).all()
