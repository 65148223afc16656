"""The causes of a wrong skyline, by name."""

from typing import get_args

from skyline_viz.cost import TERMS as OURS
from skyline_viz.diagnosis import diagnosing, places
from skyline_viz.diagnosis.causes import CAUSES, PLACES, TERMS, Preferring
from testing.detections import WITHOUT_SKY, lines_in_the_sky
from testing.injected import MAKERS, PLACE_MAKERS


def test_each_is_explained_and_can_be_made_on_purpose():
    explained = diagnosing.__doc__
    for cause in CAUSES:
        assert f"\n{cause} " in explained
    assert set(MAKERS) == set(CAUSES)


def test_each_place_is_explained_and_can_be_painted():
    for place in PLACES:
        assert f"\n{place} " in places.__doc__
    assert set(PLACE_MAKERS) == set(PLACES)


def test_terms_are_named_as_the_cost_names_them():
    photo, _ = lines_in_the_sky(1)
    model = WITHOUT_SKY.detect(photo).cost_model
    assert [term.name for term in model.terms] == list(get_args(Preferring))
    assert len(model.nodal) == len(OURS)
    assert set(TERMS.values()) <= set(get_args(Preferring))
