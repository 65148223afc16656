"""Open a network; and, as a program, open and run one in a process that may die of it.

`trial` starts the program: the network comes on standard input; memory, seconds, whether to take
the classic engine, and the shape of an input as arguments. Status 0 says that it was survived,
whatever OpenCV said; `MEMORY` that it wanted too much memory.
"""

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import cv2
import numpy as np

MEMORY = 3
"""Exit status of one that wanted more memory than it may have."""


def opened(content: bytes, *, classic: bool = False) -> Any:  # noqa: ANN401 - OpenCV has no types
    """The network in an ONNX file.

    Args:
        content: The content of the file.
        classic: Whether OpenCV's older engine runs it: five times as fast for a network of a few
            thousand weights. OpenCV 4 has no other.

    Raises:
        cv2.error: OpenCV does not know such a network.
    """
    if classic and hasattr(cv2.dnn, "ENGINE_CLASSIC"):
        # OpenCV 5.0 takes the engine for a file, and forgets it for a content in memory. Where
        # there is no room for a file, the other engine does: slower, and as right.
        with suppress(OSError), _file_of(content) as path:
            return cv2.dnn.readNetFromONNX(path, cv2.dnn.ENGINE_CLASSIC)
    return cv2.dnn.readNetFromONNX(np.frombuffer(content, np.uint8))


@contextmanager
def _file_of(content: bytes) -> Iterator[str]:
    """The path of a file of this content, which goes when it was read.

    Where the system can, it is a file in memory, which goes with the process, however this ends.
    """
    if hasattr(os, "memfd_create"):
        with os.fdopen(os.memfd_create("network"), "wb") as file:
            file.write(content)
            file.flush()
            yield f"/proc/self/fd/{file.fileno()}"
        return
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "network.onnx")
        path.write_bytes(content)
        yield str(path)


def main() -> None:
    """Try."""
    memory, seconds, classic, *shape = map(int, sys.argv[1:])
    _limit(memory, seconds)
    cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    status = 0
    try:
        network = opened(sys.stdin.buffer.read(), classic=bool(classic))
        network.setInput(np.zeros(shape, np.float32))
        network.forward()
        del network
    except MemoryError:
        status = MEMORY
    except cv2.error as error:
        if error.code == cv2.Error.StsNoMem or "bad_alloc" in str(error):
            status = MEMORY
    os._exit(status)


def _limit(memory: int, seconds: int) -> None:
    try:
        import resource  # noqa: PLC0415  # not on Windows
    except ImportError:
        return
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 9))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


if __name__ == "__main__":
    main()
