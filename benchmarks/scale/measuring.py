"""What a command takes: time, processor time, and the memory of its first process."""

from __future__ import annotations

import os
import resource
import signal
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter, sleep

import psutil

KINDS = ("clear", "hazy", "cloudy", "snow", "foreground", "spires", "desert", "rover")
"""Kinds of scenes that stand for many photos."""

SIZE = (480, 360)
"""Width and height of these, in pixels."""

LOOK_EVERY = 0.2  # seconds


@dataclass(frozen=True)
class Cost:
    """What a run took."""

    seconds: float
    processor: float
    memory: tuple[int, ...]
    """Bytes of the first process, at each look."""

    said: str


def measured(
    words: list[str], kept: Callable[[], int] = int, kill: tuple[float, float] | None = None
) -> Cost:
    """Run a command to its end, or until it is killed.

    Args:
        words: The command.
        kept: Tells how many bytes it has kept of what it has done.
        kill: Bytes from which on a worker is killed, and from which on the first process is.
    """
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    process = subprocess.Popen(
        words, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    watched, memory, killed = psutil.Process(process.pid), [], False
    while process.poll() is None:
        try:
            memory.append(watched.memory_info().rss)
        except psutil.NoSuchProcess:
            break
        done = kept() if kill else 0
        if kill and done > kill[0] and not killed:
            killed = _kill_a_worker(watched)
            print(f"a worker killed after {perf_counter() - began:.0f} s: {killed}", flush=True)
        if kill and done > kill[1]:
            process.kill()
        sleep(LOOK_EVERY)
    said = process.communicate()[0]
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Cost(perf_counter() - began, spent, tuple(memory), said)


def _kill_a_worker(client: psutil.Process) -> bool:
    """Kill the process that has worked most, but for the first one; whether there was one."""
    workers = client.children(recursive=True)
    if workers:
        os.kill(max(workers, key=_worked).pid, signal.SIGKILL)
    return bool(workers)


def _worked(process: psutil.Process) -> float:
    try:
        return sum(process.cpu_times()[:2])
    except psutil.NoSuchProcess:
        return 0.0
