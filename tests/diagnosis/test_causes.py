"""The causes of a wrong skyline, by name."""

from skyline_viz.diagnosis import diagnosing
from skyline_viz.diagnosis.causes import CAUSES
from testing.injected import MAKERS


def test_each_is_explained_and_can_be_made_on_purpose():
    explained = diagnosing.__doc__
    for cause in CAUSES:
        assert f"\n{cause} " in explained
    assert set(MAKERS) == set(CAUSES)
