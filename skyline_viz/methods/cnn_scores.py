"""CNN-DCSI: a small convolutional network on the grey pixels around every pixel.

A network after LeNet looks at a patch of the locally normalised photo:

=======  ===============================  =========  ======================
layer    what it does                     of 16x16   a trous, on a photo
=======  ===============================  =========  ======================
first    5x5 convolution, rectified       12x12      the same
         largest of 2x2                   6x6        one pixel apart
second   3x3 convolution, rectified       4x4        two pixels apart
         largest of 2x2                   2x2        two pixels apart
third    2x2 convolution, rectified       1x1        four pixels apart
score    weighted sum, logistic           1x1        the same
=======  ===============================  =========  ======================

Where pooling would keep every second pixel, the photo's network keeps all of them and takes its
taps further apart, so that one pass gives the patch network's answer at every pixel.

PyTorch trains it. What it has learned is kept as an ONNX graph, which OpenCV runs.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import cv2
import numpy as np

from skyline_viz.arrays import F32, U8, Bool
from skyline_viz.datasets.item import Item
from skyline_viz.edges import to_grey
from skyline_viz.method import MethodError, Model, shown_to_learners
from skyline_viz.methods.extras import needed
from skyline_viz.methods.score_images import (
    BEFORE,
    PATCH,
    DenseScores,
    draw_samples,
    fusions,
    logistic,
    normalised_parts,
    patches,
)
from skyline_viz.networks.trial import try_network
from skyline_viz.system.settings import Presets

CHANNELS = (8, 16, 32)
"""Outputs of the first, second and third convolution."""

EPOCHS = 8
"""How often each sample is learned from. In two-fold cross-validation over the Web set, the median
error of the score alone is 0.46 to 0.73 px with 3 (three seeds), 0.47 and 0.56 px with 8 (two). One
photo has a second line as likely as the skyline: it is missed as a whole with one seed of the three
and one of the two, for a mean error above 3 px instead of below 1, but not by the fusions with the
gradient and with Canny edges."""

BATCH = 256
"""Samples that are learned from together."""

LEARNING_RATE = 3e-3
"""The highest one; it rises to it, and falls again."""

STRIP = 512
"""Rows of a photo that the network works on at a time; memory grows with it."""

OPSET = 13
"""Version of the ONNX operators; OpenCV reads it."""

_FURTHEST = np.iinfo(np.int32).max  # the end of a slice that goes on to the end


@dataclass(frozen=True)
class CnnScores(DenseScores):
    """The model: ``onnx``, the bytes of the graph as uint8 ``(n,)``."""

    PRESETS: ClassVar[Presets] = fusions("cnn")

    @property
    def family(self) -> str:
        """All its fusions learn the same."""
        return "cnn-dcsi"

    def learn(self, items: Sequence[Item], seed: int) -> Model:
        """See `method.Learner.fit`; needs PyTorch and ONNX."""
        torch = needed("torch", "deep", self.name)
        onnx = needed("onnx", "deep", self.name)
        seen: list[F32] = []
        on_line: list[Bool] = []
        for photo, truth in shown_to_learners(items):
            rows, columns, labels = draw_samples(photo, truth, seed)
            seen.append(patches(locally_normalised(photo), rows, columns))
            on_line.append(labels)
        samples, labels = np.concatenate(seen), np.concatenate(on_line)
        if labels.all() or not labels.any():
            raise ValueError("training needs pixels on a true skyline, and pixels off it.")
        weights = train_network(torch, samples, labels, seed)
        return {"onnx": np.frombuffer(onnx_graph(onnx, weights), np.uint8)}

    def model_shapes(self) -> Mapping[str, tuple[int | None, ...]]:
        """See `LearnedMethod.model_shapes`."""
        return {"onnx": (None,)}

    def dense_score(self, photo: U8) -> F32:
        """See `DenseScores.dense_score`."""
        # a network of its own, for OpenCV's are not to be shared between threads
        data = self.part("onnx").astype(np.uint8)
        said = f"the network of {self.name}"
        try_network(data.tobytes(), (1, 1, 4 * PATCH, 4 * PATCH), said)
        try:
            network = cv2.dnn.readNetFromONNX(data)
        except cv2.error as error:
            raise MethodError(f"{said} is damaged.") from error
        image = np.pad(locally_normalised(photo), (BEFORE, PATCH - 1 - BEFORE), mode="edge")
        strips = []
        for top in range(0, len(photo), STRIP):
            strip = image[top : top + STRIP + PATCH - 1]
            try:
                network.setInput(strip[None, None])
                values = np.asarray(network.forward(), np.float32)
            except cv2.error as error:
                raise MethodError(f"{said} is damaged.") from error
            if values.shape != (1, 1, len(strip) - PATCH + 1, photo.shape[1]):
                raise MethodError(f"{said} is damaged: it gives {values.shape}.")
            if not np.isfinite(values).all():
                raise MethodError(f"{said} gives values that are no finite numbers.")
            strips.append(values[0, 0])
        return logistic(np.concatenate(strips))


def locally_normalised(photo: U8) -> F32:
    """Grey photo ``(H, W)`` float32, each pixel less the mean of its patch, over its deviation.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
    """
    grey = to_grey(photo)
    mean, deviation = normalised_parts(grey)
    return ((grey - mean) / deviation).astype(np.float32)


def train_network(
    torch: Any,  # noqa: ANN401 - a module, imported only here
    samples: F32,
    labels: Bool,
    seed: int,
    epochs: int = EPOCHS,
) -> dict[str, F32]:
    """Weights of the network, by the name of the layer, those of ``first`` and ``first_bias``.

    The loss is the cross-entropy of skyline and not skyline, both of equal weight; every other
    batch, by lot, is mirrored. The same arguments give the same weights.

    Args:
        torch: The module.
        samples: ``(n, 16, 16)`` patches of the normalised photo.
        labels: ``(n,)`` whether they are on the skyline.
        seed: Seed of the first weights and of the order of the samples.
        epochs: How often each sample is learned from.
    """
    lots = torch.Generator().manual_seed(seed)
    weights = {}
    for name, shape in layer_shapes().items():
        spread = (2 / np.prod(shape[1:])) ** 0.5
        weights[name] = (torch.randn(shape, generator=lots) * spread).requires_grad_()
        weights[f"{name}_bias"] = torch.zeros(shape[0], requires_grad=True)
    x = torch.from_numpy(samples)[:, None]
    y = torch.from_numpy(labels.astype(np.float32))
    balance = (1 - y).sum() / y.sum()
    batches = epochs * -(-len(y) // BATCH)
    optimiser = torch.optim.AdamW(weights.values(), lr=LEARNING_RATE, weight_decay=1e-4)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, LEARNING_RATE, total_steps=batches)
    threads = torch.get_num_threads()
    torch.set_num_threads(1)  # sums depend on how they are shared out
    try:
        for _ in range(epochs):
            for drawn in torch.randperm(len(y), generator=lots).split(BATCH):
                batch = x[drawn]
                if torch.rand(1, generator=lots) < 0.5:
                    batch = batch.flip(-1)
                loss = torch.nn.functional.binary_cross_entropy_with_logits(
                    patch_network(torch, weights, batch), y[drawn], pos_weight=balance
                )
                optimiser.zero_grad()
                loss.backward()
                optimiser.step()
                schedule.step()
    finally:
        torch.set_num_threads(threads)
    return {name: weight.detach().numpy() for name, weight in weights.items()}


def layer_shapes() -> dict[str, tuple[int, int, int, int]]:
    """Shape of each layer's weights: outputs, inputs, rows, columns."""
    first, second, third = CHANNELS
    return {
        "first": (first, 1, 5, 5),
        "second": (second, first, 3, 3),
        "third": (third, second, 2, 2),
        "score": (1, third, 1, 1),
    }


