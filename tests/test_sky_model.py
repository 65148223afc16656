"""The sky model: what its network sees and gives, which ones are refused, and which are trusted."""

import pickle
from concurrent.futures import ThreadPoolExecutor

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz import sky_model
from skyline_viz.arrays import U8
from skyline_viz.config import DetectorConfig
from skyline_viz.detector import Detector
from skyline_viz.filter_bank import FilterBankError
from skyline_viz.methods.registry import find_method, method_digest
from skyline_viz.networks import trial
from skyline_viz.sky_model import SkyModel, reduced
from skyline_viz.system import headed_npz
from skyline_viz.system.settings import MethodError
from testing.examples import examples
from testing.networks import bright_model, bright_sky

STEADY = examples(25)


def half_bright(height=60, width=80) -> U8:
    """White over black, with a grey strip of eight rows between them."""
    photo = np.zeros((height, width, 3), np.uint8)
    photo[: height // 2] = 255
    return photo


# The map


def test_each_region_gets_its_probability():
    sky = bright_model().sky(half_bright())
    assert sky.shape == (6, 8)
    assert sky.dtype == np.float32
    assert np.allclose(sky[:3], 1, atol=1e-6)
    assert np.allclose(sky[3:], 0, atol=1e-6)


@STEADY
@given(st.integers(2, 70), st.integers(2, 70), st.integers(0, 2**32 - 1))
def test_photos_of_any_size_have_a_map_in_range(height, width, seed):
    photo = np.random.default_rng(seed).integers(0, 256, (height, width, 3), np.uint8)
    sky = bright_model().sky(photo)
    assert sky.shape == (6, 8)
    assert (sky >= 0).all()
    assert (sky <= 1).all()


def test_the_network_sees_red_green_and_blue_in_their_order_and_normalised_as_it_wants():
    grey = np.full((12, 16, 3), 128, np.uint8)
    (plain,) = {*bright_model(sharpness=2.0).sky(grey).ravel().tolist()}
    assert plain == pytest.approx(1 / (1 + np.exp(-(2 * 128 / 255 - 1))), abs=1e-5)
    other = SkyModel("other", bright_sky(taken="input.1", sharpness=2.0))
    (normal,) = {*other.sky(grey).ravel().tolist()}
    mean, std = np.array(sky_model.MEAN), np.array(sky_model.STD)
    logit = 2 * ((128 / 255 - mean) / std).mean() - 1
    assert normal == pytest.approx(1 / (1 + np.exp(-logit)), abs=1e-5)
    red = np.zeros((12, 16, 3), np.uint8)
    red[..., 0] = 255
    for taken in ("photo", "input.1"):
        reddish = SkyModel("reddish", bright_sky(taken=taken, colours=(3, 0, 0)))
        assert reddish.sky(red).min() > 0.99
        assert reddish.sky(np.ascontiguousarray(red[..., ::-1])).max() < 0.01


def test_values_that_are_probabilities_stay_and_others_are_logits():
    # 0.5 + 0.25 (2 x - 1) stays between 0.25 and 0.75
    photo = half_bright()
    by_range = SkyModel("any", bright_sky(given="map", sharpness=1.0)).sky(photo)
    assert by_range.min() < 0.4 < 0.6 < by_range.max()  # -0.5 and 0.5 cannot be probabilities
    assert by_range.min() == pytest.approx(1 / (1 + np.exp(0.5)), abs=1e-5)
    bright = np.full_like(photo, 255)
    stays = SkyModel("any", bright_sky(given="map", sharpness=1.0)).sky(bright)
    assert np.allclose(stays, 0.5)
    named = SkyModel("any", bright_sky(given="logit", sharpness=1.0)).sky(bright)
    assert np.allclose(named, 1 / (1 + np.exp(-0.5)))


def test_a_photo_is_reduced_in_two_steps():
    rng = np.random.default_rng(1)
    large = rng.integers(0, 256, (500, 700, 3), np.uint8)
    between = cv2.resize(large, (64, 24), interpolation=cv2.INTER_LINEAR)
    wanted = cv2.resize(between, (16, 12), interpolation=cv2.INTER_AREA)
    assert np.array_equal(reduced(large, 12, 16), wanted)
    small = rng.integers(0, 256, (24, 64, 3), np.uint8)
    means = small.reshape(12, 2, 16, 4, 3).mean(axis=(1, 3))
    assert np.abs(reduced(small, 12, 16) - means).max() <= 0.5


def test_threads_share_a_model():
    photos = [np.full((20, 30, 3), value, np.uint8) for value in range(0, 250, 25)]
    model = bright_model(sharpness=3.0)
    expected = [model.sky(photo) for photo in photos]
    with ThreadPoolExecutor(4) as threads:
        found = list(threads.map(model.sky, photos * 5))
    for at, sky in enumerate(found):
        assert np.array_equal(sky, expected[at % len(photos)])


@pytest.mark.parametrize("photo", [np.zeros((9, 9)), np.zeros((9, 9, 3)), None], ids=str)
def test_what_is_no_photo_is_refused(photo):
    with pytest.raises((TypeError, ValueError), match="a photo"):
        bright_model().sky(photo)


# Networks


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "is not an ONNX file"),
        (b"hello, I am no network", "is not an ONNX file"),
        (bright_sky(0, 0), "takes photos of any size; a sky model fixes its size"),
        (bright_sky(maps=2), r"gives \(1, 2, 6, 8\), and not one map"),
        (bright_sky()[:-40], "is not an ONNX file|cannot be read"),
    ],
    ids=["empty", "text", "any size", "two maps", "cut"],
)
def test_files_that_are_no_sky_network_are_one_sentence(tmp_path, content, message):
    file = tmp_path / "a.onnx"
    file.write_bytes(content)
    with pytest.raises(MethodError, match=message) as caught:
        SkyModel.load(file)
    assert str(caught.value).startswith(str(file))
    assert str(caught.value).endswith(".")
    assert "\n" not in str(caught.value)


