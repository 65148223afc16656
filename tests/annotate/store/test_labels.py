"""What is known about a photo that has been labelled, and names of annotators."""

import numpy as np
import pytest

from annotate.store.labels import LONGEST_NAME, STATUSES, Label, check_annotator
from skyline_viz.skyline import Skyline

WHOLE = {
    "name": "a.png",
    "digest": "",
    "width": 3,
    "height": 9,
    "annotator": "ann",
    "number": 1,
    "status": "accepted",
    "tags": (),
    "skyline": Skyline([1, 2, 3]),
    "origin": np.zeros(3, np.uint8),
    "operations": (),
    "seconds": 0.0,
    "detector": "",
    "blind": False,
}


def test_names_are_plain_text():
    assert check_annotator("Änne B.") == "Änne B."
    for name, reason in (
        (" ", "needs a name"),
        ("x" * (LONGEST_NAME + 1), "at most 80 characters"),
        ("a/b", "without slashes"),
        ("a\nb", "plain text"),
    ):
        with pytest.raises(ValueError, match=reason):
            check_annotator(name)


@pytest.mark.parametrize("status", STATUSES)
def test_a_label_is_frozen_down_to_its_origins(status):
    label = Label(**{**WHOLE, "status": status, "origin": np.zeros(3, np.uint8)})
    with pytest.raises(ValueError, match="read-only"):
        label.origin[0] = 1


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"status": "done"}, "the status of 'a.png' is 'done', which is none"),
        ({"skyline": Skyline([1, 2])}, "has 3 columns, its skyline 2"),
        ({"origin": np.zeros(4, np.uint8)}, "has 3 columns, and as many origins"),
    ],
)
def test_what_does_not_fit_is_refused(changes, reason):
    with pytest.raises(ValueError, match=reason):
        Label(**{**WHOLE, **changes})
