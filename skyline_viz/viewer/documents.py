"""Texts in recordings: every one that the viewer shows is made here."""

import rerun as rr

from skyline_viz.system.names import shown_in_viewer


def markdown_document(text: str) -> rr.TextDocument:
    """A document in Markdown of which the viewer's fonts have every character."""
    return rr.TextDocument(shown_in_viewer(text), media_type="text/markdown")
