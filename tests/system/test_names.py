"""Names that a file system allows, through everything that shows them."""

import ast
import os
import unicodedata
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from skyline_viz.cli import main
from skyline_viz.datasets.layouts import open_dataset
from skyline_viz.system import names
from skyline_viz.viewer.program.rerun_internals import program
from testing import ROOT, photo_files

PHOTO, ROWS = photo_files.scene(64, 96)

ODD = [
    "富士山",
    "hash#1",
    "new\nline",
    "emoji⛰",
    os.fsdecode(b"Z\xfcrich"),
    "\x1b]0;pwn\x07\x1b[31mx",
    "[red]a[b]",
    "<img src=x onerror=alert(1)>",
    "q?x%41&b=c",
    "-n",
    "rtl\u202egpj",
    "trail. ",
    "quo'te\"`$x$",
    "a" * 251,
    "Zu\u0308rich",
    "**b** _c_",
    "tab\tcr\r",
    "\u2028x",
]


def put(folder, name):
    folder.mkdir(parents=True, exist_ok=True)
    Image.fromarray(PHOTO).save(folder / f"{name}.png")


@given(st.text())
def test_nothing_that_a_terminal_obeys_is_printed(text):
    shown = names.printable(text)
    assert len(shown.splitlines()) <= 1
    shown.encode()
    for one in shown:
        assert unicodedata.category(one) not in ("Cc", "Cs", "Zl", "Zp")
        assert unicodedata.bidirectional(one) not in ("LRE", "RLE", "LRO", "RLO", "PDF", "RLI")
    assert names.printable(shown) == shown


@given(st.text(), st.integers(8, 60))
def test_a_name_in_a_table_has_a_limit(text, most):
    assert len(names.shortened(text, most)) <= most


@given(st.text(), st.text())
def test_identifiers_are_plain_and_tell_names_apart(one, other):
    assert names._PLAIN.fullmatch(names.recording_id(one))
    assert (names.recording_id(one) == names.recording_id(other)) == (one == other)


def fonts_of_the_viewer():
    """Characters of the fonts inside the viewer's program."""
    import io  # noqa: PLC0415
    import mmap  # noqa: PLC0415
    import struct  # noqa: PLC0415

    from fontTools.ttLib import TTFont  # noqa: PLC0415

    found = {}
    with program().open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        place = -1
        while (place := data.find(b"\0\1\0\0\0", place + 1)) >= 0:
            count = struct.unpack(">H", data[place + 4 : place + 6])[0]
            if not 8 < count < 40 or data[place + 12 : place + 16] not in (
                b"GDEF",
                b"DSIG",
                b"OS/2",
            ):
                continue
            entries = [
                struct.unpack(">4sIII", data[place + 12 + 16 * one : place + 28 + 16 * one])
                for one in range(count)
            ]
            end = max(start + length for _, _, start, length in entries)
            font = TTFont(io.BytesIO(data[place : place + end]), lazy=True)
            found[font["name"].getDebugName(4)] = set(font.getBestCmap())
    return found


def test_the_viewers_fonts_have_whatever_is_shown_in_it():
    fonts = fonts_of_the_viewer()
    assert len(fonts) >= 2
    shown = {code for code in range(0x20, 0x3000) if names.shown_in_viewer(chr(code)) == chr(code)}
    assert len(shown) > 600
    for name, characters in fonts.items():
        if "Mono" in name or "Inter" in name:
            assert {hex(code) for code in shown - characters} == set(), name


@given(st.text())
def test_what_is_not_in_the_fonts_becomes_an_escape(text):
    shown = names.shown_in_viewer(names.printable(text))
    assert not names._NOT_IN_FONTS.search(shown)
    shown.encode()


def calls(tree):
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            called = node.func
            owner = called.value.id if isinstance(getattr(called, "value", None), ast.Name) else ""
            yield owner, getattr(called, "attr", getattr(called, "id", "")), node.lineno


