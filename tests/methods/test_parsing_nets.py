"""The networks of scene parsing, layer by layer."""

from dataclasses import replace

import numpy as np
import pytest

from skyline_viz.method import MethodError
from skyline_viz.methods.parsing import Fcn8s
from testing.deep import needs_deep, rendered


@needs_deep
def test_values_are_put_back_as_by_max_unpooling(one_thread):
    from torch.nn import functional as fn  # noqa: PLC0415

    from skyline_viz.methods.parsing_nets import put_back  # noqa: PLC0415

    full = one_thread.randint(0, 3, (2, 5, 8, 12)).float()  # with equal ones
    top, indices = fn.max_pool2d(full, 2, return_indices=True)
    values = one_thread.randn(top.shape)
    assert one_thread.equal(put_back(values, full, top), fn.max_unpool2d(values, indices, 2))


@needs_deep
def test_enlarging_begins_bilinear(one_thread):
    from skyline_viz.methods.parsing_nets import enlarging  # noqa: PLC0415

    coarse = one_thread.randn(1, 1, 6, 7)
    for factor in (2, 8, 32):
        fine = enlarging(factor)(coarse)
        expected = one_thread.nn.functional.interpolate(
            coarse, scale_factor=factor, mode="bilinear", align_corners=False
        )
        inside = slice(factor, -factor)
        one_thread.testing.assert_close(
            fine[..., inside, inside], expected[..., inside, inside], atol=1e-5, rtol=0
        )


@needs_deep
def test_pretrained_weights_are_read_and_used(tmp_path, one_thread):
    from skyline_viz.methods.parsing_nets import build, load_backbone  # noqa: PLC0415

    published = [0, 2, 5, 7, 10, 12, 14, 17, 19, 21, 24, 26, 28]
    names = [f"features.{number}" for number in published]
    for architecture in ("fcn-8s", "segnet"):
        net = build(architecture, 1 / 32, normalised=architecture == "segnet")
        assert [name for name, _ in net.backbone()] == names
    state = {"classifier.0.weight": one_thread.zeros(3)}
    for name, layer in build("fcn-8s", 1 / 32, normalised=False).backbone():
        state[f"{name}.weight"] = one_thread.randn(layer.weight.shape)
        state[f"{name}.bias"] = one_thread.randn(layer.bias.shape)
    path = tmp_path / "vgg16.pth"
    one_thread.save(state, path)
    load_backbone(net, path)
    for name, layer in net.backbone():
        assert one_thread.equal(layer.weight, state[f"{name}.weight"])
        assert one_thread.equal(layer.bias, state[f"{name}.bias"])
    quick = Fcn8s(width=1 / 32, epochs=1, columns=64, pretrained=path)
    before = quick.fit(rendered([1])).model["network"]
    state["features.28.bias"] += 1
    one_thread.save(state, path)
    assert not np.array_equal(before, quick.fit(rendered([1])).model["network"])


@needs_deep
def test_pretrained_weights_that_do_not_fit_are_refused(tmp_path, one_thread):
    from skyline_viz.methods.parsing_nets import build  # noqa: PLC0415

    good = {}
    for name, layer in build("fcn-8s", 1 / 32, normalised=False).backbone():
        good |= {f"{name}.weight": layer.weight.data, f"{name}.bias": layer.bias.data}
    quick = Fcn8s(width=1 / 32, epochs=1, columns=64)

    def refused(content, reason, **settings):
        path = tmp_path / "w.pth"
        if isinstance(content, bytes):
            path.write_bytes(content)
        elif content is not None:
            one_thread.save(content, path)
        with pytest.raises(MethodError, match=reason) as caught:
            replace(quick, pretrained=path, **settings).fit(rendered([1]))
        assert "w.pth" in str(caught.value) and "\n" not in str(caught.value)

    refused(None, "cannot be read: no such file")
    refused(b"no weights", "is not a PyTorch file of weights")
    refused([1, 2], "holds no state dict of VGG-16, but a list")
    refused(good, r"features\.0\.weight of the shape \(2, 3, 3, 3\).*width of 1", width=1 / 8)
    refused({"x": 1}, r"has no features\.0\.weight")
    refused({**good, "features.28.bias": None}, r"has no features\.28\.bias")
    # weights alone are read: nothing is run that a file brings along
    refused(Fcn8s(), "is not a PyTorch file of weights")
