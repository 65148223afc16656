"""Photos to work on: each by a name of its own."""

from pathlib import Path

import pytest

from skyline_viz.command_line.inputs import collect
from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.datasets.named_item import NamedItem


def test_two_photos_of_one_name_get_names_of_their_own(tmp_path):
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "p.png").write_bytes(b"\x89PNG")
    found = collect([tmp_path / "a" / "p.png", tmp_path / "b" / "p.png"])
    assert len({one.name for one in found}) == 2
    assert [one.item.photo_path.parent.name for one in found] == ["a", "b"]


def test_an_item_is_not_changed():
    one = NamedItem("p", DatasetItem("p", Path("p.png")))
    with pytest.raises(AttributeError):
        one.name = "q"
