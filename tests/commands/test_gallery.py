"""``skyline-viz gallery`` on the command line, without a viewer."""

import json

import numpy as np
import pytest

import skyline_viz as sv


@pytest.fixture
def hills(tmp_path):
    for number in range(5):
        photo = np.full((50, 60, 3), 200, np.uint8)
        photo[20 + number :] = 60
        sv.write_photo(tmp_path / "hills" / "images" / f"h{number}.png", photo)
        sv.Skyline(np.full(60, 21.0)).write_csv(tmp_path / "hills" / "masks" / f"h{number}.csv")
    return tmp_path / "hills"


def test_a_cause_that_there_is_not(say, hills, tmp_path):
    words = ["gallery", hills, "--out", "g", "--screenshot", "a.png", "--cause"]
    status, out, err = say(*words, "fog")
    assert (status, out) == (2, "")
    assert "invalid choice 'fog'" in err
    assert not (tmp_path / "g").exists()
    status, _, err = say(*words, "starved bin")
    assert status == 1
    assert err == "skyline-viz: none of 5 photos with a truth has the cause starved bin.\n"
    assert not (tmp_path / "a.png").exists()
    assert len(json.loads((tmp_path / "g" / "gallery.json").read_text())["photos"]) == 5
