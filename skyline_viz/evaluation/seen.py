"""Whether a photo was seen in training: then its error is no test."""

from __future__ import annotations

from skyline_viz.arrays import U8
from skyline_viz.datasets.fingerprints import fingerprint, known_as
from skyline_viz.detector import Detector
from skyline_viz.method import Method


def photos_learned(method: Method) -> tuple[str, ...]:
    """Fingerprints of the photos that the filters of a detector have learned from, if it tells."""
    return method.bank.seen if isinstance(method, Detector) else ()


def seen_in_training(method: Method, photo: U8) -> str:
    """Whether a method has learned from a photo ``(H, W, 3)``.

    Returns:
        ``exact``, ``near`` for a copy that was resized or compressed, or a frame with hardly a
        change; an empty text where it has not, or does not tell.
    """
    learned = photos_learned(method)
    return known_as(fingerprint(photo), learned) if learned else ""
