"""One wild sample in a recording is named with channel, place and size; recordings without one say nothing."""

import numpy as np
import pytest

from mixedlub.cli import main
from mixedlub.commands.new import evaluation_files
from mixedlub.evaluate import evaluate
from mixedlub.evaluate.outlying import check_lines, check_turns
from mixedlub.schema.findings import collected


def outlying(name, folder, file="", column="", row=0, change=float):
    """Texts on outlying samples of a template one cell of which is changed."""
    for one, text in evaluation_files(name).items():
        lines = text.splitlines()
        if one == file:
            cells = lines[row].split(",")
            number = lines[0].split(",").index(column)
            cells[number] = f"{change(float(cells[number])):.9g}"
            lines[row] = ",".join(cells)
        (folder / one).write_text("\n".join(lines) + "\n")
    with collected() as found:
        evaluate(name, folder / f"{name}.toml")
    return [str(one) for one in found if one.code == "sample_outlying"]


WILD = [
    ("off-line", "recording.csv", "off_line_displacement_um", 1000, lambda v: v + 40.0, "row 1000, "),
    ("off-line", "recording.csv", "off_line_displacement_um", 20, lambda v: v - 40.0, "row 20, "),
    ("strain-gauge", "recording.csv", None, 720, lambda v: v + 300.0, "row 720, "),
    ("calorimetric", "readings.csv", "oil_flow_L_min", 15, lambda v: 2.0 * v, "run 15 ("),
    ("two-disc", "readings.csv", "friction_torque_Nm", 4, lambda v: 3.0 * v, "run 4 ("),
]


@pytest.mark.parametrize(("name", "file", "column", "row", "change", "said"), WILD)
def test_one_wild_sample_is_named_alone(tmp_path, name, file, column, row, change, said):
    column = column or evaluation_files(name)[file].splitlines()[0].split(",")[-1]
    (text,) = outlying(name, tmp_path, file, column, row, change)
    assert said in text
    assert text.endswith(" robust standard deviations from the others; it is used as it is")


@pytest.mark.parametrize("name", ["off-line", "strain-gauge", "calorimetric", "two-disc"])
def test_a_sound_recording_says_nothing(tmp_path, name):
    assert outlying(name, tmp_path) == []


def test_the_command_prints_it_as_a_caution(tmp_path, capsys):
    outlying("off-line", tmp_path, "recording.csv", "off_line_displacement_um", 1000, lambda v: v + 40.0)
    assert main(["evaluate", "off-line", str(tmp_path / "off-line.toml"), "--out", str(tmp_path / "o")]) == 0
    assert "caution: recording.csv, off_line_displacement_um: row 1000, revolution" in capsys.readouterr().err


def turns(seed, count):
    """Noise of one unit about a signal with a jump, sampled at angles of their own in each turn."""
    random = np.random.default_rng(seed)
    turn = np.repeat(np.arange(count), 400)
    angle = np.concatenate([0.9 * (np.arange(400) + random.uniform(0.0, 1.0)) for _ in range(count)])
    signal = np.where(angle > 100.0, 60.0, -60.0) + 30.0 * np.sin(np.radians(3.0 * angle))
    return turn, angle, signal + random.standard_normal(turn.size)


def test_the_size_is_that_of_the_deviation_over_the_scatter():
    turn, angle, signal = turns(0, 8)
    signal[1234] += 25.0
    with collected() as found:
        check_turns(turn, angle, {"x": signal}, "t.csv")
    (text,) = map(str, found)
    assert text.startswith("t.csv, x: row 1235, revolution 3 at ")
    assert float(text.split(") is ")[1].split()[0]) == pytest.approx(25.0, abs=4.0)


@pytest.mark.parametrize("place", [0, 1, 198, 199])
def test_the_ends_of_a_turn_are_looked_at(place):
    angle = np.tile(1.8 * np.arange(200), 5)
    signal = 50.0 * np.cos(np.radians(angle)) + np.random.default_rng(1).standard_normal(angle.size)
    signal[400 + place] += 60.0
    with collected() as found:
        check_turns(np.repeat(np.arange(5), 200), angle, {"x": signal}, "t.csv")
    (text,) = map(str, found)
    assert f"row {401 + place}, revolution 2 at {1.8 * place:.4g} deg" in text


def test_noise_at_some_angles_alone_is_no_outlier():
    """Fifteen times as much within 30 degrees as elsewhere; what is far off is named there too."""
    random = np.random.default_rng(3)
    for count in (2, 3, 6):
        angle = np.tile(0.9 * np.arange(400), count)
        noise = np.where((angle > 120.0) & (angle < 150.0), 3.0, 0.2) * random.standard_normal(angle.size)
        signal = 60.0 * np.sin(np.radians(angle)) + noise
        with collected() as sound:
            check_turns(np.repeat(np.arange(count), 400), angle, {"x": signal}, "t.csv")
        assert not sound
        signal[150] += 150.0
        with collected() as found:
            check_turns(np.repeat(np.arange(count), 400), angle, {"x": signal}, "t.csv")
        assert "row 151, revolution 0 at 135 deg" in str(found[0])


def series_of_loads(seed, loads, idle):
    """Losses of six series with the errors that an evaluation states; the first may have a stage without load."""
    random, product, loss, series = np.random.default_rng(seed), [], [], []
    for number in range(6):
        x = np.arange(0.0 if idle else 1.0, loads + 1.0)
        friction = 1.5 * np.maximum(x, 0.1) ** (0.03 * random.standard_normal())
        product.append(x)
        loss.append((2.0 + friction * x) * (1.0 + 3e-3 * random.standard_normal(x.size)))
        series.append(np.full(x.size, number))
    return tuple(map(np.concatenate, (product, loss, series)))


@pytest.mark.parametrize("loads", [4, 5])
@pytest.mark.parametrize("idle", [False, True])
def test_the_wild_reading_of_a_short_series_is_the_one_named(loads, idle):
    for seed in range(20):
        x, y, series = series_of_loads(seed, loads, idle)
        run = 1 + np.arange(x.size)
        with collected() as sound:
            check_lines(x, y, series, run, "loss", exponent=0.03)
        assert not sound
        for place in np.flatnonzero(series == 0):
            with collected() as found:
                check_lines(x, np.where(run == run[place], 1.5 * y, y), series, run, "loss", exponent=0.03)
            assert [str(one).split(" (")[0] for one in found] == [f"loss: run {run[place]}"]


def test_a_jump_or_normal_scatter_is_no_outlier_in_200_recordings():
    with collected() as found:
        for seed in range(200):
            check_turns(*turns(seed, 2 + seed % 5)[:2], {"x": turns(seed, 2 + seed % 5)[2]}, "t.csv")
    assert len(found) <= 1, found[:3]


@pytest.mark.parametrize("alike", [True, False])
def test_a_jump_anywhere_in_quiet_turns_is_no_outlier(alike):
    """Turns sampled at the same angles, or each at its own: also where the jump is within the first or last step."""
    for seed in range(100):
        random = np.random.default_rng(seed)
        count, jump = 2 + seed % 5, random.uniform(0.0, 36.0)
        begin = np.zeros(count) if alike else random.uniform(0.0, 0.9, count)
        angle = (begin[:, None] + 0.9 * np.arange(40)).ravel()
        signal = np.where(angle > jump, -60.0, 60.0) + 5.0 * np.sin(np.radians(10.0 * angle))
        with collected() as found:
            check_turns(np.repeat(np.arange(count), 40), angle, {"x": signal}, "t.csv")
        assert not found, str(found[0])
