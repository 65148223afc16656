"""What all commands share: options, messages, exit codes. The commands are in `commands`."""

import os

os.environ.setdefault("OPENBLAS_THREAD_TIMEOUT", "4")
# NumPy starts a thread for each processor, and each of them looks for work for 2^26 cycles before
# it sleeps: on two processors as much time as three detections take. Before NumPy is imported they
# can be told to sleep at once, in the programs, which all begin here, and in their workers.
