"""Results that appear whole or not at all: written aside, then renamed into place."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def writing(folder: Path) -> Iterator[Path]:
    """A folder beside the results to write into; its entries replace theirs when all are written."""
    for stale in folder.glob(".writing-*"):
        if not _alive(stale.name.rpartition("-")[2]):
            shutil.rmtree(stale, ignore_errors=True)
    aside = folder / f".writing-{os.getpid()}"
    shutil.rmtree(aside, ignore_errors=True)
    aside.mkdir()
    try:
        yield aside
        entries = sorted(aside.iterdir())
        for entry in entries:
            target = folder / entry.name
            if target.is_dir():
                target.rename(aside / f"{entry.name}.before")
            entry.replace(target)
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def _alive(process: str) -> bool:
    try:
        os.kill(int(process), 0)
    except (ValueError, ProcessLookupError):
        return False
    except PermissionError:
        return True
    return True
