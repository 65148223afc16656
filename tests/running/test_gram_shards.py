"""Shards of a training: the bank of one process to the bit, and what does not fit is refused."""

import pytest

from skyline_viz.running.gram_shards import joined
from skyline_viz.running.line_table import TableError
from skyline_viz.running.shards import Shard
from skyline_viz.system.headed_npz import opened, packed


@pytest.mark.parametrize("of", [1, 8])
def test_shards_give_the_very_bank_of_one_process(say, hills, tmp_path, of):
    assert say("train", hills, "--out", "whole.npz")[0] == 0
    for number in range(1, of + 1):
        assert say("train", hills, "--out", "parts", "--shard", f"{number}/{of}")[0] == 0
    status, out, err = say("join", "parts", "--out", "joined.npz")
    assert (status, err) == (0, "")
    assert "photos used" in out
    assert (tmp_path / "joined.npz").read_bytes() == (tmp_path / "whole.npz").read_bytes()


def test_what_does_not_fit_is_refused(say, hills, tmp_path):
    for number, seed in ((1, 0), (2, 1)):
        words = ("--shard", f"{number}/2", "--seed", seed)
        assert say("train", hills, "--out", "parts", *words)[0] == 0
    two = tmp_path / "parts" / Shard(2, 2).file_of(".npz")
    with pytest.raises(TableError, match="was gathered otherwise, or from others, than"):
        joined(tmp_path / "parts")
    two.write_bytes(two.read_bytes()[:2000])
    with pytest.raises(TableError, match="is damaged, or no shard of a training"):
        joined(tmp_path / "parts")
    two.unlink()
    assert say("join", "parts", "--out", "b.npz")[2] == (
        "skyline-viz: parts lacks the shard 2/2.\n"
    )
    assert say("train", hills, "--out", "parts", "--shard", "3/2")[0] == 2


def test_a_shard_by_the_name_of_another_is_refused(say, hills, tmp_path):
    for number in (1, 2):
        assert say("train", hills, "--out", "parts", "--shard", f"{number}/2")[0] == 0
    one, two = (tmp_path / "parts" / Shard(number, 2).file_of(".npz") for number in (1, 2))
    own = one.read_bytes()
    one.write_bytes(two.read_bytes())
    said = "skyline-viz: parts/shard-00001-of-00002.npz holds the shard 2/2, and by its name it is "
    assert say("join", "parts", "--out", "b.npz") == (2, "", f"{said}1/2.\n")
    assert not (tmp_path / "b.npz").exists()
    with opened(own) as file:
        header = {"gathered": file.header["gathered"]}
        arrays = {name: file.read(name) for name in file.arrays}
    one.write_bytes(packed(header, arrays))
    with pytest.raises(TableError, match="is a shard of another version, and has to be made again"):
        joined(tmp_path / "parts")
