"""Label files and masks: whatever is in them, no label comes out that is not theirs.

A *misread* label is one that came in without a word and is not, in every column that it shows,
the line that the file was made from.
"""

from __future__ import annotations

import random
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from PIL import Image

from annotate.formats import FORMATS, FormatError, export_labels, import_labels
from annotate.store.labels import Label
from benchmarks.reliability import Trial
from skyline_viz.command_line.inputs import output_names
from skyline_viz.datasets.layouts import open_dataset
from skyline_viz.datasets.tree import photos_below
from skyline_viz.datasets.truths import read_truth
from skyline_viz.photo import write_photo
from skyline_viz.skyline import Skyline, SkylineError
from testing import label_documents as documents
from testing import label_files as made

LINES, FOLDERS, DOCUMENTS, PICTURES = 400, 120, 6000, 3000
"""How many random lines, folders with random names, damaged label files and damaged pictures."""


def measured() -> list[Trial]:
    """Try everything."""
    return [
        _masks("masks that mean one line", {**made.SAME, **made.NEAR}, read=True),
        _masks("masks that can mean two, and pictures that are none", made.UNREADABLE, read=False),
        _random_lines(),
        _documents_read(),
        _documents_refused(),
        _names(),
        _damaged_documents(),
        _damaged_pictures(),
    ]


def _masks(fault: str, kinds: dict[str, Callable[[Path], Path]], *, read: bool) -> Trial:
    """Each picture through each way in."""
    misread, refused, times = 0, 0, 0
    for name, make in kinds.items():
        with _folder() as folder:
            (folder / "photos" / "masks").mkdir(parents=True)
            write_photo(folder / "photos" / made.NAME, made.photo())
            path = make(folder / "photos" / "masks")
            path = path.rename(path.with_name(f"ridge{path.suffix}"))
            for way in (_by_itself, _in_a_data_set, _imported):
                times += 1
                try:
                    found = way(folder, path)
                except (SkylineError, FormatError):
                    refused += 1
                    continue
                misread += not read or not _close(found, made.ROWS, 2 if name in made.NEAR else 0)
    how = "read_truth, open_dataset and import, for each kind"
    lost = _lost(misread, "misread") if not (read and refused) else f"{refused} not read"
    return Trial(fault, f"{len(kinds)} kinds: {how}", times, lost)


def _random_lines() -> Trial:
    """Random lines as masks of all conventions: right, or asked about."""
    chance = np.random.default_rng(0)
    ways: dict[str, Callable[[np.ndarray], object]] = {
        "m.png": lambda sky: np.where(sky, 0, 255).astype(np.uint8),
        "w.png": lambda sky: np.where(sky, 255, 0).astype(np.uint8),
        "i.png": lambda sky: np.where(sky, 0, 1).astype(np.uint8),
        "d.png": lambda sky: np.where(sky, 255, 0).astype(np.uint16),
        "c.png": lambda sky: np.where(sky[:, :, None], (0, 0, 255), (0, 0, 0)).astype(np.uint8),
        "a.png": lambda sky: np.dstack([np.zeros((*sky.shape, 3)), ~sky * 255]).astype(np.uint8),
    }
    misread = times = 0
    with _folder() as folder:
        for _ in range(LINES):
            steps = chance.normal(0, chance.choice([0.3, 1, 4, 20]), 160)
            rows = np.round(chance.integers(-20, 140) + np.cumsum(steps)).clip(0, 120).astype(int)
            for name, make in ways.items():
                times += 1
                Image.fromarray(make(Skyline(rows).to_mask(120))).save(folder / name)
                try:
                    found = read_truth(folder / name)
                except SkylineError:
                    continue
                convention = set(rows.tolist()) in ({0}, {120})
                misread += not convention and not _close(found, rows, 0)
    return Trial(
        "either of two values is sky",
        f"{LINES} random lines, {len(ways)} kinds of mask each",
        times,
        _lost(misread, "misread"),
    )


def _documents_read() -> Trial:
    lost = times = 0
    for kind, document in documents.READ.items():
        with _folder() as folder:
            write_photo(folder / "photos" / made.NAME, made.photo())
            ending = "xml" if kind.startswith("cvat") else "json"
            file = made.written(folder / "in" / f"theirs.{ending}", document)
            packed = made.zipped(folder / "theirs.zip", {file.name: file.read_bytes()})
            for source in (file, file.parent, packed):
                times += 1
                (found,) = import_labels(source, folder / "photos", [made.NAME])
                lost += not (found.skyline.visible.all() and _close(found.skyline, made.ROWS, 0))
    what = f"{len(documents.READ)} files of COCO, LabelMe, CVAT, each as file, folder and ZIP"
    return Trial(
        "other programs' spellings, shapes and encodings", what, times, _lost(lost, "misread")
    )


def _documents_refused() -> Trial:
    lost = times = 0
    for document, words in documents.SAID.values():
        with _folder() as folder:
            write_photo(folder / "photos" / made.NAME, made.photo())
            text = document if isinstance(document, str) else ""
            ending = "xml" if text.lstrip().startswith("<") else "json"
            file = made.written(folder / f"theirs.{ending}", document)
            times += 1
            try:
                import_labels(file, folder / "photos", [made.NAME])
                lost += 1
            except FormatError as error:
                lost += not all(word in str(error) for word in words)
    return Trial(
        "files that are not what is needed",
        "imported; the sentence must name what was found",
        times,
        _lost(lost, "without its sentence"),
    )


