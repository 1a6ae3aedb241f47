"""SDF profiles (BCR-1.0, ISO-1.0, ISO-2.0; text and binary), by the library sdfio."""

from __future__ import annotations

import io

import numpy as np

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.base import HoldsMap, Source, foreign_parser, make_profile

_MAGICS = (b"aBCR-1.0", b"bBCR-1.0", b"aISO-1.0", b"bISO-1.0", b"aISO-2.0", b"bISO-2.0")
_NPL = b"aNPL-V1.0"


class SdfReader:
    """SDF with one profile; missing points bridged and masked.

    The softgauges of NPL carry the magic aNPL-V1.0 over a BCR-1.0 text and are read as such. Checked against
    the six profiles of sdfio's own samples; aNPL-V1.0 only on a constructed file after NPL's help page.
    """

    name = "SDF"
    format = "surface data file, BCR-1.0 and ISO 25178-71"

    def magic(self, source: Source) -> bool:
        return source.data.startswith((*_MAGICS, _NPL))

    def read(self, source: Source) -> Profile:
        import sdfio

        data = source.data
        if data.startswith(_NPL):
            data = b"aBCR-1.0" + data[len(_NPL) :]
        with foreign_parser("SDF", source.where):
            content = sdfio.read(io.BytesIO(data))
            heights = np.asarray(content.data, dtype=float)
            spacing = float(content.header.x_scale)
            maker = str(content.header.manufacturer_id).strip("\x00 ")
        if heights.ndim == 2 and heights.shape[0] != 1:
            raise HoldsMap(source.where, heights.shape)
        z = heights.ravel()
        if z.size < 3:
            raise InputError("a profile needs at least three heights", where=source.where, value=z.size)
        origin: dict[str, object] = {"format": self.format, "maker": maker}
        return make_profile(source, z, spacing, origin, present=np.isfinite(z))
