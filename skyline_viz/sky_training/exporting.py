"""A trained network as an ONNX file, its weights in half precision."""

from __future__ import annotations

import io
import warnings

import onnx
import torch
from onnx import TensorProto, helper, numpy_helper

from skyline_viz.sky_training.network import SkyNet

SMALLEST = 16
"""Constants of fewer numbers stay as they are."""


def exported(net: SkyNet, about: dict[str, str]) -> bytes:
    """The ONNX file of a network: input ``photo``, output ``logit``.

    Args:
        net: A trained network.
        about: What the file says of itself: where the network is from.
    """
    file = io.BytesIO()
    photo = torch.zeros(1, 3, net.size.rows, net.size.columns)
    with warnings.catch_warnings():
        # the exporter by tracing is on its way out, but OpenCV reads what it writes
        warnings.simplefilter("ignore")
        torch.onnx.export(
            net.eval(),
            (photo,),
            file,
            dynamo=False,
            opset_version=13,
            input_names=["photo"],
            output_names=["logit"],
        )
    model = onnx.load_model_from_string(file.getvalue())
    halve(model)
    shorten(model)
    helper.set_model_props(model, about)
    onnx.checker.check_model(model)
    return bytes(model.SerializeToString())


def halve(model: onnx.ModelProto) -> None:
    """Keep the weights as 16-bit numbers, which the network casts when it is read."""
    casts = []
    for tensor in model.graph.initializer:
        if tensor.data_type != TensorProto.FLOAT:
            continue
        values = numpy_helper.to_array(tensor)
        if values.size < SMALLEST:
            continue
        name = tensor.name
        tensor.CopyFrom(numpy_helper.from_array(values.astype("float16"), f"{name}h"))
        casts.append(helper.make_node("Cast", [f"{name}h"], [name], to=TensorProto.FLOAT))
    for cast in reversed(casts):
        model.graph.node.insert(0, cast)


def shorten(model: onnx.ModelProto) -> None:
    """Give all that is inside the graph short names: they are a tenth of a small file."""
    graph = model.graph
    kept = {one.name for one in (*graph.input, *graph.output)}
    names: dict[str, str] = {}

    def short(name: str) -> str:
        if not name or name in kept:
            return name
        return names.setdefault(name, f"{len(names):x}")

    for tensor in graph.initializer:
        tensor.name = short(tensor.name)
    for index, node in enumerate(graph.node):
        node.name = f"{index:x}"
        node.doc_string = ""
        for places in (node.input, node.output):
            places[:] = [short(name) for name in places]
    del graph.value_info[:]
    graph.name = "sky"
