"""``skyline-viz join``: what it refuses; that shards come together, `test_to_table` tells."""

import pytest

from skyline_viz.running.line_table import write_lines
from skyline_viz.running.shards import Shard


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("gone", "--out", "t.parquet"), "gone is no folder of shards."),
        (
            ("parts", "--out", "t.csv"),
            "name a file that ends in .parquet for a table, or in .npz for a detector, not t.csv.",
        ),
        (("parts", "--out", "t.parquet"), "parts holds no shards, shard-00001-of-0000N.parquet"),
    ],
)
def test_what_cannot_be_joined_is_said(say, tmp_path, words, said):
    (tmp_path / "parts").mkdir()
    status, out, err = say("join", *words)
    assert (status, out) == (2, "")
    assert err.startswith(f"skyline-viz: {said}")


def test_a_missing_shard_is_named_and_nothing_is_written(say, tmp_path):
    write_lines(tmp_path / "parts" / Shard(1, 2).file, [], {"digest": "d"})
    status, _, err = say("join", "parts", "--out", "t.parquet")
    assert (status, err) == (2, "skyline-viz: parts lacks the shard 2/2.\n")
    assert not (tmp_path / "t.parquet").exists()
