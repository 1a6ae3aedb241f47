"""Tables of a TOML file as classes with fields that describe the keys: type, default, meaning, example and range."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from types import NoneType, UnionType
from typing import Annotated, Any, Union, cast, get_args, get_origin

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    ValidationError,
    ValidationInfo,
    field_validator,
)
from pydantic.fields import FieldInfo
from pydantic_core import PydanticCustomError

from mixedlub.schema.messages import printable
from mixedlub.schema.ranges import Range, range_of, range_violation, ranges
from mixedlub.schema.shown import table_html
from mixedlub.schema.units import unit_of


def _number(value: Any) -> Any:
    if isinstance(value, (bool, str)):
        raise ValueError("must be a number")
    return value


def _whole(value: Any) -> Any:
    if isinstance(value, (bool, str)):
        raise ValueError("must be a whole number")
    return value


def _number_or_name(value: Any) -> Any:
    if not isinstance(value, str) and (isinstance(value, bool) or not isinstance(value, (int, float))):
        raise ValueError("must be a number")
    if not isinstance(value, str) and not isfinite(value):
        raise ValueError("must be a finite number")
    return value


def one_of(value: str, known: Iterable[str]) -> str:
    """Return a value of a choice known only when a file is read; raise an error with the known values otherwise."""
    *others, last = (repr(name) for name in known)
    if repr(value) not in (*others, last):
        expected = f"{', '.join(others)} or {last}" if others else last
        raise PydanticCustomError("literal_error", "Input should be {expected}", {"expected": expected})
    return value


Float = Annotated[float, BeforeValidator(_number)]
Number = Annotated[Float, Field(allow_inf_nan=False)]
Whole = Annotated[int, BeforeValidator(_whole)]
Flag = Annotated[bool, Field(strict=True)]
"""true or false, and no word or number that could stand for them."""
NumberOrName = Annotated[Any, BeforeValidator(_number_or_name)]
NAME = "NAME"
"""Placeholder for a user-given table name."""


def key(
    meaning: str,
    default: Any = ...,
    *,
    example: Any = None,
    values: Mapping[str, str] | None = None,
    unit: str = "",
    alternative: bool = False,
    **constraints: Any,
) -> Any:
    """Field that describes a key, which is required without a default.

    ``example``: value consistent with the examples of other keys, by default the default; ``values``: meaning of each
    value of a choice; ``alternative``: the key replaces other keys.
    """
    extra: dict[str, Any] = {"values": dict(values or {}), "unit": unit, "alternative": alternative}
    examples = None if example is None else [example]
    return Field(default=default, description=meaning, examples=examples, json_schema_extra=extra, **constraints)


class Section(BaseModel):
    """Table of a file: unknown keys are errors; values are immutable and within their range.

    Control characters in texts are escaped, so that no title or name commands a terminal.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    @field_validator("*")
    @classmethod
    def _possible(cls, value: Any, info: ValidationInfo) -> Any:
        within = range_of(cls.model_fields[str(info.field_name)])
        rule = "" if within is None or value is None else range_violation(within, value)
        if rule:
            raise ValueError(rule)
        return printable(value) if isinstance(value, str) else value

    def __repr_args__(self) -> Iterator[tuple[str, Any]]:
        """Keys with another value than their default, for a short repr."""
        for name, field in type(self).model_fields.items():
            value = getattr(self, name)
            if field.is_required() or value != field.get_default(call_default_factory=True):
                yield name, value

    def _repr_html_(self) -> str:
        """Table of a notebook: keys with another value than their default, with unit and meaning."""
        fields = type(self).model_fields
        rows = [
            (name, value, unit_of(name), (fields[name].description or "").partition(";")[0])
            for name, value in self.__repr_args__()
        ]
        return table_html(type(self).__name__.removesuffix("Section"), rows, ("key", "value", "unit", "meaning"))


def check_keys_of(section: Section, option: str, takes: Mapping[str, Sequence[str]]) -> None:
    """Raise an error for missing keys of the chosen value of an option and for keys without effect at this value."""
    chosen = getattr(section, option)
    for name in takes[chosen]:
        if getattr(section, name) is None:
            raise ValueError(f'{option} = "{chosen}" needs {name}')
    for name in sorted(section.model_fields_set):
        takers = [f'"{value}"' for value, names in takes.items() if name in names]
        unset = getattr(section, name) == type(section).model_fields[name].default
        if takers and name not in takes[chosen] and not unset:
            rule = f"{name} acts only with {option} = {' or '.join(takers)}"
            raise ValueError(f'{rule}; with {option} = "{chosen}" leave it out')


