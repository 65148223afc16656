"""A sky model learns what sky is."""

import numpy as np
import pytest

from skyline_viz.sky_model import SkyModel
from skyline_viz.sky_training.examples import COLUMNS, ROWS, Example
from skyline_viz.sky_training.sizes import Size
from testing.deep import needs_deep

pytestmark = needs_deep


@pytest.fixture
def learning(monkeypatch):
    pytest.importorskip("torch")
    from skyline_viz.sky_training import learning  # noqa: PLC0415

    monkeypatch.setitem(learning.SIZES, "small", Size(64, 32, (8, 12, 16, 16, 16), 1))
    return learning


def hills(count: int) -> list[Example]:
    """Bright sky over dark, rough terrain."""
    rng = np.random.default_rng(0)
    found = []
    for _ in range(count):
        line = rng.uniform(80, 300) + 40 * np.sin(np.arange(COLUMNS) / rng.uniform(20, 60))
        sky = np.arange(ROWS)[:, None] < line
        rough = rng.integers(0, 90, (ROWS, COLUMNS, 3))
        photo = np.where(sky[..., None], 200, rough).astype(np.uint8)
        found.append(Example(photo, (sky * 255).astype(np.uint8), "hills"))
    return found


def test_a_model_learns(learning, tmp_path):
    steps: list[int] = []
    network = learning.learn(
        hills(6), "small", steps=60, seed=1, progress=lambda step, _: steps.append(step)
    )
    path = tmp_path / "sky.onnx"
    path.write_bytes(network)
    unseen = hills(9)[-1]
    sky = SkyModel.load(path).sky(unseen.photo)
    half = unseen.sky.reshape(32, ROWS // 32, 16, COLUMNS // 16).mean((1, 3)) / 255
    assert ((sky > 0.5) == (half > 0.5)).mean() > 0.9
    assert steps == list(range(1, 61))


def test_the_same_seed_gives_the_same_model(learning):
    first, second = (learning.learn(hills(3), "small", steps=3, seed=4) for _ in range(2))
    assert first == second
    assert first != learning.learn(hills(3), "small", steps=3, seed=5)


def test_a_file_tells_what_it_was_learned_from(learning):
    assert b'"hills": 3' in learning.learn(hills(3), "small", steps=1)


def test_there_must_be_something_to_learn(learning):
    with pytest.raises(ValueError, match="at least one photo"):
        learning.learn([], "small")
