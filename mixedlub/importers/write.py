"""A case folder written in one go: `system.toml` and `recordings.csv`."""

from __future__ import annotations

import csv
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from profiles.errors import InputError

SECTIONS = ("schema", "kind", "boundary_friction", "description")


def write_case(out: Path, system: Mapping[str, Any], columns: Mapping[str, Sequence[Any] | np.ndarray]) -> Path:
    """Write a case folder aside and move it into place; an existing case is replaced whole, anything else is left.

    ``columns`` are those of the recording without ``run``, which is numbered here.
    """
    if out.exists() and not (out / "system.toml").exists() and (not out.is_dir() or any(out.iterdir())):
        raise InputError("exists and is no case folder; name another --out", where=str(out))
    aside = out.with_name(f".{out.name}.part")
    shutil.rmtree(aside, ignore_errors=True)
    aside.mkdir(parents=True)
    full = {"schema": "mixedlub-case/1", **system}
    (aside / "system.toml").write_text(to_toml(full), encoding="utf-8")
    lengths = {len(values) for values in columns.values()}
    if len(lengths) != 1:
        raise InputError("columns differ in length", where=str(out), value=sorted(lengths))
    with (aside / "recordings.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["run", *columns])
        for run, row in enumerate(zip(*columns.values(), strict=True), start=1):
            writer.writerow([run, *(_cell(value) for value in row)])
    if out.exists():
        shutil.rmtree(out)
    aside.rename(out)
    return out


def _cell(value: Any) -> Any:
    return f"{float(value):.7g}" if isinstance(value, float | np.floating) else value


def to_toml(data: Mapping[str, Any], place: str = "") -> str:
    """TOML of nested tables with plain values, tables last.

    >>> print(to_toml({"kind": "film", "contact": {"radius_mm": [9.5, float("inf")]}}))
    kind = "film"
    <BLANKLINE>
    [contact]
    radius_mm = [9.5, inf]
    <BLANKLINE>
    """
    lines = [f"{key} = {_value(v)}" for key, v in data.items() if v is not None and not isinstance(v, Mapping)]
    text = "\n".join(lines) + "\n" if lines else ""
    for key, v in data.items():
        if isinstance(v, Mapping) and v:
            name = f"{place}.{key}" if place else key
            inner = to_toml(v, name)
            plain = any(not isinstance(x, Mapping) for x in v.values())
            text += (f"\n[{name}]\n" if plain else "") + inner
    return text


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        escaped = value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ")
        return f'"{escaped}"'
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_value(v) for v in value) + "]"
    number = float(value)
    return str(int(value)) if isinstance(value, int) else repr(number)
