"""Kinds of recording: one a file, each saying what its rows hold and which chain predicts them."""

from __future__ import annotations

import importlib
from functools import cache

from mixedlub.kinds.kind import Kind
from mixedlub.schema.system_file import KINDS


@cache
def kind(name: str) -> Kind:
    """The kind of a name of the contract."""
    if name not in KINDS:
        raise KeyError(name)
    return importlib.import_module(f"mixedlub.kinds.{name}").KIND


__all__ = ["Kind", "kind"]
