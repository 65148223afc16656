"""Open and run a network once, in a process that may die of it; see `network_trial`.

A program of its own: the network comes on standard input, the shape of its input as arguments.
Status 0 says that it was survived, whatever OpenCV said; `MEMORY` that it wanted too much memory.
"""

import os
import sys

import cv2
import numpy as np

MEMORY = 3
"""Exit status of one that wanted more memory than it may have."""


def main() -> None:
    """Try."""
    memory, seconds, *shape = map(int, sys.argv[1:])
    _limit(memory, seconds)
    cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    status = 0
    try:
        network = cv2.dnn.readNetFromONNX(np.frombuffer(sys.stdin.buffer.read(), np.uint8))
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
