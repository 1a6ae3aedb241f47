"""Answers looked at when they are given: whether system.toml would take them, by themselves."""

from __future__ import annotations

import re
from typing import Any

from mixedlub.importers.draft import EVERY
from mixedlub.schema import system_file, toml_file
from mixedlub.schema.section import examples, tables
from profiles.errors import InputError

BARE = re.compile(r"[-+.\deinf]+(\s*,\s*[-+.\deinf]+)+")
"""Numbers with commas between, as a list is typed without its brackets."""


def is_list(example: str, reply: str) -> bool:
    """Whether a reply is a list without its brackets, where one is asked for.

    >>> is_list("[206.0, 206.0]", "206, 75"), is_list("[206.0, 206.0]", "[206, 75]"), is_list("0.1", "0,2")
    (True, False, False)
    """
    return example.startswith("[") and BARE.fullmatch(reply.strip()) is not None


def refuse_wrong(key: str, value: Any) -> None:
    """An error, at its key, about an answer that system.toml would not take whatever else it says.

    >>> refuse_wrong("contact.radius_mm", [9.5])
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: contact.radius_mm: [9.5]: needs 2 entries, not 1
    """
    if key == EVERY.key and (not isinstance(value, int) or isinstance(value, bool) or value < 1):
        raise InputError("must be a whole number of at least 1", where=key, value=value)
    section, _, last = key.rpartition(".")
    found = next((t for t in tables(system_file.System) if section and t.name == section), None)
    if found is None or last not in found.model.model_fields:
        return
    try:
        toml_file.parse(found.model, {**examples(found.model), last: value}, section)
    except InputError as error:
        raise InputError(error.rule, where=key, value=value) from None
