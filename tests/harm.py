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


class Mutations:
    """Mutants of a file, one after another."""

    def __init__(self, path: Path, seed: int) -> None:
        self.plain, self.parts = path.read_bytes(), members(path)
        self.draw = random.Random(seed)

    def next(self) -> bytes:
        """The next one: four of five with right checksums, the others of the file's own bytes."""
        if self.draw.random() < 0.2:
            return self._harmed(self.plain)
        parts = dict(self.parts)
        name = self.draw.choice([*parts, "header"])
        kind = self.draw.choice(("front", "front", "anywhere", "dropped", "renamed", "swapped"))
        if kind == "front":  # type, shape, and the first numbers; of the header all there is
            first = len(parts[name]) if name == "header" else 140
            parts[name] = self._harmed(parts[name][:first]) + parts[name][first:]
        elif kind == "anywhere":
            parts[name] = self._harmed(parts[name])
        elif kind == "dropped":
            del parts[name]
        elif kind == "renamed":
            parts[name + "x"] = parts.pop(name)
        else:
            parts[name] = parts[self.draw.choice(list(parts))]
        return npz_of(parts)

    def _harmed(self, content: bytes) -> bytes:
        """Some bytes changed, cut out, doubled, or the end cut off."""
        harmed = bytearray(content)
        for _ in range(self.draw.choice((1, 1, 2, 5))):
            if not harmed:
                break
            at = self.draw.randrange(len(harmed))
            how = self.draw.random()
            if how < 0.6:
                harmed[at] = self.draw.choice((0, 255, 48, 57, self.draw.randrange(256)))
            elif how < 0.75:
                del harmed[at : at + self.draw.randrange(1, 9)]
            elif how < 0.9:
                harmed[at:at] = harmed[at : at + self.draw.randrange(1, 9)]
            else:
                del harmed[at:]
        return bytes(harmed)
