"""A study of two surfaces, and the recording of a drive with mixed friction at low speeds."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import mixedlub as ml

STUDY = """
schema = "mixedlub-study/1"
title = "Two flanks"
[gears]
teeth = [17, 26]
normal_module_mm = 4.0
face_width_mm = 14.0
[surfaces.ground]
m0_um2 = 0.137
m2 = 0.0031
m4_per_um2 = 0.0021
[surfaces.polished]
m0_um2 = 4e-4
m2 = 2e-4
m4_per_um2 = 4e-4
[conditions]
"""


@pytest.fixture(scope="session")
def two_flanks(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """The file of a study with these levels."""

    def write(title: str = "Two flanks", **levels: str) -> Path:
        path = tmp_path_factory.mktemp("study") / "own.toml"
        conditions = "\n".join(f"{name} = {level}" for name, level in levels.items())
        path.write_text(STUDY.replace("Two flanks", title) + conditions, encoding="utf-8")
        return path

    return write


@pytest.fixture(scope="session")
def drive() -> ml.case.Case:
    speed = np.array([10.0, 20, 50, 100, 200, 300, 400, 500] * 4)
    torque = (0.5 + 2e-3 * speed + 0.6 * np.exp(-speed / 40)) * (1 + 0.01 * np.cos(7.0 * np.arange(32)))
    system = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm", "noise": {"relative": 0.01}}}
    rows = {"speed_rpm": speed, "friction_torque_Nm": torque}
    return ml.case.case_of(system, rows, {"speed_rpm": [150.0, 250.0]}, name="drive")


@pytest.fixture(scope="session")
def answer(drive: ml.case.Case) -> ml.Answer:
    return ml.diagnose(drive)