@pytest.mark.parametrize(
    "path",
    [
        path
        for package in ("skyline_viz", "annotate")
        for path in sorted((ROOT / package).rglob("*.py"))
    ],
    ids=lambda path: str(path.relative_to(ROOT)),
)
def test_names_are_shown_through_one_place(path):
    allowed = path.name in ("messages.py", "documents.py", "terminal.py")
    for owner, name, line in calls(ast.parse(path.read_text(encoding="utf-8"))):
        direct = (owner, name) in {("", "print"), ("console", "print"), ("rr", "TextDocument")}
        assert allowed or not direct, f"line {line} shows something past `names`"


def test_every_odd_name_goes_through_detect_evaluate_and_train(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ODD:
        put(Path("set/images"), name)
    mask = Image.fromarray(photo_mask())
    for name in ODD:
        Path("set/masks").mkdir(exist_ok=True)
        mask.save(Path("set/masks") / f"{name}.png")
    assert main(["detect", "set", "--out", "lines", "--overlay"]) == 0
    assert len(list(Path("lines").glob("*.csv"))) == len(ODD) + 1  # and the table of the run
    assert main(["evaluate", "set", "--out", "figures"]) == 0
    assert main(["diagnose", "set", "--out", "why", "--no-remedies"]) == 0
    assert main(["train", "set", "--out", "bank.npz"]) == 0
    said = capsys.readouterr()
    for line in (said.out + said.err).split("\n"):
        assert names.printable(line) == line
        assert not line.startswith("a" * 200)
    assert "names too long for those of outputs are cut" in said.err


def photo_mask():
    import numpy as np  # noqa: PLC0415

    return (np.arange(len(PHOTO))[:, None] >= ROWS).astype(np.uint8) * np.uint8(255)


def test_an_odd_option_is_said_without_its_escapes(capsys):
    assert main(["detect", "--bo\x1b[31mgus"]) == 2
    assert "\x1b[31mgus" not in capsys.readouterr().err


def test_a_stream_that_has_not_all_characters_gets_escapes(tmp_path, monkeypatch):
    import io  # noqa: PLC0415
    import sys  # noqa: PLC0415

    put(tmp_path / "in", "富士山")
    plain = io.TextIOWrapper(io.BytesIO(), encoding="ascii")
    monkeypatch.setattr(sys, "stdout", plain)
    assert main(["detect", str(tmp_path / "in"), "--out", str(tmp_path / "out")]) == 0
    plain.flush()
    assert b"\\u5bcc" in plain.buffer.getvalue()


def test_what_is_not_taken_is_said_at_the_end(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    put(Path("in"), "a")
    put(Path("in/sub"), "b")
    for name in ("x.nef", "y.CR2", "z.jxl", "notes.txt", ".hidden.nef"):
        (Path("in") / name).touch()
    (Path("in") / "link.png").symlink_to("a.png")
    assert main(["detect", "in", "--out", "out"]) == 0
    *_, unread = capsys.readouterr().err.strip().split("\n")
    assert "3 files are no photos that can be read: x.nef, y.CR2 (raw" in unread
    assert "z.jxl (JPEG XL)" in unread
    assert open_dataset("in").left_out == (unread[17:],)
    assert {file.stem for file in Path("out").glob("*.csv")} == {"a", "b", "link", "skylines"}


@pytest.mark.parametrize("workers", ["1", "2"])
def test_a_note_is_said_once_whatever_reads_the_photo(tmp_path, capsys, workers):
    for number in range(3):
        (tmp_path / "in").mkdir(exist_ok=True)
        photo_files.deep(12, "png")(tmp_path / "in" / f"{number}.png", PHOTO)
        Image.fromarray(photo_mask()).save(tmp_path / "in" / f"{number}-mask.png")
    assert main(["evaluate", str(tmp_path / "in"), "--folds", "3", "--workers", workers]) == 0
    said = capsys.readouterr().err
    for number in range(3):
        assert said.count(f"{number}.png has 16-bit values") == 1
