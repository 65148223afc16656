"""``skyline-viz gallery --html``: pages for any browser, and no display."""

import pytest

from skyline_viz.gallery.flags import Change, change_flags
from skyline_viz.system.loopback import LOOPBACK
from testing.programs.commands import write_flat


@pytest.fixture
def hills(tmp_path):
    return write_flat(tmp_path / "hills", 3)


def test_pages_are_written_with_what_was_said_before(say, hills, tmp_path):
    (tmp_path / "g").mkdir()
    change_flags(tmp_path / "g", {"h1": Change(True)})
    (hills / "images" / "h2.png").write_bytes(b"no photo")
    status, out, err = say("gallery", hills, "--html", "out", "--out", "g")
    assert status == 1
    assert "h2.png" in err
    assert out == "2 photos; open out/index.html in a browser\n"
    assert {file.name for file in (tmp_path / "out" / "pages").iterdir()} == {"h0.html", "h1.html"}
    text = (tmp_path / "out" / "index.html").read_text()
    assert 'data-tags="reviewed"' in text
    assert "h2.png" in text
    assert LOOPBACK not in text


def test_photos_of_several_folders_are_chosen_by_folder(say, hills, tmp_path):
    write_flat(tmp_path / "more", 1)
    photos = [hills / "images" / "h0.png", tmp_path / "more" / "images" / "h0.png"]
    assert say("gallery", *photos, "--html", "out")[0] == 0
    text = (tmp_path / "out" / "index.html").read_text()
    for tag in ("hills/images", "more/images"):
        assert f"<option>{tag}</option>" in text


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--html", "out", "--serve"], "--serve and --html exclude each other."),
        (["--html", "out", "--cause", "haze"], "the page of --html has a filter for it."),
        (["--html", "out", "--method", "default", "paper"], "--html shows one method, and 2 are"),
        (["--html", "site"], "site holds another page index.html; choose another folder"),
        (["--html", "hills/images"], "would be taken for the truth of the photos"),
        ([], "there is no display to open the viewer on; --html DIR writes pages"),
    ],
)
def test_what_is_refused(say, hills, tmp_path, monkeypatch, words, reason):
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "site").mkdir()
    (tmp_path / "site" / "index.html").touch()
    status, out, err = say("gallery", hills, *words)
    assert (status, out) == (2, "")
    assert reason in err
    assert not (tmp_path / "skyline-gallery").exists()