def patch_network(torch: Any, weights: Mapping[str, Any], x: Any) -> Any:  # noqa: ANN401
    """The network on patches ``(n, 1, 16, 16)``: a value each ``(n,)``, above 0 for skyline."""
    function = torch.nn.functional
    for name in ("first", "second"):
        x = function.conv2d(x, weights[name], weights[f"{name}_bias"])
        x = function.relu(function.max_pool2d(x, 2))
    x = function.relu(function.conv2d(x, weights["third"], weights["third_bias"]))
    return function.conv2d(x, weights["score"], weights["score_bias"]).flatten()


def onnx_graph(onnx: Any, weights: Mapping[str, F32]) -> bytes:  # noqa: ANN401
    """The network on whole images ``(1, 1, h + 15, w + 15)``, values ``(1, 1, h, w)``, as ONNX.

    Pooling is written as the larger of two slices: OpenCV 4 takes dilated pooling for plain one.
    """
    helper, tensors = onnx.helper, dict(weights)
    nodes = []

    def convolution(x: str, name: str, apart: int) -> str:
        size = weights[name].shape[2:]
        inputs = [x, name, f"{name}_bias"]
        nodes.append(
            helper.make_node(
                "Conv", inputs, [f"{name}_out"], kernel_shape=size, dilations=[apart, apart]
            )
        )
        return f"{name}_out"

    def larger(x: str, axis: int, apart: int) -> str:
        halves = []
        for half, bounds in (("near", (0, -apart)), ("far", (apart, _FURTHEST))):
            out = f"{x}_{half}"
            inputs = [f"{out}_start", f"{out}_end", f"{out}_axis"]
            for name, value in zip(inputs, (*bounds, axis), strict=True):
                tensors[name] = np.array([value], np.int64)
            nodes.append(helper.make_node("Slice", [x, *inputs], [out]))
            halves.append(out)
        nodes.append(helper.make_node("Max", halves, [f"{x}_max"]))
        return f"{x}_max"

    def rectified(x: str) -> str:
        nodes.append(helper.make_node("Relu", [x], [f"{x}_relu"]))
        return f"{x}_relu"

    x = "image"
    for name, apart in (("first", 1), ("second", 2)):
        x = convolution(x, name, apart)
        for axis in (2, 3):
            x = larger(x, axis, apart)
        x = rectified(x)
    x = convolution(rectified(convolution(x, "third", 4)), "score", 1)
    image, values = (
        helper.make_tensor_value_info(name, onnx.TensorProto.FLOAT, [1, 1, *sides])
        for name, sides in (("image", ("height", "width")), (x, ("rows", "columns")))
    )
    initial = [onnx.numpy_helper.from_array(array, name) for name, array in tensors.items()]
    graph = helper.make_graph(nodes, "cnn-dcsi", [image], [values], initial)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", OPSET)], ir_version=8)
    onnx.checker.check_model(model)
    written: bytes = model.SerializeToString()
    return written
