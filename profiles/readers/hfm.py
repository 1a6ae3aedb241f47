"""HFM text export: position, height and a validity flag."""

from __future__ import annotations

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.base import Source, make_profile
from profiles.readers.numbers import decoded, table
from profiles.readers.positions import sampled
from profiles.units import metres


class HfmReader:
    """HFM: ``X;Y;valid`` over ``[mm];[mm];[1/0]``, then rows; invalid points are bridged and masked.

    Checked against the sample of SurfaceTopography.
    """

    name = "HFM"
    format = "HFM text, X;Y;valid"

    def magic(self, source: Source) -> bool:
        return source.data[:64].lstrip(b"\xef\xbb\xbf \r\n").lower().startswith(b"x;y;valid")

    def read(self, source: Source) -> Profile:
        content = table(decoded(source.data, source.where), source.where).alone(source.where)
        units = [cell.strip(" []") for cell in content.header[-1].split(";")] if content.header else []
        if content.columns.shape[0] != 3 or len(units) != 3:
            raise InputError("three columns with their units are needed", where=source.where, value=units)
        x, z, valid = content.columns
        if x.size < 3:
            raise InputError("a profile needs at least three heights", where=source.where, value=x.size)
        found = sampled(x, z * metres(units[1], source.where), valid != 0, content.quantum, source.where)
        step = found.step * metres(units[0], source.where)
        return make_profile(
            source, found.heights, step, {"format": self.format}, present=found.present, steps=found.notes
        )
