"""What a folder's own guideline says about labelling it, for the page to show in place of ours."""

from __future__ import annotations

from pathlib import Path

from skyline_viz.files import read_at_most

NAME = "GUIDELINE.md"
"""The file, beside the photos."""

MOST_BYTES = 200_000
"""Bytes that it may have."""


class GuidelineError(ValueError):
    """There is a guideline, but it cannot be shown; the message is one sentence that says why."""


def own_guideline(folder: Path) -> str | None:
    """The text of the guideline of a folder of photos; None where it has none.

    Raises:
        GuidelineError: It cannot be read, is too large, or is no text in UTF-8.
    """
    try:
        text = read_at_most(folder / NAME, MOST_BYTES).decode("utf-8-sig")
    except FileNotFoundError:
        return None
    except UnicodeError:
        raise GuidelineError(f"{NAME} is no text in UTF-8.") from None
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise GuidelineError(f"{NAME} cannot be read: {reason}.") from error
    return text if text.strip() else None
