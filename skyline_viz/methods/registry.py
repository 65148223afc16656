"""Methods by what they are named: a name, a file or a class, with settings and a label."""

from __future__ import annotations

import re
from pathlib import Path

from skyline_viz.config import refuse_gone
from skyline_viz.detector import Detector
from skyline_viz.filter_bank import FilterBank, FilterBankError
from skyline_viz.method import Configurable, LearnedMethod, Method, MethodError
from skyline_viz.methods.finding.importing import class_at, offered
from skyline_viz.methods.finding.method_files import (
    Trained,
    load_method,
    make_method,
    method_digest,
    model_bytes,
    save_method,
)
from skyline_viz.methods.finding.plugins import PluggedLearner, as_method, plug_in
from skyline_viz.methods.finding.specs import Spec, parse
from skyline_viz.methods.names import NAMES
from skyline_viz.methods.sky_network import SkyNetwork
from skyline_viz.system.nearest import meant
from skyline_viz.system.notes import note
from skyline_viz.system.settings import from_texts, name_with

__all__ = [
    "NAMES",
    "Trained",
    "find_method",
    "has_learned",
    "learned_from",
    "load_method",
    "make_method",
    "method_digest",
    "model_bytes",
    "save_method",
]

MODEL = "model"
"""The setting that names the file of what a method has learned."""

_CLASS = re.compile(r"[A-Za-z_][\w.]*:[A-Za-z_][\w.]*")
_ENDINGS = (".npz", ".onnx")


def find_method(text: str) -> Configurable:
    """A method by what it is named: ``[LABEL=](NAME | FILE | package.module:Class)[:SETTINGS]``.

    Settings are ``name=value``, with commas between; of a method by its name, ``model=FILE`` is the
    file of what it has learned. See `specs` for names of files that hold such signs.

    Raises:
        MethodError: There is none of that name, or its file or its class is of no use.

    Examples:
        >>> find_method("steep=paper:delta=4").name, find_method("paper:delta=4").name
        ('steep', 'paper:delta=4')
    """
    if not isinstance(text, str):
        raise MethodError(f"a method is named by a text, not by {text!r:.60}.")
    spec = _parsed(text)
    settings = dict(spec.settings)
    method = _by_target(spec)
    base = "" if not spec.is_file else method.label or Path(spec.target).name
    if model := settings.pop(MODEL, ""):
        if spec.is_file:
            raise MethodError(f"{spec.target} brings what it has learned; leave out {MODEL}.")
        method = _with_model(method, model)
    try:
        if isinstance(method, Detector):
            refuse_gone(settings)
        values = from_texts(settings, method.kinds(), spec.target)
        usual = method.settings()
        changed = method.with_settings(values) if values else method
    except MethodError:
        raise
    except ValueError as error:
        said = str(error)
        about = said if spec.target in said else f"{spec.target}: {said}"
        raise MethodError(about if about.endswith((".", "?")) else f"{about}.") from error
    if base:
        now = {name: changed.settings()[name] for name in usual if name in method.kinds()}
        label = name_with(base, now, usual)
    elif model:
        own = changed.own_name()
        label = f"{own}{',' if ':' in own else ':'}{MODEL}={Path(model).name}"
    else:
        label = ""
    return changed.labelled(spec.label or label)


def learned_from(method: str | Method) -> str:
    """Name of the data set that a method was trained on; empty if it is not known.

    Several names have a comma and a space between them.

    Args:
        method: A method, or one as `find_method` takes it.

    Raises:
        MethodError: There is no such method.
    """
    known = find_method(method) if isinstance(method, str) else as_method(method)
    return known.learned_from


def has_learned(text: str) -> bool:
    """Whether what is named brings what it has learned from a file, and so is not to be trained."""
    spec = _parsed(text)
    return spec.is_file or MODEL in spec.settings


def _parsed(text: str) -> Spec:
    try:
        return parse(text, lambda part: part not in NAMES and _exists(part))
    except ValueError as error:
        raise MethodError(str(error)) from error


def _exists(name: str) -> bool:
    try:
        return bool(name) and Path(name).exists()
    except (OSError, ValueError):  # longer than any name, or with a sign that none has
        return False


def _by_target(spec: Spec) -> Configurable:
    target = spec.target
    if spec.is_file or target.endswith(_ENDINGS):
        return _from_file(target)
    if target in NAMES:
        return make_method(target)
    packages = offered()
    if target in packages:
        return plug_in(packages[target], class_at(packages[target]), spec.settings)
    first, _, rest = target.partition(":")
    if first in (*NAMES, *packages):
        raise MethodError(
            f"{target} gives no value: settings are NAME=VALUE, as in {first}:{rest}=1."
        )
    if _CLASS.fullmatch(target):
        return plug_in(target, class_at(target), spec.settings)
    known = [*NAMES, *packages]
    raise MethodError(
        f"{target} is neither a method nor the file of a trained one; "
        f"{meant(target, known, 'methods are')}"
    )


def _from_file(name: str) -> Configurable:
    if name.endswith(".onnx"):
        return SkyNetwork(Path(name))
    method = load_method(name)
    if isinstance(method, Detector) and method.bank.provenance.detector is None:
        _tell_of_earlier(name, method)
    return method


def _tell_of_earlier(name: str, detector: Detector) -> None:
    """Say what is taken, where a bank of an earlier version knows its settings only in part."""
    if not detector.label and detector.config.name != "default":
        note(
            f"{name} knows of the settings it was trained for only that edges were "
            f"{detector.config.edge_source}; {detector.config.name} is taken. "
            f"Others are named so: {name}:delta=1, or paper:{MODEL}={name}."
        )


def _with_model(method: Configurable, file: str) -> Configurable:
    """A method with what a file says that it has learned.

    Raises:
        MethodError: It learns something else, or nothing.
    """
    if isinstance(method, Detector):
        try:
            return method.sharing(Detector(FilterBank.load(file)))
        except FilterBankError as error:
            raise MethodError(str(error)) from error
    other = load_method(file)
    match method, other:
        case LearnedMethod(), LearnedMethod():
            if type(other) is type(method) or other.family == method.family:
                return method.sharing(other)
        case PluggedLearner(), PluggedLearner():
            if other.place == method.place:
                return method.sharing(other)
    raise MethodError(f"{file} holds {other.own_name()}, and not what {method.name} learns.")
