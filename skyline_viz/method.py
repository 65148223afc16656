"""What every method offers: a name, to detect and, where it learns, to be fitted."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Protocol, Self, TypeVar, runtime_checkable

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import U8, Bool
from skyline_viz.datasets.item import Item
from skyline_viz.detection import Detection
from skyline_viz.skyline import Skyline
from skyline_viz.system.headed_npz import Stored
from skyline_viz.system.settings import Configured
from skyline_viz.system.settings import MethodError as MethodError  # noqa: PLC0414 - known from here

Model = Mapping[str, npt.NDArray[np.generic]]
"""What a method has learned: arrays by name, as they are written to a file."""


Sums = TypeVar("Sums")
"""What photos add up to, for methods that learn from sums."""


class UnnamedClassError(MethodError):
    """A file was made by a class that nobody has named; the message says how to."""


class Method(Protocol):
    """Finds skylines."""

    @property
    def name(self) -> str:
        """What it is called in tables and reports: a name with settings, a file's, or a label."""

    def detect(self, photo: U8) -> Detection:
        """Find the skyline of a photo.

        Args:
            photo: ``(H, W, 3)`` uint8 RGB.

        Raises:
            MethodError: It has not been trained.
        """


@runtime_checkable
class Learner(Method, Protocol):
    """A method that learns from photos with truth."""

    @property
    def family(self) -> str:
        """Methods of one family learn the same, and can share it."""

    def fit(self, items: Iterable[Item], seed: int = 0) -> Self:
        """The method, trained on the photos of a data set; those without a truth are left out.

        Args:
            items: Photos with truth, such as ``sv.open_dataset(folder)``.
            seed: Seed of all that is drawn.

        Raises:
            MethodError: A package that training needs is missing.
            ValueError: No photo has a truth, or nothing can be learned from them.
        """

    def sharing(self, other: Self) -> Self:
        """This method with what another of its family has learned."""


@runtime_checkable
class AddingLearner(Learner, Protocol[Sums]):
    """A method that learns from sums over photos, as our detector does from Gram matrices.

    `fit` comes to the same as `from_sums` of what `gather` gives for all photos. So a
    cross-validation looks at each photo once, and adds up what the other folds gave.
    """

    def gather(self, item: Item, seed: int = 0) -> Sums:
        """What there is to learn from one photo; two of these add up with ``+``.

        Args:
            item: A photo with truth.
            seed: Seed of all that is drawn.

        Raises:
            PhotoError: The photo cannot be read.
            SkylineError: It has no truth, or one that does not fit.
        """

    def from_sums(self, sums: Sums, seed: int = 0) -> Self:
        """The method, trained on the photos that were added up.

        Args:
            sums: Over all photos to learn from.
            seed: The one that they were gathered with.

        Raises:
            ValueError: Nothing can be learned from them.
        """


@runtime_checkable
class Configurable(Method, Protocol):
    """A method that can be named with settings, and written to a file."""

    @property
    def label(self) -> str:
        """What it is called instead of after its settings; empty where it is not."""

    @property
    def learned_from(self) -> str:
        """Name of the data set that it learned from; empty if that is not known."""

    def labelled(self, label: str) -> Self:
        """The same under another name."""

    def own_name(self) -> str:
        """What it is called without a label."""

    def settings(self) -> dict[str, object]:
        """Its settings by name."""

    def kinds(self) -> dict[str, object]:
        """Type of each setting that can be given as text."""

    def with_settings(self, values: Mapping[str, object]) -> Self:
        """The same with other settings.

        Raises:
            ValueError: One is unknown, of another kind, or out of its range.
        """

    def arrays(self) -> Mapping[str, npt.NDArray[Any]]:
        """What it has learned, by name."""

    def model_bytes(self) -> int:
        """Size of what it has learned, in bytes, as it lies in memory."""

    def require_told(self) -> None:
        """Refuse to be written to a file that would give back another one, or none.

        Raises:
            ValueError: Its settings or what it has learned cannot be told.
        """


