"""Drives the viewer as a person would: hovers, clicks, and reads what it says.

It speaks to the viewer through ``rerun viewer-mcp``, the Model Context Protocol over standard input
and output. Tests alone may: what it finds are texts on the screen, which change with the version.
"""

import json
import subprocess

import psutil

from skyline_viz.system.aftermath import ended, started
from skyline_viz.system.loopback import LOOPBACK
from skyline_viz.viewer.program.rerun_internals import ViewerError, program


def listening(process=None):
    """Addresses and ports on which this process and its children listen."""
    process = process or psutil.Process()
    return [
        (one.pid, connection.laddr.ip, connection.laddr.port)
        for one in (process, *process.children(recursive=True))
        for connection in one.net_connections("inet")
        if connection.status == psutil.CONN_LISTEN
    ]


def viewer_port(besides=()):
    """Port of the one viewer that this process has started, besides those on other ports."""
    here = psutil.Process().pid
    (port,) = {port for pid, _, port in listening() if pid != here} - set(besides)
    return port


class Robot:
    """A hand for the viewer that listens on a port, for as long as a block lasts."""

    def __init__(self, port):
        self._process = started(
            [program(), "viewer-mcp", "--endpoint", f"http://{LOOPBACK}:{port}"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            bufsize=1,
        )
        self._number = 0
        client = {"name": "skyline-viz", "version": "1"}
        said = {"protocolVersion": "2024-11-05", "capabilities": {}, "clientInfo": client}
        self._call("initialize", said)
        self._send({"jsonrpc": "2.0", "method": "notifications/initialized"})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.kill()
        self._process.communicate()
        ended(self._process)

    def do(self, tool, **arguments):
        """Do something, such as ``click`` or ``hover``; return what the viewer says."""
        answer = self._call("tools/call", {"name": tool, "arguments": arguments})
        text = "\n".join(part.get("text", "") for part in answer["content"])
        if answer.get("isError"):
            raise ViewerError(text)
        return text

    def widgets(self, **which):
        """Everything on the screen that fits, such as ``role="CheckBox"``."""
        found = []
        waiting = json.loads(self.do("widget_tree", **which))["nodes"]
        while waiting:
            node = waiting.pop()
            found.append(node)
            waiting += node.get("children", [])
        return found

    def says(self, text):
        """Texts on the screen that hold `text`."""
        values = [str(node.get("value")) for node in self.widgets(content_contains=text)]
        return [value for value in values if text in value]

    def _send(self, message):
        self._process.stdin.write(json.dumps(message) + "\n")
        self._process.stdin.flush()

    def _call(self, method, parameters):
        self._number += 1
        self._send({"jsonrpc": "2.0", "id": self._number, "method": method, "params": parameters})
        while line := self._process.stdout.readline():
            message = json.loads(line)
            if message.get("id") == self._number:
                if "error" in message:
                    raise ViewerError(str(message["error"]))
                return message["result"]
        raise ViewerError("the viewer is gone.")
