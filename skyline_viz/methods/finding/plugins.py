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
from uuid import uuid4

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import U8, check_photo
from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.detection import Detection, timed
from skyline_viz.method import Configurable, MethodError, UnnamedClassError
from skyline_viz.methods.finding.importing import class_at, failed_in, offered
from skyline_viz.methods.finding.parameters import MODEL, checked, kinds_of, made_with, required
from skyline_viz.skyline import Skyline
from skyline_viz.system.headed_npz import HeadedNpz
from skyline_viz.system.settings import SettingError, from_texts, name_with

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

    learned_from: str = field(default="", compare=False)
    """See `Configurable.learned_from`."""

    seen: tuple[str, ...] = field(default=(), compare=False, repr=False)
    """See `Configured.seen`."""

    unsaid: str = ""
    """What tells it from others of its class where its settings cannot be told."""

    kept_back: str = ""
    """What tells it from others of its class where what it has learned cannot be told."""

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
        base = _called(self.inner, self.place) or type(self.inner).__name__
        return name_with(base, self.given, {})

    def labelled(self, label: str) -> Self:
        """See `Configurable.labelled`."""
        return replace(self, label=label)

    def settings(self) -> dict[str, object]:
        """See `Configurable.settings`."""
        return dict(self.given)

    def kinds(self) -> dict[str, object]:
        """See `Configurable.kinds`: the parameters of the class."""
        return kinds_of(type(self.inner))

    def with_settings(self, values: Mapping[str, object]) -> Self:
        """See `Configurable.with_settings`."""
        settings = {**self.given, **checked(values, self.kinds())}
        return self._with(self._remade(settings, self.arrays()), settings)

    def arrays(self) -> Mapping[str, npt.NDArray[Any]]:
        """See `Configurable.arrays`."""
        model = getattr(self.inner, MODEL, None)
        if not isinstance(model, Mapping):
            return {}
        return {str(name): np.asarray(array) for name, array in model.items()}

    def model_bytes(self) -> int:
        """See `Configurable.model_bytes`."""
        return sum(array.nbytes for array in self.arrays().values())

    def require_told(self) -> None:
        """See `Configurable.require_told`.

        Raises:
            MethodError: What it has learned, its settings or its class cannot be told.
        """
        reason = ""
        learns = callable(getattr(self.inner, "fit", None))
        if learns and not isinstance(getattr(self.inner, MODEL, None), Mapping):
            reason = f"what it has learned is in no {MODEL}, arrays by name"
        elif "<locals>" in self.place:
            reason = "its class is inside of a function, where nobody finds it again"
        elif not self.unsaid:
            self._remade(self.given, self.arrays())
        if self.unsaid or reason:
            reason = reason or "its settings are in no attributes named like its parameters"
            raise MethodError(f"{self.place} cannot be written to a file, because {reason}.")

    def _remade(self, settings: Mapping[str, object], model: Mapping[str, Any]) -> Any:  # noqa: ANN401
        """An object of the class with these settings and this model.

        Raises:
            MethodError: The class fails, or the settings of this one cannot be told to it.
        """
        made = None if self.unsaid else _made(type(self.inner), self.place, settings, model)
        alike = settings != self.given or made_with(made) == made_with(self.inner)
        if made is None or not alike:
            raise MethodError(
                f"{self.place} cannot be made anew with its settings, because they are not in "
                f"attributes named like its parameters."
            )
        return made

    def _with(self, inner: object, given: Mapping[str, object]) -> Self:
        """The same with another object of the class."""
        return replace(self, inner=inner, given=given, kept_back=_kept_back(inner))

    def digest_of_code(self) -> str:
        """Digest of the file that its class is in: other code finds other lines.

        What cannot be told of the object is drawn, so that no other one is taken for it.
        """
        drawn = self.unsaid + self.kept_back
        try:
            content = Path(inspect.getfile(type(self.inner))).read_bytes()
        except (OSError, TypeError):  # typed into a session
            return drawn
        return hashlib.sha256(content).hexdigest() + drawn

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
        except (Exception, SystemExit) as error:
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
        if self.unsaid:
            return f"{self.place} {self.unsaid}"
        return str(getattr(self.inner, "family", f"{self.place} {self.given}"))

    def fit(self, items: Sequence[DatasetItem], seed: int = 0) -> Self:
        """See `Learner.fit`."""
        try:
            fitted = self.inner.fit(items, seed)
        except (MethodError, MemoryError):
            raise
        except (Exception, SystemExit) as error:
            raise failed_in(self.place, error) from error
        if not callable(getattr(fitted, "detect", None)):
            raise MethodError(f"fit of {self.place} returns no trained method.")
        return replace(self._with(fitted, self.given), learned_from="", seen=())

    def sharing(self, other: Self) -> Self:
        """See `Learner.sharing`."""
        if (self.given, self.unsaid) == (other.given, other.unsaid):
            shared = replace(self, inner=other.inner, kept_back=other.kept_back)
        else:
            shared = self._with(self._remade(self.given, other.arrays()), self.given)
        return replace(shared, learned_from=other.learned_from, seen=other.seen)


