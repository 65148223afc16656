"""Nothing is left behind: temporary files and processes end with the program, however it ends.

Whoever makes a file or a folder for a while, or starts a process, says so here. A program that is
asked to end (Ctrl-C, SIGTERM, SIGHUP) cleans up on its own. One that is killed cannot; therefore a
`janitor`, a small process that is started when there is first something to tell, watches it and
cleans up when it is gone. Workers of `batch` tell the janitor of the program that started them.

Where there are no such pipes, on Windows, nothing is watched, and killing leaves things behind.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import shutil
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from multiprocessing import parent_process
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

_LINE = 4000  # bytes that a pipe takes in one piece, whoever else writes into it, or less


class _Watch:
    """The janitor of this process, or of the one that started it."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.process: subprocess.Popen[bytes] | None = None
        self.news: Connection | None = None
        """Where to tell; it can be sent to workers."""

    def start(self) -> Connection | None:
        """Start the janitor, once."""
        with self.lock:
            if self.news is None and os.name == "posix":
                told, tell = os.pipe()
                program = Path(__file__).with_name("janitor.py")
                self.process = subprocess.Popen(  # noqa: S603
                    [sys.executable, "-I", "-S", str(program), str(told)],
                    stdin=subprocess.PIPE,
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                    pass_fds=[told],
                    cwd="/",  # it holds no folder that somebody wants to remove
                    start_new_session=True,
                )
                os.close(told)
                self.news = Connection(tell, readable=False)
                atexit.register(self.end)
            return self.news

    def tell(self, sign: str, what: str | os.PathLike[str] | int) -> bool:
        """Tell the janitor; whether somebody listens."""
        line = sign.encode() + os.fsencode(str(what)) + b"\0"
        news = self.start()
        if news is None or len(line) > _LINE:
            return False
        with contextlib.suppress(OSError):
            os.write(news.fileno(), line)
            return True
        return False

    def end(self) -> None:
        """Let the janitor go, when the program ends by itself."""
        with self.lock:
            process, news, self.process, self.news = self.process, self.news, None, None
        if news:
            news.close()
        if process and process.stdin:
            process.stdin.close()
            process.wait()


_WATCH = _Watch()


def _forked() -> None:
    """Leave the janitor to the parent."""
    global _WATCH  # noqa: PLW0603
    atexit.unregister(_WATCH.end)
    _WATCH = _Watch()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forked)


@contextmanager
def passing(path: str | os.PathLike[str]) -> Iterator[None]:
    """Have a file or a folder removed if the program is killed before the block ends.

    Args:
        path: Where it is, or will be.
    """
    whole = os.path.abspath(path)  # noqa: PTH100  # a Path would take a trailing blank or a colon for more
    _WATCH.tell("+", whole)
    try:
        yield
    finally:
        _WATCH.tell("-", whole)


@contextmanager
def passing_folder(
    prefix: str = "skyline-viz-", parent: str | os.PathLike[str] | None = None
) -> Iterator[Path]:
    """Make a folder that lasts as long as the block, even where the program is killed.

    Args:
        prefix: How its name begins.
        parent: Where to make it; the system's folder for such things unless given.
    """
    with tempfile.TemporaryDirectory(prefix=prefix, dir=parent) as folder, passing(folder):
        yield Path(folder)


@contextmanager
def passing_temporaries() -> Iterator[Path]:
    """A folder that lasts as long as the block, for all that libraries put into such places.

    For what runs in this process and is no Python, which asks the environment each time.
    """
    names = ("TMPDIR", "TEMP", "TMP")
    before = {name: os.environ.get(name) for name in names}
    with passing_folder() as folder:
        os.environ.update(dict.fromkeys(names, str(folder)))
        try:
            yield folder
        finally:
            for name, value in before.items():
                if value is None:
                    del os.environ[name]
                else:
                    os.environ[name] = value


def started(command: Sequence[str | os.PathLike[str]], **how: Any) -> subprocess.Popen[bytes]:  # noqa: ANN401
    """Start a process that ends with this one; takes what `subprocess.Popen` takes.

    It gets a folder of its own for its temporary files, which goes with it: not every program
    cleans up when it is ended. `ended` is to be called in any case.

    Raises:
        OSError: It cannot be started.
    """
    folder = tempfile.mkdtemp(prefix="skyline-viz-")
    _WATCH.tell("+", folder)
    places = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), folder)
    environment = {**os.environ, **how.pop("env", {}), **places}
    try:
        process = subprocess.Popen(command, env=environment, **how)  # noqa: S603
    except BaseException:
        _remove(folder)
        raise
    _WATCH.tell("*", process.pid)
    _folders[process.pid] = folder
    return process


def ended(process: subprocess.Popen[Any]) -> None:
    """End a process, gently at first, and wait until it is gone."""
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.terminate()
        process.wait(_GRACE)
    if process.poll() is None:
        process.kill()
        process.wait()
    _WATCH.tell("/", process.pid)
    if folder := _folders.pop(process.pid, None):
        _remove(folder)


def _remove(folder: str) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    _WATCH.tell("-", folder)


_GRACE = 10.0  # seconds
_folders: dict[int, str] = {}

News = Connection | None
"""What a worker process needs to join the janitor of the program that started it."""


def for_workers() -> News:
    """What to hand to worker processes, see `join`."""
    return _WATCH.start()


def join(news: News) -> None:
    """Make this worker process end with the program that started it."""
    _WATCH.news = news
    heard = news is None or _WATCH.tell("*", os.getpid())
    parent = parent_process()
    if not heard and parent is not None and not parent.is_alive():
        os._exit(1)  # before the janitor could be told
