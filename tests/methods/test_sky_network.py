"""A sky-segmentation network from an ONNX file: what it may take and give, and what is refused."""

import pickle

import numpy as np
import pytest

from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.evaluation.metrics import a_err
from skyline_viz.method import MethodError
from skyline_viz.methods.sky_boundary import MAP
from skyline_viz.methods.sky_network import SkyNetwork
from skyline_viz.networks.onnx_files import read_header
from skyline_viz.skyline import Skyline
from testing.deep import needs_deep

SHAPE = (75, 110)  # no multiples of anything
PLAIN = {"mean": (0.0, 0.0, 0.0), "std": (1.0, 1.0, 1.0)}


def scene():
    """A bright sky over dark terrain, and where it ends."""
    columns = np.arange(SHAPE[1])
    truth = Skyline(np.round(38 + 12 * np.sin(columns / 17)).astype(np.float32))
    sky = truth.to_mask(SHAPE[0])
    return np.where(sky[..., None], np.uint8(220), np.uint8(40)).repeat(3, axis=2), truth


def write(path, tail, outputs, *, sizes=("h", "w"), whole=False, last=False, weights=((20, -20),)):
    """A network: class k is ``weights[k] . (red, 1)``, and then whatever is in the tail."""
    from onnx import TensorProto, helper, numpy_helper, save  # noqa: PLC0415

    kernel = np.zeros((len(weights), 3, 1, 1), np.float32)
    kernel[:, 0, 0, 0] = [red for red, _ in weights]
    bias = np.array([one for _, one in weights], np.float32)
    nodes = [helper.make_node("Transpose", ["photo"], ["chw"], perm=[0, 3, 1, 2])] if last else []
    nodes.append(helper.make_node("Conv", ["chw" if last else "photo", "k", "b"], ["x0"]))
    for number, (kind, attributes) in enumerate(tail):
        names = [f"x{number}"], [f"x{number + 1}"]
        nodes.append(helper.make_node(kind, *names, **attributes))
    shape = [1, *sizes, 3] if last else [1, 3, *sizes]
    kind = TensorProto.INT64 if whole else TensorProto.FLOAT
    graph = helper.make_graph(
        nodes,
        "net",
        [helper.make_tensor_value_info("photo", TensorProto.FLOAT, shape)],
        [helper.make_tensor_value_info(f"x{len(tail)}", kind, outputs)],
        [numpy_helper.from_array(kernel, "k"), numpy_helper.from_array(bias, "b")],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 12)])
    model.ir_version = 8
    save(model, path)
    return path


SKY = ((20, -10),)  # bright is sky
TERRAIN_SKY = ((-20, 10), (20, -10))
FORMS = {
    "logits": ([], [1, 2, "h", "w"], TERRAIN_SKY, 1, False),
    "probabilities": ([("Softmax", {"axis": 1})], [1, 2, "h", "w"], TERRAIN_SKY, 1, False),
    "logit": ([], [1, 1, "h", "w"], SKY, 0, False),
    "probability": ([("Sigmoid", {})], [1, 1, "h", "w"], SKY, 0, False),
    "no channel": ([("Squeeze", {"axes": [1]})], [1, "h", "w"], SKY, 0, False),
    "labels": (
        [("ArgMax", {"axis": 1, "keepdims": 1})],
        [1, 1, "h", "w"],
        TERRAIN_SKY,
        1,
        True,
    ),
    "coarse": (
        [("AveragePool", {"kernel_shape": [2, 2], "strides": [2, 2]})],
        [1, 1, "h2", "w2"],
        SKY,
        0,
        False,
    ),
}


@needs_deep
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("sizes", [("h", "w"), (64, 96)])
def test_every_form_of_output_gives_the_skyline(tmp_path, form, sizes):
    tail, outputs, weights, sky_class, whole = FORMS[form]
    photo, truth = scene()
    path = write(tmp_path / "n.onnx", tail, outputs, sizes=sizes, whole=whole, weights=weights)
    detection = SkyNetwork(path, sky_class, **PLAIN).detect(photo)
    sky = detection.maps[MAP]
    assert sky.shape == SHAPE and sky.min() >= 0 and sky.max() <= 1
    assert sky[2].min() > 0.9 and sky[-2].max() < 0.1
    assert a_err(detection.skyline, truth) < (0.2 if form != "coarse" and sizes[0] == "h" else 0.8)
    assert diagnose(detection, truth).right


@needs_deep
def test_another_class_is_not_the_sky(tmp_path):
    photo, _ = scene()
    path = write(tmp_path / "n.onnx", [], [1, 2, "h", "w"], weights=TERRAIN_SKY)
    sky = SkyNetwork(path, 0, **PLAIN).detect(photo).maps[MAP]
    assert sky[2].max() < 0.1 and sky[-2].min() > 0.9


