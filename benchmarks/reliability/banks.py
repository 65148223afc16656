"""Filter banks, methods and networks: damaged with the right checksums, and used all the same."""

from __future__ import annotations

import random
import tempfile
import tracemalloc
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

import skyline_viz as sv
from benchmarks.reliability import Trial
from skyline_viz.method import Method, MethodError
from skyline_viz.methods.descriptors import LENGTH
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.methods.registry import Trained, load_method, make_method, save_method
from skyline_viz.methods.score_images import PATCH
from skyline_viz.methods.sky_network import SkyNetwork
from skyline_viz.rendering import render
from testing.harm import Mutations, harmed, small_network

_BANKS, _METHODS, _NETWORKS = 2000, 700, 120
_PHOTO = render("desert", 50, 60, 48).photo


def measured() -> list[Trial]:
    """Mutate, read, and use what can be read."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        bank, *methods = _files(place)
        trials = [_trial("a damaged filter bank", [bank], _BANKS, _bank, place)]
        sv.find_method("steep=paper:delta=4").save(place / "detector.npz")
        detector = [place / "detector.npz"]
        trials.append(_trial("a damaged detector", detector, _BANKS, sv.Detector.load, place))
        trials.append(_trial("a damaged method file", methods, _METHODS, load_method, place))
        trials.append(_networks(place))
    return trials


def _files(folder: Path) -> list[Path]:
    """A bank, and a method of each kind that learns without a network, and one that does not."""
    sv.FilterBank.default().save(folder / "bank.npz")
    save_method(EdgesOnly(), folder / "edges.npz", Trained("hills", 4))
    bias = {"bias": np.zeros(1)}
    dense = {**bias, "weights": np.zeros((PATCH, PATCH), np.float32), "logistic": np.ones(2)}
    models = {
        "sift-hog-edges": {**bias, "weights": np.zeros(LENGTH, np.float32)},
        "svm-dcsi": dense,
        "svm-mdcsi": dense,
    }
    for name, model in models.items():
        method = make_method(name)
        save_method(replace(method, model=model), folder / f"{name}.npz", Trained())  # type: ignore[type-var]
    return [folder / f"{name}.npz" for name in ("bank", "edges", *models)]


def _bank(path: Path) -> Method:
    return sv.Detector(sv.FilterBank.load(path))


def _trial(
    fault: str, files: list[Path], times: int, read: Callable[[Path], Method], folder: Path
) -> Trial:
    mutations = [Mutations(file, seed) for seed, file in enumerate(files)]
    path, peak = folder / "mutant.npz", 0
    found: Counter[str] = Counter()
    tracemalloc.start()
    for number in range(times):
        path.write_bytes(mutations[number % len(mutations)].next())
        tracemalloc.reset_peak()
        found[_outcome(read, path)] += 1
        peak = max(peak, tracemalloc.get_traced_memory()[1])
    tracemalloc.stop()
    tried = (
        f"bytes of {len(files)} {'file' if len(files) == 1 else 'kinds of file'} changed, four of "
        f"five with right checksums: {found['refused']:,} refused with a sentence, "
        f"{found['ran']:,} read and run"
    )
    return Trial(fault, tried, times, _lost(found, f"at most {peak / 1e6:.0f} MB at a time"))


def _outcome(read: Callable[[Path], Method], path: Path) -> str:
    """What becomes of a file: refused, ran, or the name of what should not have been."""
    try:
        read(path).detect(_PHOTO)
    except (sv.FilterBankError, MethodError) as error:
        said = str(error)
        named = path.name in said or type(error) is MethodError
        return "refused" if named and "\n" not in said else f"a bad sentence, {said[:40]}"
    except Exception as error:
        return type(error).__name__
    return "ran"


def _networks(folder: Path) -> Trial:
    draw, plain, found = random.Random(3), small_network(), Counter[str]()
    for number in range(_NETWORKS):
        path = folder / f"{number}.onnx"
        path.write_bytes(harmed(plain, draw))
        found[_outcome(SkyNetwork, path)] += 1
    tried = (
        f"bytes of an ONNX file changed: {found['refused']:,} refused with a sentence, "
        f"{found['ran']:,} read and run; each first in a process of its own"
    )
    return Trial("a damaged network", tried, _NETWORKS, _lost(found, "no crash of the program"))


def _lost(found: Counter[str], besides: str) -> str:
    bad = {name: count for name, count in found.items() if name not in ("refused", "ran")}
    said = ", ".join(f"{count} times {name}" for name, count in bad.items())
    return f"{said or 'nothing'}; {besides}"
