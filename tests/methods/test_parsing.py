"""Scene parsing: trained in PyTorch, run by OpenCV."""

import pickle
import sys
from dataclasses import replace

import numpy as np
import pytest

from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.evaluation.metrics import a_err
from skyline_viz.method import Learner, MethodError
from skyline_viz.methods.parsing import Fcn8s, Fcn16s, Fcn32s, SegNet
from skyline_viz.methods.sky_boundary import MAP
from skyline_viz.skyline import Skyline
from testing.deep import Rendered, needs_deep, rendered

METHODS = (Fcn8s, Fcn16s, Fcn32s, SegNet)
SMALL = {"width": 1 / 8, "epochs": 32, "columns": 64}
COARSE = {"width": 1 / 16, "epochs": 16, "columns": 96}  # 64 columns are two cells of FCN-32s


@needs_deep
@pytest.mark.parametrize("method", METHODS)
def test_from_photos_to_a_diagnosis(method, one_thread):
    learner = method(**(COARSE if method is Fcn32s else SMALL))
    assert isinstance(learner, Learner)
    trained = learner.fit(rendered(range(8)), seed=1)
    assert trained.name == learner.name
    assert learner.name.startswith(method.architecture)
    assert {name: array.dtype for name, array in trained.model.items()} == {
        "network": np.uint8,
        "columns": np.int32,
    }
    errors, guesses = [], []
    for item in rendered(range(100, 106)):
        detection = trained.detect(item.photo())
        truth = item.truth()
        assert detection.maps[MAP].shape == detection.cost.shape == (120, 160)
        assert detection.edges.all() and 0 <= detection.scores.min() <= detection.scores.max() <= 1
        found = diagnose(detection, truth)
        assert found.right == bool((np.abs(detection.skyline.rows - truth.rows) <= 4).all())
        errors.append(a_err(detection.skyline, truth))
        guesses.append(a_err(Skyline(np.full(160, 60.0)), truth))
    assert np.mean(errors) < 0.5 * np.mean(guesses)


@needs_deep
@pytest.mark.parametrize("method", METHODS)
def test_opencv_computes_what_pytorch_does(method, one_thread):
    from skyline_viz.methods.parsing_nets import build  # noqa: PLC0415
    from skyline_viz.methods.parsing_training import export  # noqa: PLC0415
    from skyline_viz.networks.onnx_files import Network  # noqa: PLC0415

    torch = one_thread
    for normalised in (True, False):
        torch.manual_seed(3)
        net = build(method.architecture, 1 / 16, normalised)
        for name, values in net.named_parameters():
            if "score" in name or "skips" in name:  # which begin with zeros
                torch.nn.init.normal_(values)
        net.train()
        net(torch.randn(4, 3, 64, 64))  # for the running means
        net.eval()
        network = Network(export(net), "test")
        for rows, columns in ((64, 96), (128, 32)):
            photo = torch.randn(1, 3, rows, columns)
            photo[..., :20, :20] = 0.5  # flat: many equal values in a window
            with torch.no_grad():
                expected = net(photo).numpy()
            given = network.run(photo.numpy())
            assert expected.shape == given.shape == (1, 1, rows, columns)
            assert expected.std() > 1e-3
            np.testing.assert_allclose(given, expected, atol=1e-4 * np.abs(expected).max())


@needs_deep
def test_equal_seeds_give_equal_networks_and_hidden_columns_do_not_count(one_thread):
    quick = Fcn32s(width=1 / 32, epochs=2, columns=64)
    items = rendered(range(3))
    state = one_thread.get_rng_state()
    first = quick.fit(items, seed=5).model["network"]
    assert one_thread.equal(state, one_thread.get_rng_state())
    assert np.array_equal(first, quick.fit(items, seed=5).model["network"])
    assert not np.array_equal(first, quick.fit(items, seed=6).model["network"])

    hidden = [Rendered(one.scene, (40, 100)) for one in items]
    other = hidden[0].scene.truth.rows.copy()
    other[40:100] = 0
    wrong = [
        Rendered(replace(one.scene, truth=Skyline(np.where(other == 0, 0, one.scene.truth.rows))))
        for one in items
    ]
    told = [Rendered(one.scene, (40, 100)) for one in wrong]
    unseen = quick.fit(hidden, seed=5).model["network"]
    assert np.array_equal(unseen, quick.fit(told, seed=5).model["network"])
    assert not np.array_equal(unseen, quick.fit(wrong, seed=5).model["network"])


@needs_deep
def test_it_goes_to_other_processes(one_thread):
    trained = Fcn32s(width=1 / 32, epochs=1, columns=64).fit(rendered([1]))
    photo = rendered([2])[0].photo()
    first = trained.detect(photo)
    assert pickle.loads(pickle.dumps(trained)).detect(photo).skyline == first.skyline
    # what was learned at 64 columns is run at 64 columns, whatever the settings are
    assert Fcn32s().sharing(trained).detect(photo).skyline == first.skyline


def test_untrained_ones_say_so():
    for method in METHODS:
        name = method.architecture
        with pytest.raises(MethodError, match=f"{name} has learned nothing yet"):
            method().detect(np.zeros((40, 60, 3), np.uint8))


@pytest.mark.parametrize("missing", ["torch", "onnx"])
def test_a_missing_package_is_named_with_its_extra(monkeypatch, missing):
    for module in [one for one in sys.modules if one.startswith("skyline_viz.methods.parsing_")]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, missing, None)
    monkeypatch.setitem(sys.modules, "onnx", None if missing == "onnx" else sys)
    with pytest.raises(MethodError) as caught:
        Fcn8s().fit(rendered([1]))
    assert str(caught.value).startswith(f"fcn-8s needs {missing} to be trained; install it with: ")


@pytest.mark.parametrize("settings", [{"width": 0}, {"epochs": 0}, {"columns": 8}])
def test_settings_out_of_range_are_refused(settings):
    with pytest.raises(ValueError, match="width is above 0"):
        Fcn8s(**settings).fit(rendered([1]))
