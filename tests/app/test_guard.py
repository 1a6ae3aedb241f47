"""The page answers this machine alone: hosts, origins, sizes, names and paths that it refuses."""

import errno
import http.client
import io
import shutil
import socket
import zipfile
from urllib.parse import urlsplit

import pytest

from mixedlub.app.security import LARGEST_UPLOAD, TOO_LARGE
from mixedlub.cli import main
from tests.app.recordings_of_all_kinds import driven_and_back_driven

pytest.importorskip("fastapi")
httpx = pytest.importorskip("httpx")

RECORDING = {"files": ("rig.csv", driven_and_back_driven().encode())}


@pytest.fixture
def client(in_process):
    with httpx.Client(base_url=in_process[0], timeout=120) as made:
        yield made


@pytest.fixture
def at_desk(in_process):
    return in_process[1]


@pytest.fixture(scope="module")
def sent(in_process):
    """Id of a recording that was sent."""
    return httpx.post(f"{in_process[0]}/api/recordings", files=RECORDING, timeout=120).json()["id"]


@pytest.mark.parametrize("host", ["evil.example", "evil.example:8765", "127.0.0.1", "127.0.0.1:9", "[::1]:8765"])
def test_a_foreign_host_is_refused(client, host):
    answer = client.get("/", headers={"host": host})
    assert (answer.status_code, answer.text) == (403, "This page answers to 127.0.0.1 and localhost alone.")


@pytest.mark.parametrize(("port", "refused"), [(80, None), (8765, 403)])
def test_port_80_is_called_without_its_number(port, refused):
    from mixedlub.app.security import Guard
    from mixedlub.app.server import hosts_of

    guard = Guard(None, hosts_of(port))
    for host in ("127.0.0.1", "localhost"):
        found = guard.refused("POST", {"host": host, "origin": f"http://{host}"})
        assert (found and found[0]) == refused
        assert guard.refused("GET", {"host": f"{host}:{port}"}) is None


@pytest.mark.parametrize(
    "headers",
    [
        {"origin": "http://evil.example"},
        {"origin": "null"},
        {"origin": "https://127.0.0.1"},
        {"origin": "http://127.0.0.1:9"},
        {"sec-fetch-site": "cross-site"},
        {"sec-fetch-site": "same-site"},
    ],
)
def test_a_foreign_origin_changes_nothing(client, at_desk, headers):
    before = len(at_desk.store.items("recordings"))
    answer = client.post("/recordings", files=RECORDING, headers=headers)
    assert (answer.status_code, answer.text) == (403, "A page of another origin may not use this one.")
    assert len(at_desk.store.items("recordings")) == before


def test_the_own_origin_may_send(client):
    answer = client.post("/api/recordings", files=RECORDING, headers={"origin": str(client.base_url).rstrip("/")})
    assert answer.status_code == 201
    assert answer.json()["draft"]["kind"] == "friction_map"
    assert answer.json()["draft"]["count"] == 54


def test_a_page_loads_nothing_from_elsewhere_and_is_framed_by_nobody(client):
    policy = client.get("/").headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "frame-ancestors 'none'" in policy
    assert "http" not in policy
    assert "unsafe" not in policy


