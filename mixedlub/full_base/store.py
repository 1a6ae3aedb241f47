"""Emulators kept in the cache folder of the user: found by oil, bodies and range, else built there."""

from __future__ import annotations

import os
import sys
import zipfile
from functools import cache, lru_cache
from hashlib import sha256
from pathlib import Path

from mixedlub import laws
from mixedlub.full_base.box import FACTORS, Box, contains, rounded, size
from mixedlub.full_base.emulator import Emulator, read, trained
from mixedlub.full_base.progress import mode
from mixedlub.full_base.solutions import Matter, drawn, hash_of, solved

SOLUTIONS, WITH_FACTORS = 640, 1024
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

    A kept emulator over a range that contains the needed one is reused, the smallest first. Solutions are kept in
    parts: an interrupted run resumes, and another version of the emulator is fitted to them.
    """
    folder = cache_folder() / "full_solutions" / matter.digest
    every = (_kept(path) for path in sorted(folder.glob(f"*-{fit_fingerprint()}.npz")))
    fitting = [one for one in every if one is not None and contains(one.box, needed)]
    if fitting:
        return min(fitting, key=lambda one: size(one.box)), False
    box = rounded(needed)
    count = count or (WITH_FACTORS if any(name in box for name in FACTORS) else SOLUTIONS)
    name, way = sha256(repr((sorted(box.items()), count)).encode()).hexdigest()[:16], mode()
    contacts = drawn(matter, box, count)
    found = solved(matter, contacts, keep=folder / name, scheduler=way.scheduler, progress=way.progress)
    made = trained(matter, box, contacts, found)
    made.save(folder / f"{name}-{fit_fingerprint()}.npz")
    return made, True


@cache
def fit_fingerprint() -> str:
    """Hash of the code on which an emulator of given solutions depends."""
    own = (Path(__file__).with_name(name) for name in ("emulator.py", "gaussian_process.py"))
    return hash_of((*own, *sorted(Path(str(laws.__file__)).parent.rglob("*.py"))))[:16]


@lru_cache(maxsize=16)
def _kept(path: Path) -> Emulator | None:
    """Emulator of a file, read once; None for a spoilt file."""
    try:
        return read(path)
    except (OSError, ValueError, KeyError, TypeError, zipfile.BadZipFile):
        return None