def test_models_by_name(tmp_path):
    file = tmp_path / "mine.onnx"
    file.write_bytes(bright_sky())
    mine = SkyModel.named(str(file))
    assert mine == SkyModel("mine.onnx", bright_sky())
    assert SkyModel.named("small") is SkyModel.small()
    with pytest.raises(MethodError, match="tiny is no sky model: name small, large, or a FILE"):
        SkyModel.named("tiny")
    with pytest.raises(MethodError, match=r"gone\.onnx cannot be read: no such file"):
        SkyModel.named(tmp_path / "gone.onnx")


def test_a_missing_file_of_the_package_is_one_sentence(tmp_path, monkeypatch):
    monkeypatch.setattr(sky_model.resources, "files", lambda _: tmp_path)
    sky_model._shipped.cache_clear()
    try:
        with pytest.raises(MethodError, match=r"the sky model small is missing: .*install"):
            SkyModel.small()
    finally:
        sky_model._shipped.cache_clear()


# Trust


def test_shipped_models_are_opened_without_a_trial_and_others_after_one(monkeypatch):
    monkeypatch.setattr(trial, "_survived", set())
    sky_model._shipped.cache_clear()
    tried = []
    monkeypatch.setattr(trial, "started", lambda command, **_: tried.append(command) or _Survivor())
    photo = half_bright()
    shipped = SkyModel.small()
    shipped.sky(photo)
    SkyModel("small", shipped.network).sky(photo)  # as a file brings it
    assert tried == []
    other = SkyModel("small", bright_sky())
    other.sky(photo)
    assert len(tried) == 1
    assert tried[0][5] == "1"  # by the engine that runs it
    other.sky(photo)
    assert len(tried) == 1


class _Survivor:
    returncode = 0
    pid = None

    def communicate(self, *_, **__):
        return b"", b""

    def poll(self):
        return 0

    wait = kill = terminate = lambda self, *_, **__: 0


def test_a_model_goes_to_other_processes_and_with_it_that_it_was_tried(tmp_path, monkeypatch):
    file, photo = tmp_path / "mine.onnx", half_bright()
    file.write_bytes(bright_sky(sharpness=7.0))
    model = SkyModel.load(file)
    sent = pickle.dumps(model)
    monkeypatch.setattr(trial, "_survived", set())
    monkeypatch.setattr(trial, "started", None)  # it would fail
    again = pickle.loads(sent)
    assert again == model
    assert again.sky(photo).shape == (6, 8)
    shipped = pickle.dumps(SkyModel.small())
    assert len(shipped) < 200
    assert pickle.loads(shipped) is SkyModel.small()


