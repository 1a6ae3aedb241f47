"""A look at the recording: which repeated values are odd, and which are not."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mixedlub.case.folder import Case, read_case
from mixedlub.case.forward import Forward
from mixedlub.data_checks.audit import check_readings
from mixedlub.data_checks.misread import misread
from mixedlub.gear import RigidSharing, at_roll_angle
from mixedlub.gear.build import gear_pair
from mixedlub.importers import write_case
from mixedlub.rig.plausibility import implausible
from mixedlub.schema.findings import Finding, Severity, codes
from mixedlub.schema.table import Table
from profiles.errors import InputError

Change = Callable[[np.ndarray], np.ndarray]


@pytest.fixture
def case(make_case: Callable[..., Path], tmp_path: Path) -> Case:
    """A disc rig: 72 readings at differing conditions."""
    return read_case(make_case(tmp_path / "case", "disc"))


def told(case: Case, change: Change) -> list[Finding]:
    """What is said of the readings after a change."""
    assert case.recordings is not None
    y = change(np.array(case.recordings[case.quantity], dtype=float))
    return check_readings(case, case.recordings, y, Forward(case, case.recordings))


def with_rows(case: Case, rows: Table, y: np.ndarray) -> list[Finding]:
    """The findings where other rows were recorded."""
    return check_readings(replace(case, recordings=rows), rows, y, Forward(case, rows))


def first(count: int, value: float = 0.0333) -> Change:
    """The first readings replaced by one value."""
    return lambda y: np.where(np.arange(y.size) < count, value, y)


def test_a_sound_recording_raises_no_doubt(case: Case) -> None:
    assert told(case, lambda y: y) == []


@pytest.mark.parametrize(
    ("includes", "known", "named"),
    [
        ("mesh, Bearings and shaft seals", {}, "bearings, seals"),
        ("mesh, bearings and shaft seals", {"bearing_drag": {}}, "seals"),
        ("the mesh alone", {}, ""),
        ("mesh; bearing and seal losses subtracted", {}, ""),
    ],
)
def test_losses_that_the_reading_includes_and_nothing_models_are_told(
    make_case: Callable[..., Path], tmp_path: Path, includes: str, known: dict, named: str
) -> None:
    gears = read_case(make_case(tmp_path / "case", "gear_pair"))
    recording = gears.system.recording.model_copy(update={"includes": includes})
    system = gears.system.model_copy(update={"recording": recording, "effects": known})
    notes = told(replace(gears, system=system), lambda y: y)
    assert [f"includes {named}, which" in note.text for note in notes if note.code == "losses_unmodelled"] == (
        [True] if named else []
    )


def test_a_value_in_a_fifth_of_the_rows_is_named_with_its_runs(case: Case) -> None:
    (note,) = told(case, first(15))
    assert note.code == "channel_stuck"
    assert "15 of 72 readings are exactly 0.0333" in note.text
    assert "(runs 1, 2, 3, 4, 5 and 10 more)" in note.text


def test_readings_of_exactly_zero_among_others_far_from_it_are_named_with_their_runs(case: Case) -> None:
    (note,) = told(case, first(2, 0.0))
    assert (note.code, note.place) == ("readings_zero", "friction_coefficient")
    assert note.text.startswith("2 of 72 readings are exactly zero where nearly all others are 0.0")
    assert "(runs 1, 2)" in note.text
    assert told(case, first(2, 1e-4)) == []


@pytest.mark.parametrize(
    "near_zero",
    [
        pytest.param(lambda y: y * np.linspace(0.0, 1.0, y.size), id="readings that grow from zero"),
        pytest.param(lambda y: np.round(y * 20.0) / 20.0, id="steps as large as the readings"),
    ],
)
def test_zeros_that_other_readings_come_near_are_not_placeholders(case: Case, near_zero: Change) -> None:
    found = told(case, lambda y: np.where(np.arange(y.size) < 1, 0.0, near_zero(y)))
    assert "readings_zero" not in codes(found)


def test_a_value_in_fewer_rows_is_not(case: Case) -> None:
    assert told(case, first(14)) == []


def test_readings_that_repeat_because_the_channel_is_coarse_are_not_stuck(case: Case) -> None:
    """Two decimals: a value in more than a fifth of the rows, each the nearest step to what was there."""
    rounded: list[int] = []

    def coarse(y: np.ndarray) -> np.ndarray:
        y = np.round(y, 2)
        rounded.append(int(np.unique(y, return_counts=True)[1].max()))
        return y

    assert told(case, coarse) == []
    assert rounded[0] >= 15


def test_equal_readings_at_equal_conditions_are_not_stuck(case: Case) -> None:
    assert case.recordings is not None
    again = case.recordings.take(np.array([*([0] * 20), *range(20, 72)]))
    y = np.array(again[case.quantity], dtype=float)
    assert with_rows(case, again, y) == []
    assert codes(told(case, first(20, y[0]))) == ["channel_stuck"]


def test_equal_readings_where_the_model_gives_equal_ones_are_not_stuck(case: Case) -> None:
    """A rig whose coefficient hardly changes with load: readings agree to the last digit, as the model's do."""

    class Level(Forward):
        def predict(self, *values: object) -> np.ndarray:
            return super().predict()[:1] * np.where(np.arange(72) < 15, 1.0 + 0.04 * np.linspace(0, 1, 72), 1.5)

    assert case.recordings is not None
    y = first(15)(np.array(case.recordings[case.quantity], dtype=float))
    assert check_readings(case, case.recordings, y, Level(case, case.recordings)) == []


