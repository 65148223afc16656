"""Methods of somebody's: a class with ``detect(photo)``, from a module or an installed package.

``detect`` may return rows ``(W,)``, a `Skyline` or a `Detection`. A class that learns has
``fit(items, seed)``, which returns a trained one, and keeps what it learned as arrays by name in
``model``, which its constructor takes. The other parameters of that are its settings.
"""

from __future__ import annotations

import hashlib
import inspect
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import U8, check_photo
from skyline_viz.datasets.layouts import DatasetItem
from skyline_viz.detection import Detection, timed
from skyline_viz.method import Configurable, Learner, Method, MethodError, UnnamedClassError
from skyline_viz.methods.finding.importing import class_at, failed_in, offered
from skyline_viz.skyline import Skyline
from skyline_viz.system.headed_npz import HeadedNpz
from skyline_viz.system.settings import SettingError, check_kind, from_document, name_with

_MODEL = "model"

_named: set[str] = set()  # places of classes that somebody has named in this process


@dataclass(frozen=True)
class PluggedIn:
    """A method of somebody's, with all that is asked of one of ours."""

    inner: Any
    """An object of their class."""

    place: str
    """Where the class is: ``package.module:Class``."""

    given: Mapping[str, object] = field(default_factory=dict)
    """The settings that it was made with."""

    label: str = ""
    """What it is called instead of after its settings."""

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Its class has been named also where it is sent to."""
        _named.add(state["place"])
        vars(self).update(state)

    @property
    def name(self) -> str:
        """Its label, or its name and settings."""
        return self.label or self.own_name()

    def own_name(self) -> str:
        """See `Configurable.own_name`."""
        called = getattr(self.inner, "name", "")
        base = called if isinstance(called, str) and called else type(self.inner).__name__
        return name_with(base, self.given, {})

    def labelled(self, label: str) -> Self:
        """See `Configurable.labelled`."""
        return replace(self, label=label)

    def settings(self) -> dict[str, object]:
        """See `Configurable.settings`."""
        return dict(self.given)

    def kinds(self) -> dict[str, object]:
        """See `Configurable.kinds`: the parameters of the class."""
        return _kinds(type(self.inner))

    def with_settings(self, values: Mapping[str, object]) -> Self:
        """See `Configurable.with_settings`."""
        settings = {**self.given, **_checked(values, self.kinds())}
        made = _made(type(self.inner), self.place, settings, self.arrays())
        return replace(self, inner=made, given=settings)

    def arrays(self) -> Mapping[str, npt.NDArray[Any]]:
        """See `Configurable.arrays`."""
        model = getattr(self.inner, _MODEL, None)
        if not isinstance(model, Mapping):
            return {}
        return {str(name): np.asarray(array) for name, array in model.items()}

    def require_model(self) -> None:
        """Refuse to be written to a file without what has been learned.

        Raises:
            MethodError: It learns, and says nothing of what it has learned.
        """
        if isinstance(self, Learner) and not isinstance(getattr(self.inner, _MODEL, None), Mapping):
            raise MethodError(
                f"what {self.place} has learned cannot be written to a file, because it has no "
                f"{_MODEL}, arrays by name."
            )

    def digest_of_code(self) -> str:
        """Digest of the file that its class is in: other code finds other lines."""
        try:
            content = Path(inspect.getfile(type(self.inner))).read_bytes()
        except (OSError, TypeError):  # typed into a session
            return ""
        return hashlib.sha256(content).hexdigest()

    def detect(self, photo: U8) -> Detection:
        """See `Method.detect`.

        Raises:
            MethodError: It failed, or found what is no skyline of the photo.
        """
        check_photo(photo)
        seconds: dict[str, float] = {}
        try:
            with timed(seconds, "detect"):
                found = self.inner.detect(photo)
        except (MethodError, MemoryError):
            raise
        except Exception as error:
            raise failed_in(self.place, error) from error
        if isinstance(found, Detection):
            own: Detection = replace(found, method=self.name)
            return own
        line = self._line(found, photo)
        return Detection.of_line(photo, line, method=self.name, seconds=seconds)

    def _line(self, found: object, photo: U8) -> Skyline:
        if isinstance(found, Skyline):
            line = found
        else:
            try:
                line = Skyline(rows=np.asarray(found, np.float32))
            except (TypeError, ValueError) as error:
                raise MethodError(f"{self.place} found no skyline: {error}.") from error
        if line.width != photo.shape[1]:
            raise MethodError(
                f"{self.place} found {line.width} rows in a photo of {photo.shape[1]} columns."
            )
        return line


class PluggedLearner(PluggedIn):
    """One that learns."""

    @property
    def family(self) -> str:
        """See `Learner.family`."""
        return str(getattr(self.inner, "family", f"{self.place} {self.given}"))

    def fit(self, items: Sequence[DatasetItem], seed: int = 0) -> Self:
        """See `Learner.fit`."""
        try:
            fitted = self.inner.fit(items, seed)
        except (MethodError, MemoryError):
            raise
        except Exception as error:
            raise failed_in(self.place, error) from error
        if not callable(getattr(fitted, "detect", None)):
            raise MethodError(f"fit of {self.place} returns no trained method.")
        return replace(self, inner=fitted)

    def sharing(self, other: Self) -> Self:
        """See `Learner.sharing`."""
        if self.given == other.given:
            return replace(self, inner=other.inner)
        return replace(self, inner=_made(type(self.inner), self.place, self.given, other.arrays()))


def as_method(method: Method) -> Configurable:
    """A method with all that is asked of one of ours, wherever its class comes from."""
    if isinstance(method, Configurable):
        return method
    kind = type(method)
    place = f"{kind.__module__}:{kind.__qualname__}"
    return _plugged(method, place, {})


def plug_in(place: str, kind: Any) -> PluggedIn:  # noqa: ANN401 - anything may be at a place
    """A method of a class that somebody has named.

    Raises:
        MethodError: There is no such class, or it is no method.
    """
    if not callable(getattr(kind, "detect", None)):
        raise MethodError(f"{place} is no method: it has no detect(photo).")
    _named.add(place)
    return _plugged(_made(kind, place, {}, {}), place, {})


def plugged_from_file(
    path: str, place: str, settings: Mapping[str, object], file: HeadedNpz, label: str, hint: str
) -> PluggedIn:
    """The method of somebody's in an open file.

    Raises:
        UnnamedClassError: Nobody has named its class in this process; `hint` ends what to name.
        MethodError: It does not take the settings.
        NpzError: An array is damaged.
    """
    if place not in _named and place not in offered().values():
        raise UnnamedClassError(
            f"{path} was made by {place}, and no file decides what is run: name that class, too, "
            f"as in --method {place}{hint}."
        )
    kind = class_at(place)
    try:
        checked = _checked(settings, _kinds(kind))
    except SettingError as error:
        raise MethodError(f"{path} is damaged: {error}.") from error
    model = {name: file.read(name) for name in file.arrays}
    return _plugged(_made(kind, place, checked, model), place, checked, label)


def _plugged(inner: object, place: str, given: Mapping[str, object], label: str = "") -> PluggedIn:
    learns = callable(getattr(inner, "fit", None))
    return (PluggedLearner if learns else PluggedIn)(inner, place, given, label)


def _made(kind: Any, place: str, settings: Mapping[str, object], model: Mapping[str, Any]) -> Any:  # noqa: ANN401
    try:
        return kind(**settings, **({_MODEL: model} if model else {}))
    except Exception as error:
        raise failed_in(place, error) from error


def _kinds(kind: type) -> dict[str, object]:
    """Type of each parameter of a class that can be given as text; of its default if untyped."""
    try:
        parameters = inspect.signature(kind, eval_str=True).parameters.values()
    except (TypeError, ValueError, NameError):
        return {}
    found: dict[str, object] = {}
    for one in parameters:
        if one.name in (_MODEL, "label") or one.kind in (one.VAR_POSITIONAL, one.VAR_KEYWORD):
            continue
        usual = str if one.default in (one.empty, None) else type(one.default)
        found[one.name] = usual if one.annotation is one.empty else one.annotation
    return found


def _checked(values: Mapping[str, object], kinds: Mapping[str, object]) -> dict[str, object]:
    """Values of settings, if they are of the kinds that a class takes; it checks their range."""
    checked: dict[str, object] = {}
    for name, value in values.items():
        if name not in kinds:
            raise SettingError(f"there is no setting {name}")
        checked[name] = from_document(value, kinds[name])
        check_kind(name, checked[name], kinds[name], -float("inf"), float("inf"))
    return checked
