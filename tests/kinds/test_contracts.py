"""Every effect that a recording of these kinds can show: silent at null, finite over its prior, in any pair."""

from itertools import combinations

import numpy as np
import pytest

from mixedlub.case.forward import Forward
from mixedlub.effects import catalogue

from .conftest import BALL, OIL, system

N = 12
RAMP = np.linspace(0.02, 1.0, N)
TABLES = {
    "film": (
        system("film", "film_thickness_nm", contact=BALL, lubricant=OIL),
        {
            "load_N": np.full(N, 30.0),
            "entrainment_speed_m_s": 2.0 * RAMP,
            "slide_roll_ratio": 0.3 * RAMP,
            "oil_temperature_C": 30.0 + 50.0 * RAMP,
            "sequence": RAMP,
            "film_thickness_nm": 100.0 * RAMP,
        },
    ),
    "friction_history": (
        system("friction_history", "friction_coefficient"),
        {
            "time_s": 3600.0 * RAMP,
            "load_N": np.full(N, 30.0),
            "entrainment_speed_m_s": 0.2 * RAMP,
            "slide_roll_ratio": 0.3 * RAMP,
            "oil_temperature_C": 30.0 + 50.0 * RAMP,
            "friction_coefficient": 0.06 + 0.01 * RAMP,
        },
    ),
    "friction_map": (
        system("friction_map", "friction_torque_Nm"),
        {
            "speed_rpm": np.concatenate([-100.0 * RAMP[:6], 100.0 * RAMP[6:]]),
            "torque_Nm": 3.0 * RAMP,
            "oil_temperature_C": 30.0 + 50.0 * RAMP,
            "position_deg": 360.0 * RAMP,
            "sequence": RAMP,
            "friction_torque_Nm": 1.0 + RAMP,
        },
    ),
    "viscosity": (
        system("viscosity", "viscosity_mPa_s", lubricant=OIL),
        {
            "temperature_C": 20.0 + 60.0 * RAMP[::-1],
            "pressure_MPa": 600.0 * RAMP,
            "time_s": 3600.0 * RAMP,
            "viscosity_mPa_s": 50.0 + 10.0 * RAMP,
        },
    ),
}


@pytest.fixture(params=TABLES)
def forward(request, make):
    case = make(*TABLES[request.param])
    return Forward(case, case.recordings)


def test_each_effect_is_silent_at_its_null(forward):
    base = forward.predict()
    for effect in forward.effects():
        assert np.array_equal(forward.predict(None, {effect.id: effect.nulls}), base), effect.id


def test_each_effect_is_finite_over_its_prior(forward):
    rng = np.random.default_rng(0)
    for effect in forward.effects():
        for z in 1.5 * rng.standard_normal((12, len(effect.parameters))):
            assert np.isfinite(forward.predict(None, {effect.id: effect.values(z)})).all(), effect.id


def test_each_pair_of_effects_is_finite(forward):
    middle = {e.id: e.values(np.zeros(len(e.parameters))) for e in forward.effects()}
    for a, b in combinations(middle, 2):
        assert np.isfinite(forward.predict(None, {a: middle[a], b: middle[b]})).all(), (a, b)


def test_each_effect_moves_the_reading_smoothly_in_its_parameters(forward):
    for effect in forward.effects():
        z = np.full(len(effect.parameters), 0.2)

        def reading(step, direction, effect=effect, z=z):
            return forward.predict(None, {effect.id: effect.values(z + step * direction)})

        for direction in np.eye(z.size):
            coarse = (reading(2e-3, direction) - reading(-2e-3, direction)) / 4e-3
            fine = (reading(1e-3, direction) - reading(-1e-3, direction)) / 2e-3
            size = np.max(np.abs(fine)) + 1e-9 * np.max(np.abs(reading(0.0, direction)))
            assert np.max(np.abs(coarse - fine)) < 0.02 * size, effect.id


def test_the_effects_of_these_kinds_are_offered_where_they_belong(make):
    for kind, names in {
        "film": ("boundary_film", "fringe_order", "inlet_shear_heating", "zero_drift", "viscosity_drift"),
        "friction_history": ("contact_creep", "tribofilm_growth", "friction_run_in", "two_time_scales"),
        "friction_map": ("stribeck", "direction_dependence", "periodic_mesh", "torque_constant", "grease_temperature"),
        "viscosity": ("pressure_viscosity_law", "viscosity_drift"),
    }.items():
        case = make(*TABLES[kind])
        offered = {e.id for e in Forward(case, case.recordings).effects()}
        assert set(names) <= offered
        assert offered <= set(catalogue())


def test_no_two_drifts_of_the_instrument_are_one_law(forward):
    base = forward.predict()
    drifts = [e for e in forward.effects() if e.stage == "measurement" and "sequence" in e.reads]
    assert drifts or "sequence" not in forward.inputs
    for a, b in combinations(drifts, 2):
        one, other = (forward.predict(None, {e.id: e.values(np.full(len(e.parameters), 0.1))}) - base for e in (a, b))
        assert abs(one @ other) < 0.999 * np.linalg.norm(one) * np.linalg.norm(other), (a.id, b.id)
