"""Conversion of TeX equations to a line of text for terminals."""

from __future__ import annotations

import re
from string import ascii_letters
from textwrap import fill

WIDTH, INDENT = 80, 16
"""Width of a page and of its column of names, in characters."""

SIGNS = {
    r"\qquad": "~ ",
    r"\quad": "~ ",
    r"\,": " ",
    r"\;": " ",
    r"\ ": " ",
    r"\!": "",
    r"\cdot": "·",
    r"\times": "×",
    r"\leftarrow": "←",
    r"\rightarrow": "→",
    r"\propto": "∝",
    r"\leq": "≤",
    r"\geq": "≥",
    r"\le": "≤",
    r"\ge": "≥",
    r"\pm": "±",
    r"\infty": "∞",
    r"\int": "∫",
    r"\sum": "Σ",
    r"\sqrt": "√",
    r"\partial": "∂",
    r"\nabla": "∇",
    r"\ell": "ℓ",
    r"\ast": "*",
    r"\langle": "⟨",
    r"\rangle": "⟩",
}
LETTERS = (
    "alpha beta gamma delta epsilon zeta eta theta kappa lambda mu nu xi pi rho sigma tau phi varphi chi psi omega "
    "Gamma Delta Theta Lambda Sigma Phi Psi Omega"
)
GREEK = dict(zip(LETTERS.split(), "αβγδεζηθκλμνξπρστφφχψωΓΔΘΛΣΦΨΩ", strict=True))


def plain_equation(latex: str) -> str:
    r"""A LaTeX equation as a line of text.

    >>> plain_equation(r"h \leftarrow h\,\frac{1 - a}{1 + b\,L^{0.64}}")
    'h ← h ((1 - a)/(1 + b L^0.64))'
    """
    text = re.sub(r"\\(?:left|right|[bB]igg?[lr]?)(?![a-zA-Z])", "", " ".join(latex.split()))
    text = re.sub(r"\\[dt]?frac(\d)(\d)", r"\\frac{\1}{\2}", text).replace(r"^\circ", "°")
    text = text.replace(r"\{", "(").replace(r"\}", ")")
    while (found := re.search(r"\\[dt]?frac(?![a-zA-Z])\s*", text)) is not None:
        over, rest = _argument(text, found.end())
        under, end = _argument(text, rest)
        ratio = "½" if (over, under) == ("1", "2") else f"{_bracketed(over)}/{_bracketed(under)}"
        before = re.sub(r"(\\quad|\\,|\\;|\\ )\s*$", "", text[: found.start()].rstrip()).rstrip()
        after = re.sub(r"^(\\,|\\;|\s)+", "", text[end:])
        alone = not before or before[-1] in "=,([{+-<>" or before.endswith(r"\leftarrow")
        if ratio != "½" and not (alone and re.match(r"$|[-+=,)\]}]|\\(quad|pm|text|leq?|geq?| )", after)):
            ratio = f"({ratio})"
        text = f"{text[: found.start()]}{ratio}{text[end:]}"
    text = re.sub(r"\\bar\s*\{?\s*(\w)\}?", "\\1\u0304", text)
    text = re.sub(r"\\(?:mathrm|text|operatorname|mathit)\s*\{([^{}]*)\}", r" \1 ", text)
    for sign, plain in SIGNS.items():
        text = re.sub(re.escape(sign) + (r"(?![a-zA-Z])" if sign[-1].isalpha() else ""), plain, text)
    text = re.sub(r"(?<=_\w)(?=\\[a-zA-Z])", " ", text)
    text = re.sub(r"\\([a-zA-Z]+)", lambda m: GREEK.get(m[1], f" {m[1]} "), text)
    text = re.sub(r"([α-ω])(?=[α-ω])", r"\1 ", text)
    text = re.sub(r"(_\s*\{(?=[^\W\d_]+\})|[_^]\s*\{(?=(?:\w|\*|-?[\d.]+)\}))([^}]*)\}", lambda m: m[1][0] + m[2], text)
    text = text.replace("{", "(").replace("}", ")")
    text = re.sub(r"(?<=[(\[]) +| +(?=[)\],^_])", "", re.sub(r" +", " ", text))
    text = re.sub(r"\b(a?sinh|cosh|tanh|sin|cos|ln|log|exp|sgn|min|max) (?=[(\[])", r"\1", text)
    text = re.sub(r" ?/ ?", "/", text)
    return text.replace(" ~", "  ").replace("~", " ").replace("° C", "°C").strip()


def plain_symbol(symbol: str) -> str:
    """A symbol of the glossary as text.

    >>> plain_symbol("omega_1"), plain_symbol("E'"), plain_symbol("epsilon_alpha")
    ('ω_1', "E'", 'ε_α')
    """
    return re.sub(r"[A-Za-z]+", lambda m: GREEK.get(m[0], m[0]), symbol)


def with_symbol(name: str, symbol: str) -> str:
    """A name followed by its symbol.

    >>> with_symbol("coefficient", "Λ"), with_symbol("path", "")
    ('coefficient (Λ)', 'path')
    """
    return f"{name} ({symbol})" if symbol else name


def _argument(text: str, start: int) -> tuple[str, int]:
    """Argument of a LaTeX command at ``start`` (braces, a command or a character), and the position after it."""
    while text[start : start + 1] == " ":
        start += 1
    if text[start] == "\\":
        end = len(text) - len(text[start + 1 :].lstrip(ascii_letters))
        return text[start:end], end
    if text[start] != "{":
        return text[start], start + 1
    depth = 0
    for i in range(start, len(text)):
        depth += {"{": 1, "}": -1}.get(text[i], 0)
        if depth == 0:
            return text[start + 1 : i], i + 1
    return text[start + 1 :], len(text)


def _bracketed(text: str) -> str:
    return text if re.fullmatch(r"\\?[a-zA-Z0-9.]+'?(_(\w|\{\w+\}))?", text) else f"({text})"


def entry(name: str, text: str, indent: int = INDENT) -> str:
    """A line of a page: name and wrapped text."""
    begin, rest = f"{name:{indent}}", " " * indent
    return fill(
        text, WIDTH, initial_indent=begin, subsequent_indent=rest, break_long_words=False, break_on_hyphens=False
    )
