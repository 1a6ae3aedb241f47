"""The contract of every reader, and what it does with files that are cut, lie or attack."""

import io
import struct
import sys
import zipfile

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from profiles import InputError, Profile, read
from profiles.read import READERS, read_source
from profiles.readers.base import Source
from roughness.parameters import CONVENTIONS
from tests.profiles import samples

BUILT = {name: build() for name, (build, _) in samples.SAMPLES.items()}
HURRIED = settings(max_examples=30, deadline=2000, suppress_health_check=list(HealthCheck))


def opened(name, data):
    """A profile or an InputError: the only two ends a file may come to."""
    try:
        return read_source(Source(name, data))
    except InputError:
        return None


def test_every_reader_has_a_sample():
    assert {name for _, name in samples.SAMPLES.values()} == {reader.name for reader in READERS}


@pytest.mark.parametrize("reader", READERS, ids=lambda r: r.name)
def test_reader_says_its_name_and_format_and_what_it_was_checked_against(reader):
    assert reader.name
    assert reader.format
    assert "hecked" in (type(reader).__doc__ or "") or "worked out from" in (type(reader).__doc__ or "")


@pytest.mark.parametrize("name", BUILT)
def test_sample_is_taken_by_its_own_reader(name):
    source = Source(name, BUILT[name])
    assert next(r for r in READERS if r.magic(source)).name == samples.SAMPLES[name][1]


@pytest.mark.parametrize("name", BUILT)
def test_sample_gives_its_heights_and_spacing(name, tmp_path):
    file = tmp_path / name
    file.write_bytes(BUILT[name])
    profile = read(file)
    assert profile.heights == pytest.approx(samples.HEIGHTS, abs=1e-15)
    assert profile.spacing == pytest.approx(samples.STEP, rel=1e-9)
    assert profile.name == file.stem or name == "box.zip"
    assert profile.valid.all()
    file.unlink()  # left open, it could not be removed everywhere


@pytest.mark.parametrize("name", BUILT)
@HURRIED
@given(data=st.data())
def test_truncated_file_ends_in_a_profile_or_an_input_error(name, data):
    whole = BUILT[name]
    opened(name, whole[: data.draw(st.integers(0, len(whole) - 1))])


@pytest.mark.parametrize("name", BUILT)
@HURRIED
@given(data=st.data())
def test_damaged_file_ends_in_a_profile_or_an_input_error(name, data):
    whole = bytearray(BUILT[name])
    for _ in range(data.draw(st.integers(1, 6))):
        place = data.draw(st.integers(0, len(whole) - 1))
        whole[place] = data.draw(st.integers(0, 255))
    profile = opened(name, bytes(whole))
    if profile is not None:
        assert isinstance(profile, Profile)
        assert np.isfinite(profile.heights).all()


@HURRIED
@given(data=st.binary(max_size=400), name=st.sampled_from([*BUILT, "bytes.bin"]), keep=st.integers(0, 24))
def test_random_bytes_end_in_a_profile_or_an_input_error(data, name, keep):
    opened(name, BUILT.get(name, b"")[:keep] + data)


@HURRIED
@given(text=st.text(alphabet="0123456789.,;-+eE \t\nNaninfxum[]:#", max_size=200))
def test_random_text_ends_in_a_profile_or_an_input_error(text):
    opened("text.txt", text.encode())


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("trace.prf", samples.prf().replace(b"6.000000e+001", b"6.000000e+009"), "number of points must be"),
        ("trace.prf", samples.prf().replace(b"6.000000e+001", b"7.000000e+001"), "declares more points"),
        ("trace.prf", samples.prf().replace(b"CZ M 6", b"CZ M 5"), "declares 50 points"),
        ("trace.smd", samples.smd().replace(b" 60 ", b" 99 "), "declares 99 and 99 points"),
        ("trace.smd", samples.smd().replace(b"CX\0 I", b"CX\0 A"), "only equally spaced"),
        ("npl.sdf", samples.npl_sdf().replace(b"NumPoints = 60", b"NumPoints = 600000000"), "SDF"),
        ("binary.sdf", samples.binary_sdf()[:42] + b"\xff" * 4 + samples.binary_sdf()[46:], "SDF"),
        ("softgauge.xml", samples.nist_xml(points=10**9), "number of points must be"),
        ("softgauge.xml", samples.nist_xml(points=61), "declares more points"),
        ("softgauge.xml", samples.nist_xml().replace(b"<UNITS>um", b"<UNITS>volt"), "not a unit of length"),
        ("softgauge.xml", samples.nist_xml().replace(b"0.05000\n", b"nan\n"), "finite"),
        ("scan.opdx", samples.opdx(count=2**60), "number of points must be"),
        ("scan.opdx", samples.opdx(count=61), "declares more points"),
        ("trace.tx3", b"cut-off 0.8", "holds settings"),
        ("report.xlsx", samples.mitutoyo(unit="mV"), None),
    ],
)
def test_lying_header_gets_a_message(name, data, message):
    if message is None:
        assert read_source(Source(name, data)).heights.size == 60
        return
    with pytest.raises(InputError, match=message):
        read_source(Source(name, data))


