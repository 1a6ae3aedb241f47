"""x3p profiles (ISO 25178-72), by the library x3pio."""

from __future__ import annotations

import io

import numpy as np

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.archive import check_archive, members
from profiles.readers.base import HoldsMap, Source, foreign_parser, make_profile
from profiles.readers.positions import sampled


class X3pReader:
    """x3p with feature type PRF: binary or XML heights, points without a value bridged and masked.

    Of several layers the first is read, and ``steps`` says so. Checked against the four profiles of x3pio's
    own samples.
    """

    name = "x3p"
    format = "x3p profile, ISO 25178-72"

    def magic(self, source: Source) -> bool:
        return "main.xml" in members(source.data)

    def read(self, source: Source) -> Profile:
        check_archive(source.data, source.where)
        import x3pio

        with foreign_parser("x3p", source.where):
            content = x3pio.read(io.BytesIO(source.data))
            if isinstance(content, x3pio.Surface):
                raise HoldsMap(source.where, np.asarray(content.layers[0].z).shape)
            if not isinstance(content, x3pio.Profile):
                kind = type(content).__name__.lower()
                raise InputError(f"holds a {kind}, not a profile: export a profile or a height map", where=source.where)
            layers = content.layers
            x = np.asarray(layers[0].x, dtype=float).ravel()
            z = np.asarray(layers[0].z, dtype=float).ravel()
            regular = bool(content.is_regular_grid)
            increment = content.header.x.increment
        if z.size < 3:
            raise InputError("a profile needs at least three heights", where=source.where, value=z.size)
        steps = (f"layer 1 of {len(layers)} read",) if len(layers) > 1 else ()
        present = np.isfinite(z)
        step = float(increment or 0.0)
        if not (regular and step):
            found = sampled(x, z, present, 0.0, source.where)
            z, present, step, steps = found.heights, found.present, found.step, (*steps, *found.notes)
        return make_profile(source, z, step, {"format": self.format}, present=present, steps=steps)
