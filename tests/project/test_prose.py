"""The docs are easy to read: short sentences, few semicolons, and the field's own words."""

import re

import pytest

from testing import ROOT

PAGES = [
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
    *sorted((ROOT / "docs").glob("*.md")),
    *sorted((ROOT / "docs" / "api").glob("*.md")),
]
LONGEST_MEAN = 18.0
"""Words of a sentence, on average over a page."""

MOST_SEMICOLONS = 4.0
"""In a thousand words."""


def prose(page: str) -> list[str]:
    """Paragraphs and list items of a page of Markdown, less code, tables, headings and pictures."""
    page = re.sub(r"^```.*?^```", "\n\n", page, flags=re.DOTALL | re.MULTILINE)
    page = re.sub(r"^:::.*(?:\n(?: .*)?)*?(?=\n\S|\Z)", "\n", page, flags=re.MULTILINE)
    page = re.sub(r"\$\$.*?\$\$", "\n\n", page, flags=re.DOTALL)
    page = re.sub(r"<!--.*?-->|!\[[^\]]*\]\([^)]*\)", "", page, flags=re.DOTALL)
    page = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", page)
    page = re.sub(r"`[^`]+`|\$[^$]+\$", "code", page)
    page = re.sub(r"^(\|.*|#+ .*|\[.*)$", "", page, flags=re.MULTILINE)
    page = re.sub(r"^ *(?:[-*]|\d+\.) ", "\n\n", page, flags=re.MULTILINE)
    blocks = (" ".join(block.split()) for block in re.split(r"\n\s*\n", page))
    return [block for block in blocks if block]


def sentences(page: str) -> list[str]:
    """Sentences of the prose of a page; a paragraph or list item ends the last one in it."""
    ends = re.compile(r"(?<=[.!?])[)*\"']*\s+(?=[(*\"']*[A-Z0-9]|code)")
    found = [sentence for block in prose(page) for sentence in ends.split(block)]
    return [sentence for sentence in found if words(sentence)]


def words(text: str) -> list[str]:
    """Whatever stands between spaces and holds a letter or a digit."""
    return [word for word in text.split() if re.search(r"\w", word)]


@pytest.mark.parametrize(
    ("page", "lengths"),
    [
        ("Two words. Three more words! Is it? Yes.", [2, 3, 2, 1]),
        ("# A heading\n\n| a | table |\n\nOne [link](to/it.md), `some code`.\n", [3]),
        ("- an item\n- another\n  item, which goes on. A new one.\n", [2, 5, 3]),
        ("```\ncode. Code.\n```\n\n$$\nx^2\n$$\n\n![A picture](a.jpg)\n", []),
        ("::: skyline_viz.Detector\n    options:\n      members: [a]\n\nText of 4.2 px.\n", [4]),
    ],
)
def test_sentences_are_counted(page, lengths):
    assert [len(words(sentence)) for sentence in sentences(page)] == lengths


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_sentences_are_short(page):
    found = sentences(page.read_text())
    mean = sum(len(words(sentence)) for sentence in found) / max(len(found), 1)
    longest = sorted(found, key=lambda sentence: -len(words(sentence)))[:5]
    assert mean < LONGEST_MEAN, f"mean {mean:.1f} words; the longest:\n" + "\n".join(longest)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_semicolons_are_few(page):
    text = " ".join(prose(page.read_text()))
    assert 1000 * text.count(";") <= MOST_SEMICOLONS * max(len(words(text)), 250)


@pytest.mark.parametrize("term", ["ground truth", "confidence", "uncertainty", "inference"])
def test_the_standard_terms_of_the_field_stand_beside_ours(term):
    assert term in (ROOT / "docs" / "method.md").read_text().lower()


if __name__ == "__main__":
    for path in PAGES:
        said = sentences(path.read_text())
        count = sum(len(words(sentence)) for sentence in said)
        semis = 1000 * " ".join(prose(path.read_text())).count(";") / max(count, 1)
        print(f"{path.name:20} {len(said):4} {count / max(len(said), 1):5.1f} {semis:5.1f}")
