"""Other settings that may mend a photo: each setting of our detector, up and down."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields, replace
from functools import cache, lru_cache
from itertools import combinations
from typing import Any

from skyline_viz.config import DetectorConfig
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.sweep import most_of

PAIRED = 4
"""So many of the settings that helped most alone are tried in pairs."""


def settings_to_try(found: Detection) -> dict[str, DetectorConfig]:
    """Other settings that may help, by what they are in words.

    Edges that are found otherwise, steeper lines, another weight of every term of the cost, and the
    presets. Those that are the same for all photos come with their flags.

    Args:
        found: The detection, with the settings as they are; one of a method that has other
            settings than ours gets none to try.
    """
    config = found.config
    if config is None or found.thresholds is None:
        return {}
    tried = {
        words: replace(config, **changes) for words, changes in _of_thresholds(found.thresholds)
    }
    weighed = tuple(
        (setting, next(one.name for one in found.cost_model.terms if one.setting == setting))
        for setting in found.cost_model.settings
    )
    return _named(config, tried) | _of_all_photos(config, weighed)


@lru_cache(maxsize=8)
def _of_all_photos(
    config: DetectorConfig, weighed: tuple[tuple[str, str], ...]
) -> dict[str, DetectorConfig]:
    """Settings that do not depend on the photo, made once; see `settings_to_try`.

    Args:
        config: The settings as they are.
        weighed: Settings that weigh a term of the cost, each with the name of a term.
    """
    tried = {
        words: replace(config, **changes)
        for words, changes in (*_of_edges(config), *_of_the_cost(config, weighed))
    }
    presets = {
        f"all settings of {name} (--preset {name})": preset
        for name, preset in _presets().items()
        if preset not in (config, *tried.values()) and type(config) is DetectorConfig
    }
    return _named(config, tried) | presets


def _named(
    config: DetectorConfig, tried: Mapping[str, DetectorConfig]
) -> dict[str, DetectorConfig]:
    """Settings that differ, with their flags if they are the same for all photos."""
    return {
        words if _of_one_photo(config, changed) else f"{words} ({flags(config, changed)})": changed
        for words, changed in tried.items()
        if changed != config
    }


def pairs_to_try(
    config: DetectorConfig, single: Mapping[str, DetectorConfig], changes: Mapping[str, float]
) -> dict[str, DetectorConfig]:
    """Two settings at once, by what they are in words: pairs of those that helped most alone.

    Args:
        config: The settings as they are.
        single: Those of `settings_to_try`.
        changes: Change of A_err by each alone that was tried, in pixels.
    """
    helped = sorted(
        (one for one in single if changes.get(one, 0.0) < 0), key=lambda one: changes[one]
    )
    pairs: dict[str, DetectorConfig] = {}
    for one, other in combinations(helped[:PAIRED], 2):
        first, second = _differing(config, single[one]), _differing(config, single[other])
        if not first.keys() & second.keys():
            pairs[f"{one} and {other}"] = replace(config, **first, **second)
    return pairs


@lru_cache(maxsize=256)
def flags(config: DetectorConfig, changed: DetectorConfig) -> str:
    """The flags that make other settings of some, to be added to a command line.

    Examples:
        >>> flags(DetectorConfig(), DetectorConfig(delta=8, fit_thresholds=False))
        '--config.no-fit-thresholds --config.delta 8'
    """
    for name, preset in _presets().items():
        if changed == preset:
            return f"--preset {name}"
    return " ".join(_flag(name, value) for name, value in _differing(config, changed).items())


@cache
def _presets() -> Mapping[str, DetectorConfig]:
    """The presets, made once: every setting that is tried is compared with them."""
    return DetectorConfig.presets()


def _differing(config: DetectorConfig, changed: DetectorConfig) -> dict[str, Any]:
    """The fields of other settings that differ from some."""
    return {
        one.name: getattr(changed, one.name)
        for one in fields(config)
        if getattr(config, one.name) != getattr(changed, one.name)
    }


def _flag(name: str, value: float | str) -> str:
    spelt = name.replace("_", "-")
    if isinstance(value, bool):
        return f"--config.{spelt}" if value else f"--config.no-{spelt}"
    return f"--config.{spelt} {value if isinstance(value, str) else f'{value:g}'}"


def _of_one_photo(config: DetectorConfig, changed: DetectorConfig) -> bool:
    """Whether thresholds were fitted to a photo, and are other ones now: its own."""
    own = config.low_threshold, config.high_threshold
    return config.fit_thresholds and (changed.low_threshold, changed.high_threshold) != own


def _of_thresholds(thresholds: tuple[float, float]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Other Canny thresholds than those of a photo, by what they are in words."""
    most = most_of("low_threshold")
    for words, factor in (("half", 0.5), ("twice", 2.0)):
        low, high = (min(factor * one, most) for one in thresholds)
        fixed = {"fit_thresholds": False, "low_threshold": low, "high_threshold": high}
        yield f"{words} the Canny thresholds", fixed