def test_readings_in_percent_are_asked_about(case: Case) -> None:
    (note,) = told(case, lambda y: 100.0 * y)
    assert note.code == "readings_in_other_unit"
    assert "a hundred times" in note.text


def test_slide_roll_ratios_in_percent_are_asked_about(case: Case) -> None:
    rows = case.recordings
    assert rows is not None
    rows = Table({**rows.columns, "slide_roll_ratio": 100.0 * rows["slide_roll_ratio"]})
    notes = with_rows(case, rows, np.array(rows[case.quantity], dtype=float))
    assert "slide_roll_ratio_in_percent" in codes(notes)


@pytest.mark.parametrize("factor", [0.6e-3, 1.0e-3, 1.7e-3])
def test_a_slip_of_the_unit_shows_though_the_model_is_off(case: Case, factor: float) -> None:
    (note,) = told(case, lambda y: factor * y)
    assert note.code == "readings_in_other_unit"
    assert "a thousandth of" in note.text


@pytest.mark.parametrize("factor", [0.2, 0.05, 20.0])
def test_a_model_that_is_off_by_more_is_no_slip_of_the_unit(case: Case, factor: float) -> None:
    assert told(case, lambda y: factor * y) == []


def one(run: int, change: Change) -> Change:
    """One reading changed."""
    return lambda y: np.where(np.arange(y.size) == run - 1, change(y), y)


@pytest.mark.parametrize("factor", [100.0, 1000.0, -1000.0, 1e6])
def test_a_single_reading_far_beyond_the_others_is_asked_about(case: Case, factor: float) -> None:
    (note,) = told(case, one(7, lambda y: factor * y))
    assert (note.code, note.place) == ("reading_too_large", "run 7")


def test_a_wrong_reading_among_many_at_few_conditions_is_found(case: Case) -> None:
    """Held levels: ten thousand readings at each of three conditions, one with its decimal point off."""
    assert case.recordings is not None
    rows = case.recordings.take(np.repeat([0, 30, 60], 10_000))
    rows = Table({**rows.columns, "run": np.arange(1, 30_001)})
    y = np.asarray(rows[case.quantity], dtype=float) * (1.0 + 0.01 * np.sin(np.arange(30_000)))
    y[15_000] *= 10.0
    (found,) = misread(case, rows, y, Forward(case, rows), np.zeros(y.size, dtype=bool))
    assert (found.code, found.place) == ("reading_too_large", "run 15001")


