"""The network of a sky model, and its file."""

import numpy as np
import pytest

from skyline_viz.networks.onnx_files import Network
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


def test_opencv_computes_what_torch_does(deep):
    """But for half precision; also at the rim, where means are over less."""
    import torch  # noqa: PLC0415

    network, exporting = deep
    torch.manual_seed(0)
    net = network.SkyNet(TINY)
    with torch.no_grad():  # some statistics other than those of an untrained net
        for _ in range(20):
            net(torch.rand(4, 3, 64, 32))
    opened = Network(exporting.exported(net, {}), "tiny", classic=True)
    photo = np.random.default_rng(0).random((1, 3, 64, 32), np.float32)
    photo[:, :, :9] /= 8  # what lies at the rim is not like the rest
    with torch.no_grad():
        want = net(torch.from_numpy(photo)).numpy()
    np.testing.assert_allclose(opened.run(photo), want, atol=0.02 * np.abs(want).max())


def test_a_file_says_where_it_is_from(deep):
    import onnx  # noqa: PLC0415

    network, exporting = deep
    file = onnx.load_model_from_string(exporting.exported(network.SkyNet(TINY), {"trained": "x"}))
    assert {one.key: one.value for one in file.metadata_props} == {"trained": "x"}
    assert [one.name for one in file.graph.input] == ["photo"]
    assert [one.name for one in file.graph.output] == ["logit"]
