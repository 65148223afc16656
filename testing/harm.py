"""Files of arrays, harmed in many ways, whose checksums are right all the same."""

import io
import random
import zipfile
from pathlib import Path

import numpy as np


def members(path: Path) -> dict[str, bytes]:
    """Unpacked content of each array of a file, by its name."""
    with zipfile.ZipFile(path) as archive:
        return {one.removesuffix(".npy"): archive.read(one) for one in archive.namelist()}


def npz_of(parts: dict[str, bytes]) -> bytes:
    """A file of such arrays; a name with a dot or a slash is kept as it is."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name if "." in name or "/" in name else f"{name}.npy", content)
    return file.getvalue()


def as_npy(array: np.ndarray) -> bytes:
    """An array as NumPy writes it."""
    file = io.BytesIO()
    np.save(file, array, allow_pickle=True)
    return file.getvalue()


def small_network() -> bytes:
    """A network that calls bright pixels sky, as an ONNX file."""
    from onnx import TensorProto, helper, numpy_helper  # noqa: PLC0415

    weights = {
        "kernel": np.full((1, 3, 3, 3), 2.0, np.float32),
        "bias": np.array([-20], np.float32),
    }
    nodes = [
        helper.make_node("Conv", ["photo", "kernel", "bias"], ["seen"], pads=[1, 1, 1, 1]),
        helper.make_node("Relu", ["seen"], ["kept"]),
        helper.make_node("Sigmoid", ["kept"], ["sky"]),
    ]
    ends = [
        helper.make_tensor_value_info(name, TensorProto.FLOAT, [1, channels, "h", "w"])
        for name, channels in (("photo", 3), ("sky", 1))
    ]
    held = [numpy_helper.from_array(array, name) for name, array in weights.items()]
    graph = helper.make_graph(nodes, "sky", ends[:1], ends[1:], held)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 13)], ir_version=8)
    written: bytes = model.SerializeToString()
    return written


def harmed(content: bytes, draw: random.Random) -> bytes:
    """Some bytes changed, cut out or doubled, or the end cut off."""
    result = bytearray(content)
    for _ in range(draw.choice((1, 1, 2, 5))):
        if not result:
            break
        at, how = draw.randrange(len(result)), draw.random()
        if how < 0.6:
            result[at] = draw.choice((0, 255, 48, 57, draw.randrange(256)))
        elif how < 0.75:
            del result[at : at + draw.randrange(1, 9)]
        elif how < 0.9:
            result[at:at] = result[at : at + draw.randrange(1, 9)]
        else:
            del result[at:]
    return bytes(result)


class Mutations:
    """Mutants of a file, one after another."""

    def __init__(self, path: Path, seed: int) -> None:
        self.plain, self.parts = path.read_bytes(), members(path)
        self.draw = random.Random(seed)

    def next(self) -> bytes:
        """The next one: four of five with right checksums, the others of the file's own bytes."""
        if self.draw.random() < 0.2:
            return harmed(self.plain, self.draw)
        parts = dict(self.parts)
        name = self.draw.choice([*parts, "header"])
        kind = self.draw.choice(("front", "front", "anywhere", "dropped", "renamed", "swapped"))
        if kind == "front":  # type, shape, and the first numbers; of the header all there is
            first = len(parts[name]) if name == "header" else 140
            parts[name] = harmed(parts[name][:first], self.draw) + parts[name][first:]
        elif kind == "anywhere":
            parts[name] = harmed(parts[name], self.draw)
        elif kind == "dropped":
            del parts[name]
        elif kind == "renamed":
            parts[name + "x"] = parts.pop(name)
        else:
            parts[name] = parts[self.draw.choice(list(parts))]
        return npz_of(parts)
