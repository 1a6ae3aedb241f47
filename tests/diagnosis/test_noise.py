"""The scatter of a reading where nobody states it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from mixedlub.case.folder import Case, read_case
from mixedlub.case.forward import Forward
from mixedlub.data_checks.audit import audit
from mixedlub.diagnosis.assessment.prediction import _noise_at
from mixedlub.diagnosis.problem import Problem
from mixedlub.recording.noise import noise, noise_from_repeats, pooled_sd
from mixedlub.schema.findings import codes
from mixedlub.schema.table import Table


def repeated(folder: Path, scatter: float, columns: dict[str, Callable[[int], object]] | None = None) -> Case:
    """The case with each of its first six readings taken five times, ``scatter`` apart (relative), noise not stated."""
    path, extra = folder / "recordings.csv", columns or {}
    lines = [line.split(",") for line in path.read_text(encoding="utf-8").splitlines()]
    rng = np.random.default_rng(3)
    rows = [[*lines[0], *extra]]
    for i in range(30):
        cells = lines[1 + i % 6]
        reading = float(cells[-1]) * np.exp(scatter * rng.standard_normal())
        rows.append([str(i + 1), *cells[1:-1], f"{reading:.9g}", *(str(make(i)) for make in extra.values())])
    path.write_text("\n".join(",".join(row) for row in rows) + "\n", encoding="utf-8")
    system = folder / "system.toml"
    kept = [line for line in system.read_text(encoding="utf-8").splitlines() if not line.startswith("noise")]
    kept += [f'check = "{name}"' for name in extra if name == "coverage"]
    system.write_text("\n".join(kept) + "\n", encoding="utf-8")
    return read_case(folder)


def seen(case: Case) -> np.ndarray:
    """The readings as they are compared."""
    assert case.recordings is not None
    y = np.asarray(case.recordings[case.quantity], dtype=float)
    return np.log(y) if case.kind.logarithmic else y


def test_repeats_count_where_readings_are_compared_by_the_logarithm(
    make_case: Callable[..., Path], tmp_path: Path
) -> None:
    case = repeated(make_case(tmp_path / "case", "viscosity"), 0.03)
    assert noise_from_repeats(case, seen(case)) == pytest.approx(0.03, rel=0.35)


def test_a_second_channel_does_not_hide_repeats(make_case: Callable[..., Path], tmp_path: Path) -> None:
    folder = make_case(tmp_path / "case", "disc")
    plain = repeated(make_case(tmp_path / "plain", "disc"), 0.03)
    case = repeated(folder, 0.03, {"coverage": lambda i: 10.0 + i})
    expected = noise_from_repeats(plain, seen(plain))
    assert expected > 0
    assert noise_from_repeats(case, seen(case)) == expected


@pytest.mark.parametrize("sizes", [[2] * 12, [3] * 10, [6] * 3, [1, 2, 3, 6] * 4, [60, 60]])
@pytest.mark.parametrize("outlier", [0.0, 20.0])
def test_repeats_give_the_scatter_with_and_without_an_outlier(sizes: list[int], outlier: float) -> None:
    group = np.repeat(np.arange(len(sizes)), sizes)
    rng = np.random.default_rng(11)
    y = rng.standard_normal((400, group.size))
    y[:, -1] += outlier
    found = np.mean([pooled_sd(one, group) for one in y])
    assert found == pytest.approx(1.0, abs=0.06)


def test_a_channel_that_seldom_moves_still_scatters() -> None:
    y = np.array([5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.2, 5.0])
    assert pooled_sd(y, np.zeros(8, int)) == pytest.approx(np.std(y, ddof=1))


@pytest.mark.parametrize("kind", ["disc", "viscosity"])
def test_the_source_of_the_noise_is_said(make_case: Callable[..., Path], tmp_path: Path, kind: str) -> None:
    case = repeated(make_case(tmp_path / "case", kind), 0.03)
    assert case.recordings is not None
    y = np.asarray(case.recordings[case.quantity], dtype=float)
    notes = audit(case, case.recordings, y, Forward(case, case.recordings))
    assert any(note.code == "noise_estimated" and "repeats" in note.text for note in notes)


def test_a_stated_noise_of_zero_is_none(make_case: Callable[..., Path], tmp_path: Path) -> None:
    folder = make_case(tmp_path / "case", "gear_pair")
    path = folder / "system.toml"
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("relative = 0.01, absolute = 0.3", "relative = 0.0, absolute = 0.0"), encoding="utf-8")
    case = read_case(folder)
    assert case.recordings is not None
    y = np.asarray(case.recordings[case.quantity], dtype=float)
    notes = audit(case, case.recordings, y, Forward(case, case.recordings))
    assert any(note.code == "noise_estimated" and "the fit" in note.text for note in notes)


def with_stated(folder: Path, sd: np.ndarray) -> Case:
    """The first readings of a case with an sd column."""
    path = folder / "recordings.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    name = lines[0].split(",")[-1]
    rows = [f"{lines[0]},{name}_sd", *(f"{line},{s:.9g}" for line, s in zip(lines[1:], sd, strict=False))]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return read_case(folder)


def taken(case: Case) -> np.ndarray:
    assert case.recordings is not None
    y = np.asarray(case.recordings[case.quantity], dtype=float)
    return noise(case, case.recordings, y)[0]


def test_a_smooth_column_of_sds_stays_as_stated(make_case: Callable[..., Path], tmp_path: Path) -> None:
    stated = np.full(20, 0.8)
    case = with_stated(make_case(tmp_path / "case", "gear_pair"), stated)
    assert taken(case) == pytest.approx(stated, rel=1e-9)


def test_sds_in_proportion_to_the_reading_stay_as_stated(make_case: Callable[..., Path], tmp_path: Path) -> None:
    folder = make_case(tmp_path / "case", "gear_pair")
    y = np.array([float(line.split(",")[-1]) for line in (folder / "recordings.csv").read_text().splitlines()[1:]])
    case = with_stated(folder, 0.02 * y)
    assert taken(case) == pytest.approx(0.02 * y, rel=1e-6)


def test_sds_of_three_tests_come_nearer_to_the_true_one(make_case: Callable[..., Path], tmp_path: Path) -> None:
    folder = make_case(tmp_path / "case", "gear_pair")
    count = len((folder / "recordings.csv").read_text().splitlines()) - 1
    drawn = np.random.default_rng(4).standard_normal((count, 3)).std(axis=1, ddof=1)
    found = taken(with_stated(folder, drawn))
    assert found.min() > 1.5 * drawn.min()
    assert np.mean(np.log(found) ** 2) < 0.5 * np.mean(np.log(drawn) ** 2)


def test_sds_that_are_left_out_or_zero_are_those_of_the_others(make_case: Callable[..., Path], tmp_path: Path) -> None:
    folder = make_case(tmp_path / "case", "gear_pair")
    path = folder / "recordings.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    cells = ["0.8", "0", "", "nan", "0.8"] * len(lines)
    rows = [f"{lines[0]},{lines[0].split(',')[-1]}_sd", *(f"{a},{b}" for a, b in zip(lines[1:], cells, strict=False))]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    case = read_case(folder)
    assert taken(case) == pytest.approx(0.8, rel=1e-9)
    assert any(note.code == "sd_filled" and "run 2, 3, 4, 7, 8 and" in note.text for note in case.notes)


def test_a_column_of_sds_that_says_nothing_is_none(make_case: Callable[..., Path], tmp_path: Path) -> None:
    case = with_stated(make_case(tmp_path / "case", "gear_pair"), np.zeros(20))
    assert case.recordings is not None
    assert "power_loss_W_sd" not in case.recordings
    assert "sd_missing" in codes(case.notes)


def test_conditions_without_an_sd_of_their_own_are_predicted_all_the_same(
    make_case: Callable[..., Path], tmp_path: Path
) -> None:
    folder = make_case(tmp_path / "case", "gear_pair")
    lines = (folder / "recordings.csv").read_text(encoding="utf-8").splitlines()
    wanted = [",".join(line.split(",")[:-1]) for line in lines[:4]]
    cells = ["power_loss_W_sd", "2", "", "0"]
    text = "\n".join(f"{row},{cell}" for row, cell in zip(wanted, cells, strict=True))
    (folder / "conditions.csv").write_text(text + "\n", encoding="utf-8")
    conditions = read_case(folder).conditions
    assert conditions is not None
    assert conditions["power_loss_W_sd"].tolist() == [2.0, 2.0, 2.0]


@pytest.mark.parametrize("kind", ["gear_pair", "viscosity"])
def test_conditions_without_an_sd_have_that_of_their_level(
    make_case: Callable[..., Path], tmp_path: Path, kind: str
) -> None:
    """The median of the column is 3.9 times that of the smallest loss and 0.27 times that of the largest."""
    folder = make_case(tmp_path / "case", kind)
    y = np.array([float(line.split(",")[-1]) for line in (folder / "recordings.csv").read_text().splitlines()[1:]])
    least = 0.02 * float(y.min())
    case = with_stated(folder, np.hypot(0.02 * y, least))
    assert case.recordings is not None
    problem = Problem.of(case)
    wanted = Table({n: c for n, c in case.recordings.columns.items() if not n.endswith("_sd")}, "conditions.csv")
    found, _ = _noise_at(problem, wanted, problem.y)
    expected = np.hypot(0.02 * y, least) / problem.d_inverse(problem.y)
    assert found == pytest.approx(expected, rel=0.1)
