"""What a click costs when thousands came before it, and what a list of long logs costs.

Processor time of this process, as ratios: of a click with so many operations in the log to one with
ten. A click is everything between the request and its answer: the line is solved, the operation
goes to the disk, and the whole document is written as JSON.
"""

import random
import tempfile
from collections.abc import Callable
from contextlib import ExitStack, suppress
from pathlib import Path
from statistics import median
from time import perf_counter, process_time

import numpy as np

from annotate.engine.edits import EditError
from annotate.server.messages import Document
from annotate.store.lines import Line
from annotate.store.operations import Forbid, Hide, MoveAnchor, Operation, SetAnchor
from annotate.store.store import Store
from annotate.work.session import Session
from benchmarks.table import markdown
from skyline_viz import Skyline
from skyline_viz.constraints import PathError
from testing.labelling import workbench, write_hills

COUNTS = (10, 100, 500, 2000)
"""Operations in the log before the click."""

CLICKS = 70
"""Clicks at each of them, in turn, so that a busy machine is as busy for all."""

LARGE = 4000, 6000
"""Height and width of a photo on which clicks are timed in milliseconds."""

_HEIGHT, _WIDTH = 519, 1388
_PHOTOS, _LOG = 300, 30


def corrected(chance: random.Random, session: Session) -> Operation | str:
    """A dozen anchors that are dragged to and fro, undone and redone."""
    state = session.state
    kind = chance.choice(("anchor", "drag", "drag", "undo", "redo"))
    row = chance.randrange(150, 350)
    if kind == "drag" and state.edits.anchors:
        column = chance.choice(list(state.edits.anchors))
        return MoveAnchor(from_column=column, column=column, row=row)
    if (kind == "undo" and state.steps) or (kind == "redo" and state.taken):
        return kind
    return SetAnchor(column=chance.randrange(12) * 100 + 40, row=row)


def brushed(chance: random.Random, session: Session) -> Operation | str:
    """Brush or eraser, undone and redone, and hidden columns, in turn."""
    first = chance.randrange(session.photo.width - 60)
    kind = ("brush", "undo", "redo", "hide", "undo", "undo", "hide")[session.state.count % 7]
    if kind == "brush":
        return stroke(first, session.photo.height, allow=chance.random() < 0.3)
    if kind == "hide":
        return Hide(first=first, last=first + 20, hidden=chance.random() < 0.5)
    return kind


def anchored(chance: random.Random, session: Session) -> Operation | str:
    """Anchors on the line, none taken back: the document itself grows."""
    column = chance.randrange(_WIDTH)
    return SetAnchor(column=column, row=int(session.wire.skyline.rows[column]))


def painted(chance: random.Random, session: Session) -> Operation | str:
    """Strokes of the brush, none taken back: the document itself grows."""
    photo = session.photo
    return stroke(chance.randrange(photo.width - 60), photo.height)


def stroke(first: int, height: int, *, allow: bool = False) -> Forbid:
    """A stroke far below the line."""
    points = [(first + 5 * step, height - 69 + step) for step in range(10)]
    return Forbid(points=points, radius=6, allow=allow)


def click(session: Session, act: Operation | str) -> None:
    """Do it, answer with the whole document, and get ready for the next one."""
    with suppress(EditError, PathError):  # nothing to undo; nothing leads there
        if isinstance(act, str):
            getattr(session, act)(session.state.revision)
        else:
            session.apply(act, session.state.revision)
    Document.of(session, None).model_dump_json()


def ratios(how: Callable[[random.Random, Session], Operation | str]) -> list[float]:
    """Cost of a click at each of the counts, in costs of a click at the first one."""
    chance = random.Random(1)
    with ExitStack() as stack:
        sessions = []
        for _ in COUNTS:
            folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
            bench = workbench(write_hills(folder, count=1, height=_HEIGHT, width=_WIDTH))
            stack.callback(bench.close)
            sessions.append(bench.session(1))
        for session, count in zip(sessions, COUNTS, strict=True):
            while session.state.count < count:
                click(session, how(chance, session))
        spent = [0.0] * len(COUNTS)
        for _ in range(CLICKS):
            for place, session in enumerate(sessions):
                act = how(chance, session)
                start = process_time()
                click(session, act)
                spent[place] += process_time() - start
                session.refresh()
    return [one / spent[0] for one in spent]


def large() -> list[list[str]]:
    """Processor time and time of clicks on a large photo with 1,000 operations behind them."""
    rows = []
    for how in (corrected, brushed):
        chance = random.Random(1)
        with tempfile.TemporaryDirectory() as folder:
            height, width = LARGE
            bench = workbench(write_hills(Path(folder), count=1, height=height, width=width))
            session = bench.session(1)
            while session.state.count < 1000:
                click(session, how(chance, session))
            spent = []
            for _ in range(CLICKS):
                act = how(chance, session)
                start, began = process_time(), perf_counter()
                click(session, act)
                spent.append((process_time() - start, perf_counter() - began))
                session.refresh()
            bench.close()
        both = np.percentile(np.array(spent) * 1000, [50, 95], axis=0).T.ravel()
        rows.append([(how.__doc__ or "").rstrip("."), *(f"{one:.1f}" for one in both)])
    return rows


def listing() -> tuple[float, int]:
    """Cost of a list of long logs in costs of one of empty logs, and the rows of logs it reads."""
    line = Line(Skyline(rows=[5] * 70), np.zeros(70, np.uint8))
    spent, read = [], 0
    for length in (0, _LOG):
        with tempfile.TemporaryDirectory() as folder:
            store = Store(write_hills(Path(folder), count=_PHOTOS))
            for photo in store.find():
                label = store.begin(photo.id, "ann", 1)
                for number in range(length):
                    body = {"column": number, "row": 9}
                    store.append(label, -1, "anchor", body, line)
            said: list[str] = []
            store._connection.set_trace_callback(said.append)
            seconds = []
            for _ in range(9):
                start = process_time()
                store.cards("ann", 1)
                seconds.append(process_time() - start)
            spent.append(median(seconds))
            read = sum("body" in one for one in said)
            store.close()
    return spent[1] / spent[0], read


def measured() -> str:
    """All of it."""
    rows = [
        [(how.__doc__ or "").rstrip("."), *(f"{one:.2f}" for one in ratios(how))]
        for how in (corrected, brushed, anchored, painted)
    ]
    table = markdown(["what was done", *(f"at {count:,}" for count in COUNTS)], rows)
    megapixels = LARGE[0] * LARGE[1] / 1e6
    header = ["what was done", "ms of a processor", "95th percentile", "ms", "95th percentile"]
    longer, read = listing()
    return (
        "## What a click costs when many came before it\n\n"
        "Processor time of a click and its answer, as a multiple of that with "
        f"{COUNTS[0]} operations in the log.\n\n{table}\n\n"
        f"At {megapixels:.0f} megapixels with 1,000 operations in the log:\n\n"
        f"{markdown(header, large())}\n\n"
        f"A list of {_PHOTOS} photos with {_LOG} operations each costs {longer:.2f} times one of "
        f"photos with none, and makes {read} queries for what is in a log.\n"
    )


if __name__ == "__main__":
    print(measured())
