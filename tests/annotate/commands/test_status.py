"""``skyline-annotate status``: what it says."""

import re

import pytest

from annotate.store.operations import SetStatus
from testing.labelling import workbench, write_hills
from testing.labels import label, run


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


def test_status_is_a_table(folder, capsys):
    label(folder)
    assert run("status", folder) == 0
    out = capsys.readouterr().out
    assert "3 photos" in out
    row = next(line for line in out.splitlines() if line.startswith("ann "))
    assert re.split(r"\s{2,}", row.strip())[:5] == ["ann", "1", "1", "0", "2"]


def test_what_was_said_of_photos_is_listed(folder, capsys):
    label(folder, photos=1)
    bench = workbench(folder, reviewer="eve")
    bench.session(2).apply(SetStatus(status="needs review", comment="the hut is cut off"), -1)
    bench.session(3).apply(SetStatus(status="rejected"), -1)
    bench.close()
    assert run("status", folder, "--review") == 0
    assert capsys.readouterr().out.splitlines()[-2:] == [
        "hill-1.png (ann): needs review, eve: the hut is cut off",
        "hill-2.png (ann): rejected",
    ]
    assert run("status", folder) == 0
    assert "hut" not in capsys.readouterr().out
