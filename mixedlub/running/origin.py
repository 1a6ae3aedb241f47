"""Whose result a folder holds: a record beside it, by which a run replaces its own result and no other."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from profiles.errors import InputError

SCHEMA = "mixedlub-origin/1"
NAME = "origin.json"
FIGURES = "figures"
"""Folder of drawings, which say themselves that they were made here (`mixedlub.running.atomic`)."""
ENDS = 1 << 20
"""Bytes at either end of a file that identify it, so that a large table need not be read completely."""


@dataclass(frozen=True)
class Origin:
    """The input of a run: where it lies and a hash of its content."""

    source: Path
    fingerprint: str

    def write_record(self, aside: Path, folder: Path, earlier: Mapping[str, str] | None = None) -> None:
        """Write `origin.json` beside the files of a result for ``folder``; ``earlier`` has marks of those that stay."""
        new = (path for path in aside.rglob("*") if path.is_file())
        names = (path.relative_to(aside).as_posix() for path in new)
        marks = {name: _mark(aside / name) for name in names if not name.startswith(f"{FIGURES}/")}
        files = dict(sorted({**(earlier or {}), **marks}.items()))
        record = {"schema": SCHEMA, **self._identity(folder), "files": files}
        text = json.dumps(record, indent=1, ensure_ascii=False) + "\n"
        (aside / NAME).write_text(text, encoding="utf-8", newline="\n")

    def check_folder(self, folder: Path, names: Collection[str], what: str) -> str:
        """Refuse a folder with files of other origin; returns a note where they are of an earlier state of this input.

        ``names`` are the files that a result has, ``what`` is the kind of input in words.
        """
        found = _read(folder)
        marks = found.get("files", {})
        paths = {name: folder / name for name in (*names, *marks)}
        there = [name for name, path in paths.items() if path.exists() and not is_same(path, self.source)]
        if not there:
            return ""
        way_out = "name another folder with --out, or say --replace"
        foreign = [name for name in there if marks.get(name) != _mark(folder / name)]
        if foreign:
            rule = f"holds {' and '.join(foreign)}, not as a run left it; {way_out}"
            raise InputError(rule, where="--out", value=str(folder))
        own = self._identity(folder)
        if found.get("fingerprint") == own["fingerprint"]:
            return ""
        if found.get("source") != own["source"]:
            rule = f"holds the result of another {what}, {found.get('source')}; {way_out}"
            raise InputError(rule, where="--out", value=str(folder))
        return f"the result in {folder} is of an earlier state of {self.source} and is replaced"

    def _identity(self, folder: Path) -> dict[str, str]:
        """The input with its path relative to the result, so that both may be moved together."""
        if not self.source.exists():  # the name of an input that the package has
            return {"source": self.source.as_posix(), "fingerprint": self.fingerprint}
        try:
            source = Path(os.path.relpath(self.source.resolve(), folder.resolve()))
        except ValueError:  # on another drive
            source = self.source.resolve()
        return {"source": source.as_posix(), "fingerprint": self.fingerprint}


def origin_of(source: Path, names: Collection[str], *choices: object) -> Origin:
    """The origin of a folder of inputs, by the content of its named files and what was chosen."""
    digest = hashlib.sha256(repr(choices).encode() if choices else b"")
    for name in names:
        path = source / name
        content = path.read_bytes() if path.is_file() else b""
        digest.update(f"{name}:{len(content)}:".encode() + content)
    return Origin(source, digest.hexdigest())


def origin_of_file(source: Path, *choices: object) -> Origin:
    """The origin of one input: a file, or the name of an input that the package has, and what was chosen."""
    content = source.read_bytes() if source.is_file() else b""
    return Origin(source, hashlib.sha256(content + repr(choices).encode()).hexdigest())


@cache
def code_fingerprint() -> str:
    """A hash of every line of code that results depend on."""
    import numpy as np

    import roughness

    digest = hashlib.sha256(np.__version__.encode())
    for package in (Path(__file__).parent.parent, Path(roughness.__path__[0])):
        for path in sorted(package.rglob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()


def as_left(folder: Path) -> dict[str, str]:
    """The marks of files in a folder that are as a run left them."""
    return {name: mark for name, mark in _read(folder).get("files", {}).items() if _mark(folder / name) == mark}


def is_same(path: Path, other: Path) -> bool:
    """Whether two paths lead to one file that exists."""
    return path.exists() and other.exists() and path.samefile(other)


def _read(folder: Path) -> dict[str, Any]:
    """The record in a folder; empty where no run wrote one."""
    try:
        found = json.loads((folder / NAME).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) and found.get("schema") == SCHEMA else {}


def _mark(path: Path) -> str:
    """Identity of a file: its size and its two ends; empty where there is none."""
    try:
        with path.open("rb") as file:
            size = file.seek(0, os.SEEK_END)
            digest = hashlib.sha256(str(size).encode())
            for start in (0, max(0, size - ENDS)):
                file.seek(start)
                digest.update(file.read(ENDS))
    except OSError:
        return ""
    return digest.hexdigest()
