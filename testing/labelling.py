"""A folder of photos and a server over it, for tests of labelling."""

import re
import subprocess
import sys
import threading
import uuid
from contextlib import ExitStack, contextmanager
from dataclasses import replace

import httpx
import numpy as np
import uvicorn

from annotate.commands.serving import bound
from annotate.server.app import make_app
from annotate.server.security import TOKEN_HEADER
from annotate.store.store import Store
from annotate.work.open_photos import BUDGET
from annotate.work.shared_photos import SharedPhotos
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


def workbench(folder, annotator="ann", detector=DETECTOR, budget=BUDGET, **how):
    """A workbench over a folder."""
    shared = SharedPhotos(Store(folder), budget=budget)
    return Workbench(shared, detector, Assignment(annotator, **how))


def beside(bench, annotator):
    """A workbench of somebody else who labels the same photos at the same time."""
    return Workbench(bench.shared, bench.detector, replace(bench.assignment, annotator=annotator))


def asked(revision=-1, **body):
    """What the page sends for a change: ``operation=...``, or nothing more for undo and redo."""
    return {"id": str(uuid.uuid4()), "revision": revision, **body}


def done(client, photo, operation, revision=-1):
    """What the server answers to an operation."""
    body = asked(revision, operation=operation)
    return client.post(f"/api/photos/{photo}/operations", json=body)


@contextmanager
def served(folder, annotator="ann", **how):
    """A real server on this machine, as a client that knows the token."""
    with served_to(folder, annotator, **how) as (client,):
        yield client


@contextmanager
def served_to(folder, *people, **how):
    """A real server on this machine, as a client for each person, who has an own token."""
    listener = bound("127.0.0.1", 0)
    address = f"http://127.0.0.1:{listener.getsockname()[1]}"
    benches = [workbench(folder, people[0], **how)]
    benches += [beside(benches[0], one) for one in people[1:]]
    tokens = [TOKEN, *(f"a-token-for-{one}" for one in people[1:])]
    app = make_app(dict(zip(tokens, benches, strict=True)), allowed_hosts())
    server = uvicorn.Server(uvicorn.Config(app, log_level="warning", lifespan="on"))
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
    thread.start()
    try:
        with ExitStack() as clients:
            until(lambda: server.started)
            yield [clients.enter_context(_client(address, token)) for token in tokens]
    finally:
        server.should_exit = True
        thread.join()


def _client(address, token):
    client = httpx.Client(base_url=address, headers={TOKEN_HEADER: token}, timeout=30)
    client.address = f"{address}/?token={token}"
    return client


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
