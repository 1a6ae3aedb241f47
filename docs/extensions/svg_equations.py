"""Formulas as SVG in the page, set as in the reports of the tool: no script, no font, no network."""

from __future__ import annotations

from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util import logging

from mixedlub.report.equations import equation

DISPLAY_SIZE = 20.0
log = logging.getLogger(__name__)


def _set(node: nodes.Element, tex: str, *size: float) -> str:
    found = equation(tex, *size)
    if found.startswith("<code>"):
        log.warning("this formula cannot be set: %s", tex, location=node)
    return found


def _inline(translator: Any, node: nodes.Element) -> None:
    translator.body.append(_set(node, " ".join(node.astext().split())))
    raise nodes.SkipNode


def _display(translator: Any, node: nodes.Element) -> None:
    tex = " ".join(node.astext().split()).replace(r"\frac", r"\dfrac")
    translator.body.append(f'<div class="display">{_set(node, tex, DISPLAY_SIZE)}</div>')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_html_math_renderer("svg", (_inline, None), (_display, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
