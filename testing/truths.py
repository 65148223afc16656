"""The sentence with which a picture is refused as a truth."""

import pytest

from skyline_viz.datasets.truths import read_truth
from skyline_viz.skyline import SkylineError


def said_about(path, **options):
    with pytest.raises(SkylineError) as caught:
        read_truth(path, **options)
    said = str(caught.value)
    assert said.startswith(str(path))
    assert said.endswith(".")
    assert len(said.splitlines()) == 1
    return said
