"""Check whether `check` and `diagnose` can use a case folder before it is put in place."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mixedlub.case.folder import Case, header_of, read_case, read_conditions
from mixedlub.kinds import kind as kind_of
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.findings import collected
from profiles.errors import InputError


def refuse_unreadable(folder: Path, system: system_file.System, complete: bool, shown: Path) -> str:
    """Raise the error that `check` would give; else return why `diagnose` would refuse the case, or nothing.

    Of a case that lacks sections (not ``complete``) only the tables and the given sections are read. The error names
    ``shown``, the folder to which the case will be moved.
    """
    try:
        with collected():
            return (_whole(folder) if complete else _parts(folder, system)).replace(str(folder), str(shown))
    except InputError as error:
        placed = system_file.in_file(error, str(folder / "system.toml"))
        rule, where = (text.replace(str(folder), str(shown)) for text in (placed.rule, placed.where))
        raise InputError(f"{rule}; nothing was written", where=where, value=placed.value) from None
    except ArithmeticError as error:
        rule = f"has numbers too large or too small to compute with ({error}); nothing was written"
        raise InputError(rule, where=str(shown)) from None


def _whole(folder: Path) -> str:
    from mixedlub.case.forward import Forward
    from mixedlub.data_checks.audit import check_readings

    case = read_case(folder)
    assert case.recordings is not None
    list(case.rig.parts())
    forward = Forward(case, case.recordings)
    try:
        check_readings(case, case.recordings, np.asarray(case.recordings[case.quantity], dtype=float), forward)
    except InputError as error:
        return str(error)
    return ""


def _parts(folder: Path, system: system_file.System) -> str:
    kind = kind_of(system.kind).of_case(system, header_of(folder, ("recordings",)))
    rig = Rig(system, folder, kind.unread_of_oil)
    list(rig.parts())
    read_conditions(Case("", folder, system, kind, rig, None, None, ()), folder / "recordings.csv")
    return ""
