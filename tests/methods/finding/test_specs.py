"""How methods are named: what is a label, a target and a setting, and which method that is."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skyline_viz as sv
from skyline_viz.method import MethodError
from skyline_viz.methods.finding.specs import Spec, parse
from skyline_viz.methods.names import HOMES, NAMES
from skyline_viz.methods.registry import learned_from, make_method
from skyline_viz.system.notes import heard_by
from testing.examples import examples
from testing.methods import configurations, write_bank, write_method

PAPER = sv.DetectorConfig.paper()


def none(_):
    return False


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("default", Spec("default", {})),
        ("paper:delta=4,link_weight=0.1", Spec("paper", {"delta": "4", "link_weight": "0.1"})),
        ("steep=paper:delta=4", Spec("paper", {"delta": "4"}, "steep")),
        ("b.npz:delta=8", Spec("b.npz", {"delta": "8"})),
        ("mine=my_pkg.mod:Mine", Spec("my_pkg.mod:Mine", {}, "mine")),
        ("my_pkg.mod:Mine:size=3", Spec("my_pkg.mod:Mine", {"size": "3"})),
        ("paper:model=a, b.npz,v=1", Spec("paper", {"model": "a, b.npz", "v": "1"})),
        ("Zwei Wörter=edges", Spec("edges", {}, "Zwei Wörter")),
        ("folder/a=b.npz", Spec("folder/a=b.npz", {})),
        ("fcn-8s:pretrained=/data/x=1:2.pth", Spec("fcn-8s", {"pretrained": "/data/x=1:2.pth"})),
    ],
)
def test_a_spec_is_taken_apart(text, wanted):
    assert parse(text, none) == wanted


def test_a_file_that_is_there_wins():
    odd = "a=b:delta=1,v=2.npz"
    assert parse(odd, lambda text: text == odd) == Spec(odd, {}, is_file=True)
    assert parse(f"{odd}:delta=4", lambda text: text == odd) == Spec(
        odd, {"delta": "4"}, is_file=True
    )
    assert parse(f"mine={odd}:delta=4", lambda text: text == odd) == Spec(
        odd, {"delta": "4"}, "mine", is_file=True
    )


@examples(200)
@given(
    st.text(st.sampled_from("ab.:=,/ "), min_size=1, max_size=12),
    st.dictionaries(st.sampled_from(["delta", "v", "x1"]), st.text("019.", max_size=3), max_size=3),
)
def test_any_name_of_a_file_can_be_used(name, changed):
    said = ",".join(f"{one}={value}" for one, value in changed.items())
    text = f"{name}:{said}" if changed else name
    assert parse(text, lambda part: part == name) == Spec(name, changed, is_file=True)


def test_a_setting_is_not_given_twice():
    with pytest.raises(MethodError, match="paper:v=1,v=2 sets v twice"):
        sv.find_method("paper:v=1,v=2")


@examples(40)
@given(configurations)
def test_the_name_of_a_detector_finds_it(config):
    name = sv.Detector(sv.FilterBank.default(), config).name
    found = sv.find_method(name)
    assert (found.config, found.name) == (config, name)


@pytest.mark.parametrize("name", NAMES)
def test_names_find_what_is_at_home_there(name):
    method = sv.find_method(name)
    kind = next(one for one in type(method).__mro__ if one.__module__ != "builtins")
    assert HOMES[name] == f"{kind.__module__}:{kind.__qualname__}"
    assert (method.name, method.own_name()) == (name, name)


def test_settings_of_earlier_methods():
    edges = sv.find_method("edges:delta=12,gap_cost=50")
    assert (edges.delta, edges.gap_cost, edges.name) == (12, 50.0, "edges:delta=12,gap_cost=50")
    svm = sv.find_method("svm-mdcsi:best=20,link_weight=0.5")
    assert (svm.fusion, svm.best) == ("best", 20)
    assert svm.name == "svm-mdcsi:link_weight=0.5,best=20"
    assert sv.find_method("svm-dcsi:fusion=best").name == "svm-mdcsi"
    net = sv.find_method("fcn-8s:width=1,pretrained=vgg.pth")
    assert (net.width, net.pretrained) == (1.0, Path("vgg.pth"))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("papr", r"papr is neither a method nor the file of a trained one; did you mean paper\?"),
        ("zzz", "methods are default, paper, edges"),
        ("paper:detla=4", r"paper has no setting detla; did you mean delta\?"),
        ("paper:delta=x", "delta is a whole number from 0 to 100000, not 'x'"),
        ("paper:v=2", "v is a number from 0 to 1, not 2"),
        ("paper:edge_source=red", "edge_source is 'grey' or 'colour', not 'red'"),
        ("edges:delta=-1", "delta is a whole number from 0 to 1,000,000, not -1"),
        ("svm-mdcsi:best=0", "best is a whole number from 1 to 1,000,000, not 0"),
        ("svm-dcsi:fusion=all", "fusion is one of none, best, gradient, msee, canny, not 'all'"),
        ("edges:tog", "edges:tog gives no value: settings are NAME=VALUE, as in edges:tog=1"),
        ("gone.npz:delta=4", "gone.npz does not exist"),
        ("paper:model=gone.npz", "gone.npz does not exist"),
        ("edges:model=gone.npz", "gone.npz does not exist"),
        ("no_such_module:Mine", "there is no module no_such_module, neither in"),
        ("skyline_viz.photo:Mine", "skyline_viz.photo has no class Mine"),
        ("", " is neither a method nor the file"),
        ("x" * 5000, "is neither a method"),
        ("a\0b", "is neither a method"),
    ],
)
def test_what_cannot_be_is_one_sentence(text, says):
    with pytest.raises(MethodError, match=says) as caught:
        sv.find_method(text)
    assert "\n" not in str(caught.value)
    assert str(caught.value).endswith((".", "?"))


def test_a_file_brings_settings_and_is_called_after_itself(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    sv.Detector(config=PAPER).save("b.npz")
    assert (sv.find_method("b.npz").config, sv.find_method("b.npz").name) == (PAPER, "b.npz")
    steep = sv.find_method("b.npz:delta=4,v=0.5")
    assert (steep.config.delta, steep.name) == (4, "b.npz:delta=4")
    assert sv.find_method("steep=b.npz:delta=4").name == "steep"
    sv.Detector(label="hills").save("labelled.npz")
    assert sv.find_method(f"{tmp_path}/labelled.npz").name == "hills"
    assert sv.find_method("labelled.npz:delta=9").name == "hills:delta=9"
    assert sv.find_method("default:model=b.npz").config == sv.DetectorConfig()
    assert sv.find_method("default:model=b.npz").name == "default:model=b.npz"
    Path("b.npz").rename("paper:v=1,delta=2.npz")
    assert sv.find_method("paper:v=1,delta=2.npz").config == PAPER
    assert sv.find_method("x=paper:v=1,delta=2.npz:delta=7").config.delta == 7


def test_what_an_earlier_bank_does_not_know_is_said(tmp_path):
    bank = sv.FilterBank.default()
    made = sv.FilterBank(bank.filters, bank.samples, bank.bins, type(bank.provenance)(edges="grey"))
    path, heard = write_bank(made, tmp_path / "old.npz"), []
    with heard_by(heard.append):
        found = sv.find_method(str(path))
    assert found.config == sv.DetectorConfig(edge_source="grey")
    assert len(heard) == 1
    assert "only that edges were grey; default:edge_source=grey is taken" in heard[0]
    with heard_by(heard.append):
        sv.find_method(f"paper:model={path}")
        sv.find_method(str(write_bank(bank, tmp_path / "colour.npz")))
    assert len(heard) == 1


def test_earlier_method_files_are_read(tmp_path):
    path = write_method(tmp_path / "edges.npz", "edges", {**make_method("edges").settings()})
    assert sv.find_method(str(path)).labelled("") == make_method("edges")
    assert learned_from(str(path)) == "hills"
    keys = ("delta", "link_weight", "best", "ruled_out", "w2", "w3")
    every = make_method("svm-mdcsi").settings()
    model = {
        "weights": np.zeros((16, 16), "f4"),
        "bias": np.zeros(1),
        "logistic": np.ones(2),
    }
    path = write_method(
        tmp_path / "svm.npz", "svm-mdcsi", {**{key: every[key] for key in keys}, "best": 7}, model
    )
    svm = sv.find_method(str(path))
    assert (svm.fusion, svm.best, svm.name) == ("best", 7, "svm.npz")
    shared = sv.find_method(f"svm-dcsi-canny:model={path}")
    assert shared.fusion == "canny"
    assert shared.name == "svm-dcsi-canny:model=svm.npz"
    with pytest.raises(MethodError, match="holds svm-mdcsi:best=7, and not what cnn-dcsi learns"):
        sv.find_method(f"cnn-dcsi:model={path}")


def test_a_network_is_called_after_its_file(tmp_path):
    (tmp_path / "sky.onnx").write_bytes(b"network")
    assert sv.find_method(str(tmp_path / "sky.onnx")).name == "sky.onnx"
    method = sv.find_method(f"{tmp_path / 'sky.onnx'}:sky_class=2")
    assert (method.sky_class, method.name) == (2, "sky.onnx:sky_class=2")
    with pytest.raises(MethodError, match="sky_class is a whole number from 0 to 1,000,000"):
        sv.find_method(f"{tmp_path / 'sky.onnx'}:sky_class=-2")
