"""Bruker (Veeco) Dektak CSV."""

from __future__ import annotations

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.base import Source
from profiles.readers.numbers import decoded, table
from profiles.readers.text import read_table
from profiles.units import known_length


class DektakReader:
    """Dektak CSV: scan parameters, analytical results between cursors, then ``Scan Data``.

    The lateral column is rounded; the step is its length over its points. The results in the file go to ``origin``:
    they depend on cursors and are not compared. Checked against the sample of SurfaceTopography.
    """

    name = "Dektak CSV"
    format = "Bruker Dektak CSV"

    def magic(self, source: Source) -> bool:
        return source.data[:64].lstrip(b"\xef\xbb\xbf").startswith(b"Scan Parameters")

    def read(self, source: Source) -> Profile:
        header, found, body = decoded(source.data, source.where).partition("\nScan Data")
        if not found:
            raise InputError("cut off: no section 'Scan Data'", where=source.where)
        origin: dict[str, object] = {"format": self.format}
        for line in header.split("\n"):
            key, comma, value = line.partition(",")
            if comma and key:
                origin.setdefault(key.strip().lower(), value.strip())
        if radius := known_length(str(origin.get("stylus", "")).removeprefix("Radius:")):
            origin["tip_radius"] = radius
        return read_table(source, table(body, f"{source.where}: Scan Data"), origin)
