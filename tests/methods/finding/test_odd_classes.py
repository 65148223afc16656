"""Classes that need settings, end the program, or fail where nobody expects it."""

import numpy as np
import pytest

import skyline_viz as sv
from testing.methods import own_folder, write_module

CODE = """
import sys
import numpy as np


class Need:
    def __init__(self, size: int):
        self.size = size

    def detect(self, photo):
        return np.full(photo.shape[1], self.size)


class Ends:
    def detect(self, photo):
        sys.exit(3)


class Nameless:
    @property
    def name(self):
        raise RuntimeError("no name today")

    def detect(self, photo):
        return np.full(photo.shape[1], 7)
"""


@pytest.fixture
def module(tmp_path, monkeypatch):
    with own_folder(tmp_path, monkeypatch) as folder:
        write_module(folder, CODE, "odd")
        yield "odd"


@pytest.fixture
def photo():
    return np.zeros((20, 30, 3), np.uint8)


def test_a_setting_without_a_default_is_asked_for_and_given(module, photo):
    with pytest.raises(sv.MethodError, match=r"odd:Need needs the setting size: odd:Need:size="):
        sv.find_method(f"{module}:Need")
    method = sv.find_method(f"{module}:Need:size=9")
    assert method.name == "Need:size=9"
    assert set(method.detect(photo).skyline.rows.tolist()) == {9.0}
    with pytest.raises(sv.MethodError, match="size"):
        sv.find_method(f"{module}:Need:size=big")


def test_a_class_that_ends_the_program_is_a_sentence(module, photo):
    with pytest.raises(sv.MethodError, match=r"odd:Ends failed in odd\.py, line 16: SystemExit: 3"):
        sv.find_method(f"{module}:Ends").detect(photo)


def test_a_name_that_fails_is_a_sentence(module):
    with pytest.raises(sv.MethodError, match="no name today"):
        _ = sv.find_method(f"{module}:Nameless").name


@pytest.mark.parametrize("wrong", [3, None, ["paper"]])
def test_what_is_no_text_names_no_method(wrong):
    with pytest.raises(sv.MethodError, match="a method is named by a text"):
        sv.find_method(wrong)
