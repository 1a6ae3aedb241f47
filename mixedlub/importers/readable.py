"""Whether a case that is about to appear is one that `check` reads."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mixedlub.case.folder import Case, read_case, read_conditions
from mixedlub.kinds import kind as kind_of
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.findings import collected
from profiles.errors import InputError


def refuse_unreadable(folder: Path, system: system_file.System, complete: bool, shown: Path) -> str:
    """An error where `check` would give one; why `diagnose` would refuse what `check` reads, else nothing.

    Of a case that still lacks sections (not ``complete``) the tables and what is described are read. The error names
    the place ``shown``, where the case would have appeared.
    """
    try:
        with collected():
            return (_whole(folder) if complete else _parts(folder, system)).replace(str(folder), str(shown))
    except InputError as error:
        told = system_file.in_file(error, str(folder / "system.toml"))
        rule, where = (text.replace(str(folder), str(shown)) for text in (told.rule, told.where))
        raise InputError(f"{rule}; nothing was written", where=where, value=told.value) from None
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
    rig = Rig(system, folder)
    list(rig.parts())
    read_conditions(Case("", folder, system, kind_of(system.kind), rig, None, None, ()), folder / "recordings.csv")
    return ""