@dataclass(frozen=True)
class LearnedMethod(Configured):
    """What methods with a `Model` have in common."""

    UNSET: ClassVar = Configured.UNSET | {"model"}

    model: Model = field(default_factory=dict)
    """What it has learned; empty before training."""

    @property
    def family(self) -> str:
        """Methods of one family learn the same; here those of one class and the same settings."""
        return f"{type(self).__name__} {self.settings()}"

    def arrays(self) -> Model:
        """See `Configurable.arrays`."""
        return self.model

    def learn(self, items: Sequence[Item], seed: int) -> Model:
        """What there is to learn from photos with truth."""
        raise NotImplementedError

    def fit(self, items: Iterable[Item], seed: int = 0) -> Self:
        """See `Learner.fit`."""
        return replace(self, model=self.learn(tuple(items), seed), learned_from="", seen=())

    def sharing(self, other: LearnedMethod) -> Self:
        """See `Learner.sharing`."""
        return replace(self, model=other.model, learned_from=other.learned_from, seen=other.seen)

    def detect(self, photo: U8) -> Detection:
        """See `Method.detect`."""
        raise NotImplementedError

    def model_shapes(self) -> Mapping[str, tuple[int | None, ...]]:
        """Shape of each array of the model, None where any length will do."""
        return {}

    def check_announced(self, arrays: Mapping[str, Stored]) -> None:
        """Refuse a file that announces other arrays than the model has, before they are read.

        Raises:
            ValueError: The message names the array.
        """
        for name, wanted in self.model_shapes().items():
            if name not in arrays:
                raise ValueError(f"its {name} is missing")
            _check_array(name, arrays[name], wanted)

    def check_model(self) -> None:
        """Refuse a model whose arrays are missing, of another shape, or not finite.

        Compiled loops trust these shapes.

        Raises:
            ValueError: The message names the array.
        """
        for name, wanted in self.model_shapes().items():
            array = self.model.get(name)
            if array is None:
                raise ValueError(f"its {name} is missing")
            _check_array(name, array, wanted)
            if not np.isfinite(array).all():
                raise ValueError(f"its {name} holds what is no finite number")

    def part(self, name: str) -> npt.NDArray[np.generic]:
        """An array of the model.

        Raises:
            MethodError: The method has not been trained.
        """
        self.require_trained()
        if name not in self.model:
            raise MethodError(f"{self.name} is damaged: its {name} is missing.")
        return self.model[name]

    def require_trained(self) -> None:
        """Refuse to go on without having learned.

        Raises:
            MethodError: The method has not been trained.
        """
        if not self.model:
            raise MethodError(
                f"{self.name} has learned nothing yet; train it with: "
                f"skyline-viz train DATASET --method {self.own_name()} --out FILE"
            )


def _check_array(
    name: str, array: Stored | npt.NDArray[np.generic], wanted: tuple[int | None, ...]
) -> None:
    """Refuse an array of another shape than the model's, or of no numbers.

    Raises:
        ValueError: The message names it.
    """
    fits = len(array.shape) == len(wanted) and all(
        want in (None, have) for want, have in zip(wanted, array.shape, strict=True)
    )
    if not fits:
        raise ValueError(f"its {name} has the shape {array.shape}")
    if array.dtype.kind not in "uif":
        raise ValueError(f"its {name} holds what is no finite number")


def shown_to_learners(items: Sequence[Item]) -> Iterator[tuple[U8, Skyline]]:
    """Photos and truths of a data set, those without a truth left out, read one at a time.

    Raises:
        ValueError: No photo has a truth.
    """
    pairs = [(item, truth) for item in items if (truth := item.truth()) is not None]
    if not pairs:
        raise ValueError("training needs at least one photo with a true skyline.")
    return ((item.photo(), truth) for item, truth in pairs)


def near_truth(shape: tuple[int, int], truth: Skyline, band: float) -> Bool:
    """``(H, W)`` pixels within `band` rows of the truth; whole columns where it is not visible."""
    rows = np.arange(shape[0], dtype=np.float32)[:, None]
    near: Bool = np.abs(rows - truth.rows[None, :]) <= band
    near |= ~truth.visible[None, :]
    return near
