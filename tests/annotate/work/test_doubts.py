"""Truths that a diagnosis doubts, opened where they are doubtful."""

import json

import pytest

from annotate.store.store import Store
from annotate.work.doubts import read_doubts
from annotate.work.shared_photos import SharedPhotos
from annotate.work.workbench import Assignment, Workbench
from testing.labelling import DETECTOR, write_hills
from testing.labels import run


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


def test_doubtful_truths_are_opened_where_they_are_doubtful(folder, tmp_path, capsys):
    segments = [
        {"cause": "truth doubtful", "columns": [3, 6]},
        {"cause": "truth doubtful", "columns": [20, 40]},
        {"cause": "missed edge", "columns": [0, 69]},
    ]
    photos = [
        {"name": "hill-1", "segments": segments},
        {"name": "hill-2", "segments": segments[2:]},
    ]
    document = {"format": "skyline-diagnosis", "version": 1, "photos": photos}
    file = tmp_path / "diagnosis.json"
    file.write_text(json.dumps(document))
    bench = Workbench(SharedPhotos(Store(folder), read_doubts(file)), DETECTOR, Assignment("ann"))
    assert [photo.name for photo in bench.photos.values()] == ["hill-1.png"]
    assert list(bench.doubts.values()) == [30]
    assert [card.photo.name for card in bench.cards()] == ["hill-1.png"]
    bench.close()
    file.write_text(json.dumps({**document, "photos": photos[1:]}))
    assert run("open", folder, "--from-diagnosis", file) == 2
    assert "has the cause truth doubtful of no photo" in capsys.readouterr().err


def test_photos_with_any_cause_place_or_term_are_opened(folder, tmp_path, capsys):
    titles = ["cheaper path by clear sky, haze", "cheaper path by sky, haze", "missed edge, wire"]
    photos = [
        {"name": f"hill-{at}", "segments": [{"cause": "x", "title": title, "columns": [4, 8 * at]}]}
        for at, title in enumerate(titles, start=1)
    ]
    document = {"format": "skyline-diagnosis", "version": 1, "photos": photos}
    file = tmp_path / "diagnosis.json"
    file.write_text(json.dumps(document))
    assert read_doubts(file, "haze") == {"hill-1": 6, "hill-2": 10}
    assert read_doubts(file, "sky") == {"hill-2": 10}
    assert read_doubts(file, "missed edge") == {"hill-3": 14}
    assert run("open", folder, "--from-diagnosis", file, "--cause", "snow") == 2
    assert "has the cause snow of no photo" in capsys.readouterr().err
    assert run("open", folder, "--cause", "snow") == 2
    assert "--from-diagnosis FILE names it" in capsys.readouterr().err


def diagnosis_with(columns, name="hill-1", version=1):
    """A diagnosis that doubts a truth, as text."""
    return (
        f'{{"format": "skyline-diagnosis", "version": {version}, "photos": [{{"name": "{name}", '
        f'"segments": [{{"cause": "truth doubtful", "columns": {columns}}}]}}]}}'
    )


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{}", "holds no diagnosis"),
        ("[]", "holds no diagnosis"),
        ("{", "holds no diagnosis: it is not JSON"),
        ("\udc80", "holds no diagnosis: it is not JSON"),
        ("[" * 100_000, "holds no diagnosis: it is not JSON"),
        (diagnosis_with("[1e400, 5]"), "holds a diagnosis that is damaged"),
        (diagnosis_with('["a", "b"]'), "holds a diagnosis that is damaged"),
        (diagnosis_with('{"a": 1}'), "holds a diagnosis that is damaged"),
        (diagnosis_with("[]"), "holds a diagnosis that is damaged"),
        ('{"format": "skyline-diagnosis", "version": 1}', "holds a diagnosis that is damaged"),
        (
            diagnosis_with("[1, 2]", version=99),
            "is not a diagnosis of version 1, the only one known",
        ),
    ],
)
def test_a_broken_diagnosis_is_one_plain_sentence(text, said, folder, tmp_path, capsys):
    file = tmp_path / "diagnosis.json"
    file.write_text(text, errors="surrogateescape")
    assert run("open", folder, "--from-diagnosis", file) == 2
    assert capsys.readouterr().err == f"skyline-annotate: {file} {said}.\n"


def test_a_diagnosis_that_is_not_there_is_said_not_to_exist(folder, tmp_path, capsys):
    file = tmp_path / "diagnosis.json"
    assert run("open", folder, "--from-diagnosis", file) == 2
    assert capsys.readouterr().err == f"skyline-annotate: {file} does not exist.\n"


def test_doubtful_columns_beyond_the_rims_are_the_rims(folder, tmp_path):
    file = tmp_path / "diagnosis.json"
    for columns, opened in (("[-50, -10]", 0), ("[5000, 6000]", 69)):
        file.write_text(diagnosis_with(columns))
        bench = Workbench(
            SharedPhotos(Store(folder), read_doubts(file)), DETECTOR, Assignment("ann")
        )
        assert list(bench.doubts.values()) == [opened]
        bench.close()
