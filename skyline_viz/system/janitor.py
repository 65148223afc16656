"""A small process that cleans up when a program of ours is gone, however it went.

Run by `aftermath` as a program of its own, with nothing but the standard library, in a session of
its own. Standard input is a pipe that the program alone holds open: its end tells that the program
is gone. A second pipe, of which the number is the only argument, brings lines from the program and
its workers: ``+path`` and ``-path`` for what is there for a while, ``*number`` and ``/number`` for
processes. What is still there at the end is killed and removed.
"""

import contextlib
import os
import select
import shutil
import signal
import sys


class Janitor:
    """What has to be cleaned up, as far as it was told."""

    def __init__(self, news: int) -> None:
        self.news, self.rest = news, b""
        self.paths: dict[bytes, None] = {}
        self.processes: dict[int, int | None] = {}

    def listen(self) -> bool:
        """Take in what has been told; whether there may be more."""
        try:
            told = os.read(self.news, 1 << 16)
        except BlockingIOError:
            return False
        lines = (self.rest + told).split(b"\0")
        self.rest = lines.pop()
        for line in lines:
            self.take(line[:1], line[1:])
        return bool(told)

    def take(self, sign: bytes, what: bytes) -> None:
        """Take in one line."""
        if sign == b"+":
            self.paths[what] = None
        elif sign == b"-":
            self.paths.pop(what, None)
        elif sign == b"*":
            self.processes[int(what)] = handle_of(int(what))
        elif handle := self.processes.pop(int(what), None):
            os.close(handle)

    def clean(self) -> None:
        """Kill and remove what is left."""
        for number, handle in self.processes.items():
            with contextlib.suppress(OSError):
                if handle is None:
                    os.kill(number, signal.SIGKILL)
                else:
                    signal.pidfd_send_signal(handle, signal.SIGKILL)
                    select.select([handle], [], [], 10)  # until it writes no more
        while self.listen():  # what they told at last
            pass
        for path in self.paths:
            if os.path.isdir(path) and not os.path.islink(path):  # noqa: PTH112, PTH114  # bytes
                shutil.rmtree(path, ignore_errors=True)
            else:
                with contextlib.suppress(OSError):
                    os.unlink(path)  # noqa: PTH108


def handle_of(number: int) -> int | None:
    """What stands for this very process, whoever gets its number later; None where it is gone."""
    with contextlib.suppress(OSError, AttributeError):
        return os.pidfd_open(number)
    return None


def main() -> None:
    """Listen until the program is gone, then clean up."""
    for one in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(one, signal.SIG_IGN)  # they are meant for the program
    news = int(sys.argv[1])
    os.set_blocking(news, False)
    janitor = Janitor(news)
    watched = [0, news]
    while 0 in watched:
        ready, _, _ = select.select(watched, [], [])
        if news in ready and not janitor.listen():
            watched.remove(news)
        if 0 in ready:  # nothing is ever written into it
            break
    janitor.clean()


if __name__ == "__main__":
    main()
