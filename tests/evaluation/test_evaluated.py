"""What an evaluation says of itself, in a terminal and in a notebook."""

import pytest

from skyline_viz.evaluation.evaluated import Evaluation
from skyline_viz.running.batch import Failure
from testing.detections import result


@pytest.fixture
def found():
    results = {"default": [result("a", 1.0), result("b", 3.0)], "<b>": []}
    return Evaluation(results, (Failure("c & d", "it is <gone>"),), fold_of={"a": 0, "b": 1})


def test_each_method_has_a_summary(found):
    assert {name: one.photos for name, one in found.summaries.items()} == {"default": 2, "<b>": 0}
    assert found.summaries["default"].mean == 2.0


def test_printed_it_is_a_table_with_what_failed_below(found):
    lines = str(found).splitlines()
    assert lines[0].split()[:3] == ["method", "mean", "st."]
    assert lines[1].split()[:4] == ["default", "2.00", "1.00", "2.00"]
    assert lines[2].split() == ["<b>", *"-" * 9]
    assert lines[3:] == ["c & d: it is <gone>."]


def test_in_a_notebook_nothing_in_a_name_is_taken_for_html(found):
    page = found._repr_html_()
    assert page.count("<tr>") == 3
    assert "&lt;b&gt;" in page
    assert "c &amp; d: it is &lt;gone&gt;." in page
    assert "<b>" not in page
