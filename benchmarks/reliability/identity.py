"""Photos and their labels: files that change, logs from elsewhere, files of labels that break."""

import contextlib
import csv
import io
import json
import random
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

from annotate.cli import main
from annotate.formats import FormatError, import_labels
from annotate.store.contents import Contents
from annotate.store.database import NAME, StoreError
from annotate.store.identity import pixel_digest
from annotate.store.operations import SetStatus, Straight
from annotate.store.store import Store
from annotate.work.importing import checked
from benchmarks.reliability import Trial
from benchmarks.reliability._faults import leave_journal, operation, small_disk
from skyline_viz.photo import PhotoError, read_photo
from testing.edited_photos import replaced, with_comment, with_place, write_jpegs
from testing.labelling import workbench

_PHOTOS = 8
_CHANGES = 250
_OPEN = 100
_LOGS = 4000
_DAMAGES = 250
_AWAY = 40


def measured() -> list[Trial]:
    """Try it all."""
    with tempfile.TemporaryDirectory() as scratch:
        source = labelled(Path(scratch) / "source")
        return [
            changed(source),
            replaced_while_open(),
            imported(source),
            damaged(source),
            *elsewhere(source),
            moved_away(),
        ]


def labelled(folder: Path, photos: int = _PHOTOS) -> Path:
    """A folder of photos, each with a level line of its own, accepted."""
    bench = workbench(write_jpegs(folder, photos))
    for number, photo in enumerate(bench.photos):
        row = 3 + 5 * number
        session = bench.session(photo)
        session.apply(Straight(column=0, row=row, to_column=69, to_row=row), -1)
        session.apply(SetStatus(status="accepted"), -1)
    bench.close()
    return folder


