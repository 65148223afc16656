"""Texts of the viewer."""

from skyline_viz.viewer.documents import markdown_document


def test_a_text_is_markdown_of_characters_that_the_viewer_has():
    document = markdown_document("**Größe** 3 px \U0001f3d4")
    (text,) = document.text.as_arrow_array().to_pylist()
    (kind,) = document.media_type.as_arrow_array().to_pylist()
    assert kind == "text/markdown"
    assert text.startswith("**Größe** 3 px ")
    assert "\U0001f3d4" not in text
    assert "1f3d4" in text.lower()
