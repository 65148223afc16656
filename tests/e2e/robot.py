"""Drives the viewer as a person would: hovers, clicks, types, and reads what it says."""

import json
import subprocess
from pathlib import Path
from time import monotonic, sleep

import psutil
import rerun_cli

PROGRAM = Path(rerun_cli.__file__).with_name("rerun")
PATIENCE = 40.0


def listening(process=None):
    """Addresses and ports on which this process and its children listen."""
    process = process or psutil.Process()
    return [
        (one.pid, connection.laddr.ip, connection.laddr.port)
        for one in (process, *process.children(recursive=True))
        for connection in one.net_connections("inet")
        if connection.status == psutil.CONN_LISTEN
    ]


def viewer_port():
    """Port of the one viewer that this process has started."""
    here = psutil.Process().pid
    (port,) = {port for pid, _, port in listening() if pid != here}
    return port


def until(what, patience=PATIENCE):
    """Ask again and again until the answer is true, and return it."""
    deadline = monotonic() + patience
    while not (answer := what()):
        assert monotonic() < deadline, "it never happened"
        sleep(0.1)
    return answer


class Robot:
    """A hand and an eye for a viewer."""

    def __init__(self, port):
        self._process = subprocess.Popen(
            [PROGRAM, "viewer-mcp", "--endpoint", f"http://127.0.0.1:{port}"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            bufsize=1,
        )
        self._number = 0
        client = {"name": "tests", "version": "1"}
        said = {"protocolVersion": "2024-11-05", "capabilities": {}, "clientInfo": client}
        self._call("initialize", said)
        self._send({"jsonrpc": "2.0", "method": "notifications/initialized"})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.stdin.close()
        self._process.wait(10)
        self._process.stdout.close()

    def do(self, tool, **arguments):
        """Do something; return what it says."""
        answer = self._call("tools/call", {"name": tool, "arguments": arguments})
        text = "\n".join(part.get("text", "") for part in answer["content"])
        assert not answer.get("isError"), text
        return text

    def widgets(self, **which):
        """Everything on the screen that fits, flat."""
        found = []
        waiting = json.loads(self.do("widget_tree", **which))["nodes"]
        while waiting:
            node = waiting.pop()
            found.append(node)
            waiting += node.get("children", [])
        return found

    def says(self, text):
        """Texts on the screen that hold `text`."""
        return [
            node["value"]
            for node in self.widgets(content_contains=text)
            if text in str(node.get("value"))
        ]

    def _send(self, message):
        self._process.stdin.write(json.dumps(message) + "\n")
        self._process.stdin.flush()

    def _call(self, method, parameters):
        self._number += 1
        self._send({"jsonrpc": "2.0", "id": self._number, "method": method, "params": parameters})
        while True:
            message = json.loads(self._process.stdout.readline())
            if message.get("id") == self._number:
                assert "error" not in message, message
                return message["result"]
