"""One wild sample in a recording is named with channel, place and size; recordings without one say nothing."""

import numpy as np
import pytest

from mixedlub.cli import main
from mixedlub.commands.new import evaluation_files
from mixedlub.evaluate import evaluate
from mixedlub.evaluate.outlying import check_turns
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
    ("off-line", "recording.csv", "off_line_displacement_um", 1000, lambda v: v + 40.0, "(row 1000)"),
    ("off-line", "recording.csv", "off_line_displacement_um", 20, lambda v: v - 40.0, "(row 20)"),
    ("strain-gauge", "recording.csv", None, 720, lambda v: v + 300.0, "(row 720)"),
    ("calorimetric", "readings.csv", "oil_flow_L_min", 15, lambda v: 2.0 * v, "run 15 with"),
    ("two-disc", "readings.csv", "friction_torque_Nm", 4, lambda v: 3.0 * v, "run 4 with"),
]


@pytest.mark.parametrize(("name", "file", "column", "row", "change", "said"), WILD)
def test_one_wild_sample_is_named_alone(tmp_path, name, file, column, row, change, said):
    column = column or evaluation_files(name)[file].splitlines()[0].split(",")[-1]
    (text,) = outlying(name, tmp_path, file, column, row, change)
    assert said in text
    assert "robust standard deviations" in text
    assert ";" not in text.split("deviations: ")[1].replace("; it is used as it is", "")


@pytest.mark.parametrize("name", ["off-line", "strain-gauge", "calorimetric", "two-disc"])
def test_a_sound_recording_says_nothing(tmp_path, name):
    assert outlying(name, tmp_path) == []


def test_the_command_prints_it_as_a_caution(tmp_path, capsys):
    outlying("off-line", tmp_path, "recording.csv", "off_line_displacement_um", 1000, lambda v: v + 40.0)
    assert main(["evaluate", "off-line", str(tmp_path / "off-line.toml"), "--out", str(tmp_path / "o")]) == 0
    assert "caution: recording.csv, off_line_displacement_um: far from the others" in capsys.readouterr().err


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
    assert text.startswith("t.csv, x: far from the others")
    size = float(text.split("): ")[-1].split(" with ")[-1].split(": ")[-1].split(";")[0])
    assert size == pytest.approx(25.0, abs=4.0)


def test_a_jump_or_normal_scatter_is_no_outlier_in_200_recordings():
    with collected() as found:
        for seed in range(200):
            check_turns(*turns(seed, 2 + seed % 5)[:2], {"x": turns(seed, 2 + seed % 5)[2]}, "t.csv")
    assert len(found) <= 1, found[:3]
