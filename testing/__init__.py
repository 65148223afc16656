"""What tests, benchmarks and tools share: places, made inputs, faults, a browser and a viewer."""

import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from time import monotonic, sleep
from typing import Any, TypeVar

Answer = TypeVar("Answer")

ROOT = Path(__file__).resolve().parents[1]
"""The checkout."""

SAMPLES = ROOT / "sample_data"
"""The rendered sample photographs."""

PATIENCE = 120.0
"""Seconds after which something that was waited for is taken for lost."""


def until(what: Callable[[], Answer], process: subprocess.Popen[Any] | None = None) -> Answer:
    """Ask again and again until the answer is true, and return it.

    Args:
        what: The question.
        process: One that has to run meanwhile; it is ended when there is no answer.
    """
    deadline = monotonic() + PATIENCE
    while not (answer := what()):
        over = monotonic() > deadline
        if process is not None and (over or process.poll() is not None):
            process.kill()
            _, errors = process.communicate()
            raise AssertionError(f"it ended before, or waited in vain: {errors.decode()}")
        assert not over, "it never happened"
        sleep(0.02)
    return answer


def uncovered() -> dict[str, str]:
    """The environment without what makes a process count its coverage.

    For tests that look at all that a process imports, prints or writes.
    """
    return {name: value for name, value in os.environ.items() if not name.startswith("COVERAGE")}
