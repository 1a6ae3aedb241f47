"""The two exceptions meant for users."""

from __future__ import annotations

import difflib
import os
from collections.abc import Iterable
from pathlib import Path


class InputError(ValueError):
    """Bad input: the message names the file, the place, the value and the rule.

    >>> raise InputError("torque must be above zero", where="study.toml: torque_Nm[1]", value=0.0)
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: study.toml: torque_Nm[1]: 0.0: torque must be above zero
    """

    def __init__(self, rule: str, *, where: str = "", value: object = None) -> None:
        self.rule, self.where, self.value = rule, where, value
        shown = "" if value is None else repr(value).replace("\n", " ")[:80]
        super().__init__(": ".join(part for part in (where, shown, rule) if part))


def as_path(given: object, where: str) -> Path:
    """Path of a text or a path; anything else is an error at the place ``where``.

    >>> as_path(None, "read")
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: read: needs a path, as text or pathlib.Path, not None
    """
    named = os.fspath(given) if isinstance(given, str | os.PathLike) else None
    if not isinstance(named, str):
        raise InputError(f"needs a path, as text or pathlib.Path, not {given!r:.80}", where=where)
    return Path(named)


def refuse_other(given: object, kind: type, made: str, where: str) -> None:
    """Raise an error at the place ``where`` if an argument is of another type; ``made`` names the type for the message.

    >>> refuse_other("study.toml", int, "a whole number", "mesh: points")
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: mesh: points: needs a whole number, not str
    """
    if not isinstance(given, kind):
        raise InputError(f"needs {made}, not {type(given).__name__}", where=where)


def refuse_masked(given: object, where: str) -> None:
    """Raise an error if entries of an array are masked: as plain numbers they would count.

    >>> import numpy as np
    >>> refuse_masked(np.ma.array([1.0, 9.0], mask=[False, True]), "torque_Nm")
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: torque_Nm: has 1 masked entry; leave masked entries out
    """
    add_up = getattr(getattr(given, "mask", None), "sum", None)
    count = int(add_up()) if callable(add_up) else 0
    if count:
        entries = "entry" if count == 1 else "entries"
        raise InputError(f"has {count} masked {entries}; leave masked entries out", where=where)


def refuse_no_file(path: Path) -> None:
    """Raise an error if a path leads to no regular file: reading a pipe or a device never ends."""
    if not path.exists():
        raise InputError("no such file", where=str(path))
    if path.is_dir():
        raise InputError("is a folder; name the files in it", where=str(path))
    if not path.is_file():
        raise InputError("is a special file (a pipe or a device), which is not read", where=str(path))


class RunError(RuntimeError):
    """A run stopped by other causes than its input: the message states the cause and how to go on."""


def nearest(name: str, known: Iterable[str]) -> str:
    """Hint with the known word closest to a misspelt word, or with all known words.

    >>> nearest("torqe_Nm", ["torque_Nm", "speed_rpm"])
    "nearest known: 'torque_Nm'"
    >>> nearest("m4", ["m2", "m4_per_um2"])
    "nearest known: 'm4_per_um2'"
    >>> nearest("iso4287", ["ISO 21920-2:2021", "ISO 4287:1997"])
    "nearest known: 'ISO 4287:1997'"
    """
    words = sorted(known)
    sought, bare = _bare(str(name)), {_bare(word): word for word in words}
    begun = [word for word in bare if len(sought) > 1 and word.startswith(sought)]
    close = sorted(begun, key=len)[:1] or difflib.get_close_matches(sought, bare, n=1, cutoff=0.5)
    if close:
        return f"nearest known: {bare[close[0]]!r}"
    return "known: " + ", ".join(words)


def _bare(word: str) -> str:
    """The letters and digits of a word, without case."""
    return "".join(letter for letter in word.casefold() if letter.isalnum())