@needs_deep
@pytest.mark.parametrize("last", [False, True])
@pytest.mark.parametrize("gives_last", [False, True])
def test_photos_come_normalised_and_at_their_place(tmp_path, last, gives_last):
    photo = np.random.default_rng(0).integers(0, 256, (*SHAPE, 3), np.uint8)
    tail, outputs = [("Sigmoid", {})], [1, 1, "h", "w"]
    if last and gives_last:
        tail, outputs = [*tail, ("Transpose", {"perm": [0, 2, 3, 1]})], [1, "h", "w", 1]
    path = write(tmp_path / "n.onnx", tail, outputs, last=last, weights=((1, 0),))
    sky = SkyNetwork(path).detect(photo).maps[MAP]
    red = (photo[..., 0] / 255 - 0.485) / 0.229  # ImageNet's
    np.testing.assert_allclose(sky, 1 / (1 + np.exp(-red)), atol=1e-5)


@needs_deep
def test_a_coarse_map_is_scaled_back_without_a_shift(tmp_path):
    ramp = np.linspace(0, 220, SHAPE[1]).astype(np.uint8)
    photo = np.ascontiguousarray(np.broadcast_to(ramp[None, :, None], (*SHAPE, 3)))
    pool = [("AveragePool", {"kernel_shape": [4, 4], "strides": [4, 4]})]
    path = write(tmp_path / "n.onnx", pool, [1, 1, "h", "w"], weights=((1, 0),))
    sky = SkyNetwork(path, **PLAIN).detect(photo).maps[MAP]
    inside = slice(4, -6)
    # half a pixel of shift at stride 4 would be 1 level in the mean
    assert abs(float((sky[:, inside] * 255 - ramp[inside]).mean())) < 0.3


@needs_deep
def test_it_goes_to_other_processes(tmp_path):
    photo, _ = scene()
    method = SkyNetwork(write(tmp_path / "n.onnx", [], [1, 1, "h", "w"], weights=SKY), **PLAIN)
    first = method.detect(photo)
    assert pickle.loads(pickle.dumps(method)).detect(photo).skyline == first.skyline


@needs_deep
def test_what_does_not_fit_is_refused_in_a_sentence(tmp_path):
    photo, _ = scene()
    two = write(tmp_path / "two.onnx", [], [1, 2, "h", "w"], weights=TERRAIN_SKY)
    flat = write(
        tmp_path / "flat.onnx",
        [("GlobalAveragePool", {}), ("Flatten", {})],
        [1, 2],
        weights=TERRAIN_SKY,
    )
    log = write(tmp_path / "nan.onnx", [("Log", {})], [1, 1, "h", "w"], weights=((-1, 0),))
    cut = tmp_path / "cut.onnx"
    cut.write_bytes(two.read_bytes()[:-9])
    for path, sky_class, reason in (
        (two, 2, "no class 2"),
        (two, -1, "no class -1"),
        (flat, 0, r"gives \(1, 2\), and not a map"),
        (log, 0, "no finite numbers"),
        (cut, 0, "not an ONNX file"),
    ):
        with pytest.raises(MethodError, match=reason) as caught:
            SkyNetwork(path, sky_class).detect(photo)
        assert path.name in str(caught.value)
        assert str(caught.value).endswith(".") and "\n" not in str(caught.value)


@needs_deep
def test_a_network_of_unknown_layers_is_refused_quietly(tmp_path, capfd):
    path = write(tmp_path / "n.onnx", [("Cauchy", {})], [1, 1, "h", "w"])
    with pytest.raises(MethodError, match=r"n\.onnx cannot be (read by OpenCV|run)"):
        SkyNetwork(path).detect(scene()[0])
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    "content", [b"", b"no network at all", b"\x89PNG\r\n\x1a\n" + bytes(64), b"\xff" * 40]
)
def test_other_files_are_no_networks(tmp_path, content):
    path = tmp_path / "n.onnx"
    path.write_bytes(content)
    with pytest.raises(MethodError, match=r"n\.onnx is not an ONNX file\."):
        SkyNetwork(path).detect(scene()[0])


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(MethodError, match=r"gone\.onnx cannot be read: no such file"):
        SkyNetwork(tmp_path / "gone.onnx").detect(scene()[0])


@needs_deep
def test_header_tells_what_goes_in_and_comes_out(tmp_path):
    path = write(tmp_path / "n.onnx", [("ArgMax", {"axis": 1})], [1, 1, "h", 7], whole=True)
    header = read_header(path.read_bytes())
    assert [(one.name, one.shape) for one in header.inputs] == [("photo", (1, 3, 0, 0))]
    assert [(one.name, one.shape, one.whole) for one in header.outputs] == [
        ("x1", (1, 1, 0, 7), True)
    ]
