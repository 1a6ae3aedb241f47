"""Signatures of functions that take the keys of a file, so that notebooks complete them."""

from __future__ import annotations

from collections.abc import Callable
from inspect import Parameter, signature
from typing import TypeVar

from mixedlub.schema.section import Section

Function = TypeVar("Function", bound=Callable[..., object])


def with_keys_of(section: type[Section], without: str = "") -> Callable[[Function], Function]:
    """Decorator that replaces ``**keys`` in the signature of a function by the keys of a table of a file.

    ``without``: key that the function takes as its first argument.

    >>> class Bearing(Section):
    ...     bore_mm: float
    ...     rows: int = 1
    >>> str(signature(with_keys_of(Bearing)(lambda **keys: None)))
    '(*, bore_mm, rows=1)'
    """

    def named(function: Function) -> Function:
        given = signature(function)
        first = [one for one in given.parameters.values() if one.kind is not Parameter.VAR_KEYWORD]
        keys = [
            Parameter(
                name,
                Parameter.KEYWORD_ONLY,
                default=Parameter.empty if field.is_required() else field.get_default(call_default_factory=True),
            )
            for name, field in section.model_fields.items()
            if name != without
        ]
        function.__signature__ = given.replace(parameters=[*first, *keys])  # type: ignore[attr-defined]
        return function

    return named
