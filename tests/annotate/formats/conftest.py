"""A photo, for which the label files of other programs are made."""

import pytest

from skyline_viz.photo import write_photo
from testing import label_files as made
from testing.label_files import NAME


@pytest.fixture
def photos(tmp_path):
    write_photo(tmp_path / "photos" / NAME, made.photo())
    return tmp_path / "photos"
