"""Effects on the load against the integrals and equations of motion behind them."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import integrate

from mixedlub.case import reference_rigs
from mixedlub.effects.dynamic_load import dynamic_load
from mixedlub.effects.misalignment import misalignment
from mixedlub.effects.tip_relief import tip_relief
from mixedlub.gear import GearPair, RigidSharing, mesh
from mixedlub.gear.inputs import contact_inputs


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


TEETH = {"pinion_teeth": 20.0, "mesh_phase": np.linspace(0.0, 1.6, 9)}
VIBRATION = {"amplitude": 0.02, "resonance": 800.0, "damping": 0.1, "second": 0.0, "power": 2.0, "fade": 0.0}
WAVE, FACTOR = {"in_phase": 0.0, "everywhere": 0.0}, {"in_phase": 1.0, "everywhere": 1.0, "phase": 0.0}


@pytest.mark.parametrize("ratio", [0.4, 0.95, 1.3])
@pytest.mark.parametrize("phase", [-1.2, 0.0, 0.9])
def test_dynamic_load_is_the_steady_vibration_that_the_transmission_error_drives(ratio: float, phase: float) -> None:
    """Springs of the teeth between wheels that an error cos(w) holds apart, over their static deflection."""

    def motion(time: float, state: np.ndarray) -> list[float]:
        return [state[1], ratio**2 * np.cos(ratio * time) - state[0] - 0.2 * state[1]]

    turn = 2.0 * np.pi * (30.0 + TEETH["mesh_phase"]) + phase
    steady = integrate.solve_ivp(
        motion, (0.0, turn[-1] / ratio), [0.0, 0.0], t_eval=turn / ratio, rtol=1e-9, atol=1e-11
    )
    speed = 2.0 * np.pi * 800.0 * ratio / 20.0
    found = dynamic_load(1.0, 3000.0, speed, **TEETH, **VIBRATION, **WAVE, phase=phase)
    np.testing.assert_allclose(found, 1.0 + 0.02 * steady.y[0], atol=1e-6)


def test_force_added_by_errors_of_the_teeth_is_the_same_at_any_load() -> None:
    load = np.array([[600.0], [3000.0], [9000.0]])
    vibration = {**VIBRATION, "second": 0.2, "fade": 1.0}
    added = load * (dynamic_load(1.0, load, 200.0, **TEETH, **vibration, **WAVE, phase=0.3) - 1.0)
    np.testing.assert_allclose(added, added[[1, 1, 1]])


@pytest.mark.parametrize("helix_deg", [0.0, 15.0, 25.0])
@pytest.mark.parametrize("second", [0.0, 0.5])
def test_the_wave_leaves_the_mean_force_of_the_mesh(helix_deg: float, second: float) -> None:
    pair = GearPair((20, 30), 4e-3, np.radians(20.0), 30e-3, helix_angle=np.radians(helix_deg))
    inputs = contact_inputs(mesh(pair, RigidSharing(), points=96, slices=24), np.array([[100.0]]), np.array([[150.0]]))
    words = ("load_share", "transmitted_force", "pinion_speed", "pinion_teeth", "mesh_phase")
    shaken = {**VIBRATION, "second": second, "phase": 0.7}
    found = dynamic_load(*(inputs[w] for w in words), **shaken, **WAVE)
    before = (inputs["load_share"] * inputs["path_weight"]).sum()
    assert np.ptp(found / inputs["load_share"]) > 0.01
    assert (found * inputs["path_weight"]).sum() == pytest.approx(before, rel=1e-3)


def test_far_below_resonance_it_is_the_dynamic_factor_of_iso_6336() -> None:
    """In proportion to speed."""
    speed = np.geomspace(2.0, 20.0, 7)[:, None] / 0.05
    slow = {**VIBRATION, "resonance": 1e6, "power": 1.0}
    added = dynamic_load(1.0, 3000.0, speed, **TEETH, **slow, **FACTOR) - 1.0
    np.testing.assert_allclose(added, np.broadcast_to(0.02 * speed * 20.0 / (2e6 * np.pi), added.shape), rtol=1e-3)


def test_far_below_resonance_it_is_nearly_the_dynamic_factor_of_agma_2001() -> None:
    """At pitch-line speeds from 2 to 20 m/s and a quality number of 7: B = 0.731, A = 65.1."""
    speed = np.geomspace(2.0, 20.0, 7)
    factor = ((65.1 + np.sqrt(200.0 * speed)) / 65.1) ** 0.731 - 1.0
    slow = {**VIBRATION, "resonance": 1e6, "power": 0.5}
    added = dynamic_load(1.0, 3000.0, speed / 0.05, 20.0, 0.0, **slow, **FACTOR) - 1.0
    np.testing.assert_allclose(added / added[3], factor / factor[3], rtol=0.05)


@pytest.mark.parametrize("relief", [5e-6, 30e-6])
def test_relief_hands_load_on_without_losing_any(relief: float) -> None:
    inputs = reference_rigs.forward("gear_pair").inputs
    words = ("load_share", "path_fraction", "contact_ratio", "transmitted_force", "contact_width", "face_width")
    before = inputs["load_share"]
    after = tip_relief(*(inputs[w] for w in words), relief=relief, length=0.2, fade=1.0)
    total = ((after - before) * inputs["path_weight"]).sum(axis=-1)
    moved = (np.abs(after - before) * inputs["path_weight"]).sum(axis=-1)
    assert (np.abs(total) < 0.01 * moved).all()
