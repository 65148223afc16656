"""Labels of one made-up photo by several people, without a folder."""

import numpy as np

from annotate.store.labels import Label
from skyline_viz.skyline import Skyline


def made(rows, annotator="ann", number=1, visible=None, origin=1, **other):
    """An accepted label with these rows; other parts of it as they are given."""
    rows = np.asarray(rows, np.float32)
    width = len(rows)
    origins = (
        np.full(width, origin, np.uint8) if np.isscalar(origin) else np.array(origin, np.uint8)
    )
    parts = {
        "name": "hill.png",
        "digest": "aa",
        "status": "accepted",
        "tags": (),
        "operations": (),
        "seconds": 1.0,
        "detector": "",
        "blind": False,
    }
    return Label(
        width=width,
        height=1000,
        annotator=annotator,
        number=number,
        skyline=Skyline(rows=rows, visible=visible),
        origin=origins,
        **(parts | other),
    )