@dataclass(frozen=True)
class Key:
    """Key described by its field; ``table``: dotted name of its table."""

    table: str
    name: str
    field: FieldInfo

    @property
    def type(self) -> Any:
        """Type of the key: a class, or a tuple, dictionary or choice of such."""
        return plain(self.field.annotation)

    @property
    def required(self) -> bool:
        """Whether the key must be given."""
        return self.field.is_required()

    @property
    def meaning(self) -> str:
        """Meaning of the key without its unit."""
        return self.field.description or ""

    @property
    def example(self) -> Any:
        """Value consistent with the examples of the other keys of the table, or None."""
        if self.field.examples:
            return self.field.examples[0]
        return None if self.required or isinstance(self.field.default, (BaseModel, dict)) else self.field.default

    @property
    def unit(self) -> str:
        """Unit of the key, or empty."""
        return self._extra["unit"] or unit_of(self.name)

    @property
    def words(self) -> str:
        """Meaning of the key with its unit."""
        unit = unit_of(self.name)
        what, mark, rest = self.meaning.partition(";")
        return f"{what} ({unit}){mark}{rest}" if unit else self.meaning

    @property
    def values(self) -> Mapping[str, str]:
        """Meaning of each value of a choice."""
        return self._extra["values"]

    @property
    def is_alternative(self) -> bool:
        """Whether the key replaces other keys, so that their examples exclude its example."""
        return self._extra["alternative"]

    @property
    def is_looked_up(self) -> bool:
        """Whether the values are names of parts declared elsewhere."""
        return any(isinstance(m, AfterValidator) for m in self.field.metadata)

    @property
    def range(self) -> Range | None:
        """Possible and typical values of the key; for lists, of each entry."""
        return range_of(self.field)

    @property
    def _extra(self) -> dict[str, Any]:
        return cast(dict[str, Any], self.field.json_schema_extra)


@dataclass(frozen=True)
class FileTable:
    """Table of a file: class of its keys, meaning, and dotted name with NAME for user-given names."""

    model: type[Section]
    meaning: str
    title: str

    @property
    def name(self) -> str:
        """Dotted name without user-given names."""
        return self.title.replace(f".{NAME}", "")

    @property
    def fields(self) -> tuple[Key, ...]:
        """All keys of the table, nested tables included."""
        return tuple(Key(self.name, f.alias or name, f) for name, f in self.model.model_fields.items())

    def __getitem__(self, name: str) -> Key:
        """Key of a name."""
        return next(key for key in self.fields if key.name == name)

    @property
    def keys(self) -> tuple[Key, ...]:
        """Keys without nested tables, required keys first."""
        return tuple(sorted((k for k in self.fields if section_in(k.type) is None), key=lambda k: not k.required))


def plain(annotation: Any) -> Any:
    """Type without annotations and None.

    >>> plain(Number | None), plain(Annotated[tuple[int, ...], Field(min_length=1)])
    (<class 'float'>, tuple[int, ...])
    """
    origin = get_origin(annotation)
    if origin is Annotated:
        return plain(get_args(annotation)[0])
    if origin in (Union, UnionType):
        (one,) = (a for a in get_args(annotation) if a is not NoneType)
        return plain(one)
    return annotation


def section_in(annotation: Any) -> type[Section] | None:
    """Class of the table, or of named tables, in a type; None otherwise."""
    found = plain(annotation)
    if get_origin(found) is dict:
        found = get_args(found)[1]
    return found if isinstance(found, type) and issubclass(found, Section) else None


def tables(model: type[Section], meaning: str = "", title: str = "") -> Iterator[FileTable]:
    """Yield a table (empty title: the whole file) and all its nested tables."""
    own = FileTable(model, meaning, title)
    yield own
    for key in own.fields:
        inner = section_in(key.type)
        if inner is not None:
            named = f".{NAME}" if get_origin(key.type) is dict else ""
            yield from tables(inner, key.meaning, f"{title}.{key.name}".lstrip(".") + named)


def table(file: type[Section], name: str) -> FileTable:
    """Table of a dotted name without user-given names; StopIteration if unknown."""
    return next(found for found in tables(file) if found.name == name)


def with_ranges(file: type[Section]) -> None:
    """Assign every key of a file its range from the table of ranges."""
    for key in (key for table in tables(file) for key in table.fields):
        found = ranges().get(f"{key.table}.{key.name}".lstrip("."))
        if found is not None and key.range is None:
            key.field.metadata.append(found)


def examples(model: type[Section]) -> dict[str, Any]:
    """Mutually consistent examples of the keys of a table."""
    keys = FileTable(model, "", "").fields
    return {key.name: key.example for key in keys if key.example is not None and not key.is_alternative}


def needed(model: type[Section]) -> tuple[str, ...]:
    """Keys of a table required by the examples of the others; empty if the table may be empty."""
    if is_valid(model, {}):
        return ()
    every = examples(model)
    return tuple(key for key in every if not is_valid(model, {k: v for k, v in every.items() if k != key}))


def is_valid(model: type[Section], data: Mapping[str, Any]) -> bool:
    """Whether a table of exactly these keys is valid."""
    try:
        model.model_validate(data)
    except ValidationError:
        return False
    return True
