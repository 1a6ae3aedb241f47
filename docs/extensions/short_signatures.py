"""Signatures with ``**keys``: pages list the keys of a file in tables, notebooks complete them."""

from __future__ import annotations

from inspect import isfunction
from typing import Any

from sphinx.application import Sphinx


def _as_written(app: Sphinx) -> None:
    """Leave the keys of files out of the signatures of public functions, as these are written."""
    import mixedlub

    for name in dir(mixedlub):
        function = getattr(mixedlub, name)
        while isfunction(function):
            function.__dict__.pop("__signature__", None)
            function = getattr(function, "__wrapped__", None)


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("builder-inited", _as_written)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
