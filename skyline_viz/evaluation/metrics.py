"""How far a skyline is from the truth. Every metric counts the columns visible in both."""

import numpy as np

from skyline_viz.arrays import F64
from skyline_viz.skyline import Skyline, SkylineError

GROSS_MISS_SHARE = 0.05
"""A_err above this share of the image height is a gross miss."""


def column_errors(skyline: Skyline, truth: Skyline) -> F64:
    """Distance ``|row - truth row|`` in pixels, ``(W,)``; NaN where not visible in both.

    Raises:
        SkylineError: The widths differ.

    Examples:
        >>> hidden = Skyline(rows=[4, 4, 4], visible=[True, False, True])
        >>> column_errors(Skyline(rows=[4, 5, 6]), hidden)
        array([ 0., nan,  2.])
    """
    if skyline.width != truth.width:
        raise SkylineError(
            f"the skyline has {skyline.width} columns, the truth {truth.width}; they must match"
        )
    errors = np.abs(skyline.rows.astype(np.float64) - truth.rows)
    return np.where(skyline.visible & truth.visible, errors, np.nan)


def a_err(skyline: Skyline, truth: Skyline) -> float:
    r"""Average pixel-wise absolute distance, in pixels (equation 27 of the paper).

    $$
    A_{err} = \frac{1}{N} \sum_{j=1}^{N} | P_{d(j)} - P_{g(j)} |
    $$

    The sum runs over the columns visible in both.

    Raises:
        SkylineError: The widths differ, or no column is visible in both.

    Examples:
        >>> a_err(Skyline(rows=[4, 5, 6]), Skyline(rows=[4, 4, 4]))
        1.0
    """
    errors = column_errors(skyline, truth)
    errors = errors[~np.isnan(errors)]
    if len(errors) == 0:
        raise SkylineError("no column is visible in both the skyline and the truth")
    return float(errors.mean())


def segmentation_accuracy(skyline: Skyline, truth: Skyline, height: int) -> float:
    """Share of pixels in visible columns that both call sky or both call terrain, in [0, 1].

    Raises:
        SkylineError: The widths differ, a row lies outside `height`, or nothing is visible.

    Examples:
        >>> segmentation_accuracy(Skyline(rows=[4, 5, 6]), Skyline(rows=[4, 4, 4]), height=10)
        0.9
    """
    whole = [
        Skyline(line.pixel_rows(height).astype(np.float32), line.visible)
        for line in (skyline, truth)
    ]
    return 1.0 - a_err(*whole) / height


def is_gross_miss(error: float, height: int) -> bool:
    """Whether an A_err in pixels is over 5 % of the image height in pixels.

    Examples:
        >>> is_gross_miss(20.0, height=519), is_gross_miss(30.0, height=519)
        (False, True)
    """
    return error > GROSS_MISS_SHARE * height
