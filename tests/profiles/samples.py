"""A small file of every format, built from its layout: 60 points every 0.5 um, heights in HEIGHTS (m)."""

import io
import struct
import zipfile

import numpy as np

STEP = 0.5e-6
HEIGHTS = np.round(0.3 * np.sin(np.arange(60) / 4.0) + 0.05 * np.cos(np.arange(60)), 5) * 1e-6
UM = HEIGHTS * 1e6


def text():
    return "".join(f"{i * 0.5:.1f}\t{z:.5f}\n" for i, z in enumerate(UM)).join(["x_um\tz_um\n", ""]).encode()


def hfm():
    rows = "".join(f"{i * 0.0005:.6f};{z * 1e-3:.8f};1\r\n" for i, z in enumerate(UM))
    return ("X;Y;valid\r\n[mm];[mm];[1/0]\r\n" + rows).encode()


def dektak():
    rows = "".join(f"{i * 0.5:.1f},{z:.5f},,\r\n" for i, z in enumerate(UM))
    head = "Scan Parameters\r\r\nScan Type,Standard Scan\r\nStylus,Radius: 2.5 µm\r\n\r\r\n"
    return (head + "Scan Data\r\r\nLateral um,Raw Micrometer,\r\n" + rows).encode("latin-1")


def surfcom():
    return "".join(f"{i * 0.0005:.7f},{z:.5f}\r\n" for i, z in enumerate(UM)).encode()


def prf():
    rows = "".join(f"{round(z * 1e6)}\r\n" for z in UM)
    return (
        "1 2\r\nSAMPLE 0.000000e+000 PRF\r\nCX M 6.000000e+001 MM 1.000000e+000 D\r\n"
        "CZ M 6.000000e+001 UM 1.000000e-006 L\r\nEOR\r\nSTYLUS_RADIUS 2.000000e-003 MM\r\n"
        "SPACING CX 5.000000e-004\r\nMAP 1.000000e+000 CZ CZ 1.000000e+000 1.000000e+000\r\nEOR\r\n"
        + rows
        + "EOR\r\nEOF\r\n"
    ).encode()


def smd():
    rows = "".join(f"{z:.5f}\r\n" for z in UM)
    return (
        "ISO 5436 - 2000\0sample\0\r\nPRF\0 1 ISO5436\0\r\nCX\0 I\0 60 mm\0 1.0e0 D\0 5.0e-4 \r\n"
        "CZ\0 A\0 60 um\0 1.0e0 D\0\r\n\x03\r\nDATE 25-Nov-2004\0\r\nCREATED_BY test\0\r\n\x03\r\n"
        + rows
        + "\x03\r\n12345\r\n\x03\r\n\x1a"
    ).encode("latin-1")


def npl_sdf():
    rows = "".join(f"{z:.5f}\r\n" for z in UM)
    return (
        "aNPL-V1.0\r\nManuFacID = Softgauges\r\nCreateDate = 210520051200\r\nModDate = 210520051200\r\n"
        "NumPoints = 60\r\nNumProfiles = 1\r\nXscale = 5.0E-07\r\nYscale = 0\r\nZscale = 1E-06\r\n"
        "Zresolution = -1\r\nCompression = 0\r\nDataType = 7\r\nCheckType = 0\r\n*\r\n" + rows + "*\r\n*\r\n"
    ).encode()


def binary_sdf():
    head = b"bBCR-1.0" + b"maker".ljust(10) + b"010120261200" * 2
    head += struct.pack("<HHddddBBB", 60, 1, STEP, 0.0, 1e-6, -1.0, 0, 7, 0)
    return head + UM.astype("<f8").tobytes()


def x3p():
    import x3pio

    buffer = io.BytesIO()
    x3pio.write(buffer, HEIGHTS, x_scale=STEP)
    return buffer.getvalue()


def mitutoyo(unit="µm"):
    import openpyxl

    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = "Certificate"
    sheet.append([" Profile", "R", "Cut-Off", "0.08mm"])
    data = book.create_sheet("DATA")
    for i, z in enumerate(UM):
        note = f"Ra     0.191  {unit}      " if i == 0 else None
        data.append([note, None, None, None, (i + 1) * 0.0005, z])
    buffer = io.BytesIO()
    book.save(buffer)
    return buffer.getvalue()


def workbook():
    import openpyxl

    book = openpyxl.Workbook()
    book.active.append(["x [mm]", "z [um]"])
    for i, z in enumerate(UM.tolist()):
        book.active.append([i * STEP * 1e3, z])
    buffer = io.BytesIO()
    book.save(buffer)
    return buffer.getvalue()


def nist_xml(points=60):
    rows = "\n".join(f"{z:.5f}" for z in UM)
    return (
        "<?xml version='1.0'?>\n<!DOCTYPE DATA SYSTEM \"data.dtd\">\n<DATA><PART/><DATAFILE><UNITS>um</UNITS>"
        f"<NUMPOINTS>{points}</NUMPOINTS><SPACING>0.5</SPACING><DATA_POINT_VALUES>{rows}"
        "</DATA_POINT_VALUES></DATAFILE></DATA>"
    ).encode()


def opdx(count=60):
    def name(word):
        return struct.pack("<I", len(word)) + word

    def counted(kind, block):
        return bytes([kind, 4]) + struct.pack("<I", len(block)) + block

    def quantity(value):
        unit = name(b"Micrometer") + name(b"\xc2\xb5m") + struct.pack("<d", 1e6) + bytes(12)
        return counted(0x13, struct.pack("<d", value) + unit)

    array = bytes([0x0D]) + struct.pack("<I", 8) + UM.astype("<f8").tobytes()
    typed = b"\x40" + name(b"double * __ptr64") + counted(0, array)[1:]
    scan = name(b"Extent") + quantity(29.5) + name(b"NumPoints") + b"\x0b" + struct.pack("<Q", count)
    scan += name(b"DataScale") + quantity(1.0) + name(b"Array") + typed
    one = name(b"Raw") + counted(0x46, scan)
    return b"VCA DATA" + bytes(4) + name(b"1D_Data") + counted(0x7D, one)


def zipped(content=None, name="trace.txt"):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, text() if content is None else content)
        archive.writestr("readme.md", "not a trace")
    return buffer.getvalue()


# File name, its content, and the name of the reader that must take it.
SAMPLES = {
    "text.txt": (text, "text"),
    "scan.hfm": (hfm, "HFM"),
    "dektak.csv": (dektak, "Dektak CSV"),
    "trace.tx1": (surfcom, "Surfcom text"),
    "trace.prf": (prf, "PRF"),
    "trace.smd": (smd, "SMD"),
    "npl.sdf": (npl_sdf, "SDF"),
    "binary.sdf": (binary_sdf, "SDF"),
    "trace.x3p": (x3p, "x3p"),
    "report.xlsx": (mitutoyo, "Mitutoyo report"),
    "trace.xlsx": (workbook, "workbook"),
    "softgauge.xml": (nist_xml, "NIST XML"),
    "scan.opdx": (opdx, "OPDx"),
    "box.zip": (zipped, "zip"),
}
