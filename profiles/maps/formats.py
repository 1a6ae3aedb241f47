"""Formats of instruments by the library SurfaceTopography: the optional extra `mixedlub[formats]`."""

from __future__ import annotations

import io
import warnings
from dataclasses import replace
from importlib.util import find_spec

import numpy as np

from profiles.errors import InputError
from profiles.maps.base import make_map, own_steps
from profiles.maps.height_map import HeightMap
from profiles.profile import Profile
from profiles.readers.archive import check_archive, members
from profiles.readers.base import HoldsMap, Source, bridged, make_profile
from profiles.readers.foreign import Format
from profiles.readers.positions import sampled
from profiles.units import known_unit, metres


def is_installed() -> bool:
    """Whether the library of the extra is there."""
    return find_spec("SurfaceTopography") is not None


def read(source: Source, known: Format) -> HeightMap | Profile:
    """The map or line scan of an instrument's file of a known format.

    Units are those of the file; a file without units is refused unless the caller gives them.
    """
    if members(source.data):
        check_archive(source.data, source.where)
    errors = []
    for name in known.readers.split():
        try:
            return _read(source, known, name)
        except InputError:
            raise
        except Exception as error:  # the library raises anything on a damaged file
            errors.append((str(error).strip().splitlines() or [type(error).__name__])[0][:120])
    rule = f"{known.name}, damaged or of an unknown version ({errors[0]}); export it as x3p, SDF or text"
    raise InputError(rule, where=source.where)


def _read(source: Source, known: Format, name: str) -> HeightMap | Profile:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from SurfaceTopography.IO import open_topography

        with open_topography(io.BytesIO(source.data), format=name) as reader:
            told = _sizes(source, reader)
            found = reader.topography(**told)
            heights = np.ma.filled(np.ma.asarray(found.heights()).astype(float), np.nan)
            own, sizes = found.unit, found.physical_sizes
            positions = found.positions() if found.dim == 1 else None
    unit = known_unit(own or "")
    if told and source.unit is not None:  # the step of the caller is in metres
        source = replace(source, unit=("m", source.unit[1]))
    units = ("m" if told else unit, unit) if unit else source.unit
    if units is None:
        rule = f"{known.name} without units of length: give them as unit 'um' or 'mm, um' (place, height)"
        raise InputError(rule, where=source.where, value=own)
    origin: dict[str, object] = {"format": f"{known.name}, by SurfaceTopography"}
    if positions is not None:
        return _line(source, heights, np.asarray(positions, dtype=float), units, origin)
    steps = tuple(size / count for size, count in zip(sizes, heights.shape, strict=True))
    # the library counts along x first
    return make_map(source, heights.T, (steps[0], steps[1]), origin, units=units)


def read_map(source: Source, known: Format) -> HeightMap:
    """The map of an instrument's file; an error for a line scan."""
    found = read(source, known)
    if isinstance(found, HeightMap):
        return found
    raise InputError("holds a profile, not a height map", where=source.where)


def read_line(source: Source, known: Format) -> Profile:
    """The line scan of an instrument's file; an error that leads on for a map."""
    found = read(source, known)
    if isinstance(found, HeightMap):
        raise HoldsMap(source.where, found.heights.shape)
    return found


def _sizes(source: Source, reader: object) -> dict[str, tuple[float, ...]]:
    """Physical sizes from the step of the caller, for a file that has none."""
    channel = reader.channels[0]  # type: ignore[attr-defined]
    if channel.physical_sizes is not None:
        own_steps(source)
        return {}
    if source.spacing is None:
        rule = "the file has no steps: give them as spacing '0.5 um'"
        raise InputError(rule, where=source.where)
    return {"physical_sizes": tuple(count * source.spacing for count in channel.nb_grid_pts)}


def _line(
    source: Source, heights: np.ndarray, x: np.ndarray, units: tuple[str, str], origin: dict[str, object]
) -> Profile:
    present = np.isfinite(heights)
    found = sampled(x, bridged(heights, present, source.where), present, 0.0, source.where)
    place, height = map(metres, units)
    return make_profile(
        source, found.heights * height, found.step * place, origin, present=found.present, steps=found.notes
    )
