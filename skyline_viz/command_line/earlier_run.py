"""Settings of an earlier run, fed back by ``--config FILE``: run.json, or summary.json."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from skyline_viz.command_line.messages import UsageError
from skyline_viz.config import DetectorConfig
from skyline_viz.system.names import listed

_MOST_BYTES = 256_000_000


@dataclass(frozen=True)
class Earlier:
    """What a run says of our detector."""

    config: DetectorConfig
    """Its settings."""

    bank: Path | None = None
    """File of its filter bank; None for the shipped one."""

    sky: str | None = None
    """Its sky model, where that is not the small one."""


def earlier(path: str | Path, *, with_bank: bool = True) -> Earlier:
    """The settings of the detector of an earlier run.

    Args:
        path: ``run.json`` of detect, or ``summary.json`` of evaluate and tables.
        with_bank: Whether its filter bank is needed, too.

    Raises:
        UsageError: It holds no settings of our detector, or of several, or its bank is missing.
    """
    path = Path(path)
    document = _document(path)
    told = _only(path, document.get("settings"))
    config = told.get("config")
    if not isinstance(config, dict):
        raise UsageError(f"{path} holds no settings of a detector.")
    try:
        known = DetectorConfig.from_file(config, str(path))
    except TypeError:
        names = sorted(config.keys() - DetectorConfig.kinds().keys())
        raise UsageError(f"{path} holds settings that there are not: {listed(names)}.") from None
    except ValueError as error:
        raise UsageError(f"{path} holds settings that are refused: {error}.") from error
    sky = told.get("sky")
    bank = _bank(path, document.get("bank_file"), told.get("bank")) if with_bank else None
    return Earlier(known, bank, sky if isinstance(sky, str) and sky != "small" else None)


def _document(path: Path) -> dict[str, Any]:
    from skyline_viz.files import read_at_most

    try:
        document = json.loads(read_at_most(path, _MOST_BYTES))
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise UsageError(f"the settings {path} cannot be read: {reason}.") from error
    except (ValueError, RecursionError) as error:
        raise UsageError(f"{path} is no JSON, as run.json and summary.json are.") from error
    return document if isinstance(document, dict) else {}


def _only(path: Path, settings: object) -> dict[str, Any]:
    """What a document says of its only method."""
    known = settings if isinstance(settings, dict) else {}
    if len(known) > 1:
        raise UsageError(
            f"{path} holds settings of several methods, {listed([*known])}; name one with --method."
        )
    for name, told in known.items():
        if told == {}:
            raise UsageError(f"{path} is of {name}, whose settings --method {name} gives.")
        if isinstance(told, dict):
            return told
    raise UsageError(f"{path} holds no settings of a detector, as run.json and summary.json do.")


def _bank(path: Path, named: object, made: object) -> Path | None:
    """The file of the filter bank of a run; None where that is the shipped one."""
    from skyline_viz.filter_bank import FilterBank

    if isinstance(named, str):
        return Path(named)
    shipped = json.loads(json.dumps(asdict(FilterBank.default().provenance)))
    if isinstance(made, dict) and made != shipped:
        data = str(made.get("dataset") or "an unnamed data set")
        raise UsageError(
            f"{path} is of a filter bank trained on {data}, which it does not hold; "
            f"name its file with --bank."
        )
    return None
