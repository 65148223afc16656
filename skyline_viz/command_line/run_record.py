"""The record of a run: what was asked, with which settings, on which photos, and when."""

from __future__ import annotations

import json
import platform
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from skyline_viz import __version__
from skyline_viz.files import write_text

if TYPE_CHECKING:
    from skyline_viz.method import Method
    from skyline_viz.running.photo_table import PhotoRow

RECORD = "run.json"
"""Name of the record in the folder of outputs."""

_asked: list[str] = []


def remember(program: str, words: Sequence[str]) -> None:
    """Keep the command line of this process for its record."""
    _asked[:] = [program, *words]


@dataclass(frozen=True)
class Beginning:
    """When a run began, and by which command line."""

    command: tuple[str, ...]
    """The program and its words."""

    at: datetime
    """When, in universal time."""

    @classmethod
    def now(cls) -> Beginning:
        """Begin a run."""
        return cls(tuple(_asked), datetime.now(UTC))

    def write(
        self,
        path: Path,
        method: Method,
        bank: Path | None,
        options: Mapping[str, object],
        photos: Sequence[PhotoRow],
    ) -> None:
        """Write the record of the run that ends now as JSON, whole or not at all.

        Args:
            path: Where to.
            method: What detected.
            bank: File of its filter bank; None for the shipped one.
            options: Further options by name.
            photos: What came of each photo.
        """
        document = {
            **self.told(method, bank, options),
            "photos": [
                {"name": one.name, "file": str(one.file), "sha256": one.sha256} for one in photos
            ],
            "failed": [{"name": one.name, "reason": one.error} for one in photos if one.error],
        }
        write_text(path, json.dumps(document, indent=2, ensure_ascii=False) + "\n")

    def told(
        self, method: Method, bank: Path | None, options: Mapping[str, object]
    ) -> dict[str, object]:
        """What there is to say of a run that ends now, but for its photos.

        Takes what `write` takes.
        """
        from skyline_viz.methods.registry import method_digest

        ended = datetime.now(UTC)
        return {
            "format": "skyline-run",
            "version": 1,
            "package": __version__,
            "command": self.command,
            "folder": str(Path.cwd()),
            "started": self.at.isoformat(timespec="seconds"),
            "ended": ended.isoformat(timespec="seconds"),
            "seconds": round((ended - self.at).total_seconds(), 3),
            "versions": _versions(),
            "settings": {method.name: _settings(method)},
            "bank_file": None if bank is None else str(bank.resolve()),
            "digest": method_digest(method),
            "options": dict(options),
        }


def _settings(method: Method) -> dict[str, object]:
    """Settings, bank and sky model, if it runs, of our detector; of another its name says all."""
    from skyline_viz.detector import Detector

    if not isinstance(method, Detector):
        return {}
    about = {"config": method.config.described(), "bank": asdict(method.bank.provenance)}
    return {**about, "sky": method.sky.name if method.config.sky_weight else None}


def _versions() -> dict[str, str]:
    import cv2
    import numpy as np

    return {
        "python": platform.python_version(),
        "numpy": np.__version__,
        "opencv": cv2.__version__,
        "system": platform.platform(),
    }