def _names() -> Trial:
    """Exports and outputs of ``detect`` of photos with random names."""
    chance = random.Random(0)
    letters = "ab.-_ ,'#@&%?*:;\"<>|\\()[]{}+=~`$!^éüß富士山\u0301\n\t\x01"
    usual = ["a", "A", "a.png", "a_mask", "a-1", "b", "a.", "a,b", "a_b", "é", "e\u0301"]
    lost = times = 0
    for _ in range(FOLDERS):
        with _folder() as folder:
            photos = folder / "photos"
            for _ in range(chance.randint(1, 6)):
                made_up = "".join(chance.choices(letters, k=chance.randint(1, 8))).lstrip(".")
                stem = chance.choice([made_up or "x", chance.choice(usual)])
                place = chance.choice(["", "", "x/", "y/"])
                name = f"{place}{stem}{chance.choice(['.png', '.PNG', '.bmp'])}"
                write_photo(photos / name, np.zeros((16, 24, 3), np.uint8))
            names = [path.relative_to(photos).as_posix() for path in photos_below(photos)]
            labels = [_label(name, 2 + number) for number, name in enumerate(names)]
            for kind in FORMATS:
                times += len(names)
                export_labels(labels, photos, folder / kind, kind)
                lost += _not_back(folder / kind, photos, names, {one.name: one for one in labels})
            flat = [item for item in _items(photos) if item.photo_path.parent == photos]
            for item, called in zip(flat, output_names(flat), strict=True):
                label = labels[names.index(item.photo_path.name)]
                label.skyline.write_csv(folder / "detected" / f"{called}.csv")
            if flat:
                times += len(flat)
                wanted = {item.photo_path.name for item in flat}
                some = {one.name: one for one in labels if one.name in wanted}
                lost += _not_back(folder / "detected", photos, names, some)
    return Trial(
        "photos of any name",
        f"{FOLDERS} folders of random names: all formats out and in, and the files of detect in",
        times,
        _lost(lost, "not back, or another's"),
    )


def _damaged_documents() -> Trial:
    chance = random.Random(0)
    broken = 0
    with _folder() as folder:
        write_photo(folder / "photos" / made.NAME, made.photo())
        for _ in range(DOCUMENTS):
            kind = chance.choice(list(documents.READ))
            whole = made.cut_up(documents.READ[kind], chance)
            ending = "xml" if kind.startswith("cvat") else "json"
            file = made.written(folder / f"a.{ending}", whole)
            try:
                import_labels(file, folder / "photos", [made.NAME])
            except FormatError as error:
                broken += len(str(error).splitlines()) != 1
            except Exception:
                broken += 1
    what = "bytes changed, put in, taken out at 1 to 6 places"
    return Trial("damaged label files", what, DOCUMENTS, _lost(broken, "without a sentence"))


def _damaged_pictures() -> Trial:
    chance = random.Random(0)
    kinds = {**made.SAME, **made.NEAR, **made.UNREADABLE}
    broken = 0
    with _folder() as folder:
        whole = {name: make(folder).read_bytes() for name, make in kinds.items()}
        suffix = {name: make(folder).suffix for name, make in kinds.items()}
        for _ in range(PICTURES):
            name = chance.choice(list(kinds))
            content = bytearray(whole[name])
            for _ in range(chance.randint(1, 8)):
                content[chance.randrange(len(content))] = chance.randrange(256)
            path = folder / f"damaged{suffix[name]}"
            path.write_bytes(bytes(content[: chance.randint(1, len(content))]))
            try:
                read_truth(path)
            except SkylineError as error:
                broken += len(str(error).splitlines()) != 1
            except Exception:
                broken += 1
    what = "bytes changed at 1 to 8 places, and cut off"
    return Trial("damaged masks", what, PICTURES, _lost(broken, "without a sentence"))


def _by_itself(_: Path, path: Path) -> Skyline:
    return read_truth(path)


def _in_a_data_set(folder: Path, _: Path) -> Skyline:
    (item,) = open_dataset(folder / "photos")
    truth = item.truth()
    assert truth is not None
    return truth


def _imported(folder: Path, path: Path) -> Skyline:
    (found,) = import_labels(path.parent, folder / "photos", [made.NAME])
    return found.skyline


def _items(photos: Path) -> Iterator:
    try:
        yield from open_dataset(photos)
    except ValueError:  # there are none outside its folders
        return


def _label(name: str, row: int) -> Label:
    line, origin = Skyline(np.full(24, row)), np.zeros(24, np.uint8)
    return Label(name, "", 24, 16, "ann", 1, "accepted", (), line, origin, (), 0.0, "", False)


def _not_back(source: Path, photos: Path, names: list[str], labels: dict[str, Label]) -> int:
    """How many labels did not come back to their photos."""
    try:
        found = {one.name: one.skyline for one in import_labels(source, photos, names)}
    except FormatError:
        return len(labels)
    return sum(found.get(name) != label.skyline for name, label in labels.items())


def _close(found: Skyline, rows: np.ndarray, tolerance: float) -> bool:
    shown = found.visible
    return bool(shown.any() and np.abs(found.rows - rows)[shown].max() <= tolerance)


def _lost(count: int, what: str) -> str:
    return f"{count} {what}" if count else "nothing"


@contextmanager
def _folder() -> Iterator[Path]:
    with tempfile.TemporaryDirectory() as folder:
        yield Path(folder)