def test_an_upload_above_the_limit_is_one_sentence(client, at_desk):
    before = len(at_desk.store.items("recordings"))
    too_large = {"files": ("long.csv", b"1,2\n" * (LARGEST_UPLOAD // 4 + 2**15))}
    answer = client.post("/recordings", files=too_large)
    assert (answer.status_code, answer.text) == (413, TOO_LARGE)
    assert len(at_desk.store.items("recordings")) == before


def test_an_upload_of_unknown_length_is_counted(served):
    address, work, _ = served
    place = urlsplit(address)
    connection = http.client.HTTPConnection(place.hostname, place.port, timeout=60)
    head = b'--x\r\ncontent-disposition: form-data; name="files"; filename="a.csv"\r\n\r\n'
    parts = [head, *[b"1,2\n" * 2**18] * 51, b"\r\n--x--\r\n"]
    headers = {"content-type": "multipart/form-data; boundary=x"}
    connection.request("POST", "/recordings", iter(parts), headers, encode_chunked=True)
    answer = connection.getresponse()
    assert (answer.status, answer.read().decode()) == (413, TOO_LARGE)
    connection.close()
    assert not list((work / "recordings").iterdir())


def test_only_the_loopback_address_is_bound(served):
    place = urlsplit(served[0])
    assert place.hostname == "127.0.0.1"
    with pytest.raises(OSError):
        socket.create_connection(("127.0.0.2", place.port), timeout=2).close()


@pytest.mark.parametrize(
    "name", ["../../../x.csv", "..\\x.csv", "/etc/x.csv", ".hidden", "-rf", "a\tb.csv", "C:x.csv", "n" * 200 + ".csv"]
)
def test_a_name_that_is_a_path_is_refused(client, at_desk, name):
    # The client quotes such names, so the body is written by hand.
    body = (
        b'--x\r\ncontent-disposition: form-data; name="files"; filename="%b"\r\n'
        b"content-type: text/csv\r\n\r\n1,2\r\n--x--\r\n" % name.replace("\\", "\\\\").encode()
    )
    headers = {"content-type": "multipart/form-data; boundary=x"}
    answer = client.post("/api/recordings", content=body, headers=headers)
    assert answer.status_code == 422
    assert answer.json()["error"].endswith("is no plain name of a file; rename it and send it again")
    assert not list(at_desk.store.folder.rglob("x.csv"))


@pytest.mark.parametrize(
    "path",
    ["item.json/../../../x", "..%2f..%2fapp.pid", "%2e%2e/%2e%2e/app.pid", "/etc/passwd", "%2fetc%2fpasswd", "", "%00"],
)
def test_no_path_leads_out_of_an_item(client, sent, path):
    answer = client.get(f"/api/recordings/{sent}/files/{path}")
    assert answer.status_code in (404, 405)
    assert set(answer.json()) <= {"error", "detail"}


def test_a_link_out_of_an_item_is_not_followed(client, at_desk, sent):
    link = at_desk.store.find("recordings", sent).folder / "link.txt"
    link.symlink_to("/etc/hostname")
    assert client.get(f"/api/recordings/{sent}/files/link.txt").status_code == 404
    link.unlink()


@pytest.mark.parametrize("folder", ["uploads", "%2e%2e", "uploads%2f%2e%2e", "%2fetc", "case%2f%2e%2e%2f%2e%2e"])
def test_only_known_folders_are_packed(client, sent, folder):
    assert client.get(f"/api/recordings/{sent}/zip/{folder}").status_code == 404


def test_a_file_that_was_sent_is_never_shown(client):
    page = {"files": ("rig.csv", driven_and_back_driven().encode())}
    id = client.post("/api/recordings", files=page).json()["id"]
    answer = client.get(f"/api/recordings/{id}/files/uploads/rig.csv")
    assert answer.headers["content-type"] == "application/octet-stream"
    assert answer.headers["content-disposition"].startswith("attachment")
    assert answer.headers["x-content-type-options"] == "nosniff"


def bomb():
    """A workbook whose sheet grows a thousandfold."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr("[Content_Types].xml", "<Types/>")
        packed.writestr("xl/worksheets/sheet1.xml", b"0" * 400_000_000)
    return content.getvalue()


WRONG = {
    "picture.png": b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 40,
    "page.html": b"<!doctype html><script>alert(1)</script>",
    "empty.csv": b"",
    "numbers.csv": b"1,2\n3,4\n",
    "bomb.xlsx": bomb(),
    "entities.csv": b'<?xml version="1.0"?><!DOCTYPE x [<!ENTITY a "b">]><x>&a;</x>',
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_file_is_one_sentence_and_leaves_nothing(client, at_desk, name):
    before = len(at_desk.store.items("recordings"))
    answer = client.post("/api/recordings", files={"files": (name, WRONG[name])})
    assert answer.status_code == 422
    assert name in answer.json()["error"]
    assert "Traceback" not in answer.text
    assert "\n" not in answer.json()["error"]
    assert len(at_desk.store.items("recordings")) == before


def test_an_answer_file_may_not_name_a_file_elsewhere(client):
    system = b'[surfaces.ground]\nprofile = "/etc/passwd"\n'
    files = [("files", ("rig.csv", RECORDING["files"][1])), ("files", ("system.toml", system))]
    answer = client.post("/api/recordings", files=files)
    assert answer.status_code == 422
    assert answer.json()["error"].endswith("names a file outside this page; send the file, and give its bare name")


def test_a_full_disk_is_one_sentence(client, at_desk, monkeypatch):
    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(shutil, "copyfileobj", full)
    before = len(at_desk.store.items("recordings"))
    answer = client.post("/api/recordings", files=RECORDING)
    assert answer.status_code == 507
    assert answer.json() == {"error": f"the disk of {at_desk.store.folder} is full; make room and send it again"}
    assert len(at_desk.store.items("recordings")) == before


def test_a_folder_serves_one_page(served, capsys):
    assert main(["app", "--port", "0", "--no-browser", "--out", str(served[1])]) == 2
    assert f"is in use by process {served[2].pid}, another mixedlub app" in capsys.readouterr().err


def test_a_port_in_use_is_one_sentence(served, tmp_path, capsys):
    port = str(urlsplit(served[0]).port)
    assert main(["app", "--port", port, "--no-browser", "--out", str(tmp_path)]) == 2
    assert f"--port: {port}: cannot be used (Address already in use)" in capsys.readouterr().err


def test_what_rest_answers_is_described_without_a_foreign_script(client):
    paths = client.get("/api/openapi.json").json()["paths"]
    assert len(paths) == 17
    assert all(one["summary"] and one["description"] for methods in paths.values() for one in methods.values())
    assert client.get("/docs").text.count("<script") == 1
    for path in paths:
        assert path in client.get("/docs").text
