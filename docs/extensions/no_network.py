"""A page that would load anything from another host breaks the build; links that a reader may follow are fine."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx
from sphinx.util import logging

log = logging.getLogger(__name__)

LOADED = re.compile(
    r"""<(?:script|img|iframe|source|video|audio|object|embed)\b[^>]*\b(?:src|data)=["']?(?:https?:)?//"""
    r"""|<link\b(?![^>]*\brel=["']?(?:canonical|author|license))[^>]*\bhref=["']?(?:https?:)?//"""
    r"""|url\(\s*["']?(?:https?:)?//|@import\s+["'](?:https?:)?//""",
    re.IGNORECASE,
)
"""What a browser fetches by itself."""


def loads_from_outside(text: str) -> bool:
    """Whether a page or style sheet makes a browser fetch from another host.

    >>> loads_from_outside('<script src="https://cdn.example/x.js">'), loads_from_outside('<a href="https://x.org">')
    (True, False)
    """
    return LOADED.search(text) is not None


def _look(app: Sphinx, error: Exception | None) -> None:
    for path in sorted(Path(app.outdir).rglob("*")):
        if path.suffix in (".html", ".css") and loads_from_outside(path.read_text(encoding="utf-8")):
            log.warning("%s loads something from another host", path.relative_to(app.outdir))


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("build-finished", _look)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
