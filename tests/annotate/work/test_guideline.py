"""The guideline of a folder."""

import os

import pytest

from annotate.work.guideline import MOST_BYTES, GuidelineError, own_guideline


def test_a_folder_says_nothing_or_something(tmp_path):
    assert own_guideline(tmp_path) is None
    file = tmp_path / "GUIDELINE.md"
    file.write_text(" \n", encoding="utf-8")
    assert own_guideline(tmp_path) is None
    file.write_text("\ufeffDie Bäume zählen.", encoding="utf-8")
    assert own_guideline(tmp_path) == "Die Bäume zählen."


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda file: file.write_bytes(b"\xff\xfe\x00"), "is no text in UTF-8."),
        (lambda file: file.write_bytes(b"x" * (MOST_BYTES + 1)), "has 200,001 bytes"),
        (os.mkfifo, "it is a pipe or a device"),
        (os.mkdir, "is a directory"),
    ],
)
def test_what_cannot_be_shown_is_a_sentence(tmp_path, make, says):
    make(tmp_path / "GUIDELINE.md")
    with pytest.raises(GuidelineError) as caught:
        own_guideline(tmp_path)
    assert says in str(caught.value)
    assert str(caught.value).endswith(".")
