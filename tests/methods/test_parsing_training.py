"""Training of scene parsing: what is shown, how often, and what counts."""

import numpy as np
import pytest

from skyline_viz.skyline import Skyline
from testing.deep import needs_deep

pytestmark = needs_deep


@pytest.fixture
def training():
    pytest.importorskip("torch")
    from skyline_viz.methods import parsing_training  # noqa: PLC0415

    return parsing_training


def made(training, hidden=()):
    photo = np.random.default_rng(0).integers(0, 256, (40, 60, 3), np.uint8)
    visible = np.ones(60, bool)
    visible[list(hidden)] = False
    return photo, Skyline(np.full(60, 20.5), visible)


def test_a_target_is_the_share_of_sky_of_small_pixels(training):
    one = training.lesson(*made(training), columns=30)
    assert one.photo.shape == (20, 30, 3)
    np.testing.assert_allclose(one.target[:10, :, 0], 1, atol=1e-6)
    np.testing.assert_allclose(one.target[10, :, 0], 0.25, atol=1e-6)  # half of one row of two
    np.testing.assert_allclose(one.target[11:, :, 0], 0, atol=1e-6)
    np.testing.assert_allclose(one.target[..., 1], 1, atol=1e-6)


def test_hidden_columns_do_not_count(training):
    one = training.lesson(*made(training, range(10, 20)), columns=30)
    assert (one.target[:, 5:10] == 0).all()
    assert (one.target[:, 10:, 1] == 1).all()


def test_the_rate_rises_and_then_falls(training):
    rates = [training.eased(done) for done in np.linspace(0, 1, 101)]
    top = int(np.argmax(rates))
    assert rates[top] == pytest.approx(1)
    assert (np.diff(rates[: top + 1]) > 0).all()
    assert (np.diff(rates[top:]) < 0).all()
    assert rates[-1] == pytest.approx(0, abs=1e-9)


def test_photos_are_shown_equally_often(training):
    lessons = [training.lesson(*made(training), columns=32) for _ in range(3)]
    seen = []
    kept = training.varied
    training_varied = []

    def remember(one, size, rng):
        training_varied.append(next(k for k, other in enumerate(lessons) if other is one))
        return kept(one, size, rng)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(training, "varied", remember)
        batches = training.shown(lessons, np.random.default_rng(0))
        for _ in range(3):
            photos, target, counts = next(batches)
            seen.append(photos.shape)
    assert set(seen) == {(training.BATCH, 3, 32, 32)}
    assert target.shape == counts.shape == (training.BATCH, 32, 32)
    assert np.bincount(training_varied).tolist() == [training.BATCH] * 3


def test_what_lies_outside_a_photo_does_not_count(training):
    one = training.lesson(*made(training), columns=32)
    rng = np.random.default_rng(1)
    for _ in range(20):
        photo, target = training.varied(one, (64, 64), rng)
        assert photo.shape == (1, 3, 64, 64)
        assert set(np.unique(target[..., 1])) <= {0.0, 1.0}
        share = target[..., 1].mean()
        assert 0 < share < 0.5  # a photo of 21 rows and 32 columns, up to a quarter larger
        assert ((target[..., 0] >= 0) & (target[..., 0] <= 1)).all()
