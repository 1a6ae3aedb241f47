"""Whose result a folder holds: a record beside it, by which a run replaces its own result and no other."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from profiles.errors import InputError

SCHEMA = "mixedlub-origin/1"
NAME = "origin.json"


@dataclass(frozen=True)
class Origin:
    """The input of a run: where it lies and a hash of its content."""

    source: Path
    fingerprint: str

    def record(self, folder: Path, contents: Mapping[str, bytes]) -> str:
        """The text of `origin.json` in a folder, for a result of these files."""
        marks = {name: hashlib.sha256(content).hexdigest() for name, content in sorted(contents.items())}
        record = {"schema": SCHEMA, **self._identity(folder), "files": marks}
        return json.dumps(record, indent=1, ensure_ascii=False) + "\n"

    def check_folder(self, folder: Path, names: Collection[str], what: str) -> str:
        """Refuse a folder with files of other origin; returns a note where they are of an earlier state of this input.

        ``names`` are the files that every result has, ``what`` is the kind of input in words.
        """
        found = _read(folder)
        marks = found.get("files", {})
        there = [name for name in {**dict.fromkeys(names), **marks} if (folder / name).exists()]
        if not there:
            return ""
        way_out = "name another folder with --out, or say --replace"
        foreign = [name for name in there if marks.get(name) != _mark(folder / name)]
        if foreign:
            rule = f"holds {' and '.join(foreign)}, not as a run left it; {way_out}"
            raise InputError(rule, where="--out", value=str(folder))
        own = self._identity(folder)
        if found["fingerprint"] == own["fingerprint"]:
            return ""
        if found["source"] != own["source"]:
            rule = f"holds the result of another {what}, {found['source']}; {way_out}"
            raise InputError(rule, where="--out", value=str(folder))
        return f"the result in {folder} is of an earlier state of {self.source} and is replaced"

    def _identity(self, folder: Path) -> dict[str, str]:
        """The input with its path relative to the result, so that both may be moved together."""
        try:
            source = Path(os.path.relpath(self.source.resolve(), folder.resolve()))
        except ValueError:  # on another drive
            source = self.source.resolve()
        return {"source": source.as_posix(), "fingerprint": self.fingerprint}


def origin_of(source: Path, names: Collection[str]) -> Origin:
    """The origin of a folder of inputs, by the content of its named files."""
    digest = hashlib.sha256()
    for name in names:
        path = source / name
        content = path.read_bytes() if path.is_file() else b""
        digest.update(f"{name}:{len(content)}:".encode() + content)
    return Origin(source, digest.hexdigest())


def _read(folder: Path) -> dict[str, Any]:
    """The record in a folder; empty where no run wrote one."""
    try:
        found = json.loads((folder / NAME).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) and found.get("schema") == SCHEMA else {}


def _mark(path: Path) -> str:
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError:
        return ""
