"""What in an address names the file."""

import pytest

from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.parts import file_part, is_within, refuse_odd_chain


@pytest.mark.parametrize(
    ("address", "part"),
    [
        ("https://host/a.jpg?raw=1", "https://host/a.jpg"),
        ("s3://b/q?x.jpg", "s3://b/q?x.jpg"),
        ("s3://b/a.jpg?versionId=abc", "s3://b/a.jpg"),
        ("zip://q?.jpg::https://host/all.zip?raw=1", "zip://q?.jpg"),
        ("photos/a?b.jpg", "photos/a?b.jpg"),
    ],
)
def test_a_query_is_cut_off_web_servers_alone(address, part):
    assert file_part(address) == part


@pytest.mark.parametrize(
    "address", ["s3://b/a", "zip://a::s3://b/all.zip", "simplecache::s3://b/a"]
)
def test_archives_and_caches_read_from_another_storage(address):
    refuse_odd_chain(address)


@pytest.mark.parametrize("address", ["s3://b/::x.jpg", "s3://b/a.jpg::c.jpg", "memory://a::b.jpg"])
def test_other_storages_do_not(address):
    with pytest.raises(StorageError, match="cannot be read: what stands before :: is no archive"):
        refuse_odd_chain(address)


@pytest.mark.parametrize(
    ("inner", "within"),
    [
        ("t/a.parquet", True),
        ("t", True),
        ("./x/../t/a", True),
        ("ta/b", False),
        ("file://{here}/t/a", True),
        ("memory://t/a", False),
    ],
)
def test_a_path_is_within_a_folder_however_it_is_spelt(tmp_path, monkeypatch, inner, within):
    monkeypatch.chdir(tmp_path)
    assert is_within(inner.format(here=tmp_path), "t") == within


def test_an_address_is_within_one_of_its_own_storage():
    assert is_within("memory://b/t//a.parquet", "memory:///b/t/")
    assert not is_within("memory://b/ta", "memory://b/t")
    assert not is_within("t/a", "memory://t")
