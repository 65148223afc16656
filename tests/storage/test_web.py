"""Photos on web servers: what they answer, and what is made of it."""

import subprocess
import sys
from email.utils import formatdate

import pyarrow.parquet as pq
import pytest

from skyline_viz.storage.addresses import StorageError, UnseenError
from skyline_viz.storage.fetching import FIRST_PAUSE, TRIES, fetch
from skyline_viz.storage.listing import photos_at
from testing.programs.commands import program, write_scene
from testing.programs.web import Answer, site

INDEX = b"""<a href="../">up</a> <a href="?C=M;O=A">by time</a> <a href="b.jpg?size=big">b</a>
<a href="a%20b.jpg">a</a> <a href="deep/">deep</a> <a href="note.txt">n</a> <a href=".h.jpg">h</a>
<a href="a%20b.jpg">a again</a> <a href="https://elsewhere.invalid/y.jpg">another's</a>"""


@pytest.fixture(scope="module")
def server():
    with site() as found:
        yield found


@pytest.fixture
def web(server):
    yield server
    server.pages.clear()
    server.asked.clear()


@pytest.mark.parametrize("path", ["/in/a.jpg", "/in/a.jpg?size=big&of=all", "/in/a%20b.jpg"])
def test_a_photo_is_one_request_and_its_query_goes_along(web, path):
    web.pages[path] = b"whole"
    assert [one.address for one in photos_at(web.place + path)] == [web.place + path]
    assert fetch(web.place + path) == b"whole"
    assert web.asked == [path]


def test_a_page_that_lists_photos_is_a_folder(web):
    web.pages["/in/"] = INDEX
    web.pages["/in/deep/"] = b'<a href="/in/">up</a> <a href="c.png">c</a>'
    paths = ["/in/a%20b.jpg", "/in/b.jpg?size=big", "/in/deep/c.png"]
    for path in paths:
        web.pages[path] = path.encode()
    found = [one.address for one in photos_at(f"{web.place}/in/")]
    assert found == [web.place + path for path in paths]
    assert web.asked == ["/in/", "/in/deep/"]
    assert [fetch(one).decode() for one in found] == paths


def test_a_server_that_sends_elsewhere_is_followed(web):
    web.pages["/in"] = Answer(301, Location="/in/")
    web.pages["/in/"] = b'<a href="a.jpg">a</a>'
    web.pages["/in/a.jpg"] = Answer(302, Location="/other.jpg")
    web.pages["/other.jpg"] = b"there"
    (photo,) = photos_at(f"{web.place}/in")
    assert fetch(photo.address) == b"there"


def test_one_that_sends_in_circles_is_given_up(web):
    web.pages["/a.jpg"] = Answer(302, Location="/a.jpg")
    with pytest.raises(StorageError, match=r"in 5 tries: it leads from place to place\.$"):
        fetch(f"{web.place}/a.jpg")


@pytest.mark.parametrize(
    ("status", "said"),
    [
        (404, "does not exist."),
        (410, "does not exist."),
        (401, "may not be downloaded."),
        (403, "may not be downloaded."),
        (414, "cannot be downloaded: 414 Request-URI Too Long."),
    ],
)
def test_what_lasts_is_not_asked_for_again(web, pauses, status, said):
    web.pages["/a.jpg"] = Answer(status)
    with pytest.raises(StorageError) as caught:
        fetch(f"{web.place}/a.jpg")
    assert str(caught.value) == f"{web.place}/a.jpg {said}"
    assert (web.asked, pauses) == (["/a.jpg"], [])


@pytest.mark.parametrize("status", [408, 425, 429, 500, 502, 503, 504])
def test_what_passes_is_asked_for_again(web, pauses, status):
    web.pages["/a.jpg"] = Answer(status, b"whole", times=2)
    assert fetch(f"{web.place}/a.jpg") == b"whole"
    assert (len(web.asked), len(pauses)) == (3, 2)


