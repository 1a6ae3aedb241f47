"""Arrays of many contacts solved together: the first axis of every array is the contact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar

import numpy as np

Own = TypeVar("Own", bound="Batch")


@dataclass(frozen=True)
class Batch:
    """Base of dataclasses with fields that are arrays over contacts, or such dataclasses."""

    def take(self: Own, index: np.ndarray) -> Own:
        """Contacts at an index or mask."""
        return self.mapped(lambda value: value[index])

    def put(self: Own, index: np.ndarray, values: Own) -> None:
        """Overwrite the contacts at an index, in place."""
        for field in fields(self):
            own, new = getattr(self, field.name), getattr(values, field.name)
            if isinstance(own, Batch):
                own.put(index, new)
            else:
                own[index] = new

    def mapped(self: Own, change: Callable[[np.ndarray], np.ndarray]) -> Own:
        """Copy with a function applied to every array."""
        changed: dict[str, Any] = {}
        for field in fields(self):
            value = getattr(self, field.name)
            changed[field.name] = value.mapped(change) if isinstance(value, Batch) else change(value)
        return replace(self, **changed)
