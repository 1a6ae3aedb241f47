"""A condition that only wanders is not one that was varied."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.recording.conditions import coordinates
from mixedlub.schema.table import Table


def axes(folder: Path, **columns: np.ndarray) -> list[str]:
    """Names of the axes of a viscosity case whose columns are replaced."""
    case = read_case(folder)
    assert case.recordings is not None
    kept = {k: v for k, v in case.recordings.columns.items() if k not in ("time_s", "sequence")}
    table = Table({**kept, **columns})
    return [axis.name for axis in coordinates(Forward(case, table)).axes]


def rows(folder: Path) -> int:
    return len((folder / "recordings.csv").read_text(encoding="utf-8").splitlines()) - 1


def test_a_temperature_that_wanders_by_a_degree_is_no_axis(make_case: Callable[..., Path], tmp_path: Path) -> None:
    folder = make_case(tmp_path / "case", "viscosity")
    count = rows(folder)
    pressure = np.linspace(0.1, 500.0, count)
    drifting = 40.0 + np.linspace(-0.7, 0.7, count)
    assert axes(folder, pressure_MPa=pressure, temperature_C=drifting) == ["pressure_MPa"]
    assert "temperature_C" in axes(folder, pressure_MPa=pressure, temperature_C=np.linspace(40.0, 60.0, count))


def test_what_wanders_counts_where_nothing_else_varies(make_case: Callable[..., Path], tmp_path: Path) -> None:
    folder = make_case(tmp_path / "case", "viscosity")
    count = rows(folder)
    drifting = 40.0 + np.linspace(-0.7, 0.7, count)
    assert axes(folder, pressure_MPa=np.full(count, 0.1), temperature_C=drifting) == ["temperature_C"]


@pytest.mark.parametrize(("span", "counts"), [(4.0, False), (9.0, True)])
def test_effects_and_discrepancy_agree_on_what_was_constant(
    make_case: Callable[..., Path], tmp_path: Path, span: float, counts: bool
) -> None:
    """One rule decides whether a temperature is an axis and whether a law of it is offered as an effect."""
    case = read_case(make_case(tmp_path / "case", "viscosity"))
    assert case.recordings is not None
    count = len(case.recordings)
    conditions = {
        "pressure_MPa": np.linspace(0.1, 500.0, count),
        "temperature_C": np.linspace(40.0, 40.0 + span, count),
    }
    forward = Forward(case, Table({**case.recordings.columns, **conditions}, "recordings.csv"))
    assert ("temperature_C" in [axis.name for axis in coordinates(forward).axes]) is counts
    assert ("viscosity_temperature_law" in [e.id for e in forward.effects()]) is counts
