"""Names of columns, explanations and equations as a reader expects them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

UNITS = {
    "per_GPa": "1/GPa",
    "percent": "%",
    "mPa_s": "mPa s",
    "m_s": "m/s",
    "MPa": "MPa",
    "rpm": "rpm",
    "deg": "°",
    "Nm": "N m",
    "nm": "nm",
    "um": "µm",
    "N": "N",
    "W": "W",
    "C": "°C",
    "s": "s",
}
"""Ending of a column's name and the unit it stands for, longer endings first."""

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


def unit_of(column: str) -> str:
    """The unit at the end of a column's name; empty where it has none.

    >>> unit_of("oil_temperature_C"), unit_of("entrainment_speed_m_s"), unit_of("slide_roll_ratio")
    ('°C', 'm/s', '')
    """
    return next((unit for ending, unit in UNITS.items() if column.endswith(f"_{ending}")), "")


def words_of(column: str) -> str:
    """A column's name in words, without its unit.

    >>> words_of("oil_temperature_C"), words_of("slide_roll_ratio")
    ('oil temperature', 'slide-roll ratio')
    """
    ending = next((e for e in UNITS if column.endswith(f"_{e}")), "")
    words = column.removesuffix(f"_{ending}").replace("_", " ")
    return words.replace("slide roll", "slide-roll").replace("pressure viscosity", "pressure-viscosity")


def axis_label(column: str) -> str:
    """Words and unit for the axis of a figure.

    >>> axis_label("torque_Nm"), axis_label("friction_coefficient")
    ('torque (N m)', 'friction coefficient (-)')
    """
    return f"{words_of(column)} ({unit_of(column) or '-'})"


def amount(value: float, column: str) -> str:
    """A number with its column's unit.

    >>> amount(2000.0, "speed_rpm"), amount(0.1, "slide_roll_ratio")
    ('2000 rpm', '0.1')
    """
    unit = unit_of(column)
    return f"{_four(value)}{'' if unit in ('', '°') else ' '}{unit}"


def _four(value: float) -> str:
    return f"{value:.0f}" if 1e4 <= abs(value) < 1e7 else f"{value:.4g}"


def number(value: float) -> str:
    """A number to three digits, without needless ones.

    >>> number(0.10412), number(1234.5), number(169.9), number(0.0)
    ('0.104', '1234', '170', '0')
    """
    return f"{value:.0f}" if 100 <= abs(value) < 1e6 else f"{value:.3g}"


def conditions_text(conditions: Mapping[str, float | str]) -> str:
    """The conditions of one reading in words.

    >>> conditions_text({"torque_Nm": 50.0, "pinion_surface": "ground"})
    'torque 50 N m, pinion surface ground'
    """
    return ", ".join(
        f"{words_of(name)} {value if isinstance(value, str) else amount(value, name)}"
        for name, value in conditions.items()
    )


def range_text(cut: Mapping[str, Any]) -> str:
    """One cut of a region in words.

    >>> range_text({"column": "speed_rpm", "low": 2000.0, "high": 3000.0})
    'speed 2000 to 3000 rpm'
    """
    name = cut["column"]
    if "values" in cut:
        return f"{words_of(name)} {' or '.join(cut['values'])}"
    if cut["low"] == cut["high"]:
        return f"{words_of(name)} {amount(cut['low'], name)}"
    return f"{words_of(name)} {_four(cut['low'])} to {amount(cut['high'], name)}"


def effect_words(name: str) -> str:
    """An effect's id in words.

    >>> effect_words("inlet_shear_heating")
    'inlet shear heating'
    """
    special = {"none": "nothing missing", "unknown": "something outside the catalogue", "micro_ehl": "micro-EHL"}
    return special.get(name, name.replace("_", " "))


def explanation_words(names: Sequence[str]) -> str:
    """An explanation in words.

    >>> explanation_words(["churning", "sensor_offset"])
    'churning and sensor offset'
    """
    return " and ".join(effect_words(name) for name in names)


def plain_equation(latex: str) -> str:
    r"""An equation's LaTeX as a line of text.

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
        if ratio != "½" and before and before[-1] not in "=,([{+-<>" and not before.endswith(r"\leftarrow"):
            ratio = f"({ratio})"
        text = f"{text[: found.start()]}{ratio}{text[end:]}"
    text = re.sub(r"\\bar\s*\{?\s*(\w)\}?", "\\1\u0304", text)
    text = re.sub(r"\\(?:mathrm|text|operatorname|mathit)\s*\{([^{}]*)\}", r" \1 ", text)
    for sign, plain in SIGNS.items():
        text = re.sub(re.escape(sign) + (r"(?![a-zA-Z])" if sign[-1].isalpha() else ""), plain, text)
    text = re.sub(r"\\([a-zA-Z]+)", lambda m: GREEK.get(m[1], f" {m[1]} "), text)
    text = re.sub(r"(_\s*\{(?=[^\W\d_]+\})|[_^]\s*\{(?=(?:\w|\*|-?[\d.]+)\}))([^}]*)\}", lambda m: m[1][0] + m[2], text)
    text = text.replace("{", "(").replace("}", ")")
    text = re.sub(r"(?<=[(\[]) +| +(?=[)\],^_])", "", re.sub(r" +", " ", text))
    text = re.sub(r"\b(a?sinh|cosh|tanh|sin|cos|ln|log|exp|sgn) (?=[(\[])", r"\1", text)
    return text.replace(" ~", "  ").replace("~", " ").replace("° C", "°C").strip()


def _argument(text: str, start: int) -> tuple[str, int]:
    """What a LaTeX command takes from ``start`` on, and the place after it: braces, a command or one sign."""
    while text[start : start + 1] == " ":
        start += 1
    if text[start] == "\\":
        end = start + 1 + len(re.match(r"[a-zA-Z]*", text[start + 1 :])[0])  # type: ignore[index]
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
