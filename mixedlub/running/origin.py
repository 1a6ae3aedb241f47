"""Origin of a result: a record in its folder, by which a run replaces only results of the same input."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from profiles.errors import InputError

SCHEMA = "mixedlub-origin/1"
NAME = "origin.json"
FIGURES = "figures"
"""Folder of drawings, which contain a mark of origin (`mixedlub.running.atomic`)."""
ENDS = 1 << 20
"""Bytes at either end of a file that identify it, so that a large table need not be read completely."""


@dataclass(frozen=True)
class Origin:
    """Input of a run: location and content hash; ``within``: another input, which may lie in the folder of results."""

    source: Path
    fingerprint: str
    within: Path | None = None

    def write_record(self, aside: Path, folder: Path, earlier: Mapping[str, str] | None = None) -> None:
        """Write `origin.json` for ``folder`` into ``aside``; ``earlier``: marks of files that remain."""
        new = (path for path in aside.rglob("*") if path.is_file())
        names = (path.relative_to(aside).as_posix() for path in new)
        marks = {name: _mark(aside / name) for name in names if not name.startswith(f"{FIGURES}/")}
        files = dict(sorted({**(earlier or {}), **marks}.items()))
        record = {"schema": SCHEMA, **self._identity(folder), "files": files}
        text = json.dumps(record, indent=1, ensure_ascii=False) + "\n"
        (aside / NAME).write_text(text, encoding="utf-8", newline="\n")

    def check_folder(self, folder: Path, names: Collection[str], what: str) -> str:
        """Raise an error for a folder with files of another origin; return a note for an earlier state of this input.

        ``names``: files and folders of a result. ``what``: kind of input as text.
        """
        found = _read(folder)
        marks = found.get("files", {})
        paths = {name: folder / name for name in (*_files(folder, names), *marks)}
        own = [self.source, *([] if self.within is None else [self.within])]
        there = [n for n, path in paths.items() if path.exists() and not any(is_same(path, one) for one in own)]
        if not there:
            return ""
        way_out = "name another folder with --out, or say --replace"
        foreign = [name for name in there if marks.get(name) != _mark(folder / name)]
        if foreign:
            rule = f"holds {' and '.join(foreign)}, not as a run left it; {way_out}"
            raise InputError(rule, where="--out", value=str(folder))
        identity = self._identity(folder)
        if found.get("fingerprint") == identity["fingerprint"]:
            return ""
        if found.get("source") != identity["source"]:
            rule = f"holds the result of another {what}, {found.get('source')}; {way_out}"
            raise InputError(rule, where="--out", value=str(folder))
        return f"the result in {folder} is of an earlier state of {self.source} and is replaced"

    def is_of(self, folder: Path) -> bool:
        """Whether a run on this input, in its present state, made the result in a folder."""
        return bool(_read(folder).get("fingerprint") == self.fingerprint)

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
    """Origin of a folder of inputs, from the content of named files and the choices of the user."""
    digest = hashlib.sha256(repr(choices).encode() if choices else b"")
    for name in names:
        path = source / name
        content = path.read_bytes() if path.is_file() else b""
        digest.update(f"{name}:{len(content)}:".encode() + content)
    return Origin(source, digest.hexdigest())


def origin_of_file(source: Path, *choices: object) -> Origin:
    """Origin of an input, a file or the name of shipped data, with the choices of the user."""
    content = source.read_bytes() if source.is_file() else b""
    return Origin(source, hashlib.sha256(content + repr(choices).encode()).hexdigest())


@cache
def code_fingerprint() -> str:
    """Hash of all code that affects results."""
    import numpy as np

    import roughness

    digest = hashlib.sha256(np.__version__.encode())
    for package in (Path(__file__).parent.parent, Path(roughness.__path__[0])):
        for path in sorted(package.rglob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()


def as_left(folder: Path) -> dict[str, str]:
    """Marks of files in a folder unchanged since a run."""
    return {name: mark for name, mark in _read(folder).get("files", {}).items() if _mark(folder / name) == mark}


def is_same(path: Path, other: Path) -> bool:
    """Whether two paths lead to the same existing file."""
    return path.exists() and other.exists() and path.samefile(other)


def _files(folder: Path, names: Collection[str]) -> Iterator[str]:
    """Names of files, those in named folders included."""
    for name in names:
        inside = (path for path in (folder / name).rglob("*") if path.is_file())
        yield from (path.relative_to(folder).as_posix() for path in inside) if (folder / name).is_dir() else (name,)


def _read(folder: Path) -> dict[str, Any]:
    """Record in a folder; empty if no run wrote it."""
    try:
        found = json.loads((folder / NAME).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) and found.get("schema") == SCHEMA else {}


def _mark(path: Path) -> str:
    """Identity of a file: size and both ends; empty if the file is missing."""
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
