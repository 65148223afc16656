"""Addresses: what is one, and the sentences about those that lead nowhere."""

import sys
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread

import fsspec.core
import pytest
from fsspec.registry import known_implementations

from skyline_viz.storage import addresses
from skyline_viz.storage.addresses import StorageError, file_system, is_address, naming, plain

OURS = {"s3": "s3fs", "gs": "gcsfs", "gcs": "gcsfs", "https": "aiohttp"}
OTHERS = {
    "az": "adlfs",
    "abfs": "adlfs",
    "sftp": "paramiko",
    "smb": "smbprotocol",
    "webdav": "webdav4",
    "libarchive": "libarchive-c",
}


@pytest.mark.parametrize(
    "text",
    ["s3://b/k.jpg", "gs://b", "https://host/a.jpg", "zip://a::s3://b/c.zip", "memory://a"],
)
def test_what_has_a_scheme_is_an_address(text):
    assert is_address(text)


@pytest.mark.parametrize(
    "text", ["a.jpg", "/a/b", "./s3/a", "C:/photos", "C:\\photos", "a:b", "@list"]
)
def test_what_has_none_is_a_path(text):
    assert not is_address(text)


def test_an_unknown_scheme_is_named():
    with pytest.raises(StorageError, match=r"^foo://x cannot be read: nothing knows foo://\.$"):
        file_system("foo://x")


def test_an_archive_without_a_file_is_explained():
    with pytest.raises(StorageError, match=r"names no archive; .* zip://::FILE"):
        file_system("zip:///photos.zip")


@pytest.mark.parametrize(
    ("kind", "package", "install"),
    [
        *((kind, name, "'skyline-viz[cluster]'") for kind, name in OURS.items()),
        *((kind, name, name) for kind, name in OTHERS.items()),
    ],
)
def test_what_is_not_installed_is_named_with_how_to_get_it(monkeypatch, kind, package, install):
    known = known_implementations[kind]

    def missing(*_):
        raise ImportError(known["err"]) from ModuleNotFoundError(name=kind)

    monkeypatch.setattr(fsspec.core, "url_to_fs", missing)
    with pytest.raises(StorageError) as caught:
        file_system(f"{kind}://photos")
    said = f"{kind}://photos needs {package}; install it with: pip install {install}"
    assert str(caught.value) == said


def test_the_extra_brings_what_its_sentence_promises():
    for kind in OURS:
        assert fsspec.get_filesystem_class(kind)


def test_a_storage_that_wants_more_than_an_address_is_said_to():
    said = "^reference:// cannot be read: reference:// needs more than an address\\.$"
    with pytest.raises(StorageError, match=said):
        file_system("reference://")


def test_without_fsspec_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "fsspec.core", None)
    with pytest.raises(StorageError, match=r"^s3:// needs fsspec; .*skyline-viz\[cluster\]'$"):
        file_system("s3://photos")


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (FileNotFoundError(2, "no"), "a://b does not exist."),
        (PermissionError(1, "Forbidden"), "a://b may not be read."),
        (RuntimeError("odd\nthing."), "a://b cannot be read: odd thing."),
        (StorageError("as it is."), "as it is."),
    ],
)
def test_errors_of_a_storage_become_sentences(error, said):
    with pytest.raises(StorageError) as raised, naming("a://b"):
        raise error
    assert str(raised.value) == said


def test_words_of_libraries_are_left_out():
    error = RuntimeError("An error occurred (SlowDown) when calling the GetObject operation: Wait.")
    assert plain(error) == "SlowDown, Wait"
    assert addresses.plain(TimeoutError()) == "TimeoutError"


def test_an_archive_on_a_server_that_gives_whole_files_is_to_be_downloaded(tmp_path):
    (tmp_path / "a.zip").write_bytes(b"x" * 1000)
    handler = partial(SimpleHTTPRequestHandler, directory=str(tmp_path))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        Thread(target=server.serve_forever, daemon=True).start()
        address = f"zip://::http://127.0.0.1:{server.server_port}/a.zip"
        with pytest.raises(StorageError, match=r"whole files alone; download the archive first\.$"):
            file_system(address)
        server.shutdown()
