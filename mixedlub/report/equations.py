"""Equations as inline SVG: TeX of docstrings, without scripts or network."""

from __future__ import annotations

import re
from functools import lru_cache
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.path import Path

SIZE = 17.0

_SMALL_FRACTION = re.compile(r"\\tfrac(?:\s*(\w)(\w))?(?![A-Za-z])")
_UNBRACED = re.compile(r"\\(sqrt|bar)\s*(\w)")
_SHORT = re.compile(r"\\(le|ge)(?![A-Za-z])")
_TEXT = re.compile(r"\\text\{([^{}]*)\}")
_GROWING = re.compile(r"\\(?:left|right|big[lr])(?![A-Za-z])")


@lru_cache(maxsize=512)
def equation(tex: str, size: float = SIZE) -> str:
    r"""A formula as an `svg` element on the baseline of the text; the TeX if it cannot be typeset.

    >>> equation(r"\mu = \tau / p_0")[:11], equation(r"\nosuchcommand")
    ('<svg class=', '<code>\\nosuchcommand</code>')
    """
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import TextPath, TextToPath

    text = f"${_simplified(tex)}$"
    font = FontProperties(size=size, math_fontfamily="stix")
    try:
        width, height, depth = TextToPath().get_text_width_height_descent(text, font, ismath=True)
        path = TextPath((0, 0), text, size=size, prop=font)
    except ValueError:
        return f"<code>{escape(tex)}</code>"
    pad = 0.06 * size
    box = f"{-pad:.2f} {-(height - depth) - pad:.2f} {width + 2 * pad:.2f} {height + 2 * pad:.2f}"
    style = f"width:{width + 2 * pad:.1f}px;height:{height + 2 * pad:.1f}px;vertical-align:{-depth - pad:.1f}px"
    return (
        f'<svg class="equation" role="img" aria-label="{escape(tex)}" viewBox="{box}" style="{style}">'
        f'<path d="{_drawing(path)}"/></svg>'
    )


def _simplified(tex: str) -> str:
    r"""TeX restricted to the commands of matplotlib.

    >>> _simplified(r"\tfrac43 E")
    '\\frac{4}{3} E'
    >>> _simplified(r"h \leftarrow \left(h\right)"), _simplified(r"\tfrac bR \le \sqrt b")
    ('h \\leftarrow (h)', '\\frac{b}{R} \\leq \\sqrt{b}')
    >>> _simplified(r"1\,\text{Pa s}")
    '1\\,\\mathrm{Pa\\ s}'
    """
    tex = _SHORT.sub(r"\\\1q", _UNBRACED.sub(r"\\\1{\2}", tex))
    tex = _SMALL_FRACTION.sub(lambda m: rf"\frac{{{m[1]}}}{{{m[2]}}}" if m[1] else r"\frac", " ".join(tex.split()))
    tex = _TEXT.sub(lambda m: r"\mathrm{" + m[1].replace(" ", r"\ ") + "}", tex)
    return _GROWING.sub("", tex).replace(r"\!", "")


def _drawing(path: Path) -> str:
    """SVG path data, with y pointing down."""
    letters = {1: "M", 2: "L", 3: "Q", 4: "C", 79: "Z"}
    parts = []
    for vertices, code in path.iter_segments(curves=True, simplify=False):
        letter = letters[int(code)]
        if letter == "Z":
            parts.append(letter)
            continue
        numbers = (f"{x:.2f} {-y:.2f}" for x, y in vertices.reshape(-1, 2))
        parts.append(letter + " ".join(numbers))
    return "".join(parts)
