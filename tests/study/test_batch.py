"""The batch engine gives the same numbers however the work is cut, and those of one condition at a time."""

import numpy as np
import pytest

from mixedlub.base_model.chains import GEAR_LOSS
from mixedlub.chain.model import Model
from mixedlub.study import batch, read_study, run_study
from profiles.errors import InputError

ALL = (*batch.OUTPUTS, *batch.CHECKS)


def collected(plan, todo, **how):
    values = {name: np.full(plan.shape, np.nan) for name in ALL}
    for block, found in batch.run(plan, todo, **how):
        for name in ALL:
            values[name][block] = found[name]
    return values


@pytest.fixture
def plan(write_study):
    return read_study(write_study()).plan


@pytest.mark.parametrize("shape", [(21, 1, 3, 6), (1000, 2, 7, 11), (1, 1, 1, 1), (3, 40, 50, 60), (100000, 1, 1, 1)])
@pytest.mark.parametrize("most", [50, 3_000, 80_000, 4_000_000])
def test_blocks_cover_the_grid_once_and_keep_to_their_size(shape, most):
    points = 50
    cover = np.zeros(shape, dtype=np.int8)
    for block in batch.split(shape, batch.reach(shape, points, most, shape[0])):
        cover[block] += 1
        assert cover[block].size * points <= most
    assert (cover == 1).all()


@pytest.mark.parametrize("reach", [(1, 1, 1, 1), (2, 1, 2, 1), (6, 2, 1, 3), (5, 2, 2, 2)])
def test_cut_of_the_work_changes_no_number(plan, reach):
    whole = collected(plan, batch.split(plan.shape, plan.shape))
    pieces = collected(plan, batch.split(plan.shape, reach))
    for name in ALL:
        np.testing.assert_allclose(whole[name], pieces[name], rtol=1e-12, err_msg=name)


def test_pieces_within_a_block_change_no_number(plan, monkeypatch):
    whole = collected(plan, batch.blocks(plan))
    monkeypatch.setattr(batch, "PIECE_POINTS", 150)
    monkeypatch.setattr(batch, "PIECE_PAIRINGS", 2)
    pieces = collected(plan, batch.blocks(plan))
    for name in ALL:
        np.testing.assert_allclose(whole[name], pieces[name], rtol=1e-12, err_msg=name)


def test_threads_change_no_bit(plan):
    todo = batch.split(plan.shape, (1, 1, 1, 3))
    alone = collected(plan, todo, threads=1)
    together = collected(plan, todo, threads=4)
    for name in ALL:
        assert np.array_equal(alone[name], together[name]), name


def test_grid_equals_one_condition_at_a_time(plan):
    found = collected(plan, batch.blocks(plan))
    model = Model(GEAR_LOSS, tuple(plan.inputs), ("power_loss", "area_ratio"))
    for place in [(0, 0, 0, 0), (3, 1, 1, 2), (5, 0, 1, 0)]:
        ranges = tuple(slice(i, i + 1) for i in place)
        one = {}
        for name, value in plan.inputs.items():
            cut = (
                value[tuple(r if n > 1 else slice(None) for r, n in zip(ranges, value.shape))]
                if np.ndim(value) == 5
                else value
            )
            one[name] = cut.reshape(cut.shape[-1]) if np.ndim(cut) == 5 else cut
        state = model(one)
        assert found["power_loss"][place] == pytest.approx(float(state["power_loss"].item()), rel=1e-13)
        mean = (state["area_ratio"] * one["mean_weight"]).sum()
        assert found["area_ratio"][place] == pytest.approx(mean, rel=1e-12)


def test_what_no_surface_changes_is_computed_without_the_surfaces(plan):
    common, own = batch.stages(plan.model(), plan.inputs)
    assert {"film_thickness", "shear_stress", "fluid_friction"} <= {s.outputs[0] for s in common.steps}
    assert {"separation", "area_ratio", "friction"} <= {s.outputs[0] for s in own.steps}


def test_effect_on_the_film_leaves_the_film_common(write_study):
    plan = read_study(write_study(effects={"inlet_shear_heating": {"strength": 1.0}})).plan
    common, _ = batch.stages(plan.model(), plan.inputs)
    assert "inlet_shear_heating" in [s.effect for s in common.steps]


def test_effect_changes_the_result_and_its_null_does_not(write_study):
    base = run_study(read_study(write_study()))
    null = run_study(read_study(write_study(effects={"inlet_shear_heating": {"strength": 0.0}})))
    hot = run_study(read_study(write_study(effects={"inlet_shear_heating": {"strength": 1.0}})))
    assert np.array_equal(base["power_loss"], null["power_loss"])
    assert (hot["film_thickness"] < base["film_thickness"]).all()


def test_parameters_of_other_kinds_stay_at_their_null(write_study):
    """Roelands is the base of a gear pair: what leads from Barus to it is a parameter of samples only."""
    bent = {"bend_down": 0.0, "bend_up": 0.0, "slope": 1.0}
    base = run_study(read_study(write_study()))
    same = run_study(read_study(write_study(effects={"pressure_viscosity_law": bent})))
    assert np.allclose(base["power_loss"], same["power_loss"], rtol=1e-12)
    with pytest.raises(InputError, match=r"no such parameter of pressure_viscosity_law"):
        read_study(write_study(effects={"pressure_viscosity_law": {"roelands": 0.5}}))


def test_unloaded_points_leave_results_finite(write_study):
    relieved = {"model": "ldp", "tip_relief_um": [60, 60], "relief_length_mm": [3, 3], "misalignment_um": 40}
    results = run_study(read_study(write_study(gears__load_sharing=relieved)))
    for name in ALL:
        assert np.isfinite(results[name]).all(), name
    assert results["film_thickness"].max() < 2e-6


def test_one_slice_or_many_agree_on_straight_teeth(write_study):
    ldp = {"model": "ldp"}
    one = run_study(read_study(write_study(gears__load_sharing=ldp, options__face_slices=1)))
    many = run_study(read_study(write_study(gears__load_sharing=ldp)))
    assert one["power_loss"] == pytest.approx(many["power_loss"], rel=0.02)


def test_path_quadrature_has_converged(write_study):
    coarse = run_study(read_study(write_study(options__path_points=48)))
    fine = run_study(read_study(write_study(options__path_points=400)))
    assert coarse["power_loss"] == pytest.approx(fine["power_loss"], rel=2e-4)


def test_cluster_gives_the_same_bits(plan):
    distributed = pytest.importorskip("distributed")
    todo = batch.split(plan.shape, (2, 1, 2, 2))
    here = collected(plan, todo, threads=1)
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=2, processes=False, dashboard_address=None, protocol="inproc://"
    ) as cluster:
        there = collected(plan, todo, scheduler=cluster.scheduler_address)
    for name in ALL:
        assert np.array_equal(here[name], there[name]), name


def test_a_system_that_tells_no_affinity_has_its_processors(monkeypatch):
    monkeypatch.delattr("os.sched_getaffinity", raising=False)
    assert batch.processors() >= 1