def as_method(method: object) -> Configurable:
    """A method with all that is asked of one of ours, wherever its class comes from.

    Settings of an object are read from its attributes that are called like the parameters of its
    class. Where they cannot be told, it is taken for no other one, and nothing of it is kept.

    Raises:
        MethodError: It is none: it has no ``detect``, or is a class instead of an object of one.
    """
    _check_detects(method, f"{method!r:.60}")
    if isinstance(method, type):
        raise MethodError(
            f"{method.__name__} is a class; make a method of it: {method.__name__}()."
        )
    if isinstance(method, Configurable):
        return method
    kind = type(method)
    place = f"{kind.__module__}:{kind.__qualname__}"
    given, called = made_with(method), _called(method, place)
    own = called != getattr(kind, "name", "")  # and not of its class
    plugged = _plugged(method, place, given or {}, called if own else "")
    return plugged if given is not None else replace(plugged, unsaid=uuid4().hex)


def plug_in(
    place: str,
    kind: Any,  # noqa: ANN401 - anything may be at a place
    texts: Mapping[str, str],
) -> PluggedIn:
    """A method of a class that somebody has named, with the settings that it cannot do without.

    Args:
        place: Where the class is.
        kind: The class.
        texts: Settings as they are named.

    Raises:
        MethodError: There is no such class, it is no method, or it needs a setting.
    """
    _check_detects(kind, place)
    _named.add(place)
    needs = required(kind)
    if missing := [name for name in needs if name not in texts]:
        raise MethodError(f"{place} needs the setting {missing[0]}: {place}:{missing[0]}=VALUE.")
    try:
        kinds = kinds_of(kind)
        given = checked(from_texts({name: texts[name] for name in needs}, kinds, place), kinds)
    except SettingError as error:
        raise MethodError(f"{place}: {error}.") from error
    return _plugged(_made(kind, place, given, {}), place, given)


def plugged_from_file(
    path: str, place: str, settings: Mapping[str, object], file: HeadedNpz, hint: str
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
        given = checked(settings, kinds_of(kind))
    except SettingError as error:
        raise MethodError(f"{path} is damaged: {error}.") from error
    model = {name: file.read(name) for name in file.arrays}
    return _plugged(_made(kind, place, given, model), place, given)


def _called(inner: object, place: str) -> str:
    """What an object calls itself; nothing where it does not."""
    try:
        called = getattr(inner, "name", "")
    except (Exception, SystemExit) as error:
        raise failed_in(place, error) from error
    return called if isinstance(called, str) else ""


def _check_detects(method: object, called: str) -> None:
    if not callable(getattr(method, "detect", None)):
        raise MethodError(f"{called} is no method: it has no detect(photo).")


def _plugged(inner: object, place: str, given: Mapping[str, object], label: str = "") -> PluggedIn:
    kind = PluggedLearner if callable(getattr(inner, "fit", None)) else PluggedIn
    return kind(inner, place, given, label, kept_back=_kept_back(inner))


def _kept_back(inner: object) -> str:
    """Drawn for an object that learns, and does not tell what it has learned."""
    told = isinstance(getattr(inner, MODEL, ""), Mapping | None)  # None: nothing yet
    return uuid4().hex if callable(getattr(inner, "fit", None)) and not told else ""


def _made(kind: Any, place: str, settings: Mapping[str, object], model: Mapping[str, Any]) -> Any:  # noqa: ANN401
    try:
        return kind(**settings, **({MODEL: model} if model else {}))
    except (Exception, SystemExit) as error:
        raise failed_in(place, error) from error