@pytest.mark.parametrize("factor", [0.1, 0.3, 3.0, 8.0])
def test_a_misshapen_outlier_is_no_slip(case: Case, factor: float) -> None:
    assert told(case, one(7, lambda y: factor * y)) == []


def test_a_single_reading_of_the_wrong_sign_is_asked_about(case: Case) -> None:
    (note,) = told(case, one(7, lambda y: -y))
    assert (note.code, note.place) == ("reading_negative", "run 7")


def test_readings_a_little_below_zero_are_not_asked_about(case: Case) -> None:
    assert told(case, one(7, lambda y: -0.1 * y)) == []


def test_many_negative_readings_are_physics_or_an_offset_and_no_slip(case: Case) -> None:
    assert "reading_negative" not in codes(told(case, lambda y: np.where(np.arange(y.size) < 20, -y, y)))


def test_a_friction_map_reads_either_sign(tmp_path: Path) -> None:
    speed = np.concatenate([np.arange(-40.0, 0.0), np.arange(1.0, 41.0)])
    system = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm"}}
    columns = {"speed_rpm": speed, "friction_torque_Nm": 2.0 * np.sign(speed) + 0.05 * speed}
    drive = read_case(write_case(tmp_path / "drive", system, columns))
    assert told(drive, one(60, lambda y: -y)) == []


def test_temperatures_of_a_room_in_kelvin_are_asked_about(case: Case) -> None:
    rows = case.recordings
    assert rows is not None
    kelvin = Table({**rows.columns, "oil_temperature_C": rows["oil_temperature_C"] * 0.0 + 298.15}, rows.source)
    notes = with_rows(case, kelvin, np.array(rows[case.quantity], dtype=float))
    assert "temperature_in_kelvin" in codes(notes)


def implausible_in(folder: Path) -> list[Finding]:
    """What is implausible in a case's files beside the readings."""
    return list(implausible(read_case(folder).rig))


def test_what_is_far_off_in_the_system_stands_above_the_answer(make_case: Callable[..., Path], tmp_path: Path) -> None:
    folder = make_case(tmp_path / "case", "disc")
    assert implausible_in(folder) == []
    file = folder / "system.toml"
    text = file.read_text(encoding="utf-8")
    assert "boundary_friction = 0.1" in text
    file.write_text(text.replace("boundary_friction = 0.1", "boundary_friction = 1.0", 1), encoding="utf-8")
    (note,) = implausible_in(folder)
    assert (note.code, note.place, note.severity) == ("value_unusual", "boundary_friction", Severity.DOUBT)


@pytest.mark.parametrize(("across", "told"), [(20.0, []), (4.0, ["law_extrapolated"])])
def test_an_ellipse_beyond_the_film_law_is_told(
    across: float, told: list[str], make_case: Callable[..., Path], tmp_path: Path
) -> None:
    """Hamrock and Dowson's regression holds for k = 1.03 (R_y/R_x)^0.64 from 1 to 8."""
    folder = make_case(tmp_path / "case", "disc")
    file = folder / "system.toml"
    text = file.read_text(encoding="utf-8")
    body = f"radius_mm = [20.0, 20.0]\ntransverse_radius_mm = [{across}, {across}]\n"
    changed = re.sub(r"radius_mm = .*\n", body, text.replace('geometry = "line"', 'geometry = "point"'))
    changed = re.sub(r"width_mm = .*\n", "", changed)
    assert changed != text
    file.write_text(changed, encoding="utf-8")
    assert codes(implausible_in(folder)) == told


