"""Modules that a block does not find."""

import sys
from importlib import import_module
from types import ModuleType

import pytest

from skyline_viz.system.stand_ins import without

RARE = "xml.dom.pulldom"


@pytest.fixture(autouse=True)
def _not_imported(monkeypatch):
    monkeypatch.delitem(sys.modules, RARE, raising=False)


def test_a_module_is_not_found_in_the_block_and_is_after_it():
    with without(RARE), pytest.raises(ImportError):
        import_module(RARE)
    assert import_module(RARE).parse


def test_another_one_is_found_instead():
    other = ModuleType(RARE)
    with without(RARE, other):
        assert sys.modules[RARE] is other
    assert RARE not in sys.modules


def test_what_has_been_imported_stays():
    with without("pytest"):
        assert sys.modules["pytest"] is pytest
    assert sys.modules["pytest"] is pytest


def test_a_block_may_end_in_an_error_and_lie_in_another():
    with pytest.raises(KeyError), without(RARE), without(RARE):
        raise KeyError
    assert RARE not in sys.modules
