"""The options that say what detects: methods by what they are named, and short forms of such."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Container, Sequence
from dataclasses import asdict, dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias, get_args

import tyro

from skyline_viz.command_line.earlier_run import earlier
from skyline_viz.command_line.local import no_path
from skyline_viz.command_line.messages import UsageError
from skyline_viz.command_line.settings import BankFile, Preset, RunFile
from skyline_viz.config import DetectorConfig, refuse_gone
from skyline_viz.methods.names import NAMES
from skyline_viz.picture_files.kinds import PHOTO_SUFFIXES
from skyline_viz.storage.addresses import is_address
from skyline_viz.system.memory import loading
from skyline_viz.system.settings import MethodError, spelt
from skyline_viz.system.stand_ins import without

if TYPE_CHECKING:
    from skyline_viz.method import Configurable

MethodTexts: TypeAlias = Annotated[tuple[str, ...], tyro.conf.arg(metavar="METHOD")]
"""Methods by what they are named, see `methods.specs`."""

SkyModelName: TypeAlias = Annotated[str | None, tyro.conf.arg(metavar="{small,large,FILE.onnx}")]
"""A sky model as `SkyModel.named` takes it."""

_SKY_MODEL = re.compile(r"small|large|.*[./\\].*", re.DOTALL)  # a name, or some file


@dataclass(frozen=True)
class Methods:
    """What detects: our detector as the short forms describe it, and methods that are named."""

    method: MethodTexts = ()
    """Methods, each [LABEL=](NAME | FILE | package.module:Class)[:setting=value,...]: default,
    paper:delta=4, svm-dcsi, bank.npz, steep=paper:delta=4."""

    network: Annotated[Path | None, tyro.conf.arg(metavar="FILE.onnx")] = None
    """A network that segments the sky, as one more method."""

    sky_class: int = 0
    """Which class of the network is sky, from 0; 0 where it gives the sky alone."""

    bank: BankFile = None
    """File of a detector or filter bank, with its settings unless --preset says others."""

    sky_model: SkyModelName = None
    """The sky model of our detector; --sky is short for it. The small one unless given."""

    preset: Preset = "default"
    """Where the settings below start from: the best that is known, or the published method."""

    run: RunFile = None
    """Settings, bank and sky model of an earlier run: its run.json or summary.json. Single settings
    below still count."""

    config: DetectorConfig = field(default_factory=DetectorConfig)
    """Single settings of our detector."""

    ours: tyro.conf.Suppress[bool] = False
    """Whether our detector was described by a short form, and so is one of the methods."""

    @property
    def given(self) -> bool:
        """Whether anything was named."""
        return bool(self.method or self.network or self.sky_class or self.ours)

    def chosen(self, *, to_train: bool = False) -> list[Configurable]:
        """The methods in the order named, that of the short forms first; the default one if none.

        Args:
            to_train: Whether those that learn are going to be trained.

        Raises:
            UsageError: Two have one name, what has learned already is to be trained, or a class is
                named of no network.
            MethodError: There is none of that name, its file is damaged, or it was not trained.
        """
        with loading(), without("coverage"):  # which numba would tell of compiled lines
            from skyline_viz.method import LearnedMethod
            from skyline_viz.methods.registry import find_method, has_learned
            from skyline_viz.methods.sky_network import SkyNetwork

        if stored := next(filter(is_address, map(_unlabelled, self.method)), None):
            raise no_path(stored, "method")
        if self.sky_class and self.network is None:
            raise UsageError("--sky-class is a class of --network, which is not named.")
        if to_train and (file := next(filter(has_learned, self.method), self.bank)):
            raise UsageError(
                f"{file} has learned already, and would be trained anew; name a method."
            )
        found = [] if self.given and not self.ours else [self._ours()]
        found += map(find_method, self.method)
        if self.network is not None:
            network = SkyNetwork(self.network).with_settings({"sky_class": self.sky_class})
            found.append(network)
        twice = [name for name, count in Counter(one.name for one in found).items() if count > 1]
        if twice:
            raise UsageError(
                f"the method {twice[0]} is named twice; give one a label: other={twice[0]}."
            )
        for one in found:
            if isinstance(one, SkyNetwork):
                one.check()
            if isinstance(one, LearnedMethod) and not to_train:
                one.require_trained()
        return found

    def one(self, *, to_train: bool = False) -> Configurable:
        """The only method.

        Raises:
            UsageError: There are several, or one of the reasons of `chosen`.
        """
        found = self.chosen(to_train=to_train)
        if len(found) != 1:
            names = ", ".join(method.name for method in found)
            raise UsageError(f"one method can be used here, and {len(found)} are named: {names}.")
        return found[0]

    def _ours(self) -> Configurable:
        """The detector that bank, preset and settings describe together."""
        from skyline_viz.detector import Detector
        from skyline_viz.methods.registry import find_method

        if self.sky_model and not self.config.sky_weight:
            raise UsageError(
                f"{self.config.name} runs no sky model, for its sky_weight is 0; leave out --sky."
            )
        if self.bank is None:
            ours = Detector(config=self.config)
            return ours.with_settings({"sky": self.sky_model}) if self.sky_model else ours
        base, _, settings = self.config.name.partition(":")
        brought = find_method(str(self.bank))
        if not isinstance(brought, Detector):
            raise UsageError(f"{self.bank} is a method, not a filter bank; name it with --method.")
        own, wanted = asdict(brought.config), asdict(self.config)
        differ = [f"{one}={spelt(value)}" for one, value in wanted.items() if value != own[one]]
        sky = [f"sky={self.sky_model}"] if self.sky_model else []
        if len(differ) > settings.count("=") + 1:  # it is nearer to a preset than to its own
            own_settings = settings.split(",") if settings else []
            text = ",".join([f"model={self.bank}", *own_settings, *sky])
            return find_method(f"{base}:{text}")
        text = ",".join([*differ, *sky])
        return find_method(f"{self.bank}:{text}" if text else str(self.bank))


MethodOptions: TypeAlias = Annotated[Methods, tyro.conf.arg(name="")]
"""`Methods` without a prefix of their own."""


def spelt_out(arguments: Sequence[str], masks: Container[str]) -> list[str]:
    """A command line in which each word stands where parsing takes it for what it is.

    ``--sky`` of a sky model is ``--sky-model``: where truths are read ``--sky`` says what is sky in
    masks, too. No value of a mask is called as sky models are, so both can be meant, and told
    apart. A photo or folder after the methods of ``--method`` goes before them.

    Args:
        arguments: The words after the program's name.
        masks: Commands that read truths.

    >>> spelt_out(["evaluate", "hills", "--sky", "0", "--sky=large"], masks={"evaluate"})
    ['evaluate', 'hills', '--sky', '0', '--sky-model=large']
    >>> spelt_out(["detect", "--method", "edges", "a.jpg"], masks={})
    ['detect', 'a.jpg', '--method', 'edges']
    """
    reads_masks = bool(arguments) and arguments[0] in masks
    words: list[str] = []
    moved: list[str] = []
    named_so_far = -1  # methods since --method; -1 after another option
    for at, word in enumerate(arguments):
        option, equals, value = word.partition("=")
        if word.startswith("--"):
            named_so_far = 0 if word == "--method" else -1
        elif named_so_far >= 0:
            named_so_far += 1
            if named_so_far > 1 and _is_photo(word):
                moved.append(word)
                continue
        named = value if equals else "".join(arguments[at + 1 : at + 2])
        if option == "--sky" and (not reads_masks or _SKY_MODEL.fullmatch(named)):
            words.append(f"--sky-model{equals}{value}")
        else:
            words.append(word)
    return words[:1] + moved + words[1:]


def _unlabelled(method: str) -> str:
    label, equals, rest = method.partition("=")
    return rest if equals and ":" not in label else method


def _is_photo(word: str) -> bool:
    """Whether a word is a photo or folder, and names no method."""
    path = Path(word)
    if word in NAMES or path.suffix.lower() in (".npz", ".onnx"):
        return False
    return path.suffix.lower() in PHOTO_SUFFIXES or path.exists()


def described(arguments: Sequence[str]) -> Methods:
    """What a command line says of our detector by short forms, looked up before it is parsed.

    It decides about the defaults of all single settings, which parsing has to know: those of an
    earlier run, of the preset, or those that a bank brings.

    Raises:
        UsageError: The file of the earlier run is of no use, or a preset is named beside it.

    >>> described(["detect", "a.jpg", "--preset", "paper", "--config.delta", "2"]).config.name
    'paper'
    """
    words = [word for argument in arguments for word in argument.split("=", 1)]
    options = [word for word in words if word.startswith("--")]
    refuse_gone(word.rpartition(".")[2].replace("-", "_") for word in options)
    presets = [after for word, after in pairwise(words) if word == "--preset"]
    banks = [after for word, after in pairwise(words) if word == "--bank"]
    short = ("--preset", "--bank", "--config", "--sky-model")
    ours = any(word.startswith(short) for word in words)
    config = DetectorConfig()
    if runs := [after for word, after in pairwise(words) if word == "--config"]:
        if is_address(runs[-1]):
            raise no_path(runs[-1], "config")
        if presets:
            raise UsageError("--config FILE and --preset both say where settings start; use one.")
        trains = words[0] == "train" or "--folds" in words
        known = earlier(runs[-1], with_bank=not banks and not trains)
        return Methods(bank=known.bank, sky_model=known.sky, config=known.config, ours=True)
    if presets:
        if presets[-1] in get_args(Preset):
            config = DetectorConfig.presets()[presets[-1]]
    elif banks:
        config = _brought(banks[-1])
    return Methods(config=config, ours=ours)


def trained_from(arguments: Sequence[str], methods: Methods) -> DetectorConfig:
    """Settings that training starts from, as a command line describes them before it is parsed.

    Those of a ``--method`` that is a detector of ours, or of the short forms.

    >>> words = ["train", "hills", "--method", "paper:delta=4"]
    >>> trained_from(words, described(words)).name
    'paper:delta=4'
    """
    named = [after for word, after in pairwise(arguments) if word == "--method"]
    named += [word.removeprefix("--method=") for word in arguments if word.startswith("--method=")]
    if not named or named[-1].partition(":")[0] not in DetectorConfig.presets():
        return methods.config
    from skyline_viz.detector import Detector
    from skyline_viz.methods.registry import find_method

    try:
        method = find_method(named[-1])
    except MethodError:  # told later
        return methods.config
    if isinstance(method, Detector) and method.config != DetectorConfig():
        return method.config
    return methods.config


def _brought(bank: str) -> DetectorConfig:
    """Settings that a bank brings; the default ones of what is none, which is told later."""
    from skyline_viz.detector import Detector
    from skyline_viz.filter_bank import FilterBankError

    try:
        return Detector.load(bank).config
    except FilterBankError:
        return DetectorConfig()