@pytest.mark.parametrize(("factor", "alarm"), [(0.5, True), (0.95, False)])
def test_shares_far_from_the_whole_load_question_the_answer_and_near_ones_are_noted(
    factor: float, alarm: bool, make_case: Callable[..., Path], tmp_path: Path
) -> None:
    folder = make_case(tmp_path / "case", "gear_pair")
    system = read_case(folder).system
    assert system.gears is not None
    pair = gear_pair(system.gears)
    angle = np.linspace(pair.path_start, pair.path_end, 201) / pair.base_radius[0]
    share = factor * at_roll_angle(pair, RigidSharing(), angle).load_share(100.0)
    rows = "".join(f"100,{a},{s}\n" for a, s in zip(np.degrees(angle), share, strict=True))
    (folder / "share.csv").write_text("torque_Nm,roll_angle_deg,load_share\n" + rows, encoding="utf-8")
    file = folder / "system.toml"
    text = file.read_text(encoding="utf-8")
    assert text.count('model = "rigid"') == 1
    file.write_text(text.replace('model = "rigid"', 'table = "share.csv"'), encoding="utf-8")
    (note,) = implausible_in(folder)
    assert note.code == "load_share_sum"
    assert float(note.text.split(" on average")[0].split()[-1]) == pytest.approx(factor, abs=0.005)
    assert (note.severity is Severity.DOUBT) == alarm


@pytest.mark.parametrize(("column", "told"), [(0.03, False), (1e-4, True)])
def test_repeats_are_held_against_the_sds_in_the_column(
    make_case: Callable[..., Path], tmp_path: Path, column: float, told: bool
) -> None:
    """The column of standard deviations is the noise, whatever is stated beside it."""
    case = read_case(make_case(tmp_path / "case", "disc"))
    assert case.recordings is not None
    twice = {name: np.tile(values, 2) for name, values in case.recordings.columns.items()}
    twice["run"] = np.arange(1, twice["run"].size + 1)
    twice[case.quantity] = twice[case.quantity] * (
        1.0 + 0.2 * np.random.default_rng(1).standard_normal(twice["run"].size)
    )
    rows = Table({**twice, f"{case.quantity}_sd": np.full(twice["run"].size, column)}, "recordings.csv")
    notes = with_rows(case, rows, np.asarray(rows[case.quantity]))
    assert ("repeats_contradictory" in codes(notes)) is told


def viscosities(folder: Path, **recording: object) -> list[Finding]:
    """What is said of twelve viscosities of two samples."""
    falling = np.geomspace(20.0, 5.0, 12)
    columns = {"temperature_C": np.linspace(20.0, 90.0, 12), "viscosity_mPa_s": falling, "setup": ["a", "b"] * 6}
    about = {"quantity": "viscosity_mPa_s", **recording}
    case = read_case(write_case(folder / "oil", {"kind": "viscosity", "recording": about}, columns))
    assert case.recordings is not None
    return check_readings(case, case.recordings, falling, Forward(case, case.recordings))


def test_set_ups_that_nothing_tells_apart_are_asked_about(tmp_path: Path) -> None:
    noise = {"relative": 0.01, "setup_relative": 0.02}
    assert "setups_pooled" in codes(viscosities(tmp_path))
    assert "setups_pooled" not in codes(viscosities(tmp_path, noise=noise))


def entered_again(case: Case, count: int, change: Change = lambda y: y) -> list[Finding]:
    """What is said where the first rows stand in the table again, under new run numbers and a later place."""
    assert case.recordings is not None
    again = case.recordings.take(np.array([*range(72), *range(count)]))
    order = np.arange(72 + count)
    later = Table({**again.columns, "run": order + 1, "sequence": order / order[-1]}, again.source)
    y = change(np.array(later[case.quantity], dtype=float))
    rows = Table({**later.columns, case.quantity: y}, later.source)
    return with_rows(case, rows, y)


def test_rows_that_were_entered_twice_are_counted(case: Case) -> None:
    (note,) = entered_again(case, 72)
    assert (note.code, note.severity) == ("readings_entered_twice", Severity.DOUBT)
    assert note.text.startswith("72 readings ")


