"""Methods as files: of one format, whoever wrote them."""

import json
from dataclasses import dataclass, replace

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.datasets.item import LoadedItem
from skyline_viz.method import MethodError
from skyline_viz.methods.finding.method_files import (
    Trained,
    load_method,
    make_method,
    method_digest,
    save_method,
)
from skyline_viz.methods.registry import learned_from
from skyline_viz.methods.sky_network import SkyNetwork
from skyline_viz.rendering import render
from skyline_viz.system import headed_npz
from testing.methods import write_method


@pytest.mark.parametrize("name", ["default", "paper", "edges", "gradient"])
def test_every_kind_comes_back_from_one_format(name, tmp_path):
    method = make_method(name).labelled("mine")
    save_method(method, tmp_path / "m.npz", Trained("hills", 4))
    with np.load(tmp_path / "m.npz") as file:
        header = json.loads(file["header"].tobytes())
    assert (header["format"], header["version"]) == (headed_npz.FORMAT, headed_npz.VERSION)
    again = load_method(tmp_path / "m.npz")
    assert (again.name, again.settings()) == ("mine", method.settings())
    assert method_digest(again) == method_digest(method)
    assert load_method((tmp_path / "m.npz").read_bytes()).settings() == method.settings()


def test_a_label_makes_another_digest_and_so_do_settings():
    digests = {
        method_digest(sv.find_method(spec))
        for spec in ("edges", "edges:tog=9", "other=edges", "default", "paper", "x=paper")
    }
    assert len(digests) == 6


def test_a_network_of_an_earlier_file_is_known_again(tmp_path):
    network = tmp_path / "sky.onnx"
    network.write_bytes(b"content")
    made = SkyNetwork(network, sky_class=2)
    settings = {"network": str(network), "sky_class": 2, "mean": made.mean, "std": made.std}
    settings["columns"] = None
    # as it was made when methods had a format of their own
    digest = "1819afa532381b41b5a0d410a90806f95828929887b1c508ac4dfc80322bcbc0"
    path = write_method(tmp_path / "m.npz", "network", settings, digest=digest)
    assert load_method(path) == made
    network.write_bytes(b"another")
    with pytest.raises(MethodError, match="is another one than it was"):
        load_method(path)


@pytest.mark.parametrize(
    "changes",
    [{"settings": []}, {"method": 3}, {"label": 3}, {"method": "nobody"}, {"version": 1}],
    ids=repr,
)
def test_other_headers_are_one_sentence(changes, tmp_path):
    header = {"method": "edges", "label": "", "settings": {}}
    path = tmp_path / "m.npz"
    path.write_bytes(headed_npz.packed({**header, **changes}, {}))
    with pytest.raises(MethodError) as caught:
        load_method(path)
    assert str(caught.value).endswith(".")


@dataclass(frozen=True)
class Deeper(sv.DetectorConfig):
    depth: float = 0.5


@dataclass(frozen=True)
class Other(sv.DetectorConfig):
    depth: float = 0.5


@pytest.mark.parametrize(
    "write",
    [
        lambda detector, path: detector.save(path),
        save_method,
        lambda detector, path: detector.bank.save(path),
        lambda detector, path: sv.Detector(detector.bank).save(path),
    ],
    ids=["detector", "method", "bank that it learned", "detector with that bank"],
)
def test_settings_of_somebodys_class_are_in_no_file(write, tmp_path):
    scene = render("desert", 1, 80, 60)
    item = LoadedItem(scene.name, scene.photo, scene.truth)
    detector = sv.Detector(config=Deeper()).fit([item])
    with pytest.raises(ValueError, match=r"^settings of Deeper cannot be written to a file.*\.$"):
        write(detector, tmp_path / "d.npz")
    assert list(tmp_path.iterdir()) == []


def test_detectors_of_other_classes_of_settings_are_others(tmp_path):
    configs = [Deeper(), Deeper(depth=1), Other(), sv.DetectorConfig()]
    assert len({method_digest(sv.Detector(config=one)) for one in configs}) == 4


def test_numbers_of_any_library_come_back_from_a_file(tmp_path):
    sv.Detector(config=sv.DetectorConfig(v=np.float32(0.25))).save(tmp_path / "d.npz")
    assert load_method(tmp_path / "d.npz").settings()["v"] == 0.25
    edges = replace(make_method("edges"), tog=np.int64(9))
    save_method(edges, tmp_path / "m.npz", Trained("hills", np.int64(4), np.int64(1)))
    assert load_method(tmp_path / "m.npz").settings()["tog"] == 9


def test_where_a_method_learned_stays_with_it(tmp_path):
    first, second = tmp_path / "m.npz", tmp_path / "n.npz"
    save_method(make_method("edges"), first, Trained("hills", 4))
    known = load_method(first)
    assert (known.learned_from, known) == ("hills", make_method("edges"))
    save_method(known.with_settings({"tog": 9}), second)
    assert learned_from(str(second)) == learned_from(load_method(second)) == "hills"
    assert learned_from("edges") == learned_from(make_method("edges")) == ""
    assert learned_from("default") == sv.Detector().bank.provenance.dataset
