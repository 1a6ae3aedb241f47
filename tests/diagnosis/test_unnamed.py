"""A mismatch without a name: what it rides on, and when it stands before a name that does not hold elsewhere."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.chain.effect import Effect
from mixedlub.diagnosis.assessment.mismatch_test import mismatch_test
from mixedlub.diagnosis.assessment.posterior import posterior
from mixedlub.diagnosis.discrepancy.modulated import (
    ADDITIVE,
    QUANTITIES,
    READING,
    THERMAL_LAG,
    TypicalSizes,
    log_slope,
    scalings_of,
)
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.inference.likelihood import log_likelihood
from mixedlub.diagnosis.inference.map_fit import map_fit
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.search import search
from mixedlub.kinds import kind
from mixedlub.kinds.standard import OIL
from mixedlub.recording.conditions import Coordinate, Coordinates, coordinates
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file, toml_file
from mixedlub.schema.table import Table

from .test_inference import found_in, problem


def test_boundary_friction_carries_in_proportion_to_its_share_of_friction() -> None:
    p = problem("disc")
    z = np.zeros(p.calibration_size)
    slope = log_slope(p, p.run(NOTHING, z), "boundary_friction")
    here = p.predict(NOTHING, z)
    moved = p.forward.predict({**p.calibration(z), "boundary_friction": 0.1001})
    assert slope == pytest.approx((moved - here) / np.log(1.001), rel=2e-3)


def test_film_and_shear_carry_with_the_signs_of_lubrication() -> None:
    p = problem("disc")
    z = np.zeros(p.calibration_size)
    base = p.run(NOTHING, z)
    found = scalings_of(p, base, TypicalSizes.of(p, base))
    assert set(found) - {THERMAL_LAG} == {READING, ADDITIVE, *QUANTITIES} - {"running_friction"}
    assert (found["film_thickness"] < 0).all()
    assert (found["shear_stress"] > 0).all()


@pytest.mark.long
def test_a_mismatch_of_the_film_is_taken_for_one() -> None:
    """Readings of a film that is thinner the colder the oil, made by hand from the chain's own slope."""
    p = problem("disc", seed=3)
    slope = log_slope(p, p.run(NOTHING, np.zeros(p.calibration_size)), "film_thickness")
    assert slope is not None
    temperature = p.rows["oil_temperature_C"]
    bend = np.sin(3.0 * (temperature - temperature.min()) / np.ptp(temperature))
    found = found_in(Problem(p.case, p.rows, p.forward, p.y + 0.6 * bend * slope, p.sd, p.shared))
    assert found.discrepancy.best.modulates == "film_thickness"


@pytest.mark.long
def test_a_mismatch_of_two_conditions_is_taken_for_one_of_two() -> None:
    """Readings above the base only where torque is low and oil is cold, at any speed and on any surface."""
    p = problem(seed=4)
    torque, temperature = p.rows["torque_Nm"], p.rows["oil_temperature_C"]
    light, cold = (np.exp(-3.0 * (x - x.min()) / np.ptp(x)) for x in (torque, temperature))
    found = found_in(Problem(p.case, p.rows, p.forward, p.y * (1.0 + 0.12 * light * cold), p.sd, p.shared))
    assert set(found.discrepancy.best.axes) == {"torque_Nm", "oil_temperature_C"}


def test_an_oil_of_another_coefficient_has_no_other_law() -> None:
    """Readings of one exponential of pressure, a third steeper than stated, make no law of pressure of their own."""
    stated = {"viscosity": 0.05, "pressure_viscosity": 0.06}
    noise = {"quantity": "viscosity_mPa_s", "noise": {"relative": 0.01, "absolute": 0.0}}
    text = {"schema": "mixedlub-case/1", "kind": "viscosity", "lubricant": OIL, "uncertainty": stated}
    system = toml_file.parse(system_file.System, {**text, "recording": noise}, "steeper oil")
    case = Case("steeper oil", Path("."), system, kind("viscosity"), Rig(system, Path(".")), None, None, ())
    warm, high = (x.ravel() for x in np.meshgrid([40.0, 60.0, 80.0, 100.0], [0.1, 50.0, 100.0, 200.0, 300.0, 400.0]))
    rows = Table({"temperature_C": warm, "pressure_MPa": high, "run": np.arange(1, warm.size + 1)})
    model = Forward(case, rows)
    y = model.predict({"pressure_viscosity": 1.35}) * np.exp(0.01 * np.random.default_rng(0).standard_normal(warm.size))
    p = Problem(case, rows, model, np.log(y), np.full(y.size, 0.01), np.zeros((y.size, 0)))
    space = coordinates(model)
    weights = search(p, space, space.values(model)).log_weights
    assert all("pressure_viscosity_law" not in m.effects or w < weights[DISCREPANCY] - 3.0 for m, w in weights.items())


def test_products_with_names_treat_all_names_alike() -> None:
    names = np.repeat(np.array(list("abcdefg")), 6)
    speed = np.tile(np.linspace(0.0, 1.0, 6), 7)
    space = Coordinates((Coordinate("surfaces", np.unique(names)), Coordinate("speed_rpm", np.unique(speed))))
    columns = space.columns([names, speed], 0.7, ("surfaces", "speed_rpm"), interactions=True)
    variance = (columns**2).sum(axis=1).reshape(7, 6)
    assert np.allclose(variance, variance[0])


def test_a_wild_reading_does_not_pull_the_fit() -> None:
    p = problem()
    clean = map_fit(p, NOTHING, np.zeros(p.size(NOTHING)))
    y = p.y.copy()
    y[7] += 400.0 * p.sd[7]
    pulled = map_fit(Problem(p.case, p.rows, p.forward, y, p.sd, p.shared), NOTHING, np.zeros(p.size(NOTHING)))
    assert np.max(np.abs(pulled.z - clean.z)) < 0.3
    value, weight = log_likelihood(np.array([300.0, 3000.0]))
    assert value[0] - value[1] == pytest.approx(2.0 * np.log(10.0), abs=0.01)
    assert (weight < 1e-4).all()


def test_a_name_that_fails_on_levels_left_out_loses_its_place() -> None:
    found = found_in(problem(extra=0.05))
    test = mismatch_test(found, 0.01)
    before = posterior(found, test)
    assert before.verdict == Explanation.of("churning")
    after = posterior(found, test, {Explanation.of("churning"): 60.0})
    assert after.verdict != Explanation.of("churning")
    assert after.weights[Explanation.of("churning")] < 1e-6


@pytest.mark.long
def test_an_effect_that_is_seldom_missing_has_lower_odds(monkeypatch: pytest.MonkeyPatch) -> None:
    from mixedlub.diagnosis.search import prior_odds

    found = found_in(problem())
    here = found.log_weights
    known = prior_odds.effects_of

    def rarer(names: list[str]) -> list[Effect]:
        return [replace(e, prior_odds=0.1) if e.id == "churning" else e for e in known(names)]

    monkeypatch.setattr(prior_odds, "effects_of", rarer)
    there = found.log_weights
    fallen = {m: here[m] - there[m] for m in map(Explanation.of, ("churning", "sensor_gain"))}
    assert fallen[Explanation.of("churning")] - fallen[Explanation.of("sensor_gain")] == pytest.approx(np.log(10.0))
