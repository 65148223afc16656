"""The table of a run: what was found in each photo."""

import csv
import hashlib
from pathlib import Path

from skyline_viz.running.photo_table import (
    HEADER,
    TABLE,
    PhotoRow,
    digest_of_content,
    is_table,
    look_first,
    write_table,
)


def test_the_table_has_a_line_a_photo(tmp_path):
    rows = [
        PhotoRow(
            "a",
            Path("in/a.png"),
            "ab",
            size=(64, 96),
            confidence=0.98765,
            case="skyline",
            least_sure=((40, 52), (7, 7)),
            seconds=0.5,
        ),
        PhotoRow("b", Path("b, c.png"), error="it is empty."),
    ]
    write_table(tmp_path / TABLE, rows)
    with (tmp_path / TABLE).open(newline="") as file:
        read = list(csv.reader(file))
    assert read[0] == list(HEADER)
    assert read[1] == [
        "a", "in/a.png", "ab", "96", "64", "0.9877", "skyline", "40 to 52; 7", "0.5000", "",
    ]  # fmt: skip
    assert read[2] == ["b", "b, c.png", "", "", "", "", "", "", "", "it is empty."]


def test_a_table_is_told_from_the_skyline_of_a_photo(tmp_path):
    write_table(tmp_path / TABLE, [])
    assert is_table(tmp_path / TABLE)
    (tmp_path / TABLE).write_text("column,row,visible\n0,3,1\n")
    assert not is_table(tmp_path / TABLE)
    assert not is_table(tmp_path / "gone" / TABLE)
    write_table(tmp_path / "other.csv", [])
    assert not is_table(tmp_path / "other.csv")


def test_the_least_sure_are_looked_at_first():
    rows = [PhotoRow(str(n), Path("x"), confidence=1 - n / 100) for n in range(40)]
    rows.append(PhotoRow("failed", Path("x"), error="gone."))
    assert [row.name for row in look_first(rows)] == ["39", "38", "37", "36", "35"]
    assert len(look_first(rows[:10])) == 2
    assert len(look_first(rows[:2])) == 1
    assert look_first(rows[40:]) == []


def test_the_digest_is_of_the_content(tmp_path):
    (tmp_path / "a").write_bytes(b"abc")
    assert digest_of_content(tmp_path / "a") == hashlib.sha256(b"abc").hexdigest()
    assert digest_of_content(tmp_path / "gone") == ""
    assert digest_of_content(tmp_path) == ""
