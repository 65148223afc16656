"""A folder at work: the order of its photos, and which of them are blind."""

from dataclasses import dataclass

import pytest

from annotate.commands.open import propose_all
from testing.labelling import DETECTOR, workbench, write_hills


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


def test_the_least_certain_photo_comes_first(folder):
    bench = workbench(folder, order="confidence")
    propose_all([bench])
    confidences = [card.confidence for card in bench.cards()]
    assert None not in confidences
    assert confidences == sorted(confidences)
    bench.close()


def test_random_orders_and_blind_shares_are_seeded(tmp_path):
    folder = write_hills(tmp_path, count=12)

    def order(seed):
        bench = workbench(folder, order="random", blind=0.5, seed=seed)
        names = [card.photo.name for card in bench.cards()]
        blind = {photo for photo in bench.photos if bench.store.is_blind(bench.label(photo))}
        bench.close()
        return names, blind

    (first, blind), (second, _) = order(0), order(1)
    assert sorted(first) == sorted(second)
    assert first != second
    assert order(0)[0] == first
    assert 2 <= len(blind) <= 10


def test_a_method_that_refuses_small_photos_lets_the_page_begin(folder):
    @dataclass(frozen=True)
    class Large:
        name: str = "large"

        def detect(self, photo):
            if photo.shape[1] < 100:
                raise ValueError("too small")
            return DETECTOR.detect(photo)

    bench = workbench(folder, detector=Large())
    assert tuple(bench.overlays()) == ("edges", "score", "cost")
    bench.close()


def test_a_photo_that_is_asked_for_again_leaves_the_next_one_its_detection(tmp_path):
    bench = workbench(write_hills(tmp_path, count=3, height=200, width=300))
    try:
        for _ in range(2):
            bench.session(1)
            bench.prepare_after(1)
            bench._ahead.submit(lambda: None).result()
        assert bench.session(2).wire.detection is not None
        assert bench.session(1).wire.detection is not None
    finally:
        bench.close()
