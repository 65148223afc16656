"""Running networks from ONNX files: what goes in and comes out, and OpenCV to run them.

OpenCV runs a network but does not tell what it wants. The file does: it is a protocol buffer, of
which only the few fields are read that describe inputs and outputs.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import prod
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from skyline_viz.arrays import F32, U8
from skyline_viz.networks.child import opened
from skyline_viz.networks.trial import remember, try_network
from skyline_viz.system.settings import MethodError

MOST_BYTES = 1 << 31
"""Bytes that a network's file may have: no protocol buffer is larger."""

MEAN = (0.485, 0.456, 0.406)
"""Mean of ImageNet's photos, red, green and blue, in [0, 1]."""

STD = (0.229, 0.224, 0.225)
"""Their standard deviation."""

ROUNDING = 1e-3
"""So far outside of [0, 1] a probability may be."""

_USUAL = 256  # rows and columns to try a network with
_LARGEST_INPUT = 3 * 150_000_000  # numbers of an input: the largest photo, in three colours
_MOST_FIELDS = 2_000_000  # of a message
_GRAPH, _INITIALIZER, _INPUT, _OUTPUT, _NOTES = 7, 5, 11, 12, 14
_INTEGERS = frozenset({2, 3, 4, 5, 6, 7, 9, 12, 13})  # element types of ONNX, bool among them


@dataclass(frozen=True)
class Value:
    """An input or an output."""

    name: str
    """Its name."""

    shape: tuple[int, ...]
    """Its shape; 0 where the size is free. Empty where the file does not say."""

    whole: bool
    """Whether it holds integers."""


@dataclass(frozen=True)
class Header:
    """Inputs, without the weights, and outputs of a network."""

    inputs: tuple[Value, ...]
    outputs: tuple[Value, ...]


def read_header(data: bytes) -> Header:
    """Inputs and outputs of an ONNX file.

    Raises:
        ValueError: It is no ONNX file.
    """
    view = memoryview(data)
    graphs = [part for number, part in _fields(view) if number == _GRAPH]
    if len(graphs) != 1 or not isinstance(graphs[0], memoryview):
        raise ValueError("it is not an ONNX file")
    inputs, outputs, weights = [], [], set()
    for number, part in _fields(graphs[0]):
        if number == _INITIALIZER:
            weights.add(_text(_first(part, 8)))
        elif number == _INPUT:
            inputs.append(_value(part))
        elif number == _OUTPUT:
            outputs.append(_value(part))
    return Header(tuple(one for one in inputs if one.name not in weights), tuple(outputs))


def read_notes(data: bytes) -> dict[str, str]:
    """What an ONNX file says of itself, by name.

    Raises:
        ValueError: It is no ONNX file.
    """
    notes = (part for number, part in _fields(memoryview(data)) if number == _NOTES)
    return {_text(_first(one, 1)): _text(_first(one, 2)) for one in notes}


def read_network(path: Path) -> bytes:
    """The content of a user's file.

    Raises:
        MethodError: It cannot be read, or is larger than any ONNX file can be.
    """
    try:
        if path.exists() and not path.is_file():
            raise MethodError(f"{path} cannot be read: it is no file.")
        size = path.stat().st_size
        if size > MOST_BYTES:
            raise MethodError(f"{path} has {size:,} bytes, and {MOST_BYTES:,} are the limit.")
        return path.read_bytes()
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise MethodError(f"{path} cannot be read: {reason}.") from error


