"""Files of instruments that are not read are named for their format, with a way out."""

import pytest

from profiles import InputError, read
from profiles.maps import formats, read_map
from profiles.readers.foreign import FORMATS
from tests.profiles.test_text import HEIGHTS, POSITIONS, rows

MAGICS = [(one.name, magic) for one in FORMATS for magic in one.magics]
ENDINGS = [(one.name, ending) for one in FORMATS for ending in one.endings]
EXPORT = r"(install mixedlub\[formats\], or )?export it as x3p, SDF or text"


@pytest.fixture(params=[False, True], ids=["base", "extra"])
def extra(request, monkeypatch):
    """Without and with the optional readers."""
    if request.param:
        pytest.importorskip("SurfaceTopography")
    monkeypatch.setattr(formats, "is_installed", lambda: request.param)
    return request.param


@pytest.mark.parametrize("reader", [read, read_map])
@pytest.mark.parametrize(("name", "magic"), MAGICS)
@pytest.mark.parametrize("rest", [bytes(500), b"\r\nwords only\r\n"])
def test_first_bytes_name_the_format(tmp_path, reader, name, magic, rest, extra):
    (tmp_path / "surface.bin").write_bytes(magic + rest)
    with pytest.raises(InputError, match=f"{name}.*; (not read: )?{EXPORT}"):
        reader(tmp_path / "surface.bin")


@pytest.mark.parametrize("reader", [read, read_map])
@pytest.mark.parametrize(("name", "ending"), ENDINGS)
@pytest.mark.parametrize("data", [b"head\x00\x01\x02" * 90, b"words: none\n" * 9, b"1 2\n3 4\n5 6\n" + bytes(9)])
def test_the_ending_names_the_format_of_what_is_no_text_of_numbers(tmp_path, reader, name, ending, data, extra):
    (tmp_path / f"surface{ending.upper()}").write_bytes(data)
    with pytest.raises(InputError, match=f"{name}.*; (not read: )?{EXPORT}"):
        reader(tmp_path / f"surface{ending.upper()}")


def test_without_the_extra_its_formats_lead_to_it_and_others_to_an_export(tmp_path, monkeypatch):
    monkeypatch.setattr(formats, "is_installed", lambda: False)
    for name, way in (("a.sur", r"install mixedlub\[formats\], or export"), ("a.stl", "not read: export")):
        (tmp_path / name).write_bytes(b"head\x00\x01\x02" * 90)
        with pytest.raises(InputError, match=way):
            read_map(tmp_path / name)


def test_a_zip_with_an_ending_of_an_instrument(tmp_path):
    import zipfile

    with zipfile.ZipFile(tmp_path / "a.plux", "w") as archive:
        archive.writestr("index.xml", "<xml/>")
        archive.writestr("LAYER_0.raw", bytes(64))
    with pytest.raises(InputError, match="Sensofar"):
        read(tmp_path / "a.plux")


def test_a_document_is_told_from_a_surface_by_its_ending(tmp_path):
    (tmp_path / "a.mnt").write_bytes(b"DSCOMPRESSED" + bytes(99))
    with pytest.raises(InputError, match="MountainsMap document"):
        read(tmp_path / "a.mnt")


@pytest.mark.parametrize("ending", [".dat", ".pro", ".top"])
def test_text_is_read_whatever_its_ending(tmp_path, ending):
    (tmp_path / f"t{ending}").write_text("x_um,z_um\n" + rows(POSITIONS, HEIGHTS, ","))
    assert read(tmp_path / f"t{ending}").heights.size == 50
    (tmp_path / f"t{ending}").write_text("x_um,z_um\n0,1\n1,2\n2,abc\n3,4\n")
    with pytest.raises(InputError, match="line 4: 'abc': not a number"):
        read(tmp_path / f"t{ending}")
