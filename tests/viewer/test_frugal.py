"""Rerun is loaded with an allocator that gives memory back, and nobody else is told to."""

import os
import subprocess
import sys

from skyline_viz.viewer.frugal import import_frugally

PROGRAM = """
import os
from skyline_viz.viewer.frugal import import_frugally
import sys
seen = []
class Finder:
    def find_spec(name, path, target=None):
        if name == "rerun_bindings":
            seen.append(os.environ.get("MIMALLOC_ARENA_RESERVE"))
sys.meta_path.insert(0, Finder)
import_frugally()
assert "rerun_bindings" in sys.modules
print(seen, os.environ.get("MIMALLOC_ARENA_RESERVE"))
"""


def told(**environment):
    names = {name: value for name, value in os.environ.items() if "MIMALLOC" not in name}
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env={**names, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout.strip() or done.stderr


def test_rerun_is_loaded_with_a_setting_that_does_not_outlive_it():
    assert told() == "['0'] None"


def test_what_somebody_has_chosen_holds():
    assert "AssertionError" in told(MIMALLOC_ARENA_RESERVE="1GiB")  # it is not imported here


def test_it_is_too_late_where_rerun_has_been_imported():
    import_frugally()
    before = dict(os.environ)
    import_frugally()
    assert dict(os.environ) == before


def test_arrow_does_without_pandas_and_nobody_else_has_to():
    program = """
import importlib.util, sys
import numpy as np
from skyline_viz.viewer.frugal import import_frugally
there = importlib.util.find_spec("pandas")
import_frugally()
import pyarrow as pa
pa.array(np.zeros(3))
pa.array(["sky"])
assert "pandas" not in sys.modules
assert (importlib.util.find_spec("pandas") is None) == (there is None)
"""
    subprocess.run([sys.executable, "-c", program], check=True)
