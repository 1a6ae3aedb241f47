"""TOML files: reading, validation with the place of each error, and formatting of values."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import chain
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from mixedlub.schema import messages
from mixedlub.schema.section import Key, Section, section_in
from profiles.errors import InputError, nearest, refuse_no_file

T = TypeVar("T", bound=Section)
Comments = Mapping[str, Sequence[str]]
"""Comment lines by the dotted name of their table; the empty name is the head of the file."""


def read_toml(path: Path) -> dict[str, Any]:
    """Content of the file; invalid TOML is an error."""
    try:
        refuse_no_file(path)
        text = path.read_text(encoding="utf-8-sig")
        return tomllib.loads(text)
    except InputError:
        raise
    except OSError as error:
        raise InputError(f"cannot be read ({error.strerror})", where=str(path)) from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(_unreadable(str(error), text.splitlines()), where=str(path)) from None
    except (UnicodeDecodeError, RecursionError) as error:
        raise InputError(f"is not readable as TOML ({error})", where=str(path)) from None
    except ValueError:
        # Python refuses to convert integers of thousands of digits.
        raise InputError("holds a whole number with too many digits", where=str(path)) from None


def _unreadable(error: str, lines: Sequence[str]) -> str:
    """Error message of invalid TOML; a duplicate key is named.

    >>> _unreadable("Cannot overwrite a value (at line 2, column 6)", ["a = 1", "a = 2"])
    "line 2 gives 'a' a second time; give it once"
    """
    twice = re.match(r"Cannot overwrite a value \(at line (\d+)", error)
    if twice is None:
        return f"is not readable as TOML ({error})"
    key = lines[int(twice[1]) - 1].partition("=")[0].strip()
    return f"line {twice[1]} gives {key!r} a second time; give it once"


def named_file(folder: Path, name: str, key: str) -> Path:
    """Path of a file named in a case or study, relative to its folder."""
    path = folder / name
    if path.is_dir():
        raise InputError("is a folder; name a file in it", where=key, value=name)
    if not path.is_file():
        near = sorted(p.name for p in path.parent.glob("*") if p.is_file())
        hint = f"; {nearest(path.name, near)}" if near else "; the file that names it may say where it comes from"
        raise InputError(f"no such file in {folder}{hint}", where=key, value=name)
    return path


def parse(model: type[T], data: Mapping[str, Any], where: str) -> T:
    """Validated section; the first error becomes a message with place, value and rule.

    Files named in the section are relative to the folder of ``where``.
    """
    try:
        return model.model_validate(data, context={"folder": Path(where).parent})
    except ValidationError as error:
        raise _refused(model, error.errors(), where) from None


@contextmanager
def keys_of(model: type[Section], path: Path) -> Iterator[None]:
    """Add the file to errors with a key as their place; errors about a table beside it are unchanged."""
    try:
        yield
    except InputError as error:
        place = re.fullmatch(r"(\w+)[^:,]*", error.where)
        if place is None or place[1] not in model.model_fields or (path.parent / error.where).is_file():
            raise
        raise InputError(error.rule, where=f"{path}: {error.where}", value=error.value) from None


def _refused(model: type[Section], errors: list[Any], where: str) -> InputError:
    """Error to report: another type of file first, then unknown keys, which explain missing keys."""
    other = (e for e in errors if e["loc"] == ("schema",) and e["type"] == "literal_error")
    unknown = (e for e in errors if e["type"] == "extra_forbidden")
    first = next(chain(other, unknown), errors[0])
    *table, last = first["loc"] or ("",)
    if first["type"] == "extra_forbidden":
        hint = nearest(str(last), _known_keys(model, table))
        return InputError(f"key is not known; {hint}", where=f"{where}: {messages.place(first['loc'])}")
    if first["type"] == "missing" and isinstance(last, int):
        needed = 1 + max(e["loc"][-1] for e in errors if e["loc"][:-1] == tuple(table))
        rule = f"needs {messages.counted(needed)}, not {last}"
        return InputError(rule, where=f"{where}: {messages.place(table)}", value=first["input"])
    shown = None if first["type"] == "missing" or isinstance(first["input"], dict) else first["input"]
    place = f"{where}: {messages.place(first['loc'])}" if first["loc"] else where
    return InputError(messages.rule(first), where=place, value=shown)


def _known_keys(model: type[Section], place: Sequence[Any]) -> list[str]:
    """Keys allowed at a place of the nested tables."""
    for part in place:
        field = model.model_fields.get(part)
        model = (None if field is None else section_in(field.annotation)) or model
    return [field.alias or name for name, field in model.model_fields.items()]


def toml_key(name: str) -> str:
    """Key in TOML notation.

    >>> toml_key("ground"), toml_key("Ra 0.4")
    ('ground', '"Ra 0.4"')
    """
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else toml_value(name)


def toml_value(value: Any) -> str:
    """Plain value, list or inline table in TOML notation.

    >>> toml_value([17, 26.0, float("inf")]), toml_value({"model": "ldp", "lead_crown_um": 3})
    ('[17, 26.0, inf]', '{ model = "ldp", lead_crown_um = 3 }')
    """
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        escaped = value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ")
        return f'"{escaped}"'
    if isinstance(value, list | tuple):
        return "[" + ", ".join(toml_value(v) for v in value) + "]"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{toml_key(k)} = {toml_value(v)}" for k, v in value.items()) + " }" if value else "{}"
    number = float(value)
    return str(int(value)) if isinstance(value, int) else repr(number)


def to_toml(data: Mapping[str, Any], place: str = "", *, comments: Comments | None = None) -> str:
    """TOML of nested tables, plain values first; the comments of a table follow its values.

    Comments of absent tables come at the end.

    >>> print(to_toml({"kind": "film", "contact": {"radius_mm": [9.5, float("inf")]}}))
    kind = "film"
    <BLANKLINE>
    [contact]
    radius_mm = [9.5, inf]
    <BLANKLINE>
    """
    below = comments or {}
    written: set[str] = set()
    text = _table(data, place, below, written)
    absent = ["\n" + "\n".join(lines) + "\n" for name, lines in below.items() if name not in written]
    return text + "".join(absent)


def _table(data: Mapping[str, Any], place: str, comments: Comments, written: set[str]) -> str:
    lines = [
        f"{toml_key(k)} = {toml_value(v)}" for k, v in data.items() if v is not None and not isinstance(v, Mapping)
    ]
    lines += comments.get(place, ())
    written.add(place)
    text = "\n".join(lines) + "\n" if lines else ""
    for key, v in data.items():
        if isinstance(v, Mapping):
            name = f"{place}.{toml_key(key)}" if place else toml_key(key)
            inner = _table(v, name, comments, written)
            plain = not v or any(not isinstance(x, Mapping) for x in v.values()) or comments.get(name)
            text += (f"\n[{name}]\n" if plain else "") + inner
    return text


def default_of(key: Key) -> str:
    """Default of a key in TOML notation; empty without an informative default."""
    value = key.field.default
    silent = key.required or value in (None, "", {}) or isinstance(value, Section)
    return "" if silent else toml_value(value)
