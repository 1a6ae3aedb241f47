"""A case: its folder, its forward model and its defaults."""

from __future__ import annotations

from os import PathLike

from mixedlub.case.folder import Case, case_of, read_case
from profiles.errors import as_path


def read(folder: str | PathLike[str]) -> Case:
    """The case in a folder; wrong files raise ``profiles.errors.InputError`` with the place and the rule."""
    return read_case(as_path(folder, "case.read"))


__all__ = ["Case", "case_of", "read"]
