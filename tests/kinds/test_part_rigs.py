"""Readings of a rig without its gears hold only the losses that need none."""

import numpy as np
import pytest

from mixedlub.case import reference_rigs
from mixedlub.case.forward import Forward
from mixedlub.schema.findings import codes, collected
from mixedlub.schema.table import Table

GEARED, BARE = slice(0, 3), slice(3, 6)


@pytest.fixture(scope="module")
def forward():
    """Three conditions with gears and the same three without."""
    once = reference_rigs.table("gear_pair").take(np.array([0, 7, 19]))
    columns = {name: np.concatenate([values, values]) for name, values in once.columns.items()}
    columns["run"] = np.arange(1, 7)
    columns["rig"] = np.repeat(["complete", "no_gears"], 3)
    return Forward(reference_rigs.case("gear_pair"), Table(columns))


def test_base_model_loses_nothing_without_gears(forward):
    base = forward.predict()
    assert np.all(base[GEARED] > 0.0)
    assert np.all(base[BARE] == 0.0)


def test_rows_with_gears_are_those_of_a_recording_without_part_rigs(forward):
    whole = forward.table.take(np.arange(3))
    np.testing.assert_allclose(Forward(forward.case, whole, 1.0).predict(), forward.predict()[GEARED], rtol=1e-12)


@pytest.mark.parametrize("name", ["seal_drag", "bearing_drag", "torque_offset"])
def test_losses_of_the_shafts_stay(forward, name):
    effect = next(e for e in forward.effects() if e.id == name)
    added = forward.predict(None, {name: effect.values(np.full(len(effect.parameters), 0.3))}) - forward.predict()
    assert np.all(np.abs(added[BARE]) > 0.05 * np.abs(added[GEARED]))


def test_bearings_carry_no_tooth_force(forward):
    size = {"strength": 1.0, "load_power": 1.3, "idle": 1.0, "rolling_power": 0.3, "rubbing": 1.4}
    loaded, half = ({"bearing_drag": {**size, "loaded": part}} for part in (1.0, 0.5))
    added = forward.predict(None, loaded) - forward.predict(None, half)
    assert np.all(added[GEARED] > 0.0)
    assert np.all(added[BARE] == 0.0)


STAGES_OF_THE_MESH = ("film", "shear", "contact", "boundary", "load")


def test_what_changes_the_mesh_or_needs_wheels_changes_nothing_without_gears(forward):
    gone = [e for e in forward.effects() if e.stage in STAGES_OF_THE_MESH]
    gone += [
        e for e in forward.effects() if e.id in ("rolling_resistance", "elastic_hysteresis", "windage", "churning")
    ]
    assert len(gone) > 15
    for effect in gone:
        assert np.allclose(forward.predict(None, {effect.id: effect.prior_medians})[BARE], 0.0, atol=1e-6), effect.id


def test_every_effect_stays_finite(forward):
    for effect in forward.effects():
        assert np.isfinite(forward.predict(None, {effect.id: effect.prior_medians})).all(), effect.id


def test_what_was_assumed_is_said(forward):
    (note,) = [note for note in forward.notes if note.code == "gears_absent"]
    assert "no_gears" in note.place


def test_a_complete_rig_says_nothing():
    with collected() as notes:
        Forward(reference_rigs.case("gear_pair"), reference_rigs.table("gear_pair").take(np.arange(3)))
    assert "gears_absent" not in codes(notes)
