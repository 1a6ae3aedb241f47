"""Results that appear whole or not at all: written aside, then renamed into place."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def writing(folder: Path) -> Iterator[Path]:
    """A folder beside the results to write into; its entries replace theirs when all are written.

    A folder gives way to its successor, but for files in it that no earlier run wrote: those stay.
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
    """Write files into a folder, by their path in it."""
    for name, content in contents.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """A name next to a file to write it to, which becomes the file when it is complete."""
    aside = path.with_suffix(f".{os.getpid()}")
    try:
        yield aside
        aside.replace(path)
    finally:
        aside.unlink(missing_ok=True)


PARTS = ".parts-"
"""Name, but for its end, of the folder next to a result that keeps what an interrupted run has done."""


def clear_parts(out: Path) -> None:
    """Remove the parts of finished and abandoned runs."""
    for folder in out.glob(f"{PARTS}*"):
        shutil.rmtree(folder, ignore_errors=True)


OWN = {
    ".svg": b"<dc:title>mixedlub</dc:title>",
    ".png": b"Software\x00mixedlub",
    ".pdf": b"/Creator (mixedlub)",
}
"""What a drawing of each format says that was made here."""
EDITED = (b"inkscape", b"sodipodi")
"""What a drawing says that was worked over since."""
ENDS = 4096
"""Bytes at either end of a drawing among which it says so."""


def is_own(path: Path) -> bool:
    """Whether a file is a drawing as an earlier run made it."""
    if path.suffix not in OWN or not path.is_file():
        return False
    with path.open("rb") as file:
        ends = file.read(ENDS)
        file.seek(max(file.tell(), path.stat().st_size - ENDS))
        ends += file.read()
    return OWN[path.suffix] in ends and not any(mark in ends for mark in EDITED)


def _take_along(before: Path, after: Path) -> None:
    """Copy what is not of an earlier run into the folder that takes the place."""
    for path in before.iterdir():
        kept = after / path.name
        if kept.exists() or is_own(path):
            continue
        if path.is_dir():
            shutil.copytree(path, kept, symlinks=True)
        else:
            shutil.copy2(path, kept, follow_symlinks=False)


def is_alive(process: str) -> bool:
    """Whether a process of this number runs on this machine."""
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
