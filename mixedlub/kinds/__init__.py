"""Kinds of recording: a file each, with the columns and the chain that predicts the readings."""

from __future__ import annotations

from mixedlub.kinds.kind import Kind
from mixedlub.schema.discovery import declared
from profiles.errors import InputError, nearest


def kind(name: str, where: str = "kind") -> Kind:
    """Return a kind by name; the error for an unknown name gives the nearest known name and the place ``where``."""
    if name not in _KINDS:
        raise InputError(f"no such kind; {nearest(name, _KINDS)}", where=where, value=name)
    return _KINDS[name]


def _sorted() -> dict[str, Kind]:
    found = declared("mixedlub.kinds", "mixedlub.kinds", "KIND")
    return {one.name: one for one in sorted(found, key=lambda one: one.rank)}


_KINDS = _sorted()
KINDS = tuple(_KINDS)
"""Names of the kinds of this package and of plug-ins (entry points ``mixedlub.kinds``)."""
NATIVE = tuple(name for name, one in _KINDS.items() if one.by_case is None)
"""Names of the kinds with laws of this package, and with the same columns in every case, which an import recognises."""

__all__ = ["KINDS", "NATIVE", "Kind", "kind"]