ENTITIES = b"<!DOCTYPE x [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;'>]>"


def bomb(member, size=300 * 2**20):
    """A zip of a few hundred kB whose member unpacks to zeros of the given size."""
    buffer = io.BytesIO()
    with (
        zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive,
        archive.open(member, "w") as out,
    ):
        for _ in range(size // 2**20):
            out.write(bytes(2**20))
    return buffer.getvalue()


@pytest.mark.parametrize(
    ("name", "member"), [("a.x3p", "main.xml"), ("a.xlsx", "xl/workbook.xml"), ("a.zip", "trace.txt")]
)
def test_zip_bomb_is_refused_in_little_memory(name, member):
    import tracemalloc

    data = bomb(member)
    tracemalloc.start()
    with pytest.raises(InputError, match="unpacks to more than"):
        read_source(Source(name, data))
    assert tracemalloc.get_traced_memory()[1] < 64 * 2**20
    tracemalloc.stop()


def with_entities(data):
    """The archive with entities declared in each of its XML members."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(buffer, "w") as new:
        for item in old.infolist():
            content = old.read(item)
            if item.filename.endswith(".xml"):
                content = ENTITIES + content
            new.writestr(item.filename, content)
    return buffer.getvalue()


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("a.xml", samples.nist_xml().replace(b'<!DOCTYPE DATA SYSTEM "data.dtd">', ENTITIES)),
        ("a.x3p", with_entities(samples.x3p())),
        ("a.xlsx", with_entities(samples.mitutoyo())),
    ],
)
def test_xml_entities_are_refused(name, data):
    with pytest.raises(InputError, match="entities are not allowed"):
        read_source(Source(name, data))


def test_missing_points_are_bridged_and_masked():
    data = samples.hfm().decode().split("\r\n")
    data[12] = data[12][:-1] + "0"
    profile = read_source(Source("scan.hfm", "\r\n".join(data).encode()))
    assert np.flatnonzero(~profile.valid).tolist() == [10]
    assert profile.heights[10] == pytest.approx((samples.HEIGHTS[9] + samples.HEIGHTS[11]) / 2)
    assert any("bridged" in step for step in profile.steps)


def test_mostly_missing_profile_is_refused():
    rows = samples.hfm().decode().replace(";1\r\n", ";0\r\n").encode()
    with pytest.raises(InputError, match="more than half of the points are missing"):
        read_source(Source("scan.hfm", rows))


def test_instrument_values_are_kept_beside_the_heights():
    profile = read_source(Source("report.xlsx", samples.mitutoyo()))
    assert profile.origin["stated"] == {"Ra": pytest.approx(0.191e-6)}
    assert dict(profile.cutoffs) == {"cutoff": pytest.approx(0.08e-3)}


@pytest.mark.parametrize("name", BUILT)
def test_what_the_file_says_goes_by_the_agreed_names(name):
    origin = read_source(Source(name, BUILT[name])).origin
    assert all(isinstance(v, float) for v in dict(origin.get("stated", {})).values())
    for key in ("stated_short_cutoff", "tip_radius"):
        assert 0 < origin.get(key, 1e-6) < 1e-3
    assert isinstance(origin.get("sampling_lengths", 1), int)
    assert origin.get("convention", "NIST") in CONVENTIONS


@pytest.mark.parametrize(("name", "radius"), [("dektak.csv", 2.5e-6), ("trace.prf", 2e-6)])
def test_tip_radius_is_kept(name, radius):
    assert read_source(Source(name, BUILT[name])).origin["tip_radius"] == pytest.approx(radius)


def test_unknown_tip_is_no_reason_to_refuse_a_trace():
    data = BUILT["trace.prf"].replace(b"STYLUS_RADIUS 2.000000e-003 MM", b"STYLUS_RADIUS not known")
    assert "tip_radius" not in read_source(Source("trace.prf", data)).origin


def test_areal_map_is_not_taken_for_a_profile():
    head = samples.binary_sdf()
    data = head[:42] + struct.pack("<HH", 30, 2) + head[46:]
    with pytest.raises(InputError, match="areal map"):
        read_source(Source("map.sdf", data))


def test_archive_with_two_traces_names_them():
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr("left.txt", samples.text())
        archive.writestr("right.txt", samples.text())
    with pytest.raises(InputError, match=r"it holds left\.txt, right\.txt"):
        read_source(Source("box.zip", buffer.getvalue()))


def test_file_larger_than_the_limit_is_not_opened(tmp_path, monkeypatch):
    monkeypatch.setattr(sys.modules["profiles.read"], "MAX_BYTES", 10)
    file = tmp_path / "large.txt"
    file.write_bytes(bytes(11))
    with pytest.raises(InputError, match="larger than 10 bytes"):
        read(file)


@pytest.mark.parametrize("name", ["trace.x3p", "report.xlsx", "box.zip"])
def test_cut_off_archive_is_called_so(name):
    with pytest.raises(InputError, match="damaged or unsupported zip archive"):
        read_source(Source(name, BUILT[name][: len(BUILT[name]) // 2]))
