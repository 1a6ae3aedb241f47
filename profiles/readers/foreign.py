"""Formats of instruments without a reader: named by their first bytes or their ending, with a way out."""

from __future__ import annotations

from pathlib import PurePath

from profiles.errors import InputError
from profiles.readers.base import Source

FORMATS: tuple[tuple[str, tuple[bytes, ...], tuple[str, ...]], ...] = (
    ("a MountainsMap document", (), (".mnt",)),
    ("a Digital Surf surface, compressed", (b"DSCOMPRESSED",), ()),
    ("a Digital Surf surface or profile", (b"DIGITAL SURF",), (".sur", ".pro")),
    ("an Alicona height map", (b"AliconaImaging\x00\r\n",), (".al3d",)),
    ("a Wyko height map", (b"\x01\x00Directory",), (".opd",)),
    ("a Sensofar height map", (), (".plu", ".plux")),
    ("a Keyence VK height map", (b"VK3_", b"VK4_", b"VK6", b"VK7"), (".vk3", ".vk4", ".vk6", ".vk7")),
    ("a Keyence VR height map", (b"KPK",), (".zon",)),
    ("a Zygo height map", (), (".datx",)),
    ("an HDF5 file", (b"\x89HDF\r\n\x1a\n",), (".h5", ".hdf5")),
    ("a MetroPro height map", (b"\x88\x1b\x03\x6f", b"\x88\x1b\x03\x70", b"\x88\x1b\x03\x71"), (".dat",)),
    ("a NanoFocus height map", (), (".nms",)),
    ("an FRT MicroProf height map", (b"FRTM_GLIDERV",), (".frt",)),
    ("a Gwyddion file", (b"GWYP", b"GWYO"), (".gwy",)),
    ("a Nanosurf file", (b"[DataSet]",), (".nid",)),
    ("a WSxM file", (b"WSxM file copyright",), (".stp", ".top")),
    ("a TrueMap height map", (b"TrueMap Data File v", b"Binary TrueMap Data File v"), (".tmd",)),
    ("a NanoScope file", (b"\\*File list", b"?*File list"), (".di", ".spm")),
    ("an OmniSurf3D height map", (b"OmniSurf3D",), (".os3d",)),
)
"""Name, first bytes and endings; first bytes after the file modules of Gwyddion and surfalize. For a format without
known first bytes the ending decides, before first bytes shared with another format."""


def foreign(source: Source, *, by_ending: bool) -> InputError | None:
    """Error about a file of these formats, known by its first bytes or, with ``by_ending``, by its ending alone.

    >>> print(foreign(Source("a.sur", b"DSCOMPRESSED"), by_ending=False))
    a.sur: a Digital Surf surface, compressed; not read: export it as x3p, SDF or text
    """
    ending = PurePath(source.bare).suffix.lower()
    begun = [name for name, magics, _ in FORMATS if magics and source.data.startswith(magics)]
    named = [name for name, magics, endings in FORMATS if ending in endings and not (begun and magics)]
    found = [*named, *begun] if begun or by_ending else []
    if not found:
        return None
    why = "" if begun else " by its ending"
    return InputError(f"{found[0]}{why}; not read: export it as x3p, SDF or text", where=source.where)
