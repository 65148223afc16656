"""A diagnosed photo; as JSON it gives back the very same, and is kept while others are done."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from skyline_viz.diagnosis.diagnosing import Diagnosis, Segment
from skyline_viz.diagnosis.remedies import Remedy
from skyline_viz.diagnosis.trials import Trial


@dataclass(frozen=True, eq=False)
class Diagnosed:
    """A photo and its diagnosis."""

    name: str
    a_err: float
    """In pixels."""

    gross_miss: bool
    """Whether that is over 5 % of the height."""

    visible: int
    """Columns in which the truth is visible."""

    diagnosis: Diagnosis
    remedies: tuple[Remedy, ...]
    """Other settings, tried on the photo; nothing unless asked for."""

    seen: str = ""
    """What has seen the photo in training, see `evaluation.seen.seen_in_training`."""


def pack(one: Diagnosed) -> dict[str, Any]:
    """An object of strings, numbers and lists."""
    return {
        "name": one.name,
        "a_err": one.a_err,
        "gross_miss": one.gross_miss,
        "visible": one.visible,
        "seen": one.seen,
        "tolerance": one.diagnosis.tolerance,
        "segments": [_segment(segment) for segment in one.diagnosis.segments],
        "remedies": [vars(remedy) for remedy in one.remedies],
    }


def unpack(record: dict[str, Any]) -> Diagnosed:
    """What `pack` packed.

    Raises:
        LookupError: A part is missing.
        TypeError: A part is of another kind.
        ValueError: A part is of another shape.
    """
    segments = tuple(_made(segment) for segment in record["segments"])
    remedies = tuple(Remedy(**remedy) for remedy in record["remedies"])
    diagnosis = Diagnosis(segments, record["tolerance"])
    told = {name: record[name] for name in ("name", "a_err", "gross_miss", "visible", "seen")}
    return Diagnosed(**told, diagnosis=diagnosis, remedies=remedies)


def _segment(segment: Segment) -> dict[str, Any]:
    values = {one.name: getattr(segment, one.name) for one in fields(Segment)}
    first, rows = segment.line
    values["trials"] = [vars(trial) for trial in segment.trials]
    values["line"] = [first, rows.dtype.str, rows.tolist()]
    return values


def _made(values: dict[str, Any]) -> Segment:
    trials = [
        {**trial, "changes": tuple(trial["changes"]), "terms": tuple(trial["terms"])}
        for trial in values["trials"]
    ]
    first, dtype, rows = values["line"]
    first_column, last_column = values["columns"]
    return Segment(
        **{
            **values,
            "columns": (first_column, last_column),
            "contributing": tuple(values["contributing"]),
            "terms": tuple(values["terms"]),
            "findings": tuple(values["findings"]),
            "trials": tuple(Trial(**trial) for trial in trials),
            "line": (first, np.array(rows, dtype)),
        }
    )
