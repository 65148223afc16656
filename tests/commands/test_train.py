"""``skyline-viz train``: the bank that it writes, and what it says about it."""

import numpy as np
import pytest

import skyline_viz as sv
from testing.programs.commands import scene, write_scene, write_scenes


def test_train_writes_a_bank_and_tells_about_it(say, hills, tmp_path):
    status, out, err = say(
        "train", hills, "--out", "new/bank.npz", "--seed", "5", "--training.filter-size", "5"
    )
    assert (status, err) == (0, "")
    bank = sv.FilterBank.load(tmp_path / "new" / "bank.npz")
    assert (bank.size, bank.provenance.dataset) == (5, "hills")
    assert (bank.provenance.images, bank.provenance.seed) == (4, 5)
    size = (tmp_path / "new" / "bank.npz").stat().st_size
    for told in (
        "4 of 4 in hills",
        f"{bank.samples.sum():,}",
        f"{bank.starved.sum()} of 288 bins",
        f"{size:,} bytes",
    ):
        assert told in out


def test_the_same_seed_gives_the_same_bank_whatever_the_workers(say, hills, tmp_path):
    for name, workers in (("a", 1), ("b", 2)):
        assert say("train", hills, "--out", f"{name}.npz", "--workers", workers)[0] == 0
    banks = [sv.FilterBank.load(tmp_path / f"{name}.npz") for name in "ab"]
    np.testing.assert_array_equal(banks[0].filters, banks[1].filters)


def test_photos_without_truth_are_named_and_left_out(say, hills, tmp_path):
    root = tmp_path / "some"
    write_scene(root / "images" / "p0.png", 0)
    write_scene(root / "images" / "bare.png", 1)
    scene(0)[1].write_csv(root / "masks" / "p0.csv")
    scene(0)[1].write_csv(root / "masks" / "stray.csv")
    status, out, err = say("train", root, "--out", "b.npz")
    assert status == 0
    assert "1 of 2 in some" in out
    assert err.splitlines() == [
        "skyline-viz: some: masks/stray.csv has no photo.",
        "skyline-viz: left out, because there is no truth: bare.",
    ]


def test_training_goes_on_past_a_bad_photo(say, tmp_path):
    root = tmp_path / "some"
    write_scenes(root, 2)
    (root / "images" / "p0.png").write_bytes(b"no photo")
    status, out, err = say("train", root, "--out", "b.npz")
    assert status == 1
    assert "1 of 2" in out
    assert "p0.png" in err


def test_several_data_sets_are_learned_from_together(say, hills, tmp_path):
    write_scenes(tmp_path / "other", 3)
    status, out, err = say("train", hills, "other", "--out", "b.npz")
    assert (status, err) == (0, "")
    assert "7 of 7 in hills, other" in out
    bank = sv.FilterBank.load(tmp_path / "b.npz")
    sets = {one.name: list(one) for one in map(sv.open_dataset, (hills, tmp_path / "other"))}
    expected, _ = sv.evaluation.train_on_several(sets, sv.TrainingConfig())
    np.testing.assert_array_equal(bank.filters, expected.filters)
    assert bank.provenance == expected.provenance
    assert bank.provenance.dataset == "hills, other"
    for one in (hills, "other"):
        _, _, err = say("evaluate", one, "--bank", "b.npz")
        assert f"was trained on all {len(sv.open_dataset(one))} photos, so this is no test" in err


def test_a_bad_photo_of_several_data_sets_is_named_with_its_own(say, hills, tmp_path):
    write_scenes(tmp_path / "other", 2)
    (tmp_path / "other" / "images" / "p0.png").write_bytes(b"no photo")
    status, out, err = say("train", hills, "other", "--out", "b.npz")
    assert status == 1
    assert "5 of 6 in hills, other" in out
    assert "other/" in err


def test_a_data_set_is_named_once(say, hills, tmp_path):
    write_scenes(tmp_path / "there" / "hills", 2)
    for again in (hills, "there/hills"):
        status, _, err = say("train", hills, again, "--out", "b.npz")
        assert status == 2
        assert err == "skyline-viz: two data sets are called hills; rename a folder.\n"
    assert not (tmp_path / "b.npz").exists()


def test_the_published_method_learns_as_published(say, hills, tmp_path):
    ways = {"a": ("--preset", "paper"), "b": ("--method", "paper")}
    for name, way in ways.items():
        status, out, _ = say("train", hills, "--out", f"{name}.npz", *way)
        assert status == 0
        assert "reach 0, smoothness 100, pooling 50" in out
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()
    say("train", hills, "--out", "c.npz", "--method", "paper", "--training.pooling", "0")
    made = sv.FilterBank.load(tmp_path / "c.npz").provenance
    assert (made.reach, made.smoothness, made.pooling) == (0, 100, 0)


@pytest.mark.parametrize("reach", [1, 3])  # 3 is that of the default
def test_single_settings_change_those_of_a_named_method(say, hills, tmp_path, reach):
    named = ("--method", "paper:delta=2", f"--training.reach={reach}", "--out", "b.npz")
    assert say("train", hills, *named)[0] == 0
    made = sv.FilterBank.load(tmp_path / "b.npz").provenance
    published = sv.TrainingConfig.of(sv.DetectorConfig.paper())
    assert (made.reach, made.smoothness) == (reach, published.smoothness)
    assert sv.Detector.load(tmp_path / "b.npz").config.name == "paper:delta=2"


def test_a_cluster_is_for_our_filters(say, hills):
    words = ("train", hills, "--out", "b.npz", "--cluster", "local:2")
    status, _, err = say(*words, "--workers", "2")
    assert (status, err) == (
        2,
        "skyline-viz: --cluster is instead of --workers; leave one of them out.\n",
    )
    status, _, err = say(*words, "--method", "svm-dcsi")
    assert (status, err) == (
        2,
        "skyline-viz: --cluster is for our filters and sky models, not svm-dcsi.\n",
    )
