"""JSON Schema of the files, from the declarations of their keys; for completion and checks of TOML in editors."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator
from math import isfinite
from typing import Any

from mixedlub.evaluate import EVALUATIONS
from mixedlub.kinds import KINDS, kind
from mixedlub.report.file_classes import EVERY_CASE, FILES, file_class, file_title
from mixedlub.schema.section import FileTable, Key, Section, section_in
from mixedlub.schema.system_file import System
from profiles.errors import InputError, nearest

DIALECT = "https://json-schema.org/draft/2020-12/schema"
OWN = ("values", "unit", "alternative")
"""Marks of the declarations without an equivalent in JSON Schema."""
TYPES = {bool: "boolean", int: "integer", float: "number", str: "string", list: "array", tuple: "array", dict: "object"}


def json_schema(name: str) -> dict[str, Any]:
    """Schema of a kind of case, or of the file of a command or evaluation.

    >>> sorted(json_schema("viscosity")["properties"])[:4]
    ['base', 'boundary_friction', 'calibration', 'description']
    """
    if name not in (*KINDS, *FILES) and name not in EVALUATIONS:
        raise InputError(f"no such file; {nearest(name, (*KINDS, *FILES, *EVALUATIONS))}", where="KIND", value=name)
    file = System if name in KINDS else file_class(name)
    schema = file.model_json_schema(by_alias=True)
    definitions = schema.pop("$defs", {})
    inner = dict.fromkeys(_sections(file))
    for own, section in ((schema, file), *((definitions.get(one.__name__, {}), one) for one in inner)):
        _complete(own, section)
    if name in KINDS and kind(name).by_case is not None:
        _open(definitions)
    if name in KINDS:
        taken = _tables_of(name)
        nested = [key.name for key in FileTable(System, "", "").fields if section_in(key.type) is not None]
        for key in set(nested) - taken:
            del schema["properties"][key]
        schema["properties"]["kind"] = {**schema["properties"]["kind"], "const": name}
    title = f"a case of kind {name}" if name in KINDS else file_title(name).replace("`", "")
    return {"$schema": DIALECT, **schema, "title": title, "$defs": _used(schema, definitions)}


def _open(definitions: dict[str, Any]) -> None:
    """Inputs of any name, and a reading of any unit, in definitions of a kind whose columns depend on the case."""
    keys = {"value": {"type": "number"}, "sd": {"type": "number", "minimum": 0}, "unit": {"type": "string"}}
    value: dict[str, Any] = {"type": "object", "properties": keys, "required": ["value", "sd"]}
    value["additionalProperties"] = False
    uncertainty = definitions["Uncertainty"]
    uncertainty["properties"] = {}
    uncertainty["additionalProperties"] = {"anyOf": [{"type": "number", "minimum": 0}, value]}
    definitions["Recording"]["properties"]["unit"] = {"type": "string", "description": "unit of the reading"}


def _tables_of(name: str) -> set[str]:
    """Tables of `system.toml` accepted by a kind of case."""
    one = kind(name)
    return {section.partition(".")[0] for section in (*EVERY_CASE, "effects", *one.sections, *one.uses)}


def _sections(file: type[Section]) -> Iterator[type[Section]]:
    for key in FileTable(file, "", "").fields:
        inner = section_in(key.type)
        if inner is not None:
            yield inner
            yield from _sections(inner)


def _complete(schema: dict[str, Any], section: type[Section]) -> None:
    """Add units and ranges to the properties of a table, and leave open the additional input of its validators."""
    keys = FileTable(section, "", "").fields
    if any(key.is_alternative for key in keys):
        schema.pop("required", None)
    for key in keys:
        found = schema.get("properties", {}).get(key.name)
        if found is not None:
            schema["properties"][key.name] = _property(found, key)


def _property(found: dict[str, Any], key: Key) -> dict[str, Any]:
    form = {k: v for k, v in found.items() if k not in (*OWN, "title", "description", "default", "examples")}
    low, high = (-float("inf"), float("inf")) if key.range is None else key.range.possible
    numbers = [one for one in (form, *form.get("anyOf", [])) if one.get("type") in ("number", "integer")]
    for one in numbers:
        one |= {name: end for name, end in (("minimum", low), ("maximum", high)) if isfinite(end)}
    other = TYPES.get(type(key.example))
    declared = {one.get("type") for one in (form, *form.get("anyOf", []))}
    if declared <= {"array"} and not section_in(key.type):
        # Lists of conditions may be one number, or a table with the ends and the count.
        form = {"anyOf": [form, {"type": ["number", "object", "string"]}]}
    elif other and "$ref" not in json.dumps(form) and declared != {None} and other not in declared:
        form = {"anyOf": [form, {"type": other}]}
    meaning = f"{key.meaning} ({key.unit})" if key.unit else key.meaning
    kept: dict[str, Any] = {name: found[name] for name in ("default", "examples") if name in found}
    return {**form, "description": meaning, **kept}


def _used(schema: dict[str, Any], definitions: dict[str, Any]) -> dict[str, Any]:
    """Definitions referred to by a schema, directly or indirectly."""
    waiting, used = list(_references(schema)), set()
    while waiting:
        name = waiting.pop()
        if name not in used:
            used.add(name)
            waiting += _references(definitions[name])
    return {name: definitions[name] for name in sorted(used)}


def _references(schema: Any) -> Collection[str]:
    if isinstance(schema, dict):
        own = {schema["$ref"].rpartition("/")[2]} if "$ref" in schema else set()
        return own.union(*(_references(value) for value in schema.values()))
    if isinstance(schema, list):
        return set().union(*map(_references, schema))
    return set()