# Files


def test_a_detector_keeps_its_network_in_its_one_file(tmp_path):
    file, photo = tmp_path / "d.npz", half_bright()
    for sky in (bright_model(), SkyModel.small()):
        detector = Detector(label="mine", sky=sky)
        detector.save(file)
        again = Detector.load(file)
        assert (again.sky, again.label) == (sky, "mine")
        assert np.array_equal(again.detect(photo).sky, detector.detect(photo).sky)
        again.save(tmp_path / "again.npz")
        assert (tmp_path / "again.npz").read_bytes() == file.read_bytes()


def rewritten(file, sky="bright", network=None):
    """The file of a detector with another network, or without any as an earlier version wrote."""
    detector = Detector()
    header, arrays = detector.header(), dict(detector.bank.arrays())
    header["sky"] = sky
    if network is None:
        del header["settings"]["sky_weight"], header["settings"]["sky_cap"], header["sky"]
    else:
        arrays[sky_model.NETWORK] = network
    with file.open("wb") as opened:
        headed_npz.write(opened, header, arrays)
    return file


def test_a_detector_of_a_version_without_sky_model_does_without(tmp_path):
    earlier = Detector.load(rewritten(tmp_path / "d.npz"))
    assert earlier.config == DetectorConfig(sky_weight=0.0)
    assert earlier.name == "default:sky_weight=0"


@pytest.mark.parametrize(
    ("sky", "network", "message"),
    [
        ("x", np.zeros(9, np.uint8), "the sky model x is not an ONNX file"),
        ("x", np.frombuffer(bright_sky(0, 0), np.uint8), "the sky model x takes photos of any"),
        ("x", np.zeros(9, np.float32), "its sky model has no name, or is no file"),
        (7, np.frombuffer(bright_sky(), np.uint8), "its sky model has no name, or is no file"),
    ],
    ids=["no network", "any size", "numbers", "no name"],
)
def test_a_file_whose_network_is_of_no_use_is_refused(tmp_path, sky, network, message):
    file = rewritten(tmp_path / "d.npz", sky, network)
    with pytest.raises(FilterBankError, match=rf"d\.npz is damaged .*: {message}"):
        Detector.load(file)


def test_sky_models_stand_in_the_names_of_detectors(tmp_path):
    file = tmp_path / "mine.onnx"
    file.write_bytes(bright_sky())
    found = find_method(f"default:sky={file}")
    assert found.name == "default:sky=mine.onnx"
    assert found.sky.network == bright_sky()
    both = find_method(f"paper:sky={file},sky_weight=2")
    assert both.name == "paper:sky_weight=2,sky=mine.onnx"
    assert both.settings()["sky"] == "mine.onnx"
    both.save(tmp_path / "d.npz")
    brought = find_method(str(tmp_path / "d.npz"))
    assert brought.sky == both.sky
    assert find_method(f"{tmp_path}/d.npz:sky=small").sky == SkyModel.small()
    assert find_method("default:sky=small").name == "default"
    assert method_digest(both) != method_digest(both.with_settings({"sky": "small"}))
    with pytest.raises(MethodError, match="huge is no sky model: name small, large"):
        find_method("default:sky=huge")


# What would not be run


def test_a_model_that_would_not_be_run_is_refused():
    with pytest.raises(ValueError, match="bright would not be run, for sky_weight is 0"):
        Detector(config=DetectorConfig.paper()).with_settings({"sky": bright_model()})


# Where it is from


def test_a_model_knows_the_data_sets_that_it_learned_from():
    notes = {sky_model.TRAINED: '{"photos": {"hills": 4, "sea": 2}}'}
    assert SkyModel("known", bright_sky(notes=notes)).learned_from == "hills, sea"


@pytest.mark.parametrize("note", ["", "{", "[]", '{"photos": 3}', "{}"])
def test_what_is_said_in_another_way_is_not_known(note):
    notes = {sky_model.TRAINED: note}
    assert SkyModel("other", bright_sky(notes=notes)).learned_from == ""
    assert SkyModel("other", bright_sky()).learned_from == ""


def test_the_shipped_models_tell():
    assert "mountains" in SkyModel.small().learned_from.split(", ")
