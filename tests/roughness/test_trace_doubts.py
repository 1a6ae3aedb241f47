"""Doubts about traces, in `mixedlub profile` and in a study."""

import numpy as np
import pytest

import profiles
from mixedlub.rig.plausibility import implausible
from mixedlub.schema.findings import Severity, collected
from tests.roughness.conftest import rig_of


def test_heights_in_another_unit_than_their_heading_are_doubted_by_command_and_study(tmp_path, evaluated, capsys):
    trace = profiles.shipped("0258")
    rows = "".join(f"{x * 1e3:.6f},{z * 1e6:.5f}\n" for x, z in zip(trace.positions, trace.heights))
    (tmp_path / "mm.csv").write_text("x_mm,z_mm\n" + rows)
    evaluated(tmp_path / "mm.csv", "--cutoff-mm", "0.8")
    said = capsys.readouterr().err
    assert said.count("are the heights in um?") == 1
    assert "doubt: " in said
    rig = rig_of(tmp_path, one={"profile": "mm.csv", "cutoff_mm": 0.8, "short_cutoff_um": 2.5})
    with collected() as found:
        rig.surface("one")
    doubts = [one for one in found if one.severity is Severity.DOUBT]
    assert [(one.code, one.place) for one in doubts] == [("value_unusual", "surfaces.one")]
    assert "are the heights in um?" in doubts[0].text
    moments = [one.text for one in implausible(rig) if "as measured" in one.place]
    assert len(moments) == 3
    assert not any("nm2" in text or "1/m" in text for text in moments)


def test_a_constant_stretch_is_told_by_command_and_study(tmp_path, evaluated, capsys):
    trace = profiles.shipped("0258")
    heights = np.where((trace.positions > 3.0e-3) & (trace.positions < 3.3e-3), 0.0, trace.heights)
    rows = "".join(f"{x * 1e6:.2f},{z * 1e6:.5f}\n" for x, z in zip(trace.positions, heights))
    (tmp_path / "held.csv").write_text("x_um,z_um\n" + rows)
    row = evaluated(tmp_path / "held.csv", "--cutoff-mm", "0.8")
    said = capsys.readouterr().err
    assert "heights constant from 3 to 3.3 mm" in said
    assert "heights are heights" not in said
    assert row["gaussian"]["verdict"] == "not_gaussian"
    with collected() as found:
        rig_of(tmp_path, held={"profile": "held.csv", "cutoff_mm": 0.8, "short_cutoff_um": 2.5}).surface("held")
    assert [one.code for one in found if "heights constant from 3 to 3.3 mm" in one.text] == ["trace_quality"]


def test_one_column_of_heights_in_another_unit_than_its_heading_is_told(tmp_path):
    trace = profiles.shipped("0258")
    heights = "".join(f"{z * 1e6:.6f}\n" for z in trace.heights)
    for unit, asked in (("mm", "are the heights in um?"), ("um", "")):
        (tmp_path / "one.txt").write_text(f"spacing: 0.25 um\nunit: {unit}\n{heights}")
        assert asked in (told := str(profiles.read(tmp_path / "one.txt").origin.get("units_doubtful", "")))
        assert bool(told) == bool(asked)


@pytest.mark.parametrize(
    ("heading", "strange", "asked"),
    [
        ("x_mm,z_mm", "a typical slope of ", "are the heights in um?"),
        ("x_um,z_um", "a step of 0.00025 um", "are the positions in mm?"),
        ("x_mm,z_um", "", ""),
    ],
)
def test_a_heading_that_makes_no_trace_is_told_with_the_probable_unit(tmp_path, heading, strange, asked):
    trace = profiles.shipped("0258")
    rows = "".join(f"{x * 1e3:.6f},{z * 1e6:.5f}\n" for x, z in zip(trace.positions, trace.heights))
    (tmp_path / "two.csv").write_text(f"{heading}\n{rows}")
    told = str(profiles.read(tmp_path / "two.csv").origin.get("units_doubtful", ""))
    assert (strange in told and "by the heading" in told and asked in told) if strange else told == ""
