"""A hand on a viewer that runs: it reads what is on the screen, clicks, types, and ends edits.

The viewer (rerun-sdk 0.41) keeps a click on a flag to itself until something else is clicked or
Escape is pressed; a flag that was clicked last would be lost with the window. `ended_edits` presses
Escape then. It speaks to the viewer through ``rerun viewer-mcp``, the Model Context Protocol over
standard input and output.
"""

from __future__ import annotations

import json
import re
import subprocess
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

from skyline_viz.system.aftermath import ended, started
from skyline_viz.viewer.process import LOOPBACK, PROGRAM, ViewerError

_LOOK_EVERY = 1.0  # seconds; each look makes the viewer draw once


class Hand:
    """Drives the viewer that listens on a port of this machine."""

    def __init__(self, port: int) -> None:
        self._process: subprocess.Popen[Any] = started(
            [PROGRAM, "viewer-mcp", "--endpoint", f"http://{LOOPBACK}:{port}"],
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

    def close(self) -> None:
        """Let go of the viewer."""
        self._process.kill()
        self._process.communicate()
        ended(self._process)

    def do(self, tool: str, **arguments: Any) -> str:  # noqa: ANN401
        """Do something, such as ``click`` or ``press_key``; return what the viewer says.

        Raises:
            ViewerError: It does not, or there is no viewer any more.
        """
        answer = self._call("tools/call", {"name": tool, "arguments": arguments})
        text = "\n".join(part.get("text", "") for part in answer["content"])
        if answer.get("isError"):
            raise ViewerError(text)
        return text

    def widgets(self, **which: str) -> list[dict[str, Any]]:
        """Everything on the screen that fits, such as ``role="CheckBox"``."""
        found = []
        waiting = json.loads(self.do("widget_tree", **which))["nodes"]
        while waiting:
            node = waiting.pop()
            found.append(node)
            waiting += node.get("children", [])
        return found

    def says(self, text: str) -> list[str]:
        """Texts on the screen that hold `text`."""
        values = [str(node.get("value")) for node in self.widgets(content_contains=text)]
        return [value for value in values if text in value]

    def _send(self, message: dict[str, Any]) -> None:
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(json.dumps(message) + "\n")
            self._process.stdin.flush()
        except OSError as error:
            raise ViewerError("the viewer is gone.") from error

    def _call(self, method: str, parameters: dict[str, Any]) -> dict[str, Any]:
        assert self._process.stdout is not None
        self._number += 1
        self._send({"jsonrpc": "2.0", "id": self._number, "method": method, "params": parameters})
        while line := self._process.stdout.readline():
            message = json.loads(line)
            if message.get("id") == self._number:
                if "error" in message:
                    raise ViewerError(str(message["error"]))
                return dict(message["result"])
        raise ViewerError("the viewer is gone.")


@contextmanager
def ended_edits(port: int, saved: Callable[[], int]) -> Iterator[None]:
    """End edits of flags in a table of cards, for as long as the block lasts.

    Where the viewer cannot be driven, nothing happens: clicking elsewhere ends edits, too.

    Args:
        port: Of the viewer.
        saved: Tells how many flags are set in what the viewer has handed over.
    """
    stop = threading.Event()

    def work() -> None:
        with suppress(ViewerError):
            hand = _patient_hand(port, stop)
            try:
                _end_edits(hand, saved, stop)
            finally:
                hand.close()

    threading.Thread(target=work, daemon=True).start()
    try:
        yield
    finally:
        stop.set()


def _patient_hand(port: int, stop: threading.Event) -> Hand:
    while True:  # the viewer may not be there yet
        hand = Hand(port)
        try:
            hand.says("marked")
        except ViewerError:
            hand.close()
            if stop.wait(_LOOK_EVERY):
                raise
        else:
            return hand


def _end_edits(hand: Hand, saved: Callable[[], int], stop: threading.Event) -> None:
    ended = 0, 0
    while not stop.wait(_LOOK_EVERY):
        counts = _marked(hand), saved()
        # a filter hides flags: counts may differ for long, for which once is enough, and agree
        # by chance when a flag has just been set, which changes what is on the screen
        open_edit = counts[0] != counts[1] or counts[0] != ended[0]
        if open_edit and counts != ended and not _typing(hand):
            hand.do("press_key", key="Escape")
            ended = counts


def _marked(hand: Hand) -> int:
    """How many flags are set on the screen."""
    for text in hand.says("marked"):
        if found := re.fullmatch(r"(\d+) marked", text):
            return int(found[1])
    return 0


def _typing(hand: Hand) -> bool:
    """Whether somebody is writing a comment, which Escape would cut short."""
    return any(one.get("focused") for one in hand.widgets(role="TextInput"))
