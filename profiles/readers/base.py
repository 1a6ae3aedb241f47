"""The interface of the readers, and the checks that all readers share."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import PurePath
from typing import Protocol

import numpy as np

from profiles.errors import InputError
from profiles.profile import Profile

MAX_BYTES = 512 * 2**20
MAX_POINTS = 20_000_000


@dataclass(frozen=True)
class Source:
    """An input file: its bytes, its name in messages, and the settings of the caller. ``unit``: units of position and
    height from the caller (None: as the file says); ``spacing``: step (m) from the caller."""

    where: str
    data: bytes
    unit: tuple[str, str] | None = None
    spacing: float | None = None

    @property
    def bare(self) -> str:
        """Name in messages, without the ending of a compressed file."""
        return re.sub(r"(?i)(?<=.)\.gz\Z", "", self.where)

    @property
    def name(self) -> str:
        return PurePath(self.bare).stem or self.where


class HoldsMap(InputError):
    """A height map in place of a trace."""

    def __init__(self, where: str, shape: tuple[int, ...]) -> None:
        file = PurePath(where).name
        size = " x ".join(map(str, shape))
        rule = (
            f'holds an areal map of {size} points, not a profile: name it as map = "{file}" of a surface in a study '
            f'or case, or cut a trace by profiles.image.along_direction(profiles.maps.read_map("{file}"), angle)'
        )
        super().__init__(rule, where=where)


class Reader(Protocol):
    """One file format. ``magic`` is cheap and never raises; ``read`` raises InputError and nothing else."""

    name: str
    format: str

    def magic(self, source: Source) -> bool: ...

    def read(self, source: Source) -> Profile: ...


@contextmanager
def foreign_parser(what: str, where: str) -> Iterator[None]:
    """Context around another project's parser: any exception on a damaged file becomes an InputError."""
    try:
        yield
    except InputError:
        raise
    except Exception as error:
        said = str(error).strip().splitlines()[0][:160] if str(error).strip() else type(error).__name__
        raise InputError(f"damaged {what} file ({said})", where=where) from None


def checked_count(count: int, available: int, where: str) -> int:
    """A declared number of points; an error, before memory is spent, if the file cannot hold it."""
    if not 3 <= count <= MAX_POINTS:
        raise InputError(f"the number of points must be from 3 to {MAX_POINTS}", where=where, value=count)
    if count > available:
        raise InputError(f"the file declares more points than it holds ({available})", where=where, value=count)
    return count


def bridged(heights: np.ndarray, present: np.ndarray, where: str) -> np.ndarray:
    """Heights with missing points bridged by straight lines; at least half must be present."""
    if present.all():
        return heights
    if 2 * np.count_nonzero(present) < heights.size or np.count_nonzero(present) < 3:
        raise InputError("more than half of the points are missing", where=where, value=int((~present).sum()))
    index = np.arange(heights.size)
    return np.interp(index, index[present], heights[present])


def make_profile(
    source: Source,
    heights: np.ndarray,
    spacing: float,
    origin: dict[str, object],
    *,
    present: np.ndarray | None = None,
    steps: tuple[str, ...] = (),
    cutoffs: dict[str, float] | None = None,
) -> Profile:
    """The profile of a file: heights and spacing in metres, missing points bridged and masked."""
    if heights.ndim != 1 or heights.size < 3:
        raise InputError("a profile needs at least three heights in one line", where=source.where, value=heights.shape)
    if not (math.isfinite(spacing) and 1e-12 < spacing < 1.0):
        raise InputError("the spacing must lie between 1 pm and 1 m", where=source.where, value=spacing)
    if present is None:
        present = np.ones(heights.size, bool)
    elif not present.all():
        steps = (*steps, f"{int((~present).sum())} missing points bridged and masked")
        heights = bridged(heights, present, source.where)
    bad = ~(np.abs(heights) < 1.0)
    if bad.any():
        row = int(bad.argmax())
        raise InputError(
            "heights must be finite and below 1 m",
            where=f"{source.where}: point {row + 1}",
            value=float(heights[row]),
        )
    told = source.spacing or spacing
    if abs(told / spacing - 1.0) > 1e-3:
        overruled = f"the file has a step of {spacing * 1e6:.6g} um, taken as {told * 1e6:.6g} um as told"
        origin = {**origin, "spacing_overruled": overruled}
    return Profile(
        heights,
        told,
        name=source.name,
        steps=steps,
        cutoffs=cutoffs or {},
        origin={"file": source.where, **origin},
        valid=present,
    )
