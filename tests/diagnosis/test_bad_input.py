"""Bad input gets one message that names the place, the value and the rule."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.report.files import diagnose
from profiles.errors import InputError


@pytest.fixture
def folder(make_case: Callable[..., Path], tmp_path: Path) -> Path:
    """A sound gear case to spoil."""
    return make_case(tmp_path / "case", "gear_pair")


def swap(path: Path, old: str, new: str, count: int = 1) -> None:
    """Replace a text that must be there."""
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, count), encoding="utf-8")


def spoil_cell(folder: Path, line: int, column: str, value: str) -> None:
    """Replace one cell of recordings.csv."""
    path = folder / "recordings.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    cells = lines[line].split(",")
    cells[lines[0].split(",").index(column)] = value
    lines[line] = ",".join(cells)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def refused(folder: Path, **options: Any) -> str:
    """The message with which a case is refused."""
    with pytest.raises(InputError) as caught:
        diagnose_case(folder, **options)
    return str(caught.value)


def test_missing_folder(tmp_path: Path) -> None:
    assert "no such case folder" in refused(tmp_path / "nowhere")


@pytest.mark.parametrize("name", ["system.toml", "recordings.csv"])
def test_missing_file_is_named(folder: Path, name: str) -> None:
    (folder / name).unlink()
    message = refused(folder)
    assert name in message
    assert "no such file" in message


def test_unknown_effect_to_exclude_names_the_nearest(folder: Path) -> None:
    message = refused(folder, exclude=["inlet_shear_heatin"])
    assert "inlet_shear_heatin" in message
    assert "inlet_shear_heating" in message.replace("inlet_shear_heatin:", "")


def test_all_readings_equal(folder: Path) -> None:
    path = folder / "recordings.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join([lines[0], *(r.rsplit(",", 1)[0] + ",50.0" for r in lines[1:])]), encoding="utf-8")
    assert "all readings are the same number" in refused(folder)


def test_all_conditions_equal(folder: Path) -> None:
    path = folder / "recordings.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    first = lines[1].split(",")[1:-1]
    rows = [",".join([str(run), *first, str(50.0 + run % 3)]) for run in range(1, 21)]
    path.write_text("\n".join([lines[0], *rows]), encoding="utf-8")
    assert "at the same conditions" in refused(folder)


@pytest.mark.parametrize("value", ["nan", "inf", "", "twelve"])
def test_reading_that_is_no_number(folder: Path, value: str) -> None:
    spoil_cell(folder, 5, "power_loss_W", value)
    message = refused(folder)
    assert "line 6" in message
    assert "power_loss_W" in message


def test_negative_torque(folder: Path) -> None:
    spoil_cell(folder, 3, "torque_Nm", "-50")
    message = refused(folder)
    assert "torque_Nm must be above 0" in message
    assert "line 4" in message


def test_run_given_twice(folder: Path) -> None:
    spoil_cell(folder, 3, "run", "1")
    assert "run must be unique" in refused(folder)


def test_quantity_of_another_kind(folder: Path) -> None:
    swap(folder / "system.toml", 'quantity = "power_loss_W"', 'quantity = "viscosity_mPa_s"')
    message = refused(folder)
    assert "viscosity_mPa_s" in message
    assert "power_loss_W" in message


def test_surface_that_is_not_described(folder: Path) -> None:
    spoil_cell(folder, 2, "pinion_surface", "groud")
    message = refused(folder)
    assert "groud" in message
    assert "ground" in message.replace("groud", "")


def test_key_that_is_not_known_names_the_nearest(folder: Path) -> None:
    swap(folder / "system.toml", "face_width_mm", "face_widht_mm")
    message = refused(folder)
    assert "face_widht_mm" in message
    assert "face_width_mm" in message


def test_missing_column_is_named(folder: Path) -> None:
    swap(folder / "recordings.csv", "speed_rpm", "speed")
    assert "'speed_rpm' is missing" in refused(folder)


def test_too_few_readings(folder: Path) -> None:
    path = folder / "recordings.csv"
    path.write_text("\n".join(path.read_text(encoding="utf-8").splitlines()[:4]), encoding="utf-8")
    assert "needs at least" in refused(folder)


def test_conditions_to_predict_that_are_missing(folder: Path, tmp_path: Path) -> None:
    assert "no such file" in refused(folder, predict=tmp_path / "none.csv")


def test_refused_case_writes_nothing(folder: Path, tmp_path: Path) -> None:
    (folder / "recordings.csv").unlink()
    with pytest.raises(InputError):
        diagnose(folder, tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_columns_that_are_not_known_are_ignored_with_a_warning(folder: Path, excluded: tuple[str, ...]) -> None:
    path = folder / "recordings.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    spoilt = [lines[0] + ",humidity", *(line + ",55" for line in lines[1:])]
    path.write_text("\n".join(spoilt) + "\n", encoding="utf-8")
    found = diagnose_case(folder, exclude=excluded)
    assert any(w.code == "columns_unknown" and "humidity" in w.text for w in found.warnings)
