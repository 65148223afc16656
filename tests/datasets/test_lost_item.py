"""What a copy of a data set lacks is named at its turn, and never taken for what was not there."""

import json
import shutil
from pathlib import Path

import pytest

import skyline_viz as sv
from skyline_viz.datasets.lost_item import LostItem, with_lost
from skyline_viz.photo import PhotoError
from skyline_viz.skyline import SkylineError
from skyline_viz.storage.addresses import StorageError


@pytest.fixture
def copy(hills, tmp_path):
    """A data set, and what makes a file of it one that is lost."""
    folder = tmp_path / "hills"
    shutil.copytree(hills, folder)

    def lose(*names):
        for name in names:
            nothing = "column,row,visible\n" if name.endswith(".csv") else ""
            (folder / name).write_text(nothing)
        lost = {name: f"s3://b/{name} may not be read." for name in names}
        (folder / ".copied.json").write_text(json.dumps({"stamps": {}, "lost": lost}))
        return sv.open_dataset(folder)

    return lose


def names_in(hills, folder):
    return sorted(path.relative_to(hills).as_posix() for path in Path(hills, folder).iterdir())


def test_a_folder_that_is_no_copy_stays_as_it_is(hills):
    dataset = sv.open_dataset(hills)
    assert with_lost([dataset], Path(hills)) == [dataset]


def test_a_lost_photo_fails_with_the_reason_and_keeps_its_truth(copy, hills):
    photo = names_in(hills, "images")[1]
    items = copy(photo).items
    assert [type(one) is LostItem for one in items] == [False, True, False, False]
    with pytest.raises(PhotoError, match=rf"^s3://b/{photo} may not be read\.$"):
        items[1].photo()
    assert items[1].truth() is not None


def test_a_lost_truth_fails_with_the_reason(copy, hills):
    truth = names_in(hills, "masks")[2]
    item = copy(truth).items[2]
    assert item.photo().ndim == 3
    with pytest.raises(SkylineError, match=rf"^s3://b/{truth} may not be read\.$"):
        item.truth()


def test_what_belongs_to_no_photo_is_a_problem(copy):
    found = copy("README.txt", "masks/other.png")
    assert found.problems == (
        "s3://b/README.txt may not be read.",
        "s3://b/masks/other.png may not be read.",
    )
    assert not any(isinstance(one, LostItem) for one in found)


def test_a_lost_text_that_may_tell_of_many_photos_refuses_the_data_set(copy):
    with pytest.raises(StorageError, match=r"^s3://b/images/metadata\.csv may not be read\.$"):
        copy("images/metadata.csv")
