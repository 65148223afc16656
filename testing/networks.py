"""Tiny sky networks as ONNX files, written without any package for it."""

import struct
from functools import cache

import numpy as np

from skyline_viz.sky_model import SkyModel

FLOAT, INTS = 1, 7
"""Types of ONNX: of numbers in a tensor, and of an attribute."""


def bright_sky(
    rows=12,
    columns=16,
    *,
    taken="photo",
    given="logit",
    maps=1,
    sharpness=40.0,
    bias=None,
    colours=(1, 1, 1),
    notes=None,
):
    """A network that calls bright regions of 2 by 2 pixels sky, as the content of its file.

    Args:
        rows: Rows of the photo that it takes; 0 for any.
        columns: Columns.
        taken: Name of its input.
        given: Name of its output.
        maps: Maps that it gives.
        sharpness: How far apart the logits of white and black are.
        bias: The logit of black; minus half the sharpness unless given.
        colours: How much red, green and blue count.
        notes: What the file says of itself, by name.
    """
    weights = np.full((maps, 3, 2, 2), sharpness / 12, np.float32)
    weights *= np.array(colours, np.float32).reshape(1, 3, 1, 1)
    bias = np.full(maps, -sharpness / 2 if bias is None else bias, np.float32)
    node = _field(1, taken.encode())
    node += _field(1, b"w") + _field(1, b"b") + _field(2, given.encode()) + _field(4, b"Conv")
    for name, sides in ((b"kernel_shape", (2, 2)), (b"strides", (2, 2))):
        attribute = _field(1, name) + b"".join(_number(8, side) for side in sides)
        node += _field(5, attribute + _number(20, INTS))
    graph = _field(1, node) + _field(2, b"sky")
    graph += _field(5, _tensor(b"w", weights)) + _field(5, _tensor(b"b", bias))
    graph += _field(11, _value(taken, (1, 3, rows, columns)))
    graph += _field(12, _value(given, (1, maps, rows // 2, columns // 2)))
    said = b"".join(
        _field(14, _field(1, name.encode()) + _field(2, note.encode()))
        for name, note in (notes or {}).items()
    )
    return _number(1, 8) + _field(7, graph) + _field(8, _number(2, 13)) + said


@cache
def bright_model(rows=12, columns=16, sharpness=40.0):
    """A sky model that calls bright regions sky."""
    return SkyModel("bright", bright_sky(rows, columns, sharpness=sharpness))


def _tensor(name, values):
    dims = b"".join(_number(1, side) for side in values.shape)
    return dims + _number(2, FLOAT) + _field(8, name) + _field(9, values.tobytes())


def _value(name, shape):
    sides = b"".join(_field(1, _number(1, side) if side else _field(2, b"n")) for side in shape)
    kind = _field(1, _number(1, FLOAT) + _field(2, sides))
    return _field(1, name.encode()) + _field(2, kind)


def _field(number, content):
    """A field of bytes of a protocol buffer."""
    return _varint(number << 3 | 2) + _varint(len(content)) + content


def _number(number, value):
    """A field that is a number."""
    return _varint(number << 3) + _varint(value)


def _varint(value):
    parts = []
    while value > 127:
        parts.append(value & 127 | 128)
        value >>= 7
    return struct.pack(f"{len(parts) + 1}B", *parts, value)