def test_a_server_that_stays_busy_is_named(web):
    web.pages["/a.jpg"] = Answer(429)
    said = rf"^{web.place}/a\.jpg could not be downloaded in 5 tries: 429 Too Many Requests\.$"
    with pytest.raises(UnseenError, match=said):
        fetch(f"{web.place}/a.jpg")
    assert len(web.asked) == TRIES


@pytest.mark.parametrize(
    ("asked", "least", "most"),
    [
        ("7", 7, 7),
        ("0", FIRST_PAUSE / 2, FIRST_PAUSE),
        ("1000000", 60, 60),
        (formatdate(4102444800, usegmt=True), 60, 60),
        (formatdate(0, usegmt=True), FIRST_PAUSE / 2, FIRST_PAUSE),
        ("soon", FIRST_PAUSE / 2, FIRST_PAUSE),
    ],
)
def test_a_pause_that_a_server_asks_for_is_made_up_to_a_minute(web, pauses, asked, least, most):
    web.pages["/a.jpg"] = Answer(503, b"whole", times=1, Retry_After=asked)
    assert fetch(f"{web.place}/a.jpg") == b"whole"
    assert len(pauses) == 1
    assert least <= pauses[0] <= most


def test_a_list_is_asked_for_again_as_well(web, pauses):
    web.pages["/in/"] = Answer(503, b'<a href="a.jpg">a</a>', times=2)
    assert [one.address for one in photos_at(f"{web.place}/in/")] == [f"{web.place}/in/a.jpg"]
    assert len(pauses) == 2


def test_a_download_that_breaks_off_is_begun_again(web):
    web.pages["/a.jpg"] = Answer(200, b"12345", Content_Length="10")
    with pytest.raises(StorageError, match=r"in 5 tries: .*received 5 of 10 bytes\)\.$"):
        fetch(f"{web.place}/a.jpg")
    assert len(web.asked) == TRIES


def test_a_server_that_is_off_is_named():
    with site() as found:
        place = found.place
    host = place.removeprefix("http://")
    with pytest.raises(UnseenError, match=rf"tries: Cannot connect to host {host}, Connect call"):
        fetch(f"{place}/a.jpg")


@pytest.fixture(scope="module")
def certificate(tmp_path_factory):
    file = tmp_path_factory.mktemp("https") / "both.pem"
    make = """
import datetime, ipaddress, sys
from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
key = ec.generate_private_key(ec.SECP256R1())
name = x509.Name([x509.NameAttribute(x509.NameOID.COMMON_NAME, "here")])
start = datetime.datetime(2020, 1, 1)
own = x509.SubjectAlternativeName([x509.IPAddress(ipaddress.ip_address("127.0.0.1"))])
made = x509.CertificateBuilder(name, name, key.public_key(), 1, start, start.replace(year=2120))
made = made.add_extension(own, False).sign(key, hashes.SHA256())
encoding = serialization.Encoding.PEM
plain = serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
open(sys.argv[1], "wb").write(made.public_bytes(encoding) + key.private_bytes(encoding, *plain))
"""
    subprocess.run([sys.executable, "-c", make, file], check=True)
    return file


def test_https_goes_all_the_way_into_a_table(certificate, tmp_path, monkeypatch):
    monkeypatch.setenv("SSL_CERT_FILE", str(certificate))
    with site(certificate) as found:
        found.pages["/in/"] = b'<a href="a.png">a</a> <a href="gone.png">gone</a>'
        found.pages["/in/a.png"] = write_scene(tmp_path / "a.png").read_bytes()
        done = program("detect", f"{found.place}/in/", "--out", tmp_path / "t.parquet")
    rows = pq.read_table(tmp_path / "t.parquet").to_pylist()
    assert [row["photo"] for row in rows] == [
        f"{found.place}/in/{name}.png" for name in ("a", "gone")
    ]
    assert [row["error"] for row in rows] == [None, f"{found.place}/in/gone.png does not exist."]
    assert done.returncode == 1


def test_a_server_that_nobody_vouches_for_is_not_trusted(certificate):
    with (
        site(certificate) as found,
        pytest.raises(UnseenError, match=r"tries: .*certificate verify failed"),
    ):
        fetch(f"{found.place}/a.jpg")
    assert found.asked == []
