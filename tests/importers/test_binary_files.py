"""Files of measurement programs: .tdms, .mf4 and .mat as tables with headers, units and clocks."""

import importlib.util
import io

import numpy as np
import pytest
from scipy.io import savemat

from mixedlub.case.folder import read_case
from mixedlub.importers import import_files
from mixedlub.importers.input_file import open_file
from profiles.errors import InputError

DRIVE = {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}
TIME = np.arange(40) * 0.5
SPEED = 100.0 + 10.0 * np.arange(40)
TORQUE = 0.5 + 1e-3 * SPEED


def needs(package):
    return pytest.mark.skipif(importlib.util.find_spec(package) is None, reason=f"needs {package}")


def tdms(path, channels):
    from nptdms import ChannelObject, TdmsWriter

    with TdmsWriter(path) as writer:
        writer.write_segment([ChannelObject(group, name, values, facts) for group, name, values, facts in channels])
    return path


def mf4(path, *groups):
    from asammdf import MDF, Signal

    with MDF(version="4.10") as file:
        for clock, signals in groups:
            file.append([Signal(values, clock, name=name, unit=unit) for name, unit, values in signals])
        file.save(path, overwrite=True)
    return path


def cells(path, **answers):
    return open_file(path, answers).table().cells


@needs("nptdms")
def test_a_tdms_file_is_a_table_with_units_and_the_time_of_its_waveform(tmp_path):
    clock = {"wf_increment": 0.5, "wf_start_offset": 0.0}
    channels = [
        ("rig", "Motor speed", SPEED, {"unit_string": "rpm", **clock}),
        ("rig", "Friction torque", 1e3 * TORQUE, {"NI_UnitDescription": "mNm", **clock}),
    ]
    read = read_case(import_files([tdms(tmp_path / "t.tdms", channels)], tmp_path / "case", **DRIVE)).recordings
    assert np.array_equal(read["time_s"], TIME)
    assert np.array_equal(read["speed_rpm"], SPEED)
    assert np.allclose(read["friction_torque_Nm"], TORQUE, rtol=1e-12)


@needs("nptdms")
def test_times_of_day_count_from_the_first_and_texts_stay(tmp_path):
    stamps = np.datetime64("2024-05-01T10:00:00") + (1000 * TIME).astype("timedelta64[ms]")
    channels = [("rig", "Time", stamps, {}), ("rig", "Remark", ["run"] * 40, {}), ("rig", "COF", TORQUE, {})]
    found = cells(tdms(tmp_path / "t.tdms", channels))
    assert list(found) == ["Time (s)", "Remark", "COF"]
    assert np.allclose(found["Time (s)"].values, TIME, atol=1e-6)
    assert set(found["Remark"]) == {"run"}


@needs("asammdf")
def test_an_mf4_file_joins_slow_channels_to_the_fast_clock(tmp_path):
    slow = np.array([0.0, 10.0, 19.5])
    path = mf4(
        tmp_path / "t.mf4",
        (TIME, [("Motor speed", "1/min", SPEED), ("Friction torque", "Nm", TORQUE)]),
        (slow, [("Oil temperature", "degC", 40.0 + slow)]),
    )
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path)
        read = read_case(import_files([path], tmp_path / "case", **DRIVE)).recordings
    assert np.allclose(read["oil_temperature_C"], 40.0 + TIME, rtol=1e-12)
    notes = open_file(path, {}).notes
    assert "'Oil temperature (degC)' of 'group 2' interpolated at the times of 'group 1'" in notes[0].text
    assert list(cells(path, **{"import.sheet": "group 2"})) == ["Time (s)", "Oil temperature (degC)"]
    with pytest.raises(InputError, match=r"no such table in t\.mf4; nearest known: 'group 2'"):
        open_file(path, {"import.sheet": "grup 2"})


@needs("asammdf")
def test_invalid_samples_of_an_mf4_file_leave_a_gap_in_their_own_row(tmp_path):
    """Load is invalid from 1 to 3 s, speed from 6 to 8 s: at 5 s stand the load and the speed of 5 s."""
    from asammdf import MDF, Signal

    clock = np.arange(10.0)
    invalid = {"Load": (1, 2, 3), "Speed": (6, 7, 8), "Remark": (6,)}
    values = {"Load": 10 * np.arange(10), "Speed": clock, "Remark": np.array([b"run"] * 10)}
    signals = [
        Signal(values[name], clock, name=name, encoding="utf-8", invalidation_bits=np.isin(clock, rows))
        for name, rows in invalid.items()
    ]
    with MDF(version="4.10") as file:
        file.append(signals)
        file.save(tmp_path / "t.mf4", overwrite=True)
    found = cells(tmp_path / "t.mf4")
    assert np.array_equal(found["Time (s)"].values, clock)
    assert np.array_equal(np.flatnonzero(np.isnan(found["Load"].values)), [1, 2, 3])
    assert np.array_equal(np.flatnonzero(np.isnan(found["Speed"].values)), [6, 7, 8])
    assert (found["Load"].values[5], found["Speed"].values[5]) == (50.0, 5.0)
    assert [found["Remark"][row] for row in (5, 6)] == ["run", ""]


