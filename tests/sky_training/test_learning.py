"""A sky model learns what sky is."""

import json

import pytest

from skyline_viz.networks.onnx_files import read_notes
from skyline_viz.sky_model import TRAINED, SkyModel
from skyline_viz.sky_training.choosing import Part
from skyline_viz.sky_training.examples import COLUMNS, ROWS
from skyline_viz.sky_training.sizes import Size
from testing.deep import kept, needs_deep, sky_examples

pytestmark = needs_deep


@pytest.fixture
def learning(monkeypatch):
    pytest.importorskip("torch")
    from skyline_viz.sky_training import learning  # noqa: PLC0415

    monkeypatch.setitem(learning.SIZES, "small", Size(64, 32, (8, 12, 16, 16, 16), 1))
    return learning


def hills(count):
    """Examples in a file, which is gone with the test: so few are kept in memory."""
    return kept(sky_examples(count))


def test_a_model_learns(learning, tmp_path):
    steps: list[int] = []
    network = learning.learn(
        hills(6), "small", steps=60, seed=1, progress=lambda step, _: steps.append(step)
    )
    path = tmp_path / "sky.onnx"
    path.write_bytes(network)
    unseen = sky_examples(9)[-1]
    sky = SkyModel.load(path).sky(unseen.photo)
    half = unseen.sky.reshape(32, ROWS // 32, 16, COLUMNS // 16).mean((1, 3)) / 255
    assert ((sky > 0.5) == (half > 0.5)).mean() > 0.9
    assert steps == list(range(1, 61))


def test_the_same_seed_gives_the_same_model(learning):
    first, second = (learning.learn(hills(3), "small", steps=3, seed=4) for _ in range(2))
    assert first == second
    assert first != learning.learn(hills(3), "small", steps=3, seed=5)


def test_a_file_tells_what_it_was_learned_from(learning):
    whole = learning.learn(hills(3), "small", steps=1, parts={"hills": Part(3, 3)})
    assert b'"hills": 3' in whole
    assert whole == learning.learn(hills(3), "small", steps=1)


def test_a_file_tells_how_many_photos_there_were_where_not_all_were_read(learning):
    parts = {"hills": Part(4, 70), "sea": Part(2, 2)}  # of six that were read one failed
    file = kept([*sky_examples(3), *sky_examples(2, "sea")])
    told = json.loads(read_notes(learning.learn(file, "small", steps=1, parts=parts))[TRAINED])
    assert told["photos"] == {"hills": 3, "sea": 2}
    assert told["of"] == {"hills": 70, "sea": 2}


def test_there_must_be_something_to_learn(learning):
    with pytest.raises(ValueError, match="at least one photo"):
        learning.learn(kept([]), "small")
