"""Which photo of a folder a label file means.

Other programs write names with the folders of another machine, with other separators, in other
case. A name is matched where only one photo can be meant, and only one name can mean it.
"""

from __future__ import annotations

import unicodedata
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from annotate.formats.common import safe_stems
from skyline_viz.command_line.inputs import output_names
from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.datasets.matching import bare_stem


@dataclass(frozen=True)
class Matched:
    """Names in label files, and the photos they mean."""

    photos: dict[str, str] = field(default_factory=dict)
    """The photo of each name that has one."""

    unclear: tuple[str, ...] = ()
    """A sentence for each name that could mean several photos, or shares its photo."""

    unknown: tuple[str, ...] = ()
    """Names that mean no photo."""


class PhotoNames:
    """The names of the photos of a folder."""

    def __init__(
        self,
        names: Iterable[str],
        below: Iterable[str] = (),
        copies: Mapping[str, str] | None = None,
    ) -> None:
        """Take the names.

        Args:
            names: Those of the photos that labels may be for, with ``/`` between folders.
            below: Those of all photos of the folder, by which exports name their files.
            copies: The photo of each name that is another one of it; labels may go by it, too.
        """
        self._copies = dict(copies or {})
        self.names = sorted({*names, *self._copies})
        self._known = frozenset(self.names)
        safe = safe_stems({*self.names, *below})
        self._schemes: tuple[dict[str, str], ...] = (
            {name: name for name in self.names},
            _outputs(self.names),
            {safe[name]: name for name in self.names},
        )
        self._loose: defaultdict[str, set[str]] = defaultdict(set)
        self._last: defaultdict[str, set[str]] = defaultdict(set)
        for name in self.names:
            path = PurePosixPath(name)
            plain = name[: len(name) - len(path.suffix)]
            joined = {plain.replace("/", "-"), name.replace("/", "-")}
            for one in {name, plain, safe[name], path.stem, path.name, *joined}:
                self._loose[one].add(name)
                self._loose[f"/{_folded(one)}"].add(name)  # no file name has this slash
            self._last[_parts(name)[-1]].add(name)

    def of_stems(self, stems: Iterable[str]) -> Matched:
        """Photos of files that have a photo's name and another ending, or ``_mask`` besides.

        We call files after photos in three ways; that which fits more of the files is believed.
        """
        stems = list(stems)
        fits = [
            sum(stem in scheme or bare_stem(stem) in scheme for stem in stems)
            for scheme in self._schemes
        ]
        return _matched(stems, lambda stem: self._one(*self._of_stem(stem, fits)))

    def of_references(self, references: Iterable[str]) -> Matched:
        """Photos of the names that label files hold."""
        return _matched(references, lambda name: self._one(*self._of_reference(name)))

    def _one(self, rank: int, found: set[str]) -> tuple[int, set[str]]:
        """One photo where all that a name could mean are copies of it."""
        photos = {self._copies.get(name, name) for name in found}
        return rank, photos if len(found) > len(photos) == 1 else found

    def _of_stem(self, stem: str, fits: list[int]) -> tuple[int, set[str]]:
        spellings = dict.fromkeys((stem, bare_stem(stem)))
        for rank, spelled in enumerate(spellings):
            knowing = [
                (fit, scheme[spelled])
                for fit, scheme in zip(fits, self._schemes, strict=True)
                if spelled in scheme
            ]
            if knowing:
                best = max(fit for fit, _ in knowing)
                return rank, {name for fit, name in knowing if fit == best}
        for rank, spelled in enumerate(spellings, 2):
            found = self._loose.get(spelled) or self._loose.get(f"/{_folded(spelled)}")
            if found:
                return rank, found
        return 0, set()

    def _of_reference(self, reference: str) -> tuple[int, set[str]]:
        if reference in self._known:
            return 0, {reference}
        wanted = _parts(reference)
        same = self._last.get(wanted[-1], set()) if wanted else set()
        shared = {name: _shared(wanted, _parts(name)) for name in same}
        best = max(shared.values(), default=0)
        return 1, {name for name, count in shared.items() if count == best}


def _outputs(names: Iterable[str]) -> dict[str, str]:
    """The photos directly in the folder by what ``skyline-viz detect`` calls its files for them."""
    flat = [PurePosixPath(name) for name in names if "/" not in name]
    repeated = Counter(path.stem for path in flat)
    items = [
        DatasetItem(path.name if repeated[path.stem] > 1 else path.stem, Path(path))
        for path in flat
    ]
    items.sort(key=lambda item: item.name)
    return {
        called: item.photo_path.name
        for item, called in zip(items, output_names(items), strict=True)
    }


def _matched(names: Iterable[str], of: Callable[[str], tuple[int, set[str]]]) -> Matched:
    """Match names; of two for one photo that which is spelled better counts, or neither."""
    unclear, unknown = [], []
    claims: defaultdict[str, list[tuple[int, str]]] = defaultdict(list)
    for name in dict.fromkeys(names):
        rank, found = of(name)
        if len(found) > 1:
            unclear.append(f"{name} could be any of {', '.join(sorted(found)[:4])}.")
        elif found:
            claims[next(iter(found))].append((rank, name))
        else:
            unknown.append(name)
    photos = {}
    for photo, claimed in claims.items():
        claimed.sort()
        best = [name for rank, name in claimed if rank == claimed[0][0]]
        if len(best) == 1:
            photos[best[0]] = photo
            others = [name for _, name in claimed[1:]]
            unknown += others
        else:
            unclear.append(f"{' and '.join(best[:4])} could all be {photo}.")
    return Matched(photos, tuple(unclear), tuple(unknown))


def _folded(name: str) -> str:
    """A name without case, accents in one form, and without what XML cannot hold."""
    plain = "".join(one if one >= " " or one in "\t\n" else "?" for one in name)
    return unicodedata.normalize("NFC", plain.encode("utf-8", "replace").decode()).casefold()


def _parts(name: str) -> list[str]:
    """Folders and name of a path of any system, compared without case."""
    return [part for part in _folded(name.replace("\\", "/")).split("/") if part not in ("", ".")]


def _shared(one: list[str], other: list[str]) -> int:
    """Number of parts in which two paths end alike."""
    count = 0
    for a, b in zip(reversed(one), reversed(other), strict=False):
        if a != b:
            break
        count += 1
    return count
