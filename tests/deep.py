"""Tests of the extra ``deep``; without its packages they are reported by name as not run."""

from importlib import import_module

import pytest


def deep(module):
    """A module of the extra ``deep``, say ``torch``; skips the test where it is missing."""
    try:
        return import_module(module)
    except ImportError as error:
        pytest.skip(f"not run, the extra 'deep' is not installed: {error}")
