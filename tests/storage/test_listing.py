"""The photos at an address."""

import tarfile
import zipfile

import boto3
import fsspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.fetching import fetch
from skyline_viz.storage.listing import Listed, files_at, photos_at

KEYS = ["b.jpg", "a/z.PNG", "a/deep/er/x.tif", "a/note.txt", ".hidden.jpg", ".trash/y.jpg", "c.csv"]
FOUND = ["b.jpg", "a/z.PNG", "a/deep/er/x.tif"]


def test_photos_of_a_bucket_are_listed_with_their_size_and_stamp(s3):
    files = fsspec.filesystem("s3")
    for key in KEYS:
        files.pipe(f"photos/in/{key}", key.encode())
    found = list(photos_at("s3://photos/in"))
    assert [one.address for one in found] == [f"s3://photos/in/{key}" for key in FOUND]
    assert [one.size for one in found] == [len(key) for key in FOUND]
    assert all(one.stamp.startswith("ETag") for one in found)
    assert len({one.stamp for one in found}) == 3
    assert s3.downloads == []


def test_a_stamp_changes_with_the_content(s3):
    files = fsspec.filesystem("s3")
    files.pipe("photos/in/a.jpg", b"one")
    (before,) = photos_at("s3://photos/in")
    files.pipe("photos/in/a.jpg", b"two")
    (after,) = photos_at("s3://photos/in")
    assert before.stamp != after.stamp


@pytest.mark.parametrize("inside", ["", "a"])
def test_photos_of_an_archive_are_fetched_by_the_addresses_of_its_listing(tmp_path, inside):
    with zipfile.ZipFile(tmp_path / "all.zip", "w") as archive:
        for key in KEYS:
            archive.writestr(key, key)
    found = list(photos_at(f"zip://{inside}::file://{tmp_path}/all.zip"))
    wanted = [key for key in FOUND if key.startswith(inside)]
    assert [fetch(one.address, one.size).decode() for one in found] == wanted
    assert all(one.stamp.startswith("CRC") for one in found)


def test_an_archive_may_lie_in_a_storage(s3, tmp_path):
    with zipfile.ZipFile(tmp_path / "all.zip", "w") as archive:
        for key in KEYS:
            archive.writestr(f"2026/july/{key}", key)
    fsspec.filesystem("s3").put(str(tmp_path / "all.zip"), "photos/all.zip")
    found = list(photos_at("zip://2026/july::s3://photos/all.zip"))
    assert [one.address for one in found] == [
        f"zip://2026/july/{key}::s3://photos/all.zip" for key in FOUND
    ]
    assert [fetch(one.address, one.size).decode() for one in found] == FOUND
    fsspec.filesystem("s3").pipe("photos/odd.zip", b"no archive" * 100)
    for name, said in [("gone.zip", "does not exist"), ("odd.zip", "cannot be read: File is not")]:
        with pytest.raises(StorageError, match=rf"^zip://::s3://photos/{name} {said}"):
            list(photos_at(f"zip://::s3://photos/{name}"))


def test_an_address_of_a_photo_is_that_photo_and_nothing_is_asked():
    assert list(photos_at("https://nowhere.invalid/a.jpg?size=big")) == [
        Listed("https://nowhere.invalid/a.jpg?size=big")
    ]


def test_a_place_without_photos_and_one_that_is_missing_are_named(memory):
    memory.pipe("/in/a.txt", b"a")
    with pytest.raises(StorageError, match=r"^memory://in holds no photograph\.$"):
        list(photos_at("memory://in"))
    with pytest.raises(StorageError, match=r"^memory://gone does not exist\.$"):
        list(photos_at("memory://gone"))


@given(
    st.sets(st.lists(st.text("abé-", min_size=1, max_size=3), min_size=1, max_size=4).map(tuple))
)
def test_every_photo_is_listed_once_however_deep(keys):
    files = fsspec.filesystem("memory")
    wanted = {"/".join(key) + ".jpg" for key in keys} | {"first.jpg"}
    try:
        for key in wanted:
            files.pipe(f"/in/{key}", b"x")
        found = [one.address for one in photos_at("memory://in")]
        assert sorted(found) == sorted(f"memory:///in/{key}" for key in wanted)
    finally:
        files.store.clear()
        files.pseudo_dirs[:] = [""]


ODD = ["/lead.jpg", "d//dbl.jpg", "d///tri.jpg", "dots/../up.jpg", "./dot.jpg", "q?.jpg", "q?x.jpg"]
NO_ADDRESS = {
    "::x.jpg": "a name that holds :: has no address.",
    "v?versionId=3.jpg": "its address means another file.",
}


def test_odd_keys_of_a_bucket_are_listed_and_fetched_or_said_to_have_no_address(s3):
    client = boto3.client("s3")
    for key in (*ODD, *NO_ADDRESS, "d/plain.jpg", "d//.hidden.jpg"):
        client.put_object(Bucket="photos", Key=f"in/{key}", Body=key.encode())
    found = list(photos_at("s3://photos/in"))
    assert sorted(one.below for one in found) == sorted([*ODD, *NO_ADDRESS, "d/plain.jpg"])
    for one in found:
        assert one.address == f"s3://photos/in/{one.below}"
        if one.below in NO_ADDRESS:
            assert one.fault == f"{one.address} cannot be downloaded: {NO_ADDRESS[one.below]}"
        else:
            assert fetch(one.address, one.size).decode() == one.below
            assert list(photos_at(one.address)) == [Listed(one.address)]


def test_odd_names_in_archives_are_listed_and_fetched(tmp_path):
    odd = [*ODD[1:], "v?versionId=3.jpg"]
    with zipfile.ZipFile(tmp_path / "all.zip", "w") as archive:
        for key in (*odd, "d/.hidden/a.jpg"):
            archive.writestr(f"in/{key}", key)
    found = list(photos_at(f"zip://in::file://{tmp_path}/all.zip"))
    assert sorted(fetch(one.address, one.size).decode() for one in found) == sorted(odd)
    with tarfile.open(tmp_path / "all.tar", "w") as archive:
        archive.add(tmp_path / "all.zip", "./a.jpg")
    assert [one.below for one in photos_at(f"tar://::file://{tmp_path}/all.tar")] == ["./a.jpg"]


def test_what_stands_before_colons_reads_from_another_storage(s3):
    for listed in (photos_at, files_at):
        with pytest.raises(
            StorageError, match=r"^s3://photos/::x\.jpg cannot be read: what stands"
        ):
            next(listed("s3://photos/::x.jpg"))


@pytest.mark.parametrize("name", ["b/all.zip", "b/all.TAR.GZ"])
def test_an_archive_is_told_how_it_is_named(name):
    kind = "zip" if "zip" in name else "tar"
    for listed in (photos_at, files_at):
        with pytest.raises(StorageError, match=rf"is an archive; .* is {kind}://::s3://{name}\.$"):
            next(listed(f"s3://{name}"))
