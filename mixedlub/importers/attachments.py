"""Files of a case besides its tables: surface traces and a table of load shares."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import Any

from mixedlub.case.import_file import NAME
from mixedlub.importers.base import nested
from mixedlub.schema.surface_file import SURFACE_FILES
from profiles import SHIPPED_MARK
from profiles.errors import InputError, nearest

RESERVED_NAMES = ("system.toml", "recordings.csv", "conditions.csv", NAME)
SHARE_COLUMNS = {"torque_Nm", "roll_angle_deg", "load_share"}
SHARE = "gears.load_sharing"


@dataclass(frozen=True)
class NamedFile:
    """File named in an answer: path of keys, name as given, case folder for a file from elsewhere."""

    keys: tuple[str | int, ...]
    name: str
    home: str


def is_share(text: str) -> bool:
    """Whether a text is a table of load shares.

    >>> is_share("torque_Nm, roll_angle_deg, load_share\\n50,18,0.5\\n"), is_share("speed_rpm,torque_Nm\\n1,2\\n")
    (True, False)
    """
    first = next((line for line in text.splitlines() if line.strip()), "")
    return {cell.strip() for cell in first.split(",")} == SHARE_COLUMNS


def with_share(answers: Mapping[str, Any], tables: Sequence[Path]) -> dict[str, Any]:
    """Answers completed by a table of load shares given with the recording."""
    if not tables:
        return dict(answers)
    if len(tables) > 1:
        raise InputError(f"is a second table of load shares after {tables[0]}; a case has one", where=str(tables[1]))
    given = {key: value for key, value in answers.items() if key.startswith(f"{SHARE}.")}
    other = {k: v for k, v in given.items() if k != f"{SHARE}.table" or PurePath(str(v)).name != tables[0].name}
    if other:
        key, value = next(iter(other.items()))
        raise InputError(f"contradicts {tables[0]}, a table of load shares", where=key, value=value)
    if not any(key.startswith("gears.") for key in answers if key not in given):
        rule = "is a table of load shares, which belongs to [gears]: describe the gears by --answers"
        raise InputError(rule, where=str(tables[0]))
    return {**answers, f"{SHARE}.table": str(tables[0].resolve())}


def with_attachments(answers: Mapping[str, Any], folders: Sequence[Path]) -> tuple[dict[str, Any], dict[str, bytes]]:
    """Answers as tables with file names relative to the case, and contents of the files by these names.

    Each folder is searched in turn; a file outside the case is copied into it.
    """
    system = deepcopy(nested(answers))
    files: dict[str, bytes] = {}
    for named in _named_files(system):
        source = _located(named, folders)
        path = PurePath(named.name)
        inside = not path.is_absolute() and ".." not in path.parts
        name_in_case = path.as_posix() if inside else (PurePath(named.home) / path.name).as_posix()
        try:
            content = source.read_bytes()
        except OSError as error:
            raise InputError(f"cannot be read ({error.strerror})", where=str(source)) from None
        if name_in_case in RESERVED_NAMES or files.get(name_in_case, content) != content:
            rule = "is a name that the case needs for another file; rename it"
            raise InputError(rule, where=".".join(map(str, named.keys)), value=named.name)
        files[name_in_case] = content
        table: Any = system
        for key in named.keys[:-1]:
            table = table[key]
        table[named.keys[-1]] = name_in_case
    return system, files


def _named_files(system: Mapping[str, Any]) -> Iterator[NamedFile]:
    gears = system.get("gears", {})
    share = gears.get("load_sharing", {}) if isinstance(gears, Mapping) else {}
    if isinstance(share, Mapping) and isinstance(share.get("table"), str):
        yield NamedFile(("gears", "load_sharing", "table"), share["table"], "")
    surfaces = system.get("surfaces", {})
    for name, surface in surfaces.items() if isinstance(surfaces, Mapping) else ():
        for key in SURFACE_FILES if isinstance(surface, Mapping) else ():
            given = surface.get(key)
            for place, one in enumerate(given) if isinstance(given, list) else [(None, given)]:
                if isinstance(one, str) and not one.startswith(SHIPPED_MARK):
                    keys = ("surfaces", name, key) if place is None else ("surfaces", name, key, place)
                    yield NamedFile(keys, one, "profiles")


def _located(named: NamedFile, folders: Sequence[Path]) -> Path:
    for folder in folders:
        if (folder / named.name).is_file():
            return folder / named.name
    beside = sorted({p.name for f in folders for p in (f / named.name).parent.glob("*") if p.is_file()})
    hint = f"; {nearest(PurePath(named.name).name, beside)}" if beside else ""
    looked = " or ".join(dict.fromkeys(str(folder) for folder in folders))
    raise InputError(f"no such file in {looked}{hint}", where=".".join(map(str, named.keys)), value=named.name)
