"""``skyline-annotate``: what its commands say and do."""

import pytest

from skyline_viz import __version__
from testing.labelling import write_hills
from testing.labels import label, run


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


def test_help_and_version(capsys):
    assert run("--version") == 0
    assert capsys.readouterr().out == f"skyline-annotate {__version__}\n"
    for words in (
        [],
        ["open"],
        ["export"],
        ["import"],
        ["status"],
        ["agreement"],
        ["consensus"],
        ["backup"],
        ["repair"],
    ):
        assert run(*words, "--help") == 0
        assert "usage: skyline-annotate" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["open", "nowhere"], "nowhere does not exist."),
        (["open", "empty"], "empty holds no photograph."),
        (["open", "alps", "--blind", "2"], "--blind is a share from 0 to 1, not 2.0."),
        (["open", "alps", "--pass-number", "0"], "there is no pass 0."),
        (["open", "alps", "--port", "99999"], "there is no port 99999."),
        (["open", "alps", "--host", "192.0.2.1"], "cannot listen on 192.0.2.1"),
        (["open", "alps", "--allow-host", "http://lab"], "takes the name of a machine, such as"),
        (["open", "alps", "--annotator", "a", "--annotator", "a"], "a is named twice."),
        (["open", "alps", "--bank", "nothing.npz"], "nothing.npz does not exist."),
        (["status", "empty"], "empty has no labels yet"),
        (["export", "empty"], "empty has no labels yet"),
        (["export", "done", "--out", "alps"], "alps exists already"),
        (["export", "done", "--annotator", "eve"], "there is no such pass; there are ann 1."),
        (["import", "alps", "nowhere"], "nowhere does not exist."),
        (["import", "alps", "empty"], "empty is of no known format"),
        (["import", "empty", "alps"], "empty holds no photograph."),
        (["agreement", "done"], "with accepted photos: ann:1."),
        (["consensus", "done"], "made of two passes at least, and there is ann alone."),
        (["consensus", "done", "--within", "-1"], "--within is a number of pixels from 0 on"),
        (["consensus", "done", "--passes", "eve"], "there is no pass eve; there are ann:1."),
        (
            ["open", "alps", "--reviewer", "a/b"],
            "an annotator's name is plain text without slashes",
        ),
        (["agreement", "done", "--picture", "x.gif"], "should end in .png or .jpg."),
        (["backup", "empty"], "empty has no labels to back up."),
    ],
)
def test_what_is_wrong_is_one_sentence(words, sentence, folder, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    label(write_hills(tmp_path / "done"), photos=1)
    assert run(*words) in (1, 2)
    err = capsys.readouterr().err
    assert sentence in err
    assert err.count("\n") == 1
    assert err.startswith("skyline-annotate: ")
