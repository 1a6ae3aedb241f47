"""What a study leaves: the columns other programs read, labels, units."""

import csv

import numpy as np
import pytest

from mixedlub.schema.findings import codes
from mixedlub.study import read_study, run_study
from mixedlub.study.columns import every_column
from mixedlub.study.validity import out_of_range

HEADER = [
    "pinion_surface",
    "gear_surface",
    "torque_Nm",
    "speed_rpm",
    "oil_temperature_C",
    "power_loss_W",
    "mean_friction",
    "boundary_area_ratio",
    "film_thickness_um",
    "film_parameter",
    "composite_roughness_um",
    "mesh_loss_W",
    "rolling_loss_W",
    "other_loss_W",
    "hertz_pressure_MPa",
    "asperity_load_ratio",
    "asperity_real_pressure_MPa",
    "validity",
    "normalised_loss",
    "input_power_W",
    "efficiency",
    "tooth_efficiency",
    "loss_factor_H_V",
    "loss_factor_H_VL",
    "plain_mean_friction",
    "minimum_film_thickness_um",
    "minimum_film_parameter",
    "asperity_load_share",
    "flash_temperature_K",
    "contact_temperature_C",
]


def numbers(results):
    """The columns of numbers as arrays."""
    return {name: column.to_numpy() for name, column in results.to_pandas().select_dtypes("number").items()}


@pytest.fixture
def results(write_study):
    return run_study(read_study(write_study()))


def test_table_has_the_agreed_columns_and_a_row_a_condition(results, tmp_path):
    results.write(tmp_path / "r.csv", tmp_path / "r.parquet")
    with (tmp_path / "r.csv").open(newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0] == HEADER
    assert len(rows) == 1 + 6 * 2 * 2 * 3
    assert len({tuple(row[:5]) for row in rows[1:]}) == len(rows) - 1


