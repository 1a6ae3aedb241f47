"""Tables of cases: what is no number, and cells that run over the end of a line."""

from pathlib import Path

import pytest

from mixedlub.schema.cells import is_number
from mixedlub.schema.table import RUN, Column, read_table
from profiles.errors import InputError

COLUMNS = (RUN, Column("speed_rpm"), Column("surface", "name"))


def read(tmp_path: Path, *rows: str):
    (tmp_path / "t.csv").write_text("\n".join(("run,speed_rpm,surface", *rows)) + "\n")
    return read_table(tmp_path / "t.csv", COLUMNS)


@pytest.mark.parametrize("cell", ["1_7.49", "1_000", "_1"])
def test_a_stroke_between_digits_is_no_number(tmp_path, cell):
    assert not is_number(cell)
    with pytest.raises(InputError, match=f"line 3, speed_rpm: '{cell}'"):
        read(tmp_path, "1,100,a", f"2,{cell},a")


@pytest.mark.parametrize("rows", [('1,100,"ground', 'a"', "2,200,b"), ("2,200,b", '1,100,"ground', "a")])
def test_a_quoted_cell_that_runs_on_is_an_error(tmp_path, rows):
    with pytest.raises(InputError, match=r"line [23]: 'ground.*a quoted cell must end in its line"):
        read(tmp_path, *rows)


def test_a_quoted_cell_may_hold_a_comma(tmp_path):
    assert read(tmp_path, '1,100,"ground, fine"', "", '2,200,"b"')["surface"].tolist() == ["ground, fine", "b"]
