"""A zip archive that holds one readable profile among other files."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable
from dataclasses import replace

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.archive import ZIP_FAULTS, check_archive, members
from profiles.readers.base import Source
from profiles.readers.positions import RESAMPLED


class ZipReader:
    """Zip archive, such as a contact.engineering container, with a single profile among its members. An error names the
    members when none or more than one can be read. Checked against the container of SurfaceTopography (stylus text, AFM
    and TEM of one surface)."""

    name = "zip"
    format = "zip archive with one profile"

    def __init__(self, read_source: Callable[[Source], Profile]) -> None:
        self._read_source = read_source

    def magic(self, source: Source) -> bool:
        return bool(members(source.data))

    def read(self, source: Source) -> Profile:
        names = [name for name in members(source.data) if not name.endswith("/")]
        if len(names) > 100:
            raise InputError("at most 100 files in an archive are looked at", where=source.where, value=len(names))
        check_archive(source.data, source.where)
        found: dict[str, Profile] = {}
        with zipfile.ZipFile(io.BytesIO(source.data)) as archive:
            for name in names:
                try:
                    data = archive.read(name)
                except ZIP_FAULTS:
                    continue
                inner = Source(f"{source.where}/{name}", data, source.unit, source.spacing)
                if data[:4] == b"PK\x03\x04" or not data.strip():
                    continue
                try:
                    found[name] = self._read_source(inner)
                except InputError:
                    continue
        equal = {name: one for name, one in found.items() if not any(s.startswith(RESAMPLED) for s in one.steps)}
        if len(equal) == 1 < len(found):
            ((name, one),) = equal.items()
            return replace(one, steps=(*one.steps, f"{name} read: {len(found) - 1} more without equal steps"))
        if len(found) != 1:
            listed = ", ".join(list(found) or names)[:300]
            rule = "more than one profile in the archive" if found else "no profile in the archive"
            raise InputError(f"{rule}; it holds {listed}", where=source.where)
        return next(iter(found.values()))
