"""Settings of an earlier run, as ``--config FILE`` takes them."""

import json
from dataclasses import asdict

import pytest

import skyline_viz as sv
from skyline_viz.command_line.earlier_run import earlier
from skyline_viz.command_line.messages import UsageError


def document(path, *, bank=None, sky="small", bank_file=None, **settings):
    config = sv.DetectorConfig(**settings)
    known = {"config": asdict(config), "bank": bank, "sky": sky}
    told = {"settings": {config.name: known}, "bank_file": bank_file}
    path.write_text(json.dumps(told))
    return path


def test_settings_come_back(tmp_path):
    found = earlier(document(tmp_path / "run.json", delta=7, v=0.25))
    assert found.config == sv.DetectorConfig(delta=7, v=0.25)
    assert (found.bank, found.sky) == (None, None)
    assert earlier(document(tmp_path / "run.json", sky="large")).sky == "large"


def test_the_shipped_bank_need_not_be_named(tmp_path):
    shipped = asdict(sv.FilterBank.default().provenance)
    assert earlier(document(tmp_path / "run.json", bank=shipped)).bank is None


def test_another_bank_is_its_file_or_must_be_named(tmp_path):
    other = asdict(sv.FilterBank.default().provenance) | {"dataset": "hills"}
    found = earlier(document(tmp_path / "run.json", bank=other, bank_file="b.npz"))
    assert str(found.bank) == "b.npz"
    path = document(tmp_path / "run.json", bank=other)
    with pytest.raises(UsageError, match="trained on hills, which it does not hold"):
        earlier(path)
    assert earlier(path, with_bank=False).bank is None


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("{", "is no JSON"),
        ("[1]", "holds no settings of a detector"),
        ("{}", "holds no settings of a detector"),
        ('{"settings": {"a": {}, "b": {}}}', "settings of several methods, a, b"),
        ('{"settings": {"edges": {}}}', "is of edges, whose settings --method edges gives"),
        ('{"settings": {"a": {"config": 3}}}', "holds no settings of a detector"),
        ('{"settings": {"a": {"config": {"depth": 3}}}}', "settings that there are not: depth"),
        ('{"settings": {"a": {"config": {"v": 3}}}}', "refused: v is a number from 0 to 1"),
    ],
)
def test_other_files_are_refused_with_a_sentence(tmp_path, content, told):
    path = tmp_path / "run.json"
    path.write_text(content)
    with pytest.raises(UsageError, match=told) as caught:
        earlier(path)
    assert "run.json" in str(caught.value)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(UsageError, match=r"gone\.json cannot be read: no such file"):
        earlier(tmp_path / "gone.json")
