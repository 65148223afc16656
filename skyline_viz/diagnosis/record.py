"""A diagnosed photo as JSON that gives back the very same, to be kept while others are done."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np

from skyline_viz.diagnosis.diagnosing import Diagnosis, Segment, Trial
from skyline_viz.diagnosis.remedies import Remedy
from skyline_viz.diagnosis.report import Diagnosed


def pack(one: Diagnosed) -> dict[str, Any]:
    """An object of strings, numbers and lists."""
    return {
        "name": one.name,
        "a_err": one.a_err,
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
    return Diagnosed(record["name"], record["a_err"], diagnosis, remedies)


def _segment(segment: Segment) -> dict[str, Any]:
    values = {one.name: getattr(segment, one.name) for one in fields(Segment)}
    first, rows = segment.line
    values["trials"] = [vars(trial) for trial in segment.trials]
    values["line"] = [first, rows.dtype.str, rows.tolist()]
    return values


def _made(values: dict[str, Any]) -> Segment:
    trials = [{**trial, "changes": tuple(trial["changes"])} for trial in values["trials"]]
    first, dtype, rows = values["line"]
    first_column, last_column = values["columns"]
    return Segment(
        **{
            **values,
            "columns": (first_column, last_column),
            "contributing": tuple(values["contributing"]),
            "trials": tuple(Trial(**trial) for trial in trials),
            "line": (first, np.array(rows, dtype)),
        }
    )
