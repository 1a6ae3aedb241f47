"""Emulators kept in the cache folder of the user: found by oil, bodies and range, else built there."""

from __future__ import annotations

import os
import shutil
import sys
import zipfile
from functools import lru_cache
from hashlib import sha256
from pathlib import Path

from mixedlub.full_base.box import FACTORS, Box, contains, rounded, size
from mixedlub.full_base.emulator import Emulator, read, trained
from mixedlub.full_base.progress import mode
from mixedlub.full_base.solutions import Matter, drawn, solved

SOLUTIONS, WITH_FACTORS = 512, 1024
"""Judgement. Solutions of an emulator over conditions alone, and over properties of the oil too."""
CACHE = "MIXEDLUB_CACHE"
"""Environment variable that names another cache folder."""


def cache_folder() -> Path:
    """Cache folder of the user for this package."""
    if os.environ.get(CACHE):
        return Path(os.environ[CACHE])
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local") / "mixedlub"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches" / "mixedlub"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "mixedlub"


def emulator(matter: Matter, needed: Box, count: int | None = None) -> tuple[Emulator, bool]:
    """Emulator that covers a range, and whether it was built now; ``count``: solutions, by default enough.

    A kept emulator whose range contains the needed one is reused, the smallest first. Solutions are saved in parts, so
    that an interrupted run resumes.
    """
    folder = cache_folder() / "full_solutions" / matter.digest
    for path in sorted(folder.glob("*.npz")):
        if not _is_readable(path):
            path.unlink(missing_ok=True)
    fitting = [one for path in sorted(folder.glob("*.npz")) if contains((one := _kept(path)).box, needed)]
    if fitting:
        return min(fitting, key=lambda one: size(one.box)), False
    box = rounded(needed)
    count = count or (WITH_FACTORS if any(name in box for name in FACTORS) else SOLUTIONS)
    name = sha256(repr((sorted(box.items()), count)).encode()).hexdigest()[:16]
    parts, way = folder / f"parts-{name}", mode()
    contacts = drawn(matter, box, count)
    found = solved(matter, contacts, keep=parts, scheduler=way.scheduler, progress=way.progress)
    made = trained(matter, box, contacts, found)
    made.save(folder / f"{name}.npz")
    shutil.rmtree(parts, ignore_errors=True)
    return _kept(folder / f"{name}.npz"), True


@lru_cache(maxsize=16)
def _kept(path: Path) -> Emulator:
    """Emulator of a file, read once."""
    return read(path)


def _is_readable(path: Path) -> bool:
    """Whether a file holds an emulator."""
    try:
        _kept(path)
    except (OSError, ValueError, KeyError, TypeError, zipfile.BadZipFile):
        return False
    return True