class HoldsNetwork:
    """A method that keeps its opened network in ``_network``.

    That does not go to other processes; that its content has been tried does.
    """

    def __getstate__(self) -> dict[str, Any]:
        """Without the opened network."""
        state = dict(vars(self))
        opened: Network | None = state.pop("_network", None)
        return {**state, "_tried": opened.digest if opened else ""}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Remember what was tried."""
        if tried := state.pop("_tried"):
            remember(tried)
        vars(self).update(state)


class Network:
    """A network that is ready to run."""

    def __init__(self, data: bytes, name: str, *, classic: bool = False) -> None:
        """Read an ONNX file.

        Args:
            data: Its content.
            name: What to call it in messages.
            classic: Whether OpenCV's classic engine runs it, see `child.opened`.

        Raises:
            MethodError: It is no ONNX file, OpenCV cannot run such a network, or dies of it.
        """
        self.name = name
        try:
            self.header = read_header(data)
        except ValueError:
            raise MethodError(f"{name} is not an ONNX file.") from None
        if not self.header.inputs or not self.header.outputs:
            raise MethodError(f"{name} takes nothing, or gives nothing.")
        self.digest = try_network(data, self._some_input(), name, classic=classic)
        """Of its content and engine."""
        with self._explained("cannot be read by OpenCV"):
            self._net = opened(data, classic=classic)

    def run(self, blob: F32) -> np.ndarray[Any, np.dtype[Any]]:
        """The first output for an input ``(1, ...)``.

        Raises:
            MethodError: The network does not run on it, or gives something that is no number.
        """
        with self._explained("cannot be run"):
            self._net.setInput(blob, self.header.inputs[0].name)
            output = np.asarray(self._net.forward(self.header.outputs[0].name))
        if not np.isfinite(output).all():
            raise MethodError(f"{self.name} gives values that are no finite numbers.")
        return output

    def _some_input(self) -> tuple[int, ...]:
        """Shape of an input; where the file leaves a side free, of a usual length."""
        shape = self.header.inputs[0].shape or (1, 3, 0, 0)
        last = len(shape) == 4 and shape[1] != 3 and shape[3] == 3  # channels
        usual = (1, _USUAL, _USUAL, 3) if last else (1, 3, _USUAL, _USUAL)
        sides = tuple(side or usual[min(at, 3)] for at, side in enumerate(shape))
        if prod(sides) > _LARGEST_INPUT:
            raise MethodError(f"{self.name} takes {shape}, which is more than any photo.")
        return sides

    @contextmanager
    def _explained(self, trouble: str) -> Iterator[None]:
        """Make one sentence of what OpenCV raises, without what it prints besides."""
        try:
            with _quiet():
                yield
        except cv2.error as error:
            reason = " ".join(str(error.err or error).split())[:200].rstrip(". ")
            raise MethodError(f"{self.name} {trouble}: {reason}.") from error


class _Quiet:
    """Threads in which OpenCV is silent, and how loud it was before the first of them."""

    lock = threading.Lock()
    threads = 0
    level = 0


@contextmanager
def _quiet() -> Iterator[None]:
    """Silence OpenCV while any thread is in here; its level is one for all of them."""
    with _Quiet.lock:
        if not _Quiet.threads:
            _Quiet.level = cv2.utils.logging.getLogLevel()
            cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
        _Quiet.threads += 1
    try:
        yield
    finally:
        with _Quiet.lock:
            _Quiet.threads -= 1
            if not _Quiet.threads:
                cv2.utils.logging.setLogLevel(_Quiet.level)


def probabilities(values: F32, *, logits: bool = False) -> F32:
    """Probabilities of what a network gave: logits, if told so or outside of [0, 1].

    What is outside by no more than rounding is a probability.
    """
    if logits or values.min() < -ROUNDING or values.max() > 1 + ROUNDING:
        return sigmoid(values)
    return np.asarray(np.clip(values, 0, 1), np.float32)


def normalised(photo: U8, mean: tuple[float, ...], std: tuple[float, ...]) -> F32:
    """Input ``(1, 3, H, W)`` of a photo ``(H, W, 3)`` uint8: in [0, 1], less mean, over std."""
    values = (photo / np.float32(255) - np.array(mean)) / np.array(std)
    return np.ascontiguousarray(values.transpose(2, 0, 1)[None], np.float32)


def sigmoid(logits: F32) -> F32:
    """Probabilities of logits."""
    return np.asarray(1 / (1 + np.exp(-np.clip(logits, -30, 30))), np.float32)


def padded(photo: U8, multiple: int = 32) -> U8:
    """A photo whose lower and right rim is repeated until its sides are such multiples."""
    down, across = (-side % multiple for side in photo.shape[:2])
    repeated: U8 = cv2.copyMakeBorder(photo, 0, down, 0, across, cv2.BORDER_REPLICATE)
    return repeated


def _fields(view: memoryview | int) -> Iterator[tuple[int, memoryview | int]]:
    """Numbers and contents of the fields of a protocol buffer.

    Raises:
        ValueError: It is none.
    """
    if isinstance(view, int):
        raise ValueError("a number, not a message")
    at = count = 0
    while at < len(view):
        count += 1
        if count > _MOST_FIELDS:
            raise ValueError("it has too many fields")
        key, at = _varint(view, at)
        kind = key & 7
        if kind == 0:
            number, at = _varint(view, at)
            yield key >> 3, number
            continue
        if kind == 2:
            length, at = _varint(view, at)
        elif kind in (1, 5):
            length = 8 if kind == 1 else 4
        else:
            raise ValueError("no such kind of field")
        if at + length > len(view):
            raise ValueError("it ends too early")
        yield key >> 3, view[at : at + length]
        at += length


def _varint(view: memoryview, at: int) -> tuple[int, int]:
    number = 0
    for shift in range(0, 70, 7):
        if at >= len(view):
            break
        byte = view[at]
        at += 1
        number |= (byte & 127) << shift
        if byte < 128:
            return number, at
    raise ValueError("it ends too early")


def _first(view: memoryview | int | None, *path: int) -> memoryview | int | None:
    """The content of the field at the end of a path of field numbers; None where there is none."""
    for wanted in path:
        if view is None:
            break
        view = next((part for number, part in _fields(view) if number == wanted), None)
    return view


def _text(part: memoryview | int | None) -> str:
    return bytes(part).decode("utf-8", "replace") if isinstance(part, memoryview) else ""


def _value(part: memoryview | int) -> Value:
    kind = _first(part, 2, 1, 1)
    shape = _first(part, 2, 1, 2)
    sizes = []
    for number, dimension in _fields(shape) if shape is not None else ():
        if number == 1:
            size = _first(dimension, 1)
            sizes.append(size if isinstance(size, int) else 0)
    return Value(_text(_first(part, 1)), tuple(sizes), kind in _INTEGERS)
