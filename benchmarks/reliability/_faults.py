"""Faults that are put into a folder of labels."""

import math
import random
import shutil
import sqlite3
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

from annotate.store.database import NAME


def operation(chance: random.Random) -> Any:  # noqa: ANN401
    """An operation, or what somebody takes for one."""
    odd = [1e30, -5, 10**25, math.nan, math.inf, None, True, "3", [], {}, [[[]]], 2.5]

    def number(top: int) -> Any:  # noqa: ANN401
        return chance.choice(odd) if chance.random() < 0.1 else chance.randrange(top)

    kinds: dict[str, Callable[[], dict[str, Any]]] = {
        "anchor": lambda: {"column": number(70), "row": number(48)},
        "move": lambda: {"from_column": number(70), "column": number(70), "row": number(48)},
        "remove": lambda: {"column": number(70)},
        "forbid": lambda: {"points": [[number(70), number(48)]], "radius": number(9)},
        "straight": lambda: {
            "column": number(70),
            "row": number(48),
            "to_column": number(70),
            "to_row": number(48),
        },
        "drawn": lambda: {"first": number(40), "rows": [number(48) for _ in range(9)]},
        "hidden": lambda: {"first": number(70), "last": number(70)},
        "release": lambda: {"first": number(70), "last": number(70)},
        "tag": lambda: {"tag": chance.choice(["fog", "", 5, "x" * 99]), "on": True},
        "status": lambda: {"status": chance.choice(["accepted", "to do", "perfect", None])},
        "undo": lambda: {"status": True} if chance.random() < 0.5 else {},
        "redo": dict,
        "rotate": lambda: {"degrees": number(360)},
    }
    kind = chance.choice(list(kinds))
    return {"kind": kind, "at": number(10**9), **kinds[kind]()}


@contextmanager
def small_disk() -> Iterator[Path | None]:
    """A disk of 3 MB; None where this user may make none."""
    with tempfile.TemporaryDirectory() as folder:
        words = ["mount", "-t", "tmpfs", "-o", "size=3m", "tmpfs", folder]
        if subprocess.run(words, capture_output=True, check=False).returncode:
            yield None
            return
        try:
            yield Path(folder)
        finally:
            subprocess.run(["umount", folder], check=False)


def leave_journal(folder: Path) -> None:
    """Leave labels as a server does that is killed: with a journal that holds the last changes."""
    path = folder / NAME
    with tempfile.TemporaryDirectory() as scratch:
        with closing(sqlite3.connect(path)) as database:
            database.execute("UPDATE photos SET size = size")
            database.commit()
            for end in ("", "-wal"):
                shutil.copy(f"{path}{end}", Path(scratch) / f"x{end}")
        for end in ("", "-wal"):
            shutil.copy(Path(scratch) / f"x{end}", f"{path}{end}")
