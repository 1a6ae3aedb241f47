"""Laws whose arguments have other names in a chain."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from functools import wraps
from typing import Any


def renamed(law: Callable[..., Any], names: Mapping[str, str]) -> Callable[..., Any]:
    """A law with some of its arguments renamed; the law itself if it has none of them.

    >>> tuple(inspect.signature(renamed(lambda m0, load: m0, {"m0": "film_m0"})).parameters)
    ('film_m0', 'load')
    """
    own = inspect.signature(law)
    if not names.keys() & own.parameters.keys():
        return law

    @wraps(law)
    def same(*values: Any) -> Any:
        return law(*values)

    same.__signature__ = own.replace(  # type: ignore[attr-defined]
        parameters=[a.replace(name=names.get(name, name)) for name, a in own.parameters.items()]
    )
    return same
