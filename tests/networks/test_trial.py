"""A network is tried in a process of its own: whatever that dies of is one sentence."""

import pickle
import random

import numpy as np
import pytest

from skyline_viz.method import MethodError
from skyline_viz.methods.sky_network import SkyNetwork
from skyline_viz.networks import trial
from skyline_viz.networks.onnx_files import HoldsNetwork, Network, read_network
from testing.deep import needs_deep
from testing.harm import harmed, small_network

pytestmark = needs_deep

DEATHS = {
    "os.kill(os.getpid(), signal.SIGSEGV)": "is damaged: opening it crashes OpenCV",
    "os.abort()": "is damaged: opening it crashes OpenCV",
    "os._exit(3)": "wants more than 4 GB of memory",
    "os.kill(os.getpid(), signal.SIGKILL)": "wants more than 4 GB of memory",
    "os.kill(os.getpid(), signal.SIGXCPU)": "does not come to an end",
}


@pytest.fixture
def fresh(monkeypatch):
    """Nothing has been tried yet."""
    monkeypatch.setattr(trial, "_survived", set())


@pytest.mark.parametrize("death", DEATHS)
def test_what_the_child_dies_of_is_one_sentence(death, fresh, tmp_path, monkeypatch):
    child = tmp_path / "child.py"
    child.write_text(f"import os, signal, sys\nsys.stdin.buffer.read()\n{death}\n")
    monkeypatch.setattr(trial, "_CHILD", child)
    with pytest.raises(MethodError, match=DEATHS[death]) as caught:
        Network(small_network(), "sky.onnx")
    assert str(caught.value).startswith("sky.onnx ")


def test_one_that_waits_for_ever_is_stopped(fresh, tmp_path, monkeypatch):
    child = tmp_path / "child.py"
    child.write_text("import sys, threading\nsys.stdin.buffer.read()\nthreading.Event().wait()\n")
    monkeypatch.setattr(trial, "_CHILD", child)
    monkeypatch.setattr(trial, "_WALL_SECONDS", 0.5)
    with pytest.raises(MethodError, match="does not come to an end"):
        Network(small_network(), "sky.onnx")


def test_the_real_child_stops_what_takes_all_memory(fresh, monkeypatch):
    monkeypatch.setattr(trial, "_MEMORY", 600 << 20)
    with pytest.raises(MethodError, match=r"wants more than 0 GB|crashes OpenCV"):
        trial.try_network(small_network(), (1, 3, 20_000, 20_000), "sky.onnx")


def test_a_network_is_tried_once_and_workers_know(fresh, tmp_path, monkeypatch):
    file = tmp_path / "sky.onnx"
    file.write_bytes(small_network())
    method = SkyNetwork(file)
    method.check()
    assert len(trial._survived) == 1
    sent = pickle.dumps(method)
    trial._survived.clear()
    again = pickle.loads(sent)
    monkeypatch.setattr(trial, "started", None)  # it would fail
    again.check()
    assert again == method
    assert issubclass(SkyNetwork, HoldsNetwork)


def test_files_that_no_network_is_are_refused_unread(tmp_path, monkeypatch):
    with pytest.raises(MethodError, match="it is no file"):
        read_network(tmp_path)
    large = tmp_path / "large.onnx"
    with large.open("wb") as file:
        file.truncate((1 << 31) + 1)
    with pytest.raises(MethodError, match="2,147,483,649 bytes, and"):
        read_network(large)


def test_a_photo_without_end_is_refused():
    wide = small_network().replace(b"\x12\x01h", b"\x12\x01k")  # names of free sides do not matter
    assert Network(wide, "sky.onnx").header.inputs
    from onnx import TensorProto, helper, load_from_string  # noqa: PLC0415

    model = load_from_string(small_network())
    shape = [1, 3, 10**6, 10**6]
    vast = helper.make_tensor_value_info("photo", TensorProto.FLOAT, shape)
    model.graph.input[0].CopyFrom(vast)
    with pytest.raises(MethodError, match="more than any photo"):
        Network(model.SerializeToString(), "sky.onnx")


def test_mutants_run_or_are_sentences(tmp_path):
    draw, plain = random.Random(2), small_network()
    photo = np.full((40, 60, 3), 200, np.uint8)
    photo[20:] = 10
    ran = 0
    for number in range(25):
        file = tmp_path / f"{number}.onnx"
        file.write_bytes(harmed(plain, draw))
        try:
            SkyNetwork(file).detect(photo)
        except MethodError as error:
            assert str(error).startswith(str(file))
            assert str(error).count("\n") == 0
        else:
            ran += 1
    assert ran < 25
