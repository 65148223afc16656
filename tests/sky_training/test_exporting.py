"""A trained network as a file: what is kept in half precision, and under which names."""

import numpy as np
import pytest

from testing.deep import needs_deep

pytestmark = needs_deep


def model(values):
    """An ONNX model that adds some numbers to its input."""
    import onnx  # noqa: PLC0415
    from onnx import helper, numpy_helper  # noqa: PLC0415

    constant = numpy_helper.from_array(np.array(values, np.float32), "a long name")
    shape = [len(values)]
    photo, logit = (
        helper.make_tensor_value_info(name, onnx.TensorProto.FLOAT, shape)
        for name in ("photo", "logit")
    )
    node = helper.make_node("Add", ["photo", "a long name"], ["logit"], name="another long name")
    graph = helper.make_graph([node], "a long name, too", [photo], [logit], [constant])
    return helper.make_model(graph, opset_imports=[helper.make_opsetid("", 13)], ir_version=8)


@pytest.fixture
def exporting():
    pytest.importorskip("torch")
    from skyline_viz.sky_training import exporting  # noqa: PLC0415

    return exporting


@pytest.mark.parametrize("count", [4, 40])
def test_a_file_without_long_names_and_halves_computes_the_same(exporting, count):
    onnx = pytest.importorskip("onnx")
    from onnx.reference import ReferenceEvaluator  # noqa: PLC0415

    values = np.linspace(-3, 3, count).astype(np.float32)
    made = model(values)
    exporting.halve(made)
    exporting.shorten(made)
    onnx.checker.check_model(made)
    assert b"long" not in made.SerializeToString()
    (found,) = ReferenceEvaluator(made).run(None, {"photo": np.ones(count, np.float32)})
    np.testing.assert_allclose(found, values + 1, atol=2e-3)
    kinds = {tensor.data_type for tensor in made.graph.initializer}
    few = count < exporting.SMALLEST
    assert kinds == {onnx.TensorProto.FLOAT if few else onnx.TensorProto.FLOAT16}
