"""The folder of the page: one folder for each recording, set of surfaces or study of pairings."""

from __future__ import annotations

import json
import os
import re
import secrets
import shutil
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path, PurePosixPath
from typing import Any, BinaryIO

from mixedlub.running.atomic import is_alive, whole
from profiles.errors import InputError

PAGES = {"recordings": "recording", "surfaces": "set of surfaces", "pairings": "study of pairings"}
"""Folders of the pages, each with the name of one of its items."""
UPLOADS = "uploads"
ID = re.compile(r"\d{6}-\d{6}-[0-9a-f]{8}")
LONGEST_NAME = 120
"""Judgement. Most characters in the name of a file that is sent."""
MOST_FILES = 40
"""Judgement. Most files sent at once."""


def safe_name(name: str) -> str:
    """Name of a file that is sent; an error if it is a path, hidden or unprintable.

    >>> safe_name("run 3.csv")
    'run 3.csv'
    >>> safe_name("../../run.csv")
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: '../../run.csv': is no plain name of a file; rename it and send it again
    """
    plain = name.isprintable() and not set(name) & set('/\\:*?"<>|') and not name.startswith((".", "-", "~"))
    if not plain or not 0 < len(name) <= LONGEST_NAME or name.endswith((".", " ")):
        raise InputError("is no plain name of a file; rename it and send it again", value=name)
    return name


@dataclass(frozen=True)
class Item:
    """Folder of a recording, a set of surfaces or a study, with its record."""

    folder: Path

    @property
    def id(self) -> str:
        """Name of the folder."""
        return self.folder.name

    @property
    def page(self) -> str:
        """Page of the item."""
        return self.folder.parent.name

    @property
    def uploads(self) -> Path:
        """Folder of the files that were sent."""
        return self.folder / UPLOADS

    @property
    def record(self) -> dict[str, Any]:
        """Name, time and answers of the item."""
        return read_record(self.folder / "item.json")

    def update(self, **values: Any) -> None:
        """Change entries of the record."""
        write_record(self.folder / "item.json", {**self.record, **values})

    def file(self, path: str) -> Path:
        """File inside the folder; an error for any other path."""
        parts = PurePosixPath(path).parts
        found = self.folder.joinpath(*parts) if parts and "\\" not in path and "\0" not in path else self.folder
        inside = found.resolve().is_relative_to(self.folder.resolve()) and ".." not in parts
        if not inside or not found.is_file():
            raise InputError("no such file", where=path[:LONGEST_NAME])
        return found

    def save(self, files: Iterable[tuple[str, BinaryIO]], folder: str = UPLOADS) -> list[str]:
        """Write files that were sent; return their names."""
        names = []
        (self.folder / folder).mkdir(exist_ok=True)
        for name, content in files:
            with whole(self.folder / folder / safe_name(name)) as aside, aside.open("wb") as file:
                shutil.copyfileobj(content, file)
            names.append(name)
        return names


def read_record(path: Path) -> dict[str, Any]:
    """Record in a JSON file; empty if there is none."""
    with suppress(OSError, ValueError):
        found = json.loads(path.read_text(encoding="utf-8"))
        return found if isinstance(found, dict) else {}
    return {}


def write_record(path: Path, record: dict[str, Any]) -> None:
    """Write a record as a whole or not at all."""
    with whole(path) as aside:
        aside.write_text(json.dumps(record, indent=1, ensure_ascii=False), encoding="utf-8")


@dataclass(frozen=True)
class Store:
    """The folder of all items, used by one page at a time."""

    folder: Path

    def claim(self) -> None:
        """Mark the folder as in use; an error if another page of this machine uses it."""
        lock = self.folder / "app.pid"
        held = lock.read_text(encoding="utf-8").strip() if lock.exists() else ""
        if held != str(os.getpid()) and is_alive(held):
            rule = f"is in use by process {held}, another mixedlub app; end that one, or name another --out"
            raise InputError(rule, where="--out", value=str(self.folder))
        lock.write_text(str(os.getpid()), encoding="utf-8")
        for page in PAGES:
            (self.folder / page).mkdir(exist_ok=True)

    def release(self) -> None:
        """Take the mark away."""
        (self.folder / "app.pid").unlink(missing_ok=True)

    def create(self, page: str, name: str, **values: Any) -> Item:
        """A new item of a page."""
        now = datetime.now()
        item = Item(self.folder / page / f"{now:%y%m%d-%H%M%S}-{secrets.token_hex(4)}")
        item.uploads.mkdir(parents=True)
        item.update(name=name, created=f"{now:%Y-%m-%d %H:%M}", **values)
        return item

    def find(self, page: str, id: str) -> Item:
        """Item of a page; an error if there is none of this name."""
        item = Item(self.folder / page / id)
        if page not in PAGES or not ID.fullmatch(id) or not item.folder.is_dir():
            raise InputError(f"no such {PAGES.get(page, 'page')}", value=id[:LONGEST_NAME])
        return item

    def remove(self, item: Item) -> None:
        """Delete an item with all of its files."""
        shutil.rmtree(item.folder)

    def items(self, page: str) -> list[Item]:
        """All items of a page, the newest first."""
        folders = sorted((self.folder / page).iterdir(), reverse=True)
        return [Item(path) for path in folders if ID.fullmatch(path.name)]
