"""What is said about the sizes of photos before work on them begins."""

import pytest

from skyline_viz.command_line import sizes
from skyline_viz.command_line.messages import UsageError
from skyline_viz.command_line.sizes import foresee, limit, pixels_of, say_too_large
from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.system.memory import SHARE, needed, photo_limit
from testing.pictures import NOISE, save


@pytest.fixture(autouse=True)
def same_limit():
    """The limit of this process is the same afterwards."""
    before = photo_limit()
    yield
    limit(before)


@pytest.fixture
def items(tmp_path):
    paths = [save(tmp_path / f"{name}.png", NOISE) for name in "ab"]
    (tmp_path / "torn.png").write_bytes(b"\x89PNG")
    return [DatasetItem(path.stem, path) for path in (*paths, tmp_path / "torn.png")]


@pytest.mark.parametrize("megapixels", [0, -1, float("inf"), float("nan")])
def test_a_limit_is_a_number_above_0(megapixels):
    with pytest.raises(UsageError, match="--max-megapixels is a number above 0, not"):
        limit(megapixels)


def test_photos_are_counted_in_pixels_and_damaged_ones_left_to_their_turn(items):
    assert [(item.name, pixels) for item, pixels in pixels_of(items)] == [("a", 768), ("b", 768)]


def test_photos_over_the_limit_are_named(items, capsys):
    limit(0.0005)
    assert foresee(items, workers=3) == 3
    said = capsys.readouterr().err
    assert "a, b are over the limit of 0.0005 megapixels, and will not be read" in said
    say_too_large([])
    say_too_large(["a"], "prog")
    assert capsys.readouterr().err.startswith("prog: a is over the limit")


@pytest.mark.parametrize(
    ("workers", "free", "chosen", "said"),
    [
        (2, None, 2, ""),  # nobody knows how much is free
        (2, 1 << 50, 2, ""),
        (1, 1, 1, "of memory, and"),
        (2, 1, 2, "--workers 1 fits better."),
    ],
)
def test_what_does_not_fit_into_memory_is_said(
    items, workers, free, chosen, said, monkeypatch, capsys
):
    monkeypatch.setattr(sizes, "available", lambda: free)
    assert foresee(items, workers) == chosen
    err = capsys.readouterr().err
    assert (said in err) if said else (err == "")


def test_where_the_workers_are_ours_to_choose_there_are_fewer(items, monkeypatch, capsys):
    monkeypatch.setattr("skyline_viz.running.batch.chosen_workers", lambda *_: 4)
    monkeypatch.setattr(sizes, "available", lambda: int(2.5 * needed(768, sizes.DETECTING) / SHARE))
    assert foresee(items, workers=0) == 2
    assert "so there are 2 workers and not 4." in capsys.readouterr().err
