"""Findings reach Python: all of them with the result, cautions and doubts once as warnings at the line of the call."""

import warnings

import numpy as np
import pytest

import mixedlub as ml
import profiles
from mixedlub.study import read_study, run_study

PAIR = ml.gear_pair(teeth=(17, 26), normal_module_mm=4.0, face_width_mm=14.0)
OIL = ml.oil("mineral")
ROUGH = ml.surface(m0_um2=0.137, m2=0.0031, m4_per_um2=0.0021)
FINE = ml.surface(m0_um2=4e-4, m2=2e-4, m4_per_um2=4e-4)
CONDITION = {"torque_Nm": 100.0, "speed_rpm": 3000.0, "oil_temperature_C": 40.0}
DRIVE = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm"}}
ROWS = {"speed_rpm": [100.0, 200.0, 300.0], "friction_torque_Nm": [0.51, 0.62, 0.69]}


def warned(call) -> tuple[object, list[str]]:
    """What a call returns, and the texts of its warnings, all of the one class and from this file."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = call()
    assert all(w.category is ml.CautionWarning and w.filename == __file__ for w in caught)
    return found, [str(w.message) for w in caught]


@pytest.fixture
def file(two_flanks):
    return two_flanks(torque_Nm="[50, 100]", speed_rpm="[500]", oil_temperature_C="[60]")


@pytest.mark.parametrize("call", [ml.power_loss, ml.along_path])
def test_a_caution_is_a_warning_and_stays_with_the_result(call) -> None:
    found, texts = warned(lambda: call(PAIR, OIL, ROUGH, **CONDITION | {"speed_rpm": 50.0}))
    (overloaded,) = texts
    assert overloaded.startswith("caution: of 1 conditions 1 not quantitative")
    assert found.attrs["findings"][0] == overloaded
    assert [text for text in found.attrs["findings"] if text.startswith("note: lubricant")]


def test_a_doubt_comes_first() -> None:
    found, texts = warned(lambda: ml.power_loss(PAIR, OIL, ROUGH, **CONDITION | {"torque_Nm": 15000.0}))
    assert texts[0].startswith("doubt: of 1 conditions 1 impossible")
    assert "17640 MPa" in texts[0]
    assert found.attrs["findings"][: len(texts)] == texts


def test_notes_alone_do_not_warn() -> None:
    found, texts = warned(lambda: ml.power_loss(PAIR, OIL, FINE, **CONDITION))
    assert texts == []
    assert [text.partition(":")[0] for text in found.attrs["findings"]] == ["note"]


def test_a_study_warns_once_when_it_runs(file) -> None:
    results, texts = warned(lambda: ml.study.run(file))
    assert len(texts) == 1
    data, again = warned(results.to_xarray)
    assert again == []
    assert data.attrs["findings"][0] == texts[0]
    assert [one.code for one in results.findings] == [
        *("asperities_overloaded", "asperities_above_hardness"),
        *("oil_typical", "boundary_friction_assumed"),
    ]


def test_the_engine_of_the_command_does_not_warn(file) -> None:
    assert warned(lambda: run_study(read_study(file)))[1] == []


def test_a_simulation_carries_its_notes() -> None:
    case = ml.case.case_of(DRIVE, ROWS)
    named = ml.case.case_of(DRIVE | {"effects": {"zero_drift": {}}}, ROWS | {"sequence": [0.0, 0.5, 1.0]})
    assert warned(lambda: ml.simulate(case))[0].attrs["findings"] == []
    found, texts = warned(lambda: ml.simulate(named, at={"speed_rpm": [150.0]}))
    assert texts == []
    assert found.attrs["findings"] == [
        "note: conditions: no column sequence: predicted for the end of the test programme"
    ]


def test_a_doubtful_trace_warns_where_its_moments_are_taken() -> None:
    quantised = profiles.Profile(1e-6 * np.round(2.0 * np.sin(0.05 * np.arange(8000.0))), 0.5e-6, name="coarse")
    _, texts = warned(lambda: ml.surface(quantised, cutoff_mm=0.8))
    assert texts
    assert all("surfaces.coarse" in text for text in texts)


def test_a_profile_is_the_surface_of_its_file(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    heights = np.random.default_rng(1).normal(scale=0.2, size=4000)
    np.savetxt(
        "flank.txt", np.column_stack([0.0005 * np.arange(4000), heights]), fmt="%.9g", header="mm um", comments="# "
    )
    keys = {"cutoff_mm": 0.25, "short_cutoff_um": 2.5, "outliers": 8.0}
    read = profiles.read("flank.txt", unit="mm, um")
    one = ml.power_loss(PAIR, OIL, ml.surface(read, **keys), **CONDITION)
    other = ml.power_loss(PAIR, OIL, ml.surface("flank.txt", unit="mm, um", **keys), **CONDITION)
    assert float(one["power_loss_W"]) == pytest.approx(float(other["power_loss_W"]), rel=1e-9)
    assert float(one["composite_roughness_um"]) == pytest.approx(float(other["composite_roughness_um"]), rel=1e-9)
