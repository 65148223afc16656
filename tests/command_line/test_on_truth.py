"""First steps of commands that test on photos with truth: what they refuse before any work."""

import pytest

import skyline_viz as sv
from skyline_viz.command_line.messages import UsageError
from skyline_viz.command_line.on_truth import OnTruth
from testing.detections import write_slanting


@pytest.fixture
def root(tmp_path):
    write_slanting(tmp_path / "hills", 2)
    return tmp_path / "hills"


def test_photos_with_truth_are_opened_and_outputs_have_a_place(root, tmp_path):
    options = OnTruth(root, workers=1)
    dataset, items = options.open()
    assert [item.name for item in items] == ["p0", "p1"]
    workers, kept = options.begin("evaluate", dataset, items, tmp_path / "out")
    assert workers == 1
    assert kept.folder == tmp_path / "out" / "unfinished" / "evaluate"
    assert (tmp_path / "out").is_dir()
    assert options.begin("evaluate", dataset, items, None)[1].folder is None


def test_outputs_are_not_put_among_photos_not_even_those_without_truth(root):
    bare = root / "images" / "bare.png"
    sv.write_photo(bare, sv.read_photo(root / "images" / "p0.png"))
    dataset, items = OnTruth(root).open()
    assert (len(dataset), len(items)) == (3, 2)
    with pytest.raises(UsageError, match="would be taken for the truth"):
        OnTruth(root).begin("evaluate", dataset, items, root / "images")


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"seed": -1}, "a seed is 0 or more, not -1"),
        ({"seed": 4}, "--seed is that of a cross-validation, and --folds asks for none"),
    ],
)
def test_options_that_contradict_each_other_are_a_sentence(root, options, says):
    with pytest.raises(UsageError, match=says):
        OnTruth(root, **options).open()
