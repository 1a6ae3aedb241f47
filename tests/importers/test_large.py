"""Tables of many rows: the time grows with the rows and no faster, whatever lines stand between them."""

import time
from contextlib import suppress

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers import import_files
from mixedlub.importers.text_table import read_sheet
from profiles.errors import InputError

DRIVE = {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}
ROWS = 30_000


def table(rows):
    lines = (f"{i * 0.1:.1f},{100 + i % 900},{0.5 + i % 7:.3f},40.0,A{i % 3}" for i in range(rows))
    return "Time [s],Speed [rpm],Friction torque [Nm],Oil temp [°C],Sample\n" + "\n".join(lines) + "\n"


def test_a_table_of_many_rows_is_imported_in_seconds(file, tmp_path):
    """Quadratic in the rows it took half a minute."""
    path = file(table(ROWS))
    start = time.process_time()
    with pytest.warns(UserWarning, match="pooled"):
        case = import_files([path], tmp_path / "case", **DRIVE)
    assert time.process_time() - start < 15.0
    read = read_case(case).recordings
    assert len(read) == ROWS
    assert np.allclose(read["friction_torque_Nm"], 0.5 + np.arange(ROWS) % 7)


@pytest.mark.parametrize("between", ["-,-,-\n", "x,y,z\n", "\n"])
def test_lines_between_the_rows_do_not_make_it_slow(between):
    """Each line of words was followed to the end of the file."""
    text = "a,b,c\n" + "".join(f"{i},1,2\n{between}" for i in range(20_000)) + "1,2,3\n1,2,4\n"
    start = time.process_time()
    with suppress(InputError):
        read_sheet(text, "t.csv")
    assert time.process_time() - start < 6.0
