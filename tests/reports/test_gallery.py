"""A data set as a folder of pages."""

import re

import pytest

from skyline_viz.evaluation.tasks import photo_tasks
from skyline_viz.reports.gallery import INDEX, write_gallery
from testing.detections import WITHOUT_SKY, write_slanting


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pages")
    items = write_slanting(folder / "hills")
    items[4].photo_path.write_bytes(b"no photo")
    tasks = photo_tasks([(item, WITHOUT_SKY) for item in items])
    tags = {"p0": ["near <lake>"]}
    found, failures = write_gallery(folder / "out", "hills", "default", tasks, tags=tags)
    return folder / "out", found, failures


def test_each_photo_has_a_page_and_a_thumbnail(written):
    folder, found, failures = written
    assert [one.name for one in found] == ["p0", "p1", "p2", "p3"]
    assert [one.name for one in failures] == ["p4"]
    text = (folder / INDEX).read_text()
    for one in found:
        assert f'href="pages/{one.name}.html"' in text
        assert one.photo.address == f"thumbnails/{one.name}.webp"
        assert (folder / one.photo.address).read_bytes()[8:12] == b"WEBP"
        page = (folder / "pages" / f"{one.name}.html").read_text()
        assert 'href="../index.html"' in page
        assert page.count("data:image/webp") > len(one.stages)
    assert "p4" in text


def test_the_cards_are_small_and_their_pictures_are_loaded_when_seen(written):
    text = (written[0] / INDEX).read_text()
    assert "data:image" not in text
    assert len(re.findall(r"<img[^>]*loading=\"lazy\"", text)) == len(written[1])
    assert len(text) < 100_000


def test_cards_have_tags_of_people_and_of_the_detection(written):
    text = (written[0] / INDEX).read_text()
    assert "near &lt;lake&gt;" in text
    assert "<lake>" not in text
    gross = [one for one in written[1] if one.verdict.gross_miss]
    assert all("gross miss" in one.tags for one in gross)
