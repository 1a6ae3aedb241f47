"""Results written to a temporary name and renamed, so that they appear completely or not at all."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def writing(folder: Path) -> Iterator[Path]:
    """A folder beside the results for writing; its entries replace the results when all are written.

    A folder is replaced, but files in it that no earlier run wrote are kept.
    """
    for stale in folder.glob(".writing-*"):
        if not is_alive(stale.name.rpartition("-")[2]):
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
                _take_along(target, entry)
                target.rename(aside / f"{entry.name}.before")
            entry.replace(target)
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def fill(contents: Mapping[str, str | bytes], folder: Path) -> None:
    """Write files into a folder, by relative path."""
    for name, content in contents.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """Temporary name next to a file; renamed to the file on completion."""
    aside = path.with_suffix(f".{os.getpid()}")
    try:
        yield aside
        aside.replace(path)
    finally:
        aside.unlink(missing_ok=True)


PARTS = ".parts-"
"""Prefix of the folder next to a result with the parts of an interrupted run."""


def clear_parts(out: Path) -> None:
    """Remove the parts of finished and abandoned runs."""
    for folder in out.glob(f"{PARTS}*"):
        shutil.rmtree(folder, ignore_errors=True)


OWN = {
    ".svg": b"<dc:title>mixedlub</dc:title>",
    ".png": b"Software\x00mixedlub",
    ".pdf": b"/Creator (mixedlub)",
}
"""Mark of a drawing made by mixedlub, by format."""
EDITED = (b"inkscape", b"sodipodi")
"""Marks of a drawing edited afterwards."""
ENDS = 4096
"""Bytes at either end of a drawing that are searched for marks."""


def is_own(path: Path) -> bool:
    """Whether a file is an unedited drawing of an earlier run."""
    if path.suffix not in OWN or not path.is_file():
        return False
    with path.open("rb") as file:
        ends = file.read(ENDS)
        file.seek(max(file.tell(), path.stat().st_size - ENDS))
        ends += file.read()
    return OWN[path.suffix] in ends and not any(mark in ends for mark in EDITED)


def _take_along(before: Path, after: Path) -> None:
    """Copy files not written by an earlier run into the new folder."""
    for path in before.iterdir():
        kept = after / path.name
        if kept.exists() or is_own(path):
            continue
        if path.is_dir():
            shutil.copytree(path, kept, symlinks=True)
        else:
            shutil.copy2(path, kept, follow_symlinks=False)


def is_alive(process: str) -> bool:
    """Whether a process with this number runs on this machine."""
    if not process.isdigit():
        return False
    if sys.platform == "win32":
        # Signal 0, which POSIX only looks up, ends a process on Windows.
        import psutil

        return bool(psutil.pid_exists(int(process)))
    try:
        os.kill(int(process), 0)
    except (ProcessLookupError, OverflowError):
        return False
    except PermissionError:
        return True
    return True