def test_csv_and_parquet_hold_the_same_numbers(results, tmp_path):
    import pyarrow.parquet as pq

    results.write(tmp_path / "r.csv", tmp_path / "r.parquet")
    table = pq.read_table(tmp_path / "r.parquet")
    assert table.column_names == HEADER
    with (tmp_path / "r.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["validity"] for row in rows] == table["validity"].to_pylist()
    for name in (name for name in HEADER[2:] if name != "validity"):
        assert np.array_equal([float(row[name]) for row in rows], table[name].to_numpy())
    for name in HEADER[:2]:
        assert [row[name] for row in rows] == table[name].to_pylist()


def test_a_table_in_many_parts_is_one_file_in_order(results, tmp_path, monkeypatch):
    import pyarrow.parquet as pq

    monkeypatch.setattr("mixedlub.study.results._ROWS", 20)
    assert len(list(results.tables())) == 6
    results.write(tmp_path / "r.csv", tmp_path / "r.parquet")
    with (tmp_path / "r.csv").open(newline="") as file:
        rows = list(csv.reader(file))
    table = pq.read_table(tmp_path / "r.parquet")
    assert [row[0] for row in rows] == ["pinion_surface", *table["pinion_surface"].to_pylist()]
    assert [float(row[5]) for row in rows[1:]] == table["power_loss_W"].to_pylist()


def test_surface_names_with_commas_survive_the_csv(write_study, tmp_path):
    odd = {"ground, fine": {"m0_um2": 0.02, "m2": 0.0025, "m4_per_um2": 0.0036}}
    run_study(read_study(write_study(surfaces=odd))).write(tmp_path / "r.csv", tmp_path / "r.parquet")
    with (tmp_path / "r.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert rows[0]["pinion_surface"] == "ground, fine"
    assert float(rows[0]["torque_Nm"]) == 50


def test_rows_and_labelled_result_agree(results, tmp_path):
    import pyarrow.parquet as pq

    results.write(tmp_path / "r.csv", tmp_path / "r.parquet")
    row = pq.read_table(tmp_path / "r.parquet").to_pylist()[17]
    data = results.to_xarray().set_index(pairing=["pinion_surface", "gear_surface"])
    one = data.sel(
        pairing=(row["pinion_surface"], row["gear_surface"]),
        **{name: row[name] for name in ("torque_Nm", "speed_rpm", "oil_temperature_C")},
    )
    for column in results.columns:
        assert float(one[column.name]) == row[column.name]


def test_labelled_result_carries_units_and_meanings(results):
    data = results.to_xarray()
    assert data["power_loss_W"].dims == ("pairing", "oil_temperature_C", "torque_Nm", "speed_rpm")
    meaning = next(c.meaning for c in every_column() if c.name == "film_thickness_um")
    assert data["film_thickness_um"].attrs == {"units": "µm", "long_name": meaning}
    assert data["asperity_load_ratio"].attrs["units"] == "-"


def test_mean_friction_is_loss_over_the_integral_of_load_and_sliding(results):
    inputs = results.study.plan.inputs
    force = inputs["load_share"] * inputs["transmitted_force"] * inputs["sliding_speed"]
    integral = (force * inputs["path_weight"]).sum(axis=-1)
    assert results["mean_friction"] == pytest.approx(results["power_loss"] / integral, rel=1e-12)


def test_film_parameter_is_mean_film_over_composite_roughness(results):
    assert results["film_parameter"] == pytest.approx(results["film_thickness"] / results["composite_roughness"])


def test_load_balance_is_flagged(results):
    assert "asperities_overloaded" in codes(out_of_range(results))


def test_thick_films_are_not_flagged(write_study):
    polished = {"a": {"m0_um2": 4e-4, "m2": 2e-4, "m4_per_um2": 4e-4}}
    study = read_study(write_study(surfaces=polished, conditions__speed_rpm=[3000], conditions__oil_temperature_C=[40]))
    assert out_of_range(run_study(study)) == ()


def test_low_bandwidth_of_a_trace_is_flagged(write_study, tmp_path):
    """A wave has one summit a period, a bandwidth of 1."""
    x = np.arange(16_000) * 0.5e-6
    np.savetxt(tmp_path / "wave.txt", 0.1 * np.sin(2 * np.pi * x / 100e-6))
    wave = {"profile": "wave.txt", "unit": "um", "spacing": "0.5 um", "cutoff_mm": 0.8}
    assert "bandwidth_limited" in codes(out_of_range(run_study(read_study(write_study(surfaces={"a": wave})))))


def test_area_ratio_held_at_one_is_flagged(write_study):
    wide = {"a": {"m0_um2": 100.0, "m2": 0.0025, "m4_per_um2": 0.9}}
    found = run_study(read_study(write_study(surfaces=wide)))
    assert found["area_ratio"].max() == 1.0
    assert "area_ratio_limited" in codes(out_of_range(found))


LOSSES_BESIDE_THE_MESH = {"churning": {}, "windage": {}, "bearing_drag": {}, "seal_drag": {}}


def test_mean_friction_is_that_of_the_mesh_whatever_else_loses_power(write_study):
    base = run_study(read_study(write_study()))
    whole = run_study(read_study(write_study("whole", effects=LOSSES_BESIDE_THE_MESH)))
    assert np.array_equal(base["mean_friction"], whole["mean_friction"])


def test_power_loss_is_the_sum_of_its_origins(write_study):
    found = run_study(read_study(write_study(effects={**LOSSES_BESIDE_THE_MESH, "rolling_resistance": {}})))
    assert (found["rolling_loss"] > 0).all()
    assert (found["other_loss"] > 0).all()
    parts = found["mesh_loss"] + found["rolling_loss"] + found["other_loss"]
    assert found["power_loss"] == pytest.approx(parts, rel=1e-12)


def test_every_loss_outside_the_mesh_has_a_column_and_they_add_up(write_study, tmp_path):
    import pyarrow.parquet as pq

    found = run_study(read_study(write_study(effects={**LOSSES_BESIDE_THE_MESH, "rolling_resistance": {}})))
    found.write(tmp_path / "r.csv", tmp_path / "r.parquet")
    table = pq.read_table(tmp_path / "r.parquet")
    origins = ["mesh_loss_W", "rolling_loss_W", *(f"{name}_loss_W" for name in sorted(LOSSES_BESIDE_THE_MESH))]
    parts = [table[name].to_numpy() for name in origins]
    assert all((part > 0).all() for part in parts)
    assert sum(parts) == pytest.approx(table["power_loss_W"].to_numpy(), rel=1e-9)
    assert {table.field(name).metadata[b"unit"] for name in origins} == {b"W"}


def test_loss_of_an_effect_is_what_switching_it_on_adds(write_study):
    base = run_study(read_study(write_study()))["power_loss"]
    both = run_study(read_study(write_study("both", effects={"windage": {}, "seal_drag": {}})))
    for name in ("windage", "seal_drag"):
        alone = run_study(read_study(write_study(name, effects={name: {}})))["power_loss"] - base
        assert both[f"{name}_loss"] == pytest.approx(alone, rel=1e-9)


def test_mean_friction_does_not_depend_on_the_averages_of_the_loss(write_study):
    base = run_study(read_study(write_study()))
    paper = run_study(read_study(write_study("paper", options={"averaging": "paper"})))
    assert paper["mean_friction"] == pytest.approx(base["mean_friction"], rel=1e-12)
    assert np.array_equal(paper["plain_mean_friction"], base["plain_mean_friction"])
    assert not np.allclose(paper["mesh_loss"], base["mesh_loss"], rtol=0.05)


def test_loss_of_the_mesh_is_input_power_times_friction_times_loss_factor(write_study):
    rows = numbers(run_study(read_study(write_study())))
    assert rows["input_power_W"] == pytest.approx(rows["torque_Nm"] * rows["speed_rpm"] * np.pi / 30, rel=1e-12)
    product = rows["input_power_W"] * rows["mean_friction"] * rows["loss_factor_H_VL"]
    assert rows["mesh_loss_W"] == pytest.approx(product, rel=1e-12)
    assert rows["efficiency"] == pytest.approx(1 - rows["power_loss_W"] / rows["input_power_W"], rel=1e-12)


def test_torque_and_speed_of_the_gear_give_the_same_input_power(write_study):
    found = numbers(run_study(read_study(write_study(options={"conditions_of": "gear"}))))
    assert found["input_power_W"] == pytest.approx(found["torque_Nm"] * found["speed_rpm"] * np.pi / 30, rel=1e-12)


def test_helical_gears_have_no_loss_factor_of_spur_gears(write_study):
    found = run_study(read_study(write_study(gears__helix_angle_deg=15.0)))
    assert not {c.name for c in found.columns} & {"loss_factor_H_V", "loss_factor_H_VL"}


def test_normalised_loss_is_one_at_the_largest(results):
    loss = results["normalised_loss"]
    assert loss.max() == 1.0
    assert loss == pytest.approx(results["power_loss"] / results["power_loss"].max(), rel=1e-12)


def test_least_film_is_below_the_mean_and_warmest_contact_above_the_oil(results):
    rows = numbers(results)
    assert (rows["minimum_film_thickness_um"] < rows["film_thickness_um"]).all()
    ratio = rows["minimum_film_thickness_um"] / rows["composite_roughness_um"]
    assert rows["minimum_film_parameter"] == pytest.approx(ratio, rel=1e-12)
    warmer = rows["contact_temperature_C"] - rows["oil_temperature_C"]
    assert warmer == pytest.approx(rows["flash_temperature_K"], rel=1e-9)
    assert (warmer > 0).all()


def test_every_column_has_one_meaning_and_a_unit(results):
    known = [c.name for c in every_column(["windage"])]
    assert len(known) == len(set(known))
    assert set(HEADER) <= set(known)
    assert all(c.meaning and c.unit for c in every_column(["windage"]))


def test_friction_of_one_pairing_follows_an_effect_on_its_load(write_study):
    """A uniform factor on the force leaves the mesh's coefficient where the load itself puts it."""
    force = {"amplitude": 0.1, "resonance": 850.0, "damping": 0.1, "phase": 0.0, "second": 0.0, "power": 2.0}
    force |= {"in_phase": 1.0, "everywhere": 1.0}
    one = {"every": ["mid"]}
    many = run_study(read_study(write_study("many", effects={"dynamic_load": force})))
    alone = run_study(read_study(write_study("alone", effects={"dynamic_load": force}, pairings=one)))
    pairing = many.study.pairings.index(("mid", "mid"))
    assert alone["mean_friction"][0] == pytest.approx(many["mean_friction"][pairing], rel=1e-12)
