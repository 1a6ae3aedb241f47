"""Maps in x3p files (ISO 25178-72), by the library x3pio."""

from __future__ import annotations

import numpy as np

from profiles.errors import InputError
from profiles.maps.base import make_map, own_steps
from profiles.maps.height_map import HeightMap
from profiles.readers.archive import check_archive, members
from profiles.readers.base import Source, foreign_parser

NAME = "x3p"


def magic(source: Source) -> bool:
    """Whether the content is an x3p archive."""
    return "main.xml" in members(source.data)


def read(source: Source) -> HeightMap:
    """The first layer of an x3p surface on a regular grid; lengths in metres, as the standard says."""
    own_steps(source)
    check_archive(source.data, source.where)
    import x3pio

    with foreign_parser("x3p", source.where):
        content = x3pio.X3pFile.loads(source.data)
        spacings = (content.header.x.increment, content.header.y.increment)
        layers = content.layers
        heights = np.asarray(layers[0].z, dtype=float)
    if not all(spacings):
        raise InputError("holds no regular height map", where=source.where, value=heights.shape)
    steps = (f"layer 1 of {len(layers)} read",) if len(layers) > 1 else ()
    return make_map(source, heights, spacings, {"format": "x3p surface, ISO 25178-72"}, steps=steps)
