"""Where two detections part, in words."""

from dataclasses import replace

from skyline_viz.diagnosis.parting import Part, Parting, Setting, Turn
from skyline_viz.viewer.parting_words import markdown, place, said

SKY = Part("sky", "stage", 0, 90, 0.0, only="default")
EDGES = Part("edges", "stage", 3, 40, -1.0, on_lines=(12, 13))
TERM = Part("clear sky", "term", 5, 60, 0.4, on_lines=(14,))
FOUND = Parting(
    names=("default", "a*b:delta=4"),
    parts=(SKY, EDGES, TERM),
    settings=(Setting("edge_source", "colour", "grey"),),
    apart=((10, 30),),
    distance=4.0,
    furthest=20.0,
    turns=(Turn("clear sky", 7.5, -2.0), Turn("link", 0.0, 0.0)),
    a_errs=(1.0, 6.5),
)


def test_a_sentence_has_the_columns_the_stage_and_the_term():
    assert said(FOUND) == ("lines apart at 10 to 30; part at edges, column 12; turned by clear sky")
    alike = Parting(("a", "b"), (), (), (), 0.0, 0.0)
    assert said(alike) == "all stages alike"
    assert said(replace(alike, parts=(TERM,))) == "part at clear sky cost, column 14, same line"


def test_a_place_is_on_the_lines_where_it_is_there():
    assert place(SKY) == "sky, which only default has"
    assert place(replace(EDGES, on_lines=())) == "edges, column 3"


def test_the_document_has_errors_terms_settings_and_stages():
    text = markdown(FOUND)
    assert text.startswith(r"**a\*b:delta=4** (yellow) against **default** (magenta)")
    assert "1.00 px" in text
    assert "+5.50 px" in text
    lines = text.splitlines()
    assert "| clear sky | +7.5 | -2.0 | -9.5 |" in lines
    assert not any(line.startswith("| link") for line in lines)  # nobody pays more for it
    assert r"| edge\_source | colour | grey |" in lines
    assert "| edges | 3 | 40 | 2 |  |" in lines
    assert "| sky | only default has it |  |  |  |" in lines


def test_a_document_of_equal_detections_has_no_table():
    text = markdown(Parting(("a", "b"), (), (), (), 0.0, 0.0))
    assert "nowhere: all stages are alike." in text
    assert "|" not in text


def test_names_are_no_markup():
    assert "<b>" not in markdown(replace(FOUND, names=("<b>", "c")))
