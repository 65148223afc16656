"""The options that choose methods: ours, the earlier ones, and networks from files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import tyro

from skyline_viz.command_line.messages import UsageError
from skyline_viz.config import DetectorConfig

if TYPE_CHECKING:
    from skyline_viz.method import Method

MethodTexts: TypeAlias = Annotated[tuple[str, ...], tyro.conf.arg(metavar="METHOD [METHOD ...]")]


@dataclass(frozen=True)
class Methods:
    """Which methods to use."""

    method: MethodTexts = ()
    """Methods by name (default, paper, edges, gradient, svm-dcsi, ...) or file of a trained one."""

    network: Annotated[Path | None, tyro.conf.arg(metavar="FILE.onnx")] = None
    """A network that segments the sky, as one more method."""

    sky_class: int = 0
    """Which class of the network is sky, from 0; 0 where it gives the sky alone."""

    @property
    def given(self) -> bool:
        """Whether any was named."""
        return bool(self.method or self.network)

    def chosen(
        self,
        *,
        bank: Path | None = None,
        config: DetectorConfig | None = None,
        to_train: bool = False,
    ) -> list[Method]:
        """The methods, in the order named.

        Args:
            bank: A filter bank that was named besides; it would be ignored, so it is refused.
            config: Settings of our detector; other ones than the default would be ignored, too.
            to_train: Whether those that learn are going to be trained.

        Raises:
            UsageError: One is named twice, what was given would be ignored, or a trained method
                is to be trained.
            MethodError: There is none of that name, its file is damaged, or it was not trained.
        """
        from skyline_viz.method import LearnedMethod  # noqa: PLC0415
        from skyline_viz.methods.registry import NAMES, find_method  # noqa: PLC0415

        if self.given and bank is not None:
            raise UsageError("leave out --bank: with --method, its file can be named as a method.")
        if self.given and config not in (None, DetectorConfig()):
            raise UsageError("leave out --preset and --config: a --method has settings of its own.")
        if to_train and (file := next((one for one in self.method if one not in NAMES), None)):
            raise UsageError(
                f"{file} has learned already, and would be trained anew; name a method."
            )
        found = [find_method(text) for text in self.method]
        if self.network is not None:
            from skyline_viz.methods.sky_network import SkyNetwork  # noqa: PLC0415

            network = SkyNetwork(self.network, self.sky_class)
            network.check()
            found.append(network)
        names = [one.name for one in found]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise UsageError(f"the method {twice[0]} is named twice.")
        for one in found:
            if isinstance(one, LearnedMethod) and not to_train:
                one.require_trained()
        return found

    def one(self, bank: Path | None, config: DetectorConfig, *, to_train: bool = False) -> Method:
        """The only method; takes what `chosen` takes.

        Raises:
            UsageError: There are several, or one of the reasons of `chosen`.
        """
        found = self.chosen(bank=bank, config=config, to_train=to_train)
        if len(found) != 1:
            raise UsageError(f"one method can be used here, and {len(found)} are named.")
        return found[0]


MethodOptions: TypeAlias = Annotated[Methods, tyro.conf.arg(name="")]
"""`Methods` without a prefix of their own."""
