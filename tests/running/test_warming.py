"""Compiled loops are loaded once a process; that they are compiled is said, and done by one."""

import subprocess
import sys
import threading
from contextlib import ExitStack
from types import SimpleNamespace

import numba
import pytest
from filelock import FileLock
from numba.core.registry import cpu_target

from skyline_viz.detector import Detector
from skyline_viz.running import warming
from skyline_viz.running.warming import COMPILING, warm_up
from skyline_viz.system.notes import heard_by


def test_the_second_call_detects_nothing(monkeypatch):
    warm_up()

    def detect(*_):
        raise AssertionError("it is warm already")

    monkeypatch.setattr(Detector, "detect", detect)
    warm_up()


@pytest.fixture
def compiling(tmp_path):
    """What a process is told that compiles a loop."""
    stats = SimpleNamespace(cache_path=str(tmp_path / "kept"))
    return SimpleNamespace(data={"dispatcher": SimpleNamespace(stats=stats)})


def test_it_is_said_once_that_loops_are_compiled(compiling):
    heard = []
    with ExitStack() as until_done, heard_by(heard.append):
        listener = warming._Compiling(until_done)
        listener.on_start(compiling)
        listener.on_end(compiling)
        listener.on_start(compiling)
    assert heard == [COMPILING]


def test_nothing_is_said_of_loops_that_are_found_done():
    heard = []
    warm_up()
    with heard_by(heard.append):
        warm_up.__wrapped__()
    assert heard == []


def test_one_process_compiles_while_another_waits(tmp_path, compiling):
    (tmp_path / "kept").mkdir()
    order = []
    with ExitStack() as until_done:
        with FileLock(tmp_path / "kept" / "compiling.lock", thread_local=False):
            other = threading.Thread(
                target=lambda: (
                    warming._Compiling(until_done).on_start(compiling),
                    order.append("other"),
                )
            )
            other.start()
            order.append("one")
        other.join()
    assert order == ["one", "other"]


def test_loops_are_compiled_where_nothing_can_be_kept(compiling):
    compiling.data["dispatcher"].stats.cache_path = "/dev/null/kept"
    with ExitStack() as until_done:
        warming._Compiling(until_done).on_start(compiling)


def test_loops_are_loaded_without_the_compiler_and_others_can_be_compiled_later():
    program = """
import sys
from skyline_viz.running.warming import warm_up
warm_up()
assert "numba.np.npyimpl" not in sys.modules
import numba
import numpy as np
assert numba.njit(lambda values: np.sqrt(values).sum())(np.full(3, 4.0)) == 6
assert "numba.np.npyimpl" in sys.modules
"""
    warm_up()  # they are kept, whoever comes first
    subprocess.run([sys.executable, "-c", program], check=True)


def test_what_is_compiled_finds_the_compiler(compiling):
    context = cpu_target.target_context
    with ExitStack() as until_done, warming._without_compiler():
        assert "refresh" in vars(context)
        warming._Compiling(until_done).on_start(compiling)
        assert "refresh" not in vars(context)


def test_loops_are_loaded_without_scipy_and_it_can_be_imported_later():
    program = """
import sys
from skyline_viz.running.warming import warm_up
warm_up()
assert "scipy.linalg" not in sys.modules
import scipy.linalg.cython_blas
warm_up.__wrapped__()
"""
    subprocess.run([sys.executable, "-c", program], check=True)


def test_other_threads_compile_when_the_loops_are_loaded(monkeypatch):
    compiled = []
    plain = Detector.detect

    def compile_meanwhile(detector, photo):
        other = threading.Thread(target=lambda: compiled.append(_square()(3.0)))
        other.start()
        other.join(0.2)
        assert other.is_alive()  # it waits
        waiting.append(other)
        return plain(detector, photo)

    waiting = []
    monkeypatch.setattr(Detector, "detect", compile_meanwhile)
    warming.warm_up.__wrapped__()
    waiting[0].join()
    assert compiled == [9.0]


def _square():
    @numba.vectorize(["float64(float64)"])
    def square(value):
        return value * value

    return square
