"""A labelling server in a process of its own, which can be killed and started again."""

import json
import os
import re
import signal
import subprocess
import sys
from contextlib import suppress

import httpx

from annotate.server.security import TOKEN_HEADER
from annotate.store.store import Store


class Restarted:
    """A server on a folder; `start` again gives it the address that it had."""

    def __init__(self, folder, port=0):
        """Serve a folder; port 0 leaves the port to the program."""
        self.folder, self.port, self._asked = folder, None, port
        self.process = self.client = self.address = None

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self.kill()

    @property
    def base_url(self):
        """Where it is."""
        return f"http://127.0.0.1:{self.port}"

    def get(self, path):
        """Ask it, as the page would."""
        return self.client.get(path)

    def start(self):
        """Start it; what it prints is its address."""
        words = [sys.executable, "-m", "annotate", "open", str(self.folder), "--no-browser"]
        words += ["--annotator", "ann", "--port", str(self._asked)]
        self.process = subprocess.Popen(
            words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        )
        for line in self.process.stdout:
            if found := re.search(r"http://127\.0\.0\.1:(\d+)/\?token=(\S+)", line):
                self.address, self.port = found[0], int(found[1])
                headers = {TOKEN_HEADER: found[2]}
                self.client = httpx.Client(base_url=self.base_url, headers=headers, timeout=30)
                return
        raise AssertionError("the server did not start")

    def kill(self):
        """End it at once, wherever it is."""
        with suppress(ProcessLookupError):
            os.kill(self.process.pid, signal.SIGKILL)
        self.process.communicate()
        self.client.close()


def kept(folder):
    """What the logs of a folder hold, by photo, oldest first: kind and body of each operation."""
    store = Store(folder)
    found = {}
    with store._reading() as database:
        for photo, kind, body in database.execute(
            "SELECT photo, kind, body FROM operations JOIN labels ON labels.id = label"
            " ORDER BY operations.id"
        ):
            if kind != "open":
                found.setdefault(photo, []).append((kind, json.loads(body)))
    store.close()
    return found


def kept_anchors(folder, photo):
    """Columns of the anchors in the log of a photo, in order."""
    return [body["column"] for kind, body in kept(folder).get(photo, []) if kind == "anchor"]
