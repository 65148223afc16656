"""Photos of a command line by path and by address."""

import fsspec
import pytest

from skyline_viz.command_line.stored import collect_stored, photos_named, stored_photo
from skyline_viz.datasets.stored_item import StoredItem
from skyline_viz.storage.addresses import StorageError
from testing.programs.commands import scene, write_scene


@pytest.fixture
def memory(tmp_path):
    files = fsspec.filesystem("memory")
    for number, key in enumerate(["in/a.png", "in/deep/a.png", "in/b.png"]):
        files.pipe(f"/{key}", write_scene(tmp_path / "x.png", number).read_bytes())
    (tmp_path / "x.png").unlink()
    yield files
    files.store.clear()
    files.pseudo_dirs[:] = [""]


def test_paths_and_addresses_get_names_of_their_own(memory, tmp_path):
    file = write_scene(tmp_path / "a.png", 5)
    found = collect_stored([str(file), "memory://in", "memory:///in/b.png"])
    assert len({one.name for one in found}) == len(found) == 4
    where = [stored_photo(one.item).name for one in found]
    assert where == [
        str(file),
        *(f"memory:///in/{key}" for key in ("a.png", "b.png", "deep/a.png")),
    ]
    assert (found[2].item.photo() == scene(2)[0]).all()
    assert isinstance(found[1].item, StoredItem)


def test_photos_travel_with_what_a_listing_tells(memory, tmp_path):
    file = write_scene(tmp_path / "a.png")
    photos, files = photos_named(["memory://in", str(file)])
    assert [one.size is None for one in photos] == [True, False, False, False]
    assert [one.photo_path for one in files] == [file]


def test_an_address_that_leads_nowhere_is_named():
    with pytest.raises(StorageError, match=r"^memory://gone does not exist\.$"):
        collect_stored(["memory://gone"])


def test_a_list_may_name_both(memory, tmp_path):
    file = write_scene(tmp_path / "c.png", 5)
    (tmp_path / "photos.txt").write_text(f"memory://in/a.png\n{file}\n")
    words = [f"@{tmp_path / 'photos.txt'}"]
    wanted = [str(file), "memory://in/a.png"]
    assert [one.name for one in photos_named(words)[0]] == wanted
    assert [stored_photo(one.item).name for one in collect_stored(words)] == wanted


def test_truths_of_a_data_set_are_no_photos(memory, capsys):
    for key in ("in/masks/a.png", "in/b_mask.png", "gt/masks/a.png"):
        memory.pipe(f"/{key}", b"x")
    photos, _ = photos_named(["memory://in"])
    assert [one.name.rpartition("/")[2] for one in photos] == ["a.png", "b.png", "a.png"]
    assert capsys.readouterr().err == (
        "skyline-viz: memory://in: truths are no photos: 2 pictures in the folder itself, masks.\n"
    )
    (asked_for,), _ = photos_named(["memory://in/masks"])
    assert asked_for.name.endswith("/in/masks/a.png")
    with pytest.raises(StorageError, match=r"^memory://gt holds no photograph but truths .* masks"):
        photos_named(["memory://gt"])
