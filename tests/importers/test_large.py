"""Tables of many rows; how long they take is told by benchmarks/import_table.py."""

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers import import_files

DRIVE = {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}
ROWS = 30_000


def table(rows):
    lines = (f"{i * 0.1:.1f},{100 + i % 900},{0.5 + i % 7:.3f},40.0,A{i % 3}" for i in range(rows))
    return "Time [s],Speed [rpm],Friction torque [Nm],Oil temp [°C],Sample\n" + "\n".join(lines) + "\n"


def test_a_table_of_many_rows_is_imported_whole(file, tmp_path):
    path = file(table(ROWS))
    with pytest.warns(UserWarning, match="pooled"):
        case = import_files([path], tmp_path / "case", **DRIVE)
    read = read_case(case).recordings
    assert len(read) == ROWS
    assert np.allclose(read["friction_torque_Nm"], 0.5 + np.arange(ROWS) % 7)
