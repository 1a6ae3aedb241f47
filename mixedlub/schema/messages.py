"""Messages on invalid keys of a TOML file, in terms of the file."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any
from unicodedata import category

from profiles.errors import nearest

RULES = {
    "missing": "is missing",
    "tuple_type": "must be a list: [..., ...]",
    "list_type": "must be a list: [..., ...]",
    "float_type": "must be a number",
    "float_parsing": "must be a number",
    "int_type": "must be a whole number",
    "int_parsing": "must be a whole number",
    "int_parsing_size": "must be a whole number of usual size",
    "int_from_float": "must be a whole number",
    "finite_number": "must be a finite number",
    "greater_than": "must be above {gt:g}",
    "greater_than_equal": "must be at least {ge:g}",
    "less_than": "must be below {lt:g}",
    "less_than_equal": "must be at most {le:g}",
    "bool_type": "must be true or false",
    "string_type": 'must be text: "..."',
    "model_type": "must be a table of keys",
    "dict_type": "must be a table of keys",
    "model_attributes_type": "must be a table of keys",
}
"""Rule for each type of pydantic validation error."""


def place(loc: Sequence[Any]) -> str:
    """Place in the file, table first.

    >>> place(("gears", "teeth", 1)), place(("surfaces", "Ground", "m0_um2"))
    ('gears.teeth, entry 2', 'surfaces.Ground.m0_um2')
    """
    keys = ".".join(part for part in loc if isinstance(part, str))
    return ", ".join([keys, *(f"entry {part + 1}" for part in loc if isinstance(part, int))])


def rule(error: Mapping[str, Any]) -> str:
    """Rule violated by a value."""
    kind, values = error["type"], error.get("ctx", {})
    if kind == "literal_error":
        return _one_of(error["input"], values["expected"])
    if kind == "too_short":
        return f"needs at least {counted(values['min_length'])}"
    if kind == "too_long":
        return f"needs {counted(values['max_length'])}, not {values['actual_length']}"
    if kind in RULES:
        return RULES[kind].format(**values)
    text = error["msg"].removeprefix("Value error, ").replace("Input should be", "must be")
    return text[:1].lower() + text[1:]


OF_OPTIONS = {
    "Input should be greater than or equal to": "must be at least",
    "Input should be less than or equal to": "must be at most",
    "Input should be a valid number, unable to parse string as a number": "must be a number",
    "Input should be a valid integer, unable to parse string as an integer": "must be a whole number",
    "Input should be": "must be",
    "Invalid value for '": "'",
}


def of_option(text: str) -> str:
    """Message on a command-line option, in the words used for keys.

    >>> of_option("Invalid value for '--cutoff-mm': Input should be greater than or equal to 0.000001")
    "'--cutoff-mm': must be at least 0.000001"
    """
    for words, replacement in OF_OPTIONS.items():
        text = text.replace(words, replacement)
    return text


def counted(count: int) -> str:
    """Count of entries in words.

    >>> counted(1), counted(2)
    ('1 entry', '2 entries')
    """
    return f"{count} {'entry' if count == 1 else 'entries'}"


def _one_of(value: object, expected: str) -> str:
    known = re.findall(r"'([^']*)'", expected)
    hint = nearest(str(value), known)
    return f"must be {expected}" + (f"; {hint}" if len(known) > 1 and hint.startswith("nearest") else "")


def printable(text: str) -> str:
    r"""Text with control characters escaped, which could command the terminal in a title or name.

    >>> printable("red \x1b[31m, next\nline")
    'red \\x1b[31m, next\nline'
    """
    return "".join(repr(c)[1:-1] if category(c) == "Cc" and c not in "\n\t" else c for c in text)
