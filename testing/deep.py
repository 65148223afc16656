"""Tests of the extra ``deep``; without its packages they are reported by name as not run."""

from importlib import import_module
from importlib.util import find_spec

import pytest

needs_deep = pytest.mark.skipif(
    find_spec("torch") is None or find_spec("onnx") is None,
    reason="not run, the extra 'deep' is not installed",
)


def deep(module):
    """A module of the extra ``deep``, say ``torch``; skips the test where it is missing."""
    try:
        return import_module(module)
    except ImportError as error:
        pytest.skip(f"not run, the extra 'deep' is not installed: {error}")
