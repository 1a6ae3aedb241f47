"""Kinds of recording: one a file, each saying what its rows hold and which chain predicts them."""

from __future__ import annotations

from mixedlub.kinds.kind import Kind
from mixedlub.schema.discovery import declared
from profiles.errors import InputError, nearest


def kind(name: str, where: str = "kind") -> Kind:
    """The kind of a name, or an error that names the nearest known one and the place ``where`` the name was given."""
    if name not in _KINDS:
        raise InputError(f"no such kind; {nearest(name, _KINDS)}", where=where, value=name)
    return _KINDS[name]


def _sorted() -> dict[str, Kind]:
    found = declared("mixedlub.kinds", "mixedlub.kinds", "KIND")
    return {one.name: one for one in sorted(found, key=lambda one: one.rank)}


_KINDS = _sorted()
KINDS = tuple(_KINDS)
"""Names of the kinds of this package and of those that other packages offer as ``mixedlub.kinds``."""

__all__ = ["KINDS", "Kind", "kind"]
