"""Signatures with ``**keys``: pages list the keys of a file in tables, notebooks complete them."""

from __future__ import annotations

from typing import Any

from sphinx.application import Sphinx


def _as_written(app: Sphinx, function: Any, bound_method: bool) -> None:
    """Leave the keys of a file out of a signature, as the function is written."""
    while function is not None:
        own = getattr(function, "__dict__", None)
        if isinstance(own, dict):
            own.pop("__signature__", None)
        function = getattr(function, "__wrapped__", None)


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("autodoc-before-process-signature", _as_written, priority=400)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
