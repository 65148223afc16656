"""What can be chosen, with units and the reasons for the defaults. Light to import."""

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from functools import cache
from typing import Any, Literal, Self, TypeAlias, get_type_hints

from skyline_viz.bins import Bins
from skyline_viz.system.notes import note
from skyline_viz.system.settings import (
    SettingError,
    check_number,
    nearest_name,
    plain_number,
    spelt,
)

EdgeSource: TypeAlias = Literal["grey", "colour"]
"""What Canny sees: the grey photo, as published, or the colour photo."""

GONE = {"terrain_weight": "the sky model does its work, with the weight sky_weight"}
"""Settings of earlier versions, and what became of them."""

FILTER_SIZES = (3, 5, 7, 9, 11, 13, 15)
"""Filter sizes that can be trained and applied, in pixels a side."""


@dataclass(frozen=True)
class DetectorConfig:
    """How a photo becomes a skyline; ``docs/method.md`` says how the defaults were chosen."""

    edge_source: EdgeSource = "colour"
    """What Canny sees: the colour photo, or the grey one as published."""

    low_threshold: float = 50.0
    """Lower Canny threshold, on the L1 Sobel gradient of 8-bit values."""

    high_threshold: float = 220.0
    """Upper Canny threshold, same unit."""

    fit_thresholds: bool = True
    """Whether the thresholds are lowered for soft and hazy photos, see `fitted_thresholds`."""

    frame: int = 4
    """Widest border around a picture that may hold anything, in pixels; bars of one colour have any
    width. 0 looks for no frame."""

    v: float = 0.5
    """Weight of the score against the gradient strength, in [0, 1] (the paper's ``v``)."""

    strength_percentile: float = 95.0
    """Percentile of a photo's gradient strengths that counts as full strength, in [1, 100]."""

    non_edge_cost: float = 2.0
    """Nodal cost of a pixel without an edge; edge pixels cost 0 to 1."""

    clear_sky: float = 0.03
    """Cost that each edge pixel above a pixel adds to it; 0 switches the term off."""

    sky_weight: float = 5.0
    """Cost of a line by which the whole height of a photo would be what the sky model finds
    improbable, above and below it; 0 switches the model off."""

    sky_cap: float = 1.0
    """Cost that the sky model adds to a pixel at the most. An edge pixel pays up to 1 for score
    and strength, and one without an edge 2: with a limit of 1 the model decides between edges, and
    never outbids the only one there is."""

    sky_edges: float = 0.4
    """Factor of the Canny thresholds where the sky model has a sure boundary and no edge lies near
    it, see `edges.seek`; 1 seeks no edges there."""

    delta: int = 4
    """Largest change of row between neighbouring columns, in pixels."""

    link_weight: float = 0.1
    """Link cost of one pixel of row change."""

    def __new__(cls, *_: object, **settings: object) -> Self:
        """Refuse settings that are gone with a sentence that says what became of them."""
        refuse_gone(settings.keys() - {one.name for one in fields(cls)})
        return super().__new__(cls)

    def __post_init__(self) -> None:
        """Refuse values outside their range with a sentence that names the field."""
        for name, (low, high) in RANGES.items():
            check_number(name, getattr(self, name), low, high, whole=name in _WHOLE)
        for one in fields(self):  # also those of a class that adds some
            real = one.name in RANGES and one.name not in _WHOLE
            object.__setattr__(self, one.name, plain_number(getattr(self, one.name), real=real))
        if not isinstance(self.fit_thresholds, bool):
            raise ValueError(f"fit_thresholds is True or False, not {self.fit_thresholds!r}")
        if self.edge_source not in ("grey", "colour"):
            raise ValueError(f"edge_source is 'grey' or 'colour', not {self.edge_source!r}")
        if self.low_threshold > self.high_threshold:
            raise ValueError("low_threshold is at most high_threshold")

    def changed(self) -> list[str]:
        """Settings that differ from the defaults, in words.

        Examples:
            >>> DetectorConfig(delta=1).changed()
            ['delta 1']
        """
        default = asdict(DetectorConfig())
        return [
            f"{name} {value if isinstance(value, bool) else spelt(value)}"
            for name, value in asdict(self).items()
            if value != default.get(name)
        ]

    @classmethod
    def paper(cls) -> "DetectorConfig":
        """Return the published method: grey edges, fixed thresholds, none of our terms.

        The paper's infinite cost of non-edge pixels is a finite one here. It leaves ``delta`` and
        the scale of the link cost open: they are 1 and 0, with which its figures are reached.
        """
        return cls(
            edge_source="grey",
            fit_thresholds=False,
            frame=0,
            strength_percentile=100.0,
            non_edge_cost=3.0,
            clear_sky=0.0,
            sky_weight=0.0,
            sky_edges=1.0,
            delta=1,
            link_weight=0.0,
        )

    @classmethod
    def presets(cls) -> dict[str, "DetectorConfig"]:
        """Configurations that have a name."""
        return {"default": cls(), "paper": cls.paper()}

    @classmethod
    def from_file(cls, told: Mapping[str, Any], of: str = "") -> Self:
        """The settings that a file tells, also one of an earlier version: without those gone.

        Args:
            told: The settings by name.
            of: What has them, in a note on each that is gone and was not 0; empty for none.

        Raises:
            TypeError: There is another setting among them.
            ValueError: One has a value that it refuses.

        Examples:
            >>> DetectorConfig.from_file({"delta": 1, "terrain_weight": 4.0}).name
            'default:delta=1'
        """
        config = cls(**{name: value for name, value in told.items() if name not in GONE})
        for name, instead in GONE.items():
            value = told.get(name, 0)
            if of and isinstance(value, int | float) and value:
                note(f"{of} was made with {name} {value:g}, which is gone: {instead}.")
        return config

    @property
    def name(self) -> str:
        """The nearest preset, and the settings that differ from it.

        Settings that a class of somebody's adds always stand in it; one that adds none is called
        after itself.

        Examples:
            >>> DetectorConfig(delta=10, v=0.9).name
            'default:v=0.9,delta=10'
        """
        presets = _settings_of_presets()
        settings = {one.name: getattr(self, one.name) for one in fields(self)}
        if type(self) is not DetectorConfig and settings.keys() == presets["default"].keys():
            presets = {type(self).__name__: presets["default"]}
        return nearest_name(settings, presets)

    def described(self) -> dict[str, object]:
        """All settings by name, for files and digests; of a class of somebody's also its place."""
        kind = type(self)
        ours = kind is DetectorConfig
        return asdict(self) | ({} if ours else {"class": f"{kind.__module__}:{kind.__qualname__}"})

    def require_ours(self) -> None:
        """Refuse to be written to a file, which knows our settings only.

        Raises:
            SettingError: They are of a class of somebody's.
        """
        if type(self) is not DetectorConfig:
            raise SettingError(
                f"settings of {type(self).__name__} cannot be written to a file, which can hold "
                f"only those of DetectorConfig."
            )

    @classmethod
    def kinds(cls) -> dict[str, object]:
        """Type of each setting."""
        return get_type_hints(cls)

    def with_settings(self, values: Mapping[str, object]) -> "DetectorConfig":
        """The same with other settings.

        Raises:
            ValueError: One has a value that it refuses.
        """
        changes: dict[str, Any] = dict(values)
        return replace(self, **changes)


