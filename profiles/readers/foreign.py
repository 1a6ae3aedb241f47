"""Formats of instruments without a reader of the base: named by their first bytes or their ending, with a way out."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import PurePath

from profiles.errors import InputError
from profiles.readers.base import Source


@dataclass(frozen=True)
class Format:
    """A format of instruments: its readers in SurfaceTopography, if any, its name, first bytes and endings."""

    readers: str
    name: str
    magics: tuple[bytes, ...] = ()
    endings: tuple[str, ...] = ()


FORMATS = (
    Format("mnt", "a MountainsMap document", (), (".mnt",)),
    Format("sur", "a Digital Surf surface, compressed", (b"DSCOMPRESSED",)),
    Format("sur", "a Digital Surf surface or profile", (b"DIGITAL SURF",), (".sur", ".pro")),
    Format("al3d", "an Alicona height map", (b"AliconaImaging\x00\r\n",), (".al3d",)),
    Format("opd", "a Wyko height map", (b"\x01\x00Directory",), (".opd",)),
    Format("plu plux", "a Sensofar height map", (), (".plu", ".plux")),
    Format("vk", "a Keyence VK height map", (b"VK3_", b"VK4_", b"VK6", b"VK7"), (".vk3", ".vk4", ".vk6", ".vk7")),
    Format("zon", "a Keyence VR height map", (b"KPK",), (".zon",)),
    Format("datx", "a Zygo height map", (), (".datx",)),
    Format("nc", "a NetCDF file", (b"CDF\x01", b"CDF\x02", b"CDF\x05"), (".nc",)),
    Format("datx nc h5", "an HDF5 file", (b"\x89HDF\r\n\x1a\n",), (".h5", ".hdf5")),
    Format(
        "metropro", "a MetroPro height map", (b"\x88\x1b\x03\x6f", b"\x88\x1b\x03\x70", b"\x88\x1b\x03\x71"), (".dat",)
    ),
    Format("nms", "a NanoFocus height map", (), (".nms",)),
    Format("frt", "an FRT MicroProf height map", (b"FRTM_GLIDERV",), (".frt",)),
    Format("gwy", "a Gwyddion file", (b"GWYP", b"GWYO"), (".gwy",)),
    Format("ezd", "a Nanosurf file", (b"[DataSet]",), (".nid", ".ezd")),
    Format("wsxm", "a WSxM file", (b"WSxM file copyright",), (".stp", ".top")),
    Format("tmd", "a TrueMap height map", (b"TrueMap Data File v", b"Binary TrueMap Data File v"), (".tmd",)),
    Format("di", "a NanoScope file", (b"\\*File list", b"?*File list"), (".di", ".spm")),
    Format("os3d", "an OmniSurf3D height map", (b"OmniSurf3D",), (".os3d",)),
    Format("bcr", "an image of the BCR-STM format", (b"fileformat = bcr",), (".bcr", ".bcrf")),
    Format("ibw", "an Igor binary wave", (), (".ibw",)),
    Format("jpk", "a JPK image", (), (".jpk",)),
    Format("lext", "an Olympus LEXT height map", (), (".lext",)),
    Format("oir poir", "an Olympus height map", (), (".oir", ".poir")),
    Format("mdt", "an NT-MDT file", (b"\x01\xb0\x93\xff",), (".mdt",)),
    Format("mi", "a Keysight image", (b"fileType      Image",), (".mi",)),
    Format("zmg", "a Zeta height map", (), (".zmg",)),
    Format("mat", "a MATLAB file", (b"MATLAB 5.0 MAT-file", b"MATLAB 7.3 MAT-file"), (".mat",)),
    Format("npy", "a NumPy array", (b"\x93NUMPY",), (".npy",)),
    Format("ps jpk lext", "a TIFF image", (b"II*\x00", b"MM\x00*"), (".tif", ".tiff")),
    Format("", "a picture", (b"\x89PNG\r\n", b"\xff\xd8\xff", b"BM"), (".png", ".jpg", ".jpeg", ".bmp")),
    Format("", "a mesh", (b"solid ", b"ply\n", b"ply\r\n"), (".stl", ".ply", ".obj")),
)
"""First bytes after the file modules of Gwyddion and surfalize. For a format without known first bytes the ending
decides, before first bytes shared with another format."""


class ForeignFormat(InputError):
    """A file of a format without a reader of the base."""

    def __init__(self, found: Format, why: str, where: str) -> None:
        self.format = found
        extra = "install mixedlub[formats], or " if found.readers else ""
        super().__init__(f"{found.name}{why}; not read: {extra}export it as x3p, SDF or text", where=where)


def foreign(source: Source, *, by_ending: bool) -> ForeignFormat | None:
    """Error about a file of these formats, known by its first bytes or, with ``by_ending``, by its ending alone.

    >>> print(foreign(Source("a.sur", b"DSCOMPRESSED"), by_ending=False))
    a.sur: a Digital Surf surface, compressed; not read: install mixedlub[formats], or export it as x3p, SDF or text
    """
    ending = PurePath(source.bare).suffix.lower()
    begun = [one for one in FORMATS if one.magics and source.data.startswith(one.magics)]
    named = [one for one in FORMATS if ending in one.endings and not (begun and one.magics)]
    found = [*named, *begun] if begun or by_ending else []
    return ForeignFormat(found[0], "" if begun else " by its ending", source.where) if found else None