def _of_edges(config: DetectorConfig) -> Iterator[tuple[str, dict[str, Any]]]:
    """Settings of the edges, by what they are in words."""
    fitted = "not fitted" if config.fit_thresholds else "fitted"
    yield f"Canny thresholds {fitted} to each photo", {"fit_thresholds": not config.fit_thresholds}
    other = "colour" if config.edge_source == "grey" else "grey"
    yield f"edges of the {other} photo", {"edge_source": other}
    frame = 0 if config.frame else type(config)().frame
    yield "edges inside a frame" if frame else "edges of a frame, too", {"frame": frame}
    if config.sky_weight:
        yield from _more_or_less(config, "sky_edges", 0.3)


def _of_the_cost(
    config: DetectorConfig, weighed: tuple[tuple[str, str], ...]
) -> Iterator[tuple[str, dict[str, Any]]]:
    """Settings of cost and path, by what they are in words; see `_of_all_photos`."""
    yield "half the delta", {"delta": config.delta // 2}
    yield "twice the delta", {"delta": min(2 * config.delta, int(most_of("delta")))}
    percentile = config.strength_percentile
    yield "full strength for fewer edges", {"strength_percentile": min(percentile + 4, 100.0)}
    yield "full strength for more edges", {"strength_percentile": max(percentile - 20, 1.0)}
    if config.sky_weight:
        yield "half the limit of sky", {"sky_cap": config.sky_cap / 2}
        yield "twice the limit of sky", {"sky_cap": min(2 * config.sky_cap, most_of("sky_cap"))}
    for setting, term in weighed:
        yield from _other_weights(config, setting, term)


def _other_weights(
    config: DetectorConfig, setting: str, term: str
) -> Iterator[tuple[str, dict[str, Any]]]:
    """Values to try of the setting that weighs a term, and what they are in words."""
    present, most = getattr(config, setting), most_of(setting)
    if most <= 1:
        yield from _more_or_less(config, setting, 0.25)
        return
    weight = "link weight" if term == "link" else f"cost of {term}"
    if not present:
        usual = getattr(type(config)(), setting)
        yield f"the {weight} at {usual:g}", {setting: usual}
        return
    yield f"no {weight}", {setting: 0.0}
    yield f"half the {weight}", {setting: present / 2}
    yield f"twice the {weight}", {setting: min(2 * present, most)}
    yield f"4 times the {weight}", {setting: min(4 * present, most)}


def _more_or_less(
    config: DetectorConfig, setting: str, by: float
) -> Iterator[tuple[str, dict[str, Any]]]:
    """A setting between 0 and 1, less and more by something."""
    present = getattr(config, setting)
    yield f"{setting} less by {by:g}", {setting: max(present - by, 0.0)}
    yield f"{setting} more by {by:g}", {setting: min(present + by, 1.0)}
