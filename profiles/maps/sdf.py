"""Maps in SDF files (ISO 25178-71; text and binary), by the library sdfio."""

from __future__ import annotations

import numpy as np

from profiles.errors import InputError
from profiles.maps.base import make_map, own_steps
from profiles.maps.height_map import HeightMap
from profiles.readers.base import Source, foreign_parser

NAME = "SDF"


def magic(source: Source) -> bool:
    """Whether the content begins as an SDF file."""
    return source.data[1:5] in (b"BCR-", b"ISO-")


def read(source: Source) -> HeightMap:
    """The map of an SDF file; lengths in metres, as the standard says."""
    own_steps(source)
    import sdfio

    with foreign_parser("SDF", source.where):
        surface = sdfio.SdfFile.loads(source.data)
        spacings = (surface.header.x_scale, surface.header.y_scale)
        heights = np.asarray(surface.data, dtype=float)
    if not all(spacings):
        raise InputError("holds no regular height map", where=source.where, value=heights.shape)
    return make_map(source, heights, spacings, {"format": "surface data file, ISO 25178-71"})
