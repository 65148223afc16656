"""The network of a sky model, and its file."""

import numpy as np
import pytest

from skyline_viz.sky_model import SkyModel
from skyline_viz.sky_training.sizes import SIZES, Size
from testing.deep import needs_deep

pytestmark = needs_deep
TINY = Size(64, 32, (4, 6, 8, 8, 8), 1)
LIMITS = {"small": 120_000, "large": 1_000_000}


@pytest.fixture
def deep():
    pytest.importorskip("torch")
    from skyline_viz.sky_training import exporting, network  # noqa: PLC0415

    return network, exporting


def test_the_map_has_half_the_rows_and_columns(deep):
    import torch  # noqa: PLC0415

    network, _ = deep
    assert network.SkyNet(TINY)(torch.zeros(2, 3, 64, 32)).shape == (2, 1, 32, 16)


@pytest.mark.parametrize("size", LIMITS)
def test_a_file_is_as_small_as_it_has_to_be(deep, size):
    network, exporting = deep
    assert len(exporting.exported(network.SkyNet(SIZES[size]), {})) <= LIMITS[size]


def test_opencv_computes_what_torch_does(deep, tmp_path):
    """But for half precision."""
    import torch  # noqa: PLC0415

    network, exporting = deep
    torch.manual_seed(0)
    net = network.SkyNet(TINY)
    with torch.no_grad():  # some statistics other than those of an untrained net
        for _ in range(20):
            net(torch.rand(4, 3, 64, 32))
    path = tmp_path / "tiny.onnx"
    path.write_bytes(exporting.exported(net, {}))
    photo = np.random.default_rng(0).integers(0, 256, (64, 32, 3), np.uint8)
    with torch.no_grad():
        want = torch.sigmoid(net(torch.from_numpy(photo.transpose(2, 0, 1)[None] / 255).float()))
    found = SkyModel.load(path).sky(photo)
    np.testing.assert_allclose(found, want[0, 0].numpy(), atol=0.02)


def test_a_file_says_where_it_is_from(deep):
    import onnx  # noqa: PLC0415

    network, exporting = deep
    file = onnx.load_model_from_string(exporting.exported(network.SkyNet(TINY), {"trained": "x"}))
    assert {one.key: one.value for one in file.metadata_props} == {"trained": "x"}
    assert [one.name for one in file.graph.input] == ["photo"]
    assert [one.name for one in file.graph.output] == ["logit"]
