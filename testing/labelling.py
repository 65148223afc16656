"""A folder of photos and a server over it, for tests of labelling."""

import re
import subprocess
import sys
import threading
import uuid
from contextlib import contextmanager

import httpx
import numpy as np
import uvicorn

from annotate.commands.open import bound
from annotate.server.app import make_app
from annotate.server.security import TOKEN_HEADER
from annotate.store.store import Store
from annotate.work.workbench import Assignment, Workbench
from skyline_viz.detector import Detector
from skyline_viz.photo import write_photo
from skyline_viz.system.loopback import allowed_hosts
from testing import until

TOKEN = "a-token-for-tests"
DETECTOR = Detector()


def hills(seed, height=48, width=70):
    """A small photo with two ridges."""
    random = np.random.default_rng(seed)
    photo = np.full((height, width, 3), 210, np.uint8)
    for top, grey in ((height * 0.3, 150), (height * 0.62, 70)):
        wave = np.sin(np.arange(width) / random.uniform(5, 15) + random.uniform(0, 6))
        photo[np.arange(height)[:, None] >= top + height / 8 * wave] = grey
    noise = random.normal(0, 6, photo.shape)
    return np.clip(photo + noise, 0, 255).astype(np.uint8)


def write_hills(folder, count=3, **size):
    """Write photos ``hill-0.png`` and so on."""
    folder.mkdir(parents=True, exist_ok=True)
    for seed in range(count):
        write_photo(folder / f"hill-{seed}.png", hills(seed, **size))
    return folder


def workbench(folder, annotator="ann", detector=DETECTOR, **how):
    """A workbench over a folder."""
    return Workbench(Store(folder), detector, Assignment(annotator, **how))


def asked(revision=-1, **body):
    """What the page sends for a change: ``operation=...``, or nothing more for undo and redo."""
    return {"id": str(uuid.uuid4()), "revision": revision, **body}


def done(client, photo, operation, revision=-1):
    """What the server answers to an operation."""
    body = asked(revision, operation=operation)
    return client.post(f"/api/photos/{photo}/operations", json=body)


@contextmanager
def served(folder, **how):
    """A real server on this machine, as a client that knows the token."""
    listener = bound("127.0.0.1", 0)
    port = listener.getsockname()[1]
    app = make_app(workbench(folder, **how), TOKEN, allowed_hosts("127.0.0.1", port))
    server = uvicorn.Server(uvicorn.Config(app, log_level="warning", lifespan="on"))
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
    thread.start()
    try:
        with httpx.Client(
            base_url=f"http://127.0.0.1:{port}", headers={TOKEN_HEADER: TOKEN}, timeout=30
        ) as client:
            until(lambda: server.started)
            yield client
    finally:
        server.should_exit = True
        thread.join()


def started(folder):
    """A server in a process of its own, and a client for it."""
    words = [sys.executable, "-m", "annotate", "open", folder, "--no-browser", "--annotator", "ann"]
    process = subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    for line in process.stdout:
        if found := re.search(r"(http://127\.0\.0\.1:\d+)/\?token=(\S+)", line):
            client = httpx.Client(base_url=found[1], headers={TOKEN_HEADER: found[2]}, timeout=20)
            return process, client
    raise AssertionError(process.stderr.read())
