"""The profile: heights at equal spacing, and the steps of their processing."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import wraps
from inspect import signature
from types import MappingProxyType
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike

from profiles.errors import InputError, refuse_masked, refuse_other

Function = TypeVar("Function", bound=Callable[..., Any])


def frozen(values: ArrayLike, kind: type) -> np.ndarray:
    """The values as a read-only array: the same object if already read-only and owner of its numbers, else a copy.

    >>> z = np.zeros(3)
    >>> frozen(z, float) is z, frozen(frozen(z, float), float).flags.writeable
    (False, False)
    """
    if isinstance(values, np.ndarray) and values.dtype == kind and values.base is None and not values.flags.writeable:
        return values
    copy: np.ndarray = np.array(values, dtype=kind)
    copy.flags.writeable = False
    return copy


@dataclass(frozen=True, eq=False)
class Profile:
    """A measured or synthetic trace: heights (m) at equal spacing (m); immutable.

    ``valid`` is False where a point was masked (dropout, spike, scratch) and bridged; ``steps``: processing of the
    heights, in order; ``cutoffs``: filter limits (m) already applied (``cutoff``, ``short_cutoff``); ``origin``:
    statements of the file about itself. Keys of ``origin`` with an effect, in the same spelling for every reader:

    ``stated``: parameters the file prints beside its heights, by ISO symbol (``Rq``, ``Pq``), lengths in m, ratios in
    percent, the rest as printed; ``stated_short_cutoff``: the low-pass (m) before the stated parameters, if the heights
    are stored before it; ``stated_filtered``: whether roughness is stated beside unfiltered heights; ``convention``:
    convention of the parameters; ``sampling_lengths``: number of sampling lengths in the instrument's means;
    ``tip_radius``: of the stylus (m).

    >>> p = Profile(np.array([0.0, 1e-6, 0.0]), 0.5e-6, name="peak")
    >>> p.length, p.steps
    (1e-06, ())
    """

    heights: np.ndarray
    spacing: float
    name: str = "profile"
    steps: tuple[str, ...] = ()
    cutoffs: Mapping[str, float] = field(default_factory=dict)
    origin: Mapping[str, object] = field(default_factory=dict)
    valid: np.ndarray = None  # type: ignore[assignment]  # left out it is all True, from construction on

    def __post_init__(self) -> None:
        where = f"profile {self.name!r}"
        refuse_masked(self.heights, where)
        try:
            heights, spacing = frozen(self.heights, float), float(self.spacing)
        except (TypeError, ValueError):
            rule = "heights and spacing must be numbers, in metres"
            raise InputError(rule, where=where, value=(self.heights, self.spacing)) from None
        if heights.ndim != 1 or heights.size < 3:
            raise InputError("a profile needs at least three heights in one line", where=where, value=heights.shape)
        if not np.isfinite(heights).all():
            first = int(np.flatnonzero(~np.isfinite(heights))[0])
            raise InputError(
                "heights must be finite numbers", where=f"{where}, point {first + 1}", value=heights[first]
            )
        if not (np.isfinite(spacing) and spacing > 0):
            raise InputError("spacing must be above zero", where=where, value=self.spacing)
        valid = frozen(np.ones(heights.size, bool) if self.valid is None else self.valid, bool)
        if valid.shape != heights.shape:
            raise InputError("the mask must be as long as the heights", where=where, value=valid.shape)
        object.__setattr__(self, "heights", heights)
        object.__setattr__(self, "spacing", spacing)
        object.__setattr__(self, "valid", valid)
        object.__setattr__(self, "cutoffs", MappingProxyType(dict(self.cutoffs)))
        object.__setattr__(self, "origin", MappingProxyType(dict(self.origin)))

    @property
    def positions(self) -> np.ndarray:
        """Distance along the trace from its first point (m)."""
        return np.arange(self.heights.size) * self.spacing

    @property
    def length(self) -> float:
        """Distance from the first point to the last (m)."""
        return float((self.heights.size - 1) * self.spacing)

    def after(self, step: str, heights: np.ndarray, **changes: Any) -> Profile:
        """The profile with new heights and one more step in its history."""
        return replace(self, heights=heights, steps=(*self.steps, step), **changes)


def of_profile(function: Function) -> Function:
    """Wrap a function of a `Profile` to reject any other first argument: heights alone have no spacing."""
    name = next(iter(signature(function).parameters))
    place = f"{function.__module__.partition('.')[0]}.{function.__name__}"

    @wraps(function)
    def checked(*args: Any, **keys: Any) -> Any:
        given = args[:1] or ((keys[name],) if name in keys else ())
        if given:
            refuse_other(given[0], Profile, "profiles.Profile(heights, spacing)", f"{place}: {name}")
        return function(*args, **keys)

    return cast(Function, checked)
