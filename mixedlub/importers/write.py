"""A case folder written in one go: `system.toml` and `recordings.csv`."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.writing import writing
from profiles.errors import InputError

Comments = Mapping[str, Sequence[str]]
"""Lines of comment by the dotted name of the table they stand in; the empty name is the head of the file."""


def write_case(
    out: Path,
    system: Mapping[str, Any],
    columns: Mapping[str, Sequence[Any] | np.ndarray],
    *,
    overwrite: bool = True,
    comments: Comments | None = None,
) -> Path:
    """Write the two files of a case folder, both or neither; other files there, and folders that are no case, stay.

    ``columns`` are those of the recording without ``run``, which is numbered here; ``comments`` are lines to put
    under the tables of system.toml. Without ``overwrite`` a file there that says something else is an error.
    """
    if not out.is_dir() and out.exists():
        raise InputError("exists and is no case folder; name another --out", where=str(out))
    if out.is_dir() and not (out / "system.toml").exists() and any(p for p in out.iterdir() if not _unfinished(p)):
        raise InputError("exists and is no case folder; name another --out", where=str(out))
    files = {
        "system.toml": to_toml({"schema": "mixedlub-case/1", **system}, comments=comments).encode(),
        "recordings.csv": _recordings(out, columns).encode(),
    }
    differing = [name for name, content in files.items() if (out / name).exists() and _held(out / name) != content]
    if differing and not overwrite:
        raise InputError(
            "exists and differs from what would be written, so it is left as it is; name another --out, or replace it "
            f"by --overwrite; with --answers {out / 'system.toml'} --overwrite what it says is taken over",
            where=str(out / differing[0]),
        )
    if not differing and all((out / name).exists() for name in files):
        return out
    try:
        out.mkdir(parents=True, exist_ok=True)
        with writing(out) as aside:
            for name, content in files.items():
                (aside / name).write_bytes(content)
    except OSError as error:
        raise InputError(f"cannot be written to ({error.strerror})", where=str(out)) from None
    return out


def _unfinished(path: Path) -> bool:
    return path.name.startswith(".writing-")


def _held(path: Path) -> bytes | None:
    return path.read_bytes() if path.is_file() else None


def _recordings(out: Path, columns: Mapping[str, Sequence[Any] | np.ndarray]) -> str:
    lengths = {len(values) for values in columns.values()}
    if len(lengths) != 1:
        raise InputError("columns differ in length", where=str(out), value=sorted(lengths))
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["run", *columns])
    for run, row in enumerate(zip(*columns.values(), strict=True), start=1):
        writer.writerow([run, *(_cell(value) for value in row)])
    return text.getvalue()


def _cell(value: Any) -> Any:
    return f"{float(value):.7g}" if isinstance(value, float | np.floating) else value


def to_toml(data: Mapping[str, Any], place: str = "", *, comments: Comments | None = None) -> str:
    """TOML of nested tables with plain values, tables last; comments of a table stand below its values.

    Comments of tables that the data do not have follow at the end.

    >>> print(to_toml({"kind": "film", "contact": {"radius_mm": [9.5, float("inf")]}}))
    kind = "film"
    <BLANKLINE>
    [contact]
    radius_mm = [9.5, inf]
    <BLANKLINE>
    """
    said = comments or {}
    written: set[str] = set()
    text = _table(data, place, said, written)
    absent = ["\n" + "\n".join(lines) + "\n" for name, lines in said.items() if name not in written]
    return text + "".join(absent)


def _table(data: Mapping[str, Any], place: str, comments: Comments, written: set[str]) -> str:
    lines = [
        f"{toml_key(k)} = {toml_value(v)}" for k, v in data.items() if v is not None and not isinstance(v, Mapping)
    ]
    lines += comments.get(place, ())
    written.add(place)
    text = "\n".join(lines) + "\n" if lines else ""
    for key, v in data.items():
        if isinstance(v, Mapping):
            name = f"{place}.{toml_key(key)}" if place else toml_key(key)
            inner = _table(v, name, comments, written)
            plain = not v or any(not isinstance(x, Mapping) for x in v.values()) or comments.get(name)
            text += (f"\n[{name}]\n" if plain else "") + inner
    return text


def toml_key(name: str) -> str:
    """A key as TOML writes it.

    >>> toml_key("ground"), toml_key("Ra 0.4")
    ('ground', '"Ra 0.4"')
    """
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else toml_value(name)


def toml_value(value: Any) -> str:
    """A plain value or a list as TOML writes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        escaped = value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ")
        return f'"{escaped}"'
    if isinstance(value, list | tuple):
        return "[" + ", ".join(toml_value(v) for v in value) + "]"
    number = float(value)
    return str(int(value)) if isinstance(value, int) else repr(number)
