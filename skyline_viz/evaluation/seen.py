"""Whether a photo was seen in training: then its error is no test.

What learns keeps fingerprints of its photos, see `system.fingerprints`, so neither the name of a
data set nor the place where it lies counts. A method without them tells nothing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from skyline_viz.arrays import U8
from skyline_viz.detecting.filter_detection import FilterDetection
from skyline_viz.detection import Detection
from skyline_viz.detector import Detector
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.method import Method
from skyline_viz.methods.finding.method_files import photos_seen
from skyline_viz.system.fingerprints import fingerprint, known_as, of_clip
from skyline_viz.system.names import listed

TRAINING, SKY = "training", "sky model"
"""What has learned from a photo: the method itself, or the sky model of our detector."""


def seen_in_training(
    method: Method, photo: U8, name: str = "", found: Detection | None = None
) -> str:
    """What of a method has learned from a photo, and how the photo is known again.

    Args:
        method: The method.
        photo: ``(H, W, 3)`` uint8 RGB.
        name: What the photo is called, which may tell of its clip.
        found: A detection of it, which may know the fingerprint of its pixels.

    Returns:
        ``training: exact``, ``sky model: near``, or both with a semicolon between; ``near`` is a
        copy that was resized or compressed, or nearly the same picture, ``clip`` another frame of a
        clip. Empty where nothing has learned from it, as far as is known.
    """
    learned = {TRAINING: photos_seen(method)}
    if isinstance(method, Detector) and method.config.sky_weight:
        learned[SKY] = method.sky.seen
    if not any(learned.values()):
        return ""
    if isinstance(found, FilterDetection):
        own = of_clip(found.fingerprint, photo, name)
    else:
        own = fingerprint(photo, name)
    seen = {part: known_as(own, others) for part, others in learned.items()}
    return "; ".join(f"{part}: {known}" for part, known in seen.items() if known)


def seen_by(part: str, seen: Mapping[str, str]) -> list[str]:
    """Names of the photos that a part of a method, `TRAINING` or `SKY`, has seen.

    Args:
        part: The part.
        seen: What `seen_in_training` says of each photo, by its name.
    """
    return [name for name, told in seen.items() if f"{part}:" in told]


def notes(method: str, seen: Mapping[str, str], *, folds: bool = False) -> list[str]:
    """What there is to say of photos that were seen in training, in sentences.

    Args:
        method: Name of the method.
        seen: What `seen_in_training` says of each photo, by its name.
        folds: Whether that is a cross-validation.

    Examples:
        >>> notes("mine.npz", {"a": "training: exact", "b": "training: clip"})
        ['mine.npz was trained on all 2 photos, so this is no test; see --folds.']
    """
    told = []
    trained, sky = seen_by(TRAINING, seen), seen_by(SKY, seen)
    if trained and len(trained) == len(seen):
        hint = "" if folds else "; see --folds"
        told.append(f"{method} was trained on {_all(seen)}, so this is no test{hint}.")
    elif trained:
        told.append(
            f"{method} has seen {len(trained)} of {len(seen)} photos in training, near copies of "
            f"them or frames of their clips, and their errors are no test: {listed(trained)}."
        )
    if sky:
        which = f"{len(sky)} of {len(seen)} photos" if len(sky) < len(seen) else _all(seen)
        told.append(
            f"the sky model of {method} was trained on {which}, also where these are tested; "
            f"sky_weight=0 does without."
        )
    return told


def in_titles(results: Mapping[str, Sequence[PhotoResult]]) -> str:
    """The same in a few words, for pictures; empty where no photo was seen."""
    told = []
    for part, words in ((TRAINING, "seen in training"), (SKY, "seen by the sky model")):
        counts = [(len(seen_by(part, by_name(found))), len(found)) for found in results.values()]
        most, photos = max(counts, default=(0, 0))
        if most:
            told.append(f"{most} of {photos} photos {words}")
    return ", ".join(told)


def by_name(results: Sequence[PhotoResult]) -> dict[str, str]:
    """What was seen of each photo, by its name."""
    return {one.name: one.seen for one in results}


def _all(seen: Mapping[str, str]) -> str:
    return f"all {len(seen)} photos" if len(seen) > 1 else "the photo"
