"""Entity paths of a recording: where each stage is found. Part of the interface.

A second detection beside the first has the same paths under `OTHER`.
"""

import rerun as rr

from skyline_viz.stage import Quantity

PHOTO = "photo"
"""The photo."""

EDGES = "edges"
"""Stage 1: the edge map."""

STRENGTH = "tensor/strength"
"""Stage 2: gradient strength."""

COHERENCE = "tensor/coherence"
"""Stage 2: coherence."""

ORIENTATION = "tensor/orientation"
"""Stage 2: orientation of the gradient."""

BIN = "bin"
"""Stage 3: bin of each edge pixel."""

SCORE = "score"
"""Stage 4: score of each edge pixel."""

COST = "cost"
"""Stage 5: fused nodal cost."""

DETOUR = "detour"
"""Stage 6: how much dearer the cheapest path through a pixel is: its min-marginal less the best."""


TERMS = "terms"
"""`TERMS`/NAME: what each pixel pays for one term of the nodal cost."""

METHODS = "methods"
"""Parent of the stages of other methods: `METHODS`/NAME/STAGE."""

METHOD_LINES = "skyline/methods"
"""`METHOD_LINES`/NAME: the skyline that another method found."""

METHODS_SWATCHES = "methods_swatches"
"""Their names on the photo, each in its colour."""

METHODS_TABLE = "methods_table"
"""How the methods compare on the photo, in Markdown."""

EDGE_PIXELS = "edge_pixels"
"""Exact values at the edge pixels: edge_row, edge_column, bin, strength, coherence, orientation,
score, cost."""

EXACT = "exact"
"""Where a full recording of a large photo keeps its maps exactly, in white on black: the numbers
called ``exact`` beside the maps are of these pixels, row by row. Missing where all are kept."""

PATH = "skyline/path"
"""Stage 6: the detected skyline."""

TRUTH = "skyline/truth"
"""The true skyline."""

ALTERNATIVE = "skyline/alternative"
"""The skyline of a second detection."""

STRIP = "skyline/strip"
"""Error of each column as a coloured strip along the lower rim of the photo; the margin where
there is no truth."""

CHOSEN = "skyline/chosen"
"""`CHOSEN`/path and /truth: the pixels in the chosen column; scrub the `COLUMN` timeline to
choose."""

ERRORS = "columns/error"
"""Error of each column, in pixels."""

MARGINS = "columns/margin"
"""Margin of each column, a cost."""

NODE_COSTS = "columns/node_cost"
"""Nodal cost of the path's pixel in each column."""

LINK_COSTS = "columns/link_cost"
"""Link cost that the path pays to reach each column."""

SERIES = "series"
"""`SERIES`/error, /margin, /path/node and /path/link: what is known of each column, on the timeline
`COLUMN`; /apart/TERM how much more the truth pays for a term than the path, /apart/all for all."""

DIFFERENCES = "columns/difference"
"""How far a second skyline lies below the first in each column, in pixels."""

COMPARISON = "comparison"
"""How the second skyline differs, in Markdown."""

APART = "apart"
"""`APART`/stage/NAME and `APART`/term/NAME: what the map of a second detection has more than that
of the first."""

OTHER_LINES = "other_lines"
"""`OTHER_LINES`/1 and so on: lines along other ridges than the path, the cheapest first."""

OTHER_LINES_TABLE = "other_lines_table"
"""What these lines pay for each term, in Markdown."""

METRICS = "metrics"
"""`METRICS`/a_err, /worst_error, /margin and /confidence of each photo, as scalars."""

TIMINGS = "timings"
"""`TIMINGS`/STAGE: milliseconds of each stage, as scalars."""

REPORT = "report"
"""The report, in Markdown."""

BANK_FILTERS = "bank/filters"
"""Mosaic of the filters."""

BANK_SAMPLES = "bank/samples"
"""Training samples of each bin."""

BANK_CHOSEN = "bank/chosen"
"""`BANK_CHOSEN`/path and /truth: frames around the filters of the chosen pixels."""

PIXEL = "pixel"
"""`PIXEL`/path and /truth: parents of what the chosen pixels come from, see `pixel_of`."""

PIXEL_ABOUT = "pixel/about"
"""What is known of both, in Markdown."""

SEGMENTS = "diagnosis/segments"
"""Frames around the failing segments; at ``largest`` below it the largest, with their causes."""

COUNTERFACTUAL = "diagnosis/counterfactual"
"""The path in each segment that comes back when its cause is made right."""

REMEDY = f"{COUNTERFACTUAL}/remedy"
"""The path with the setting that helps most, with its flags."""

TRUTH_MISSED = "diagnosis/missed"
"""Pixels of the truth without an edge."""

TRUTH_STARVED = "diagnosis/starved"
"""Edge pixels of the truth in starved bins."""

DIAGNOSIS = "diagnosis/report"
"""The diagnosis, in Markdown."""

SWEEP_PATH = "sweep/path"
"""The path with another value of a setting, on the timeline of that setting; so is all
of the sweep."""

SWEEP_EDGES = "sweep/edges"
"""The edge map with it."""

SWEEP_COST = "sweep/cost"
"""The nodal cost with it, of the cheapest edge pixels of each column."""

SWEEP_ERROR = "sweep/error"
"""A_err with each value in pixels, a scalar; the mean distance from the present path where there is
no truth. At ``present`` below it that of the present value."""

SWEEP_REPORT = "sweep/report"
"""The value, and what it changes, in Markdown."""

OTHER = "other"
"""Parent of everything about a second detection."""

IMAGE = "image"
"""Timeline: the number of the photo in a recording of several."""

COLUMN = "column"
"""Timeline: the column whose pixels are looked at."""

OPENING = 0
"""Where that timeline begins: the pixels there are those of the column with the largest error, in
place of those of column 0. The viewer opens at the first time there is, which cannot be negative:
it shows no encoded picture then."""


def of_quantity(quantity: Quantity) -> str:
    """Path of a stage, or of a term, below what it belongs to.

    >>> of_quantity(Quantity("sky probability", group="maps")), of_quantity(Quantity("score"))
    ('maps/sky_probability', 'score')
    """
    return below(quantity.group, quantity.name.replace(" ", "_"))


def stages_of(method: str) -> str:
    r"""Parent of the stages of another method, by its name.

    >>> stages_of("edges"), stages_of("paper:delta=4")
    ('methods/edges', 'methods/paper\\:delta\\=4')
    """
    return f"{METHODS}/{rr.escape_entity_path_part(method)}"


def line_of(method: str) -> str:
    """The skyline that another method found, by its name."""
    return f"{METHOD_LINES}/{rr.escape_entity_path_part(method)}"


def pixel_of(line: str) -> str:
    """Parent of ``patch``, ``ellipse``, ``filter`` and ``product`` of a line's chosen pixel.

    >>> pixel_of("truth")
    'pixel/truth'
    """
    return f"{PIXEL}/{line}"


def below(parent: str, entity: str) -> str:
    """Path of an entity under a parent, or of itself.

    >>> below(OTHER, SCORE), below("", SCORE)
    ('other/score', 'score')
    """
    return f"{parent}/{entity}" if parent else entity
