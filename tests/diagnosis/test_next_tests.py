"""Tests that are proposed can be run on the rig."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from mixedlub.diagnosis.assessment.experiment_design import candidates
from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.schema.table import Column, Table


def test_candidates_stay_within_the_limits_of_the_rig() -> None:
    table = Table({"roll_angle_deg": np.array([8.5, 20.0, 38.0])}, "")
    angles = candidates(table, [Column("roll_angle_deg")], {"roll_angle_deg": (8.3, 38.7)})["roll_angle_deg"]
    assert angles.tolist() == [8.5, 20.0, 38.0]


def test_roll_angles_near_the_ends_of_the_path_of_contact(
    make_case: Callable[..., Path], tmp_path: Path, excluded: tuple[str, ...]
) -> None:
    """The tooth tip is 0.3 degrees from the last recorded angle: a test beyond it cannot be computed, nor run."""
    folder = make_case(tmp_path / "case", "mesh_friction", lambda conditions, base: 1.06 * base)
    path = folder / "recordings.csv"
    path.write_text(path.read_text(encoding="utf-8").replace(",16.0,", ",8.6,"), encoding="utf-8")
    d = diagnose_case(folder, exclude=excluded)
    first, last = d.case.kind.column_limits(d.case.system)["roll_angle_deg"]
    assert first < 8.6
    assert d.next_tests
    assert all(first <= float(t.conditions["roll_angle_deg"]) <= last for t in d.next_tests)


def test_candidates_thinned_out_keep_every_level() -> None:
    sizes = {"torque_Nm": 5, "speed_rpm": 5, "oil_temperature_C": 4}
    levels = {name: np.arange(1.0, 1.0 + n) * 10.0 for name, n in sizes.items()}
    levels |= {"pinion_surface": np.array(["a", "b", "c"]), "gear_surface": np.array(["ground", "polished"])}
    grid = np.meshgrid(*levels.values(), indexing="ij")
    table = Table({name: column.ravel() for name, column in zip(levels, grid, strict=True)}, "")
    conditions = [Column(name, dtype="name" if "surface" in name else "number") for name in levels]
    found = candidates(table, conditions)
    assert len(found) == 600
    for name, column in levels.items():
        assert set(np.unique(found[name])) >= set(column[[0, -1]].tolist()), name
    both = {*zip(found["pinion_surface"].tolist(), found["gear_surface"].tolist(), strict=True)}
    assert len(both) == 6


def test_conditions_that_only_jitter_stay_at_their_set_point() -> None:
    """A start-up of a few readings at other loads is no set-point, and repeats of rounded numbers are no levels."""
    jitter = np.tile(np.linspace(-1.0, 1.0, 21), 5)
    columns = {
        "time_s": np.arange(107.0),
        "load_N": np.concatenate([[4.948, 12.0], 50.0 + 0.2 * jitter]),
        "slide_roll_ratio": np.concatenate([[0.82, 0.37], 1.0 + 0.002 * jitter]),
        "oil_temperature_C": np.concatenate([[115.2, 118.0], 120.0 + jitter]),
    }
    found = candidates(Table(columns, ""), [Column(name) for name in columns])
    assert {name: np.unique(found[name]).tolist() for name in columns if name != "time_s"} == {
        "load_N": [50.0],
        "slide_roll_ratio": [1.0],
        "oil_temperature_C": [120.0],
    }
    assert np.unique(found["time_s"]).size > 3