@cache
def _settings_of_presets() -> dict[str, dict[str, Any]]:
    """Settings of the presets by name, to be read only: every detection is called after one."""
    return {name: asdict(preset) for name, preset in DetectorConfig.presets().items()}


def refuse_gone(names: Iterable[str]) -> None:
    """Refuse names of settings that are gone.

    Raises:
        SettingError: The message says what became of one.
    """
    for name in names:
        if name in GONE:
            raise SettingError(f"{name} is gone: {GONE[name]}")


_WHOLE = ("frame", "delta")  # numbers of pixels

RANGES: dict[str, tuple[float, float]] = {
    "low_threshold": (0, 1e5),
    "high_threshold": (0, 1e5),
    "frame": (0, 1e4),
    "v": (0, 1),
    "strength_percentile": (1, 100),
    "non_edge_cost": (0, 1e6),
    "clear_sky": (0, 1e3),
    "sky_weight": (0, 1e3),
    "sky_cap": (0, 1e6),
    "sky_edges": (0, 1),
    "delta": (0, 1e5),
    "link_weight": (0, 1e6),
}
"""Smallest and largest value of each number of `DetectorConfig`."""


@dataclass(frozen=True)
class TrainingConfig:
    """How samples are drawn and filters are solved."""

    bins: Bins = field(default_factory=Bins)
    """How strength, coherence and orientation are quantised."""

    filter_size: int = 7
    """Pixels a side of a filter: 3, 5, 7, 9, 11, 13 or 15."""

    band: float = 10.0
    """Negatives are drawn from edges more than this many rows off the truth."""

    smoothness: float = 1e5
    """Weight of ``Q``, which draws neighbouring taps together; in squared grey levels."""

    detector: DetectorConfig = field(default_factory=DetectorConfig)
    """Whose edges are used, so that training sees what detection will see."""

    reach: int = 3
    """Positives are the edges nearest to the truth, at most this many rows off it; 0 takes the
    pixels of the truth itself, edges or not, as published."""

    pooling: float = 1000.0
    """Samples for which all bins of its orientation together count in each bin; 0 leaves each bin
    alone with its own, as published."""

    def __post_init__(self) -> None:
        """Refuse values outside their range with a sentence that names the field."""
        check_number("filter_size", self.filter_size, 3, 15, whole=True)
        if self.filter_size not in FILTER_SIZES:
            raise ValueError(f"filter_size is one of {FILTER_SIZES}, not {self.filter_size}")
        check_number("band", self.band, 0, 1e6)
        check_number("reach", self.reach, 0, 100, whole=True)
        check_number("smoothness", self.smoothness, 0, 1e12)
        check_number("pooling", self.pooling, 0, 1e12)
        for name in ("filter_size", "reach"):
            object.__setattr__(self, name, int(getattr(self, name)))
        for name in ("band", "smoothness", "pooling"):
            object.__setattr__(self, name, float(getattr(self, name)))

    @classmethod
    def of(cls, detector: DetectorConfig) -> "TrainingConfig":
        """How a detector learns: as published where it sees the grey photo, as published.

        The weight of ``Q`` and the pooling of the published method are ours, as the paper leaves
        both open. They reach its figures on the Web photographs.

        Examples:
            >>> TrainingConfig.of(DetectorConfig.paper()).reach
            0
        """
        if detector.edge_source == "grey":
            return cls(reach=0, smoothness=100.0, pooling=50.0, detector=detector)
        return cls(detector=detector)