def run(*words: object) -> tuple[int, str]:
    """Exit status of a command, and what it said."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        status = main([str(word) for word in words])
    return status, said.getvalue()


def exported(folder: Path) -> dict[str, set[int]]:
    """Rows of the labels that an export holds, by the stem of the photo."""
    with tempfile.TemporaryDirectory() as scratch:
        out = Path(scratch) / "out"
        run("export", folder, "--out", out)
        found = {}
        for file in out.glob("*.csv"):
            with file.open(newline="") as lines:
                found[file.stem] = {int(float(line["row"])) for line in csv.DictReader(lines)}
        return found


def exported_anew(folder: Path) -> dict[str, set[int]]:
    """Rows of the labels, after the folder has been opened once more."""
    workbench(folder).close()
    return exported(folder)


def pixels_of(folder: Path) -> dict[str, str]:
    """Digest of the pixels of each photo, by its stem."""
    return {path.stem: pixel_digest(read_photo(path)) for path in folder.glob("*.jpg")}


def changed(source: Path) -> Trial:
    """Change files in every way, several times, and compare what leaves with what was made."""
    chance = random.Random(1)
    wrong = lost = named = 0
    made = {
        digest: next(iter(rows))
        for stem, rows in exported(source).items()
        for digest in [pixels_of(source)[stem]]
    }
    for _ in range(_CHANGES):
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(shutil.copytree(source, Path(scratch) / "photos"))
            for step in range(chance.randint(1, 6)):
                change(folder, step, chance)
                if chance.random() < 0.3:
                    run("status", folder)
                if chance.random() < 0.3:
                    workbench(folder).close()
            left, pixels = exported(folder), pixels_of(folder)
            wrong += sum(rows != {made.get(pixels[stem])} for stem, rows in left.items())
            here = {made[one] for one in set(pixels.values()) & set(made)}
            if gone := here - {row for rows in left.values() for row in rows}:
                named += len(gone)
                opened(folder)
                left = exported_anew(folder)
                lost += len(here - {row for rows in left.values() for row in rows})
    return Trial(
        "Photos are edited, replaced, renamed, swapped, copied, deleted and put back",
        f"1 to 6 such changes in a folder of {_PHOTOS} labelled photos, between looks at it; then "
        f"each exported line against the pixels it was made on; {named} labels whose photo was "
        "there only as an edited copy seen before were named as without it, until that was opened",
        _CHANGES,
        _counted(wrong=wrong, lost=lost),
    )


def change(folder: Path, step: int, chance: random.Random) -> None:
    """Change one file."""
    paths = sorted(folder.glob("*.jpg"))
    path, other = chance.sample(paths, 2)
    how = chance.choice(["comment", "place", "replace", "rename", "swap", "copy", "delete", "name"])
    if how == "comment":
        with_comment(path, f"step {step}")
    elif how == "place":
        with_place(path, 40 + step)
    elif how == "replace":
        replaced(path, seed=chance.randrange(100, 10**6))
    elif how == "rename":
        path.rename(folder / f"z{step}.jpg")
    elif how == "swap":
        here, there = path.read_bytes(), other.read_bytes()
        path.write_bytes(there)
        other.write_bytes(here)
    elif how == "copy":
        shutil.copy(path, folder / f"y{step}.jpg")
        with_comment(folder / f"y{step}.jpg")
    elif how == "delete" and len(paths) > 3:
        path.unlink()
    elif how == "name":
        path.replace(other)  # the other one is gone


def replaced_while_open() -> Trial:
    """Replace a photo between two operations of somebody who labels it."""
    taken = refused_wrongly = 0
    for seed in range(_OPEN):
        with tempfile.TemporaryDirectory() as scratch:
            folder = write_jpegs(Path(scratch), 1)
            bench = workbench(folder)
            (photo,) = bench.photos
            session = bench.session(photo)
            path = folder / "hill-0.jpg"
            with_comment(path)
            try:
                session.apply(SetStatus(status="needs review"), -1)
            except PhotoError:
                refused_wrongly += 1
            replaced(path, seed=1000 + seed)
            try:
                session.apply(SetStatus(status="accepted"), -1)
                taken += 1
            except PhotoError:
                pass
            bench.close()
            taken += exported(folder) != {}
    return Trial(
        "A photo is edited, then replaced by another of its size, while it is open",
        "an operation after each; the first is to be kept, the second to be refused",
        2 * _OPEN,
        _counted(**{"given to the wrong photo": taken, "refused without need": refused_wrongly}),
    )


def imported(source: Path) -> Trial:
    """Import logs of random operations."""
    chance = random.Random(2)
    unreadable = errors = kept = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder, file = Path(scratch) / "photos", Path(scratch) / "labels.json"
        run("export", source, "--format", "json", "--out", Path(scratch) / "out")
        document = json.loads((Path(scratch) / "out" / "labels.json").read_text())
        shutil.copytree(source, folder)
        for name in folder.glob("skyline-labels*"):
            name.unlink()
        with closing(Store(folder, reading=True)) as store:
            photos = {photo.name: photo for photo in store.find()}
            contents = Contents.of(folder, photos.values())
            for number in range(1, _LOGS + 1):
                one = {**chance.choice(document["labels"]), "number": number}
                one["operations"] = [operation(chance) for _ in range(chance.randint(0, 5))]
                one["status"] = chance.choice(["in progress", "to do", one["status"]])
                file.write_text(json.dumps({**document, "labels": [one]}))
                try:
                    (found,) = import_labels(file, folder, photos, contents=contents)
                    photo = photos[found.name]
                    log = checked(found, photo, "ann", number, status="accepted", source=file.name)
                    store.insert([log])
                    kept += 1
                except FormatError:
                    continue
                except Exception:
                    errors += 1
            labels = list(store.labels())
            unreadable = len(store.unreadable) + abs(kept - len(labels))
            for number in range(1, _LOGS + 1, 50):
                unreadable += sum(bool(one.problem) for one in store.cards("ann", number).values())
    return Trial(
        "A log from elsewhere holds anything: unknown kinds, numbers of every size, lists, NaN",
        f"random logs imported, of which {kept:,} made sense and were kept, and the others refused "
        "with a sentence; then all read",
        _LOGS,
        _counted(**{"labels that cannot be read": unreadable, "tracebacks": errors}),
    )


def damaged(source: Path) -> Trial:
    """Change random bytes of a file of labels, read it in every way, and repair it."""
    chance = random.Random(3)
    wrong = errors = unrepaired = saved = 0
    before = exported(source)
    for _ in range(_DAMAGES):
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(shutil.copytree(source, Path(scratch) / "photos"))
            path = folder / NAME
            data = bytearray(path.read_bytes())
            for _ in range(chance.randint(1, 7)):
                data[chance.randrange(len(data))] = chance.randrange(256)
            path.write_bytes(data)
            errors += not _answers(lambda folder: run("status", folder), folder)
            errors += not _answers(opened, folder)
            wrong += sum(rows != before[stem] for stem, rows in exported(folder).items())
            try:
                run("repair", folder)
            except Exception:
                errors += 1
            left = exported(folder)
            wrong += sum(rows != before[stem] for stem, rows in left.items())
            saved += len(left)
            unrepaired += run("status", folder)[0] != 0
    hit = _DAMAGES * _PHOTOS - saved
    bad = _counted(**{"other lines than those that were made": wrong, "tracebacks": errors})
    return Trial(
        "Bytes of the file of labels are damaged",
        "1 to 7 random bytes; `status`, each photo opened, `export`, `repair`, and `export` again; "
        f"each line against the one that was made; of {unrepaired} files nothing was saved",
        _DAMAGES,
        f"{hit:,} of {_DAMAGES * _PHOTOS:,} labels were hit, and set aside or refused; else {bad}",
    )


def opened(folder: Path) -> None:
    """Open every photo, as the page does."""
    bench = workbench(folder)
    try:
        bench.cards()
        for photo in bench.photos:
            with contextlib.suppress(ValueError, PhotoError):  # their own sentences
                bench.session(photo)
    finally:
        bench.close()


def _answers(step: Callable[[Path], object], folder: Path) -> bool:
    try:
        step(folder)
    except StoreError:
        return True
    except Exception:
        return False
    return True


def elsewhere(source: Path) -> list[Trial]:
    """Read labels from a disk that is full, and from one that is read-only."""
    trials = []
    for fault, how in (
        ("The disk is full", "dd if=/dev/zero of={0}/filler bs=64k 2>/dev/null"),
        ("The folder is read-only", "mount -o remount,ro {0}"),
    ):
        with small_disk() as disk:
            if disk is None:
                continue
            folder = Path(shutil.copytree(source, disk / "photos"))
            lost = tried = 0
            subprocess.run(how.format(disk), shell=True, check=False)
            for journal in (False, True):
                if journal:
                    undo = f"rm -f {disk}/filler; mount -o remount,rw {disk}"
                    subprocess.run(undo, shell=True, check=False)
                    leave_journal(folder)
                    subprocess.run(how.format(disk), shell=True, check=False)
                with tempfile.TemporaryDirectory() as scratch:
                    tried += 3
                    lost += run("status", folder)[0] != 0
                    lost += len(exported(folder)) != _PHOTOS
                    lost += run("backup", folder, "--out", Path(scratch) / "kept.sqlite")[0] != 0
            trials.append(
                Trial(
                    fault,
                    "`status`, `export`, `backup`; after the end of a server, and after its death",
                    tried,
                    _counted(lost=lost),
                )
            )
    return trials


def moved_away() -> Trial:
    """Move, remove or replace the file of labels while somebody labels."""
    acknowledged = 0
    for number in range(_AWAY):
        with tempfile.TemporaryDirectory() as scratch:
            folder = write_jpegs(Path(scratch) / "photos", 1)
            bench = workbench(folder)
            (photo,) = bench.photos
            session = bench.session(photo)
            session.apply(SetStatus(status="needs review"), -1)
            path = folder / NAME
            if number % 4 == 0:
                path.rename(Path(scratch) / "elsewhere")
            elif number % 4 == 1:
                for end in ("", "-wal", "-shm"):
                    Path(f"{path}{end}").unlink()
            elif number % 4 == 2:
                shutil.copy(path, Path(scratch) / "copy")
                (Path(scratch) / "copy").replace(path)
            else:
                Path(f"{path}-wal").unlink()
            try:
                session.apply(SetStatus(status="accepted"), -1)
                acknowledged += 1
            except StoreError:
                pass
            bench.close()
    return Trial(
        "The file of labels is moved, removed or replaced under a running server",
        "an operation after it, which must not be called saved",
        _AWAY,
        _counted(**{"called saved": acknowledged}),
    )


def _counted(**lost: int) -> str:
    """What was lost, in words."""
    return ", ".join(f"{count} {what}" for what, count in lost.items() if count) or "nothing"