def test_few_rows_again_or_coarse_readings_are_not_taken_for_a_table_entered_twice(case: Case) -> None:
    assert entered_again(case, 3) == []
    assert "readings_entered_twice" not in codes(entered_again(case, 72, lambda y: np.round(y, 2)))


@pytest.mark.parametrize("places", [3, 9])
def test_repeats_that_are_alike_by_rounding_are_not_taken_for_a_table_entered_twice(case: Case, places: int) -> None:
    """Three readings a point of 1 % scatter; rounded to a few last digits of that, and to many with rows again."""
    assert case.recordings is not None
    rows = case.recordings.take(np.tile(np.arange(72), 3))
    y = rows[case.quantity] * (1.0 + 0.01 * np.random.default_rng(1).standard_normal(216))
    y = np.round(y, places)
    pasted = np.concatenate([np.arange(216), np.arange(60 if places > 3 else 0)]).astype(int)
    order = {"run": np.arange(1, pasted.size + 1), "sequence": np.linspace(0.0, 1.0, pasted.size)}
    table = Table({**rows.take(pasted).columns, **order, case.quantity: y[pasted]}, "recordings.csv")
    notes = with_rows(case, table, y[pasted])
    assert ("readings_entered_twice" in codes(notes)) is (places > 3)


def test_readings_at_one_condition_are_refused_with_their_file(make_case: Callable[..., Path], tmp_path: Path) -> None:
    folder = make_case(tmp_path / "one", "disc")
    head, first, *rest = (folder / "recordings.csv").read_text(encoding="utf-8").splitlines()
    _, _, *conditions, _ = first.split(",")
    same = [",".join([str(i), "0.5", *conditions, row.split(",")[-1]]) for i, row in enumerate([first, *rest])]
    (folder / "recordings.csv").write_text("\n".join([head, *same]) + "\n", encoding="utf-8")
    found = read_case(folder)
    assert found.recordings is not None
    y = np.array(found.recordings[found.quantity], dtype=float)
    with pytest.raises(InputError, match="all readings were taken at the same conditions") as error:
        check_readings(found, found.recordings, y, Forward(found, found.recordings))
    assert error.value.where == str(folder / "recordings.csv")


def test_every_second_reading_in_kilowatts_is_told(offset_folder: Path) -> None:
    case = read_case(offset_folder)
    assert case.recordings is not None
    rows, y = case.recordings, np.array(case.recordings[case.quantity], dtype=float)
    y[::2] /= 1000.0
    assert "readings_in_two_units" in codes(with_rows(case, rows, y))
    few = np.array(case.recordings[case.quantity], dtype=float)
    few[3] /= 1000.0
    assert "readings_in_two_units" not in codes(with_rows(case, rows, few))


def test_losses_above_the_power_put_in_are_told(offset_folder: Path) -> None:
    case = read_case(offset_folder)
    assert case.recordings is not None
    y = np.array(case.recordings[case.quantity], dtype=float)
    light = Table({**case.recordings.columns, "torque_Nm": case.recordings["torque_Nm"] / 1000.0}, "recordings.csv")
    assert "loss_above_input_power" in codes(with_rows(case, light, y))
    sound = check_readings(case, case.recordings, y, Forward(case, case.recordings))
    assert "loss_above_input_power" not in codes(sound)


@pytest.mark.parametrize(
    ("times", "said"),
    [
        (np.arange(72.0), ""),
        (np.arange(72) // 2.0, ""),
        (np.arange(72.0) % 24, "in 2 places, first at run 25: "),
        (np.r_[0.0, 2.0, 1.0, np.arange(3.0, 72.0)], "in 1 place, first at run 3: "),
    ],
)
def test_a_time_that_runs_backwards_is_doubted(case: Case, times: np.ndarray, said: str) -> None:
    assert case.recordings is not None
    rows = Table({**case.recordings.columns, "time_s": times})
    notes = with_rows(case, rows, np.array(rows[case.quantity], dtype=float))
    found = [note for note in notes if note.code == "time_backwards"]
    assert [said in note.text for note in found] == [True] * bool(said)
