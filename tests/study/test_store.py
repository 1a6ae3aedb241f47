"""A run that dies loses nothing but the block in hand, and parts of another study are never taken."""

import os
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from mixedlub.study import batch, checkpoint, read_study, run_study


@pytest.fixture
def small_blocks(monkeypatch):
    monkeypatch.setattr(batch, "BLOCK_POINTS", 150)


def computed_blocks(monkeypatch):
    done = []
    compute = batch.compute
    monkeypatch.setattr(batch, "compute", lambda plan, block: done.append(block) or compute(plan, block))
    return done


def test_run_goes_on_from_what_is_kept(write_study, tmp_path, monkeypatch, small_blocks):
    study = read_study(write_study())
    whole = run_study(study)
    parts = checkpoint.parts_folder(tmp_path, study.plan)
    todo = batch.blocks(study.plan)
    for block in todo[::3]:
        checkpoint.keep(parts, block, batch.compute(study.plan, block))
    done = computed_blocks(monkeypatch)
    again = run_study(study, parts=parts, threads=1)
    assert done == [b for i, b in enumerate(todo) if i % 3]
    for name in (*batch.OUTPUTS, *batch.CHECKS):
        assert np.array_equal(whole[name], again[name]), name


def test_half_written_part_is_computed_again(write_study, tmp_path, monkeypatch, small_blocks):
    study = read_study(write_study())
    parts = checkpoint.parts_folder(tmp_path, study.plan)
    block = batch.blocks(study.plan)[0]
    checkpoint.keep(parts, block, batch.compute(study.plan, block))
    path = parts / checkpoint.block_name(block)
    path.write_bytes(path.read_bytes()[:100])
    assert list(checkpoint.kept(parts, [block])) == []


@pytest.mark.parametrize(
    "change",
    [
        {"boundary_friction": 0.11},
        {"options__averaging": "paper"},
        {"conditions__torque_Nm": [50, 151]},
        {"surfaces__mid__m2": 0.0026},
        {"effects__inlet_shear_heating": {"strength": 0.5}},
        {"lubricant__eyring_stress_MPa": 5.1},
    ],
    ids=lambda change: next(iter(change)),
)
def test_fingerprint_sees_every_input(write_study, change):
    assert checkpoint.fingerprint(read_study(write_study()).plan) != checkpoint.fingerprint(
        read_study(write_study(**change)).plan
    )


def test_fingerprint_does_not_see_words(write_study):
    plain, titled = (checkpoint.fingerprint(read_study(write_study(**c)).plan) for c in ({}, {"title": "Other"}))
    assert plain == titled


def big(write_study):
    surfaces = {f"s{i}": {"m0_um2": 0.01 + 0.003 * i, "m2": 0.0025, "m4_per_um2": 0.0036} for i in range(50)}
    return write_study(
        "big",
        surfaces=surfaces,
        options__path_points=100,
        conditions__torque_Nm={"from": 20, "to": 200, "count": 24},
        conditions__speed_rpm={"from": 300, "to": 3000, "count": 24},
        conditions__oil_temperature_C=[60],
    )


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs kill -9")
def test_killed_study_started_again_gives_the_same_table(write_study, tmp_path, monkeypatch):
    path, out = big(write_study), tmp_path / "out"
    study = read_study(path)
    command = [sys.executable, "-m", "mixedlub", "study", str(path), "--no-figures", "--out", str(out)]
    # It must not end before this test, on a busy machine, looks again.
    command = ["nice", "-n", "19", *command] if shutil.which("nice") else command
    run = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    parts = checkpoint.parts_folder(out, study.plan)
    deadline = time.monotonic() + 300
    while len(list(parts.glob("*.parquet"))) < 3 and run.poll() is None and time.monotonic() < deadline:
        time.sleep(0.005)
    os.kill(run.pid, signal.SIGKILL)
    run.wait()
    saved = {p.name for p in parts.glob("*.parquet")}
    todo = {checkpoint.block_name(b) for b in batch.blocks(study.plan)}
    assert 3 <= len(saved) < len(todo)
    assert not (out / "results.csv").exists()

    done = computed_blocks(monkeypatch)
    again = run_study(study, parts=parts)
    assert {checkpoint.block_name(b) for b in done} == todo - saved
    whole = run_study(study)
    for name in batch.OUTPUTS:
        assert np.array_equal(whole[name], again[name]), name
