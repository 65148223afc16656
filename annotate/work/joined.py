"""Labels joined to the photos that are in the folder now; the others are named, never mixed up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from annotate.formats.orphans import gone
from annotate.store.contents import Contents
from annotate.store.identity import Photo
from annotate.store.labels import Label
from annotate.store.store import Store


@dataclass(frozen=True)
class Joined:
    """The labels of a folder."""

    photos: Sequence[Photo]
    """Photos that are in the folder now."""

    labels: Sequence[Label]
    """Labels of these photos."""

    orphans: Sequence[Label]
    """Labels whose photo is not there any more."""

    unreadable: Sequence[str]
    """A sentence for each label that cannot be read."""

    contents: Contents
    """What is in the files of the photos."""

    @property
    def notes(self) -> list[str]:
        """What has to be said of labels that are left out."""
        return [*self.damaged, *gone(self.orphans)]

    @property
    def damaged(self) -> list[str]:
        """What has to be said of labels that cannot be read."""
        if not self.unreadable:
            return []
        return [*self.unreadable, "skyline-annotate repair sets aside what cannot be read."]


def joined(store: Store, annotator: str | None = None, number: int | None = None) -> Joined:
    """Look which photos are in the folder, and join labels to them.

    Args:
        store: The labels.
        annotator: Only theirs.
        number: Only of this pass.
    """
    photos = store.find()
    here = {photo.digest for photo in photos}
    labels = list(store.labels(annotator, number))
    return Joined(
        photos,
        [one for one in labels if one.digest in here],
        [one for one in labels if one.digest not in here and _worked_on(one)],
        list(store.unreadable),
        Contents.of(store.folder, photos),
    )


def _worked_on(label: Label) -> bool:
    return any(one["kind"] != "open" for one in label.operations)
