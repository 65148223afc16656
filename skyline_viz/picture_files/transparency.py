"""Transparent pixels: what lies under them is unknown, and must not decide a line.

Programs leave anything there: black, white, the photo that was cut away, or remains of it. Two
rules: a region that reaches the rim of the photo was cut off, and becomes white, as on paper, so
that its only edge is the cut that somebody made; a hole inside takes the nearest colours, so that
it has no edge at all. Half-transparent pixels have a colour, which is kept.
"""

import numpy as np

from skyline_viz.arrays import U8, Bool

WHITE = 255
"""What is cut off becomes."""

SEE_THROUGH = 13
"""Alpha below which a pixel counts as transparent: a twentieth, as far as lossy formats stray."""


def without_transparency(photo: U8, alpha: U8) -> tuple[U8, str | None]:
    """The photo with its transparent pixels filled, and a note where there are any.

    Args:
        photo: ``(H, W, 3)``; changed in place.
        alpha: ``(H, W)``, 0 is transparent.
    """
    clear: Bool = alpha < SEE_THROUGH
    if not clear.any():
        return photo, None
    if clear.all():
        return photo, "is transparent all over; its colours are taken as they are"
    import cv2  # noqa: PLC0415  # most photos do not need it

    _, labels = cv2.connectedComponents(clear.astype(np.uint8), connectivity=8)
    rim = np.unique(np.concatenate([labels[0], labels[-1], labels[:, 0], labels[:, -1]]))
    cut_off = np.isin(labels, rim[rim > 0])
    photo[cut_off] = WHITE
    holes = clear & ~cut_off
    if holes.any():
        _, nearest = cv2.distanceTransformWithLabels(
            clear.astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
        )
        colours = np.zeros((int(nearest.max()) + 1, 3), np.uint8)
        colours[nearest[~clear]] = photo[~clear]
        photo[holes] = colours[nearest[holes]]
    share = clear.mean()
    percent = "under 1" if share < 0.01 else f"{share:.0%}"[:-1]
    return photo, f"is transparent in {percent} % of its pixels, whose colours do not count"