@needs("nptdms")
@pytest.mark.parametrize("kind", ["waveform", "dates"])
def test_clocks_of_groups_that_start_later_keep_their_delay(kind, tmp_path):
    """A slow group that starts 40 s after the fast one: its first temperature belongs to 40 s."""
    start, fast, slow = np.datetime64("2024-05-01T10:00:00"), np.arange(200) * 0.5, np.arange(30) * 2.0
    later = start + np.timedelta64(40, "s")
    channels = []
    for group, name, since, times in (("fast", "Speed", start, fast), ("slow", "Temperature", later, slow)):
        facts = {"wf_start_time": since, "wf_increment": times[1], "wf_start_offset": 0.0}
        if kind == "dates":
            channels.append((group, "Time", since + (1000 * times).astype("timedelta64[ms]"), {}))
        channels.append((group, name, times, facts if kind == "waveform" else {}))
    found = cells(tdms(tmp_path / "t.tdms", channels))
    assert (found["Time (s)"].values[0], found["Time (s)"].values[-1]) == pytest.approx((40.0, 98.0))
    assert np.allclose(found["Temperature"].values, found["Time (s)"].values - 40.0, atol=1e-6)


def test_a_single_signal_of_a_structure_with_time_keeps_its_label(tmp_path):
    log = {"time": TIME, "signals": {"values": SPEED, "dimensions": 1.0, "label": "Speed_rpm"}}
    savemat(tmp_path / "t.mat", {"log": log}, oned_as="column")
    found = cells(tmp_path / "t.mat")
    assert list(found) == ["time", "Speed_rpm"]
    assert np.array_equal(found["Speed_rpm"].values, SPEED)


FORMS = {
    "vectors": {"time_s": TIME, "speed_rpm": SPEED, "friction_torque_Nm": TORQUE, "Ts": 0.5},
    "struct": {"rig": {"Time": TIME, "Speed": SPEED, "M": TORQUE, "units": {"Time": "s", "Speed": "rpm", "M": "Nm"}}},
    "matrix": {
        "data": np.c_[TIME, SPEED, TORQUE],
        "names": np.array(["Time", "Speed", "M"], dtype=object),
        "units": np.array(["s", "rpm", "Nm"], dtype=object),
    },
    "structure with time": {
        "log": {
            "time": TIME,
            "signals": [{"values": SPEED, "label": "Speed_rpm"}, {"values": TORQUE, "label": "M_Nm"}],
        }
    },
    "signals": {
        "speed": {"time": TIME, "data": SPEED, "unit": "rpm"},
        "M": {"time": TIME, "data": TORQUE, "unit": "Nm"},
    },
}


@pytest.mark.parametrize("form", FORMS)
def test_a_mat_file_is_read_in_its_usual_forms(form, tmp_path):
    savemat(tmp_path / "t.mat", FORMS[form], oned_as="column")
    found = cells(tmp_path / "t.mat")
    assert len(found) == 3
    torque = next(h for h in found if h[0] in "Mf")
    told = {**DRIVE, "import.columns.friction_torque_Nm": torque}
    told |= {"import.units.time_s": "s"} if form == "structure with time" else {}
    read = read_case(import_files([tmp_path / "t.mat"], tmp_path / "case", **told)).recordings
    assert np.array_equal(read["time_s"], TIME)
    assert np.array_equal(read["speed_rpm"], SPEED)
    assert np.array_equal(read["friction_torque_Nm"], TORQUE)


@pytest.mark.parametrize(
    ("data", "rule"),
    [
        (b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM", "version 7.3"),
        (
            b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + b"\x0e\x00\x00\x00\xff",
            "damaged MATLAB file|cannot be read",
        ),
        (b"TDSm" + b"\x0e\x00\x00\x00" + b"\xff" * 40, "holds no channel of numbers"),
        (b"MDF     4.10    " + b"\x00" * 80, "damaged MDF file"),
    ],
)
def test_a_damaged_file_is_refused_by_name(data, rule, tmp_path):
    for package, magic in (("nptdms", b"TDSm"), ("asammdf", b"MDF ")):
        if data.startswith(magic) and importlib.util.find_spec(package) is None:
            pytest.skip(f"needs {package}")
    (tmp_path / "t.bin").write_bytes(data)
    with pytest.raises(InputError, match=rule):
        open_file(tmp_path / "t.bin", {})


def test_a_file_of_scalars_holds_no_table(tmp_path):
    file = io.BytesIO()
    savemat(file, {"Ts": 0.5})
    (tmp_path / "t.mat").write_bytes(file.getvalue())
    with pytest.raises(InputError, match="holds no channel of numbers"):
        open_file(tmp_path / "t.mat", {})
