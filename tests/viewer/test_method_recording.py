"""Methods side by side in a recording."""

import json

import pytest

import skyline_viz as sv
from skyline_viz.cli import main
from skyline_viz.command_line.inputs import collect
from skyline_viz.commands.gallery import build
from skyline_viz.diagnosis.parting import parting
from skyline_viz.gallery.store import Gallery
from skyline_viz.methods.registry import make_method
from skyline_viz.viewer import entities
from skyline_viz.viewer.method_recording import COLOURS
from skyline_viz.viewer.parting_words import place
from testing import SAMPLES
from testing.recordings import Read, verify

PHOTO, TRUTH = SAMPLES / "images" / "clear-2.jpg", SAMPLES / "masks" / "clear-2.png"


@pytest.fixture(scope="module")
def read(tmp_path_factory):
    file = tmp_path_factory.mktemp("methods") / "m.rrd"
    words = ["inspect", str(PHOTO), "--truth", str(TRUTH), "--save", str(file)]
    assert main([*words, "--method", "default", "paper", "edges", "gradient"]) == 0
    verify(file)
    return Read(file)


def test_each_method_has_a_line_of_its_own_colour(read):
    seen = set()
    for name, colour in zip(("paper", "edges", "gradient"), COLOURS.values(), strict=False):
        line = f"{entities.METHOD_LINES}/{name}"
        (told,) = read.last(line, "LineStrips2D:colors").as_py()
        red, green, blue = (told >> 24) & 255, (told >> 16) & 255, (told >> 8) & 255
        assert (red, green, blue) == colour
        seen.add(told)
        assert len(read.last(line, "LineStrips2D:strips").as_py()[0]) == 960
    assert len(seen) == 3


def test_each_method_has_a_tab_of_its_stages(read):
    for name in ("paper", "edges", "gradient"):
        assert f"{entities.METHODS}/{name}/{entities.COST}" in read.entities()
        assert name in read.view_names
    assert f"{entities.METHODS}/paper/{entities.BIN}" in read.entities()
    assert f"{entities.METHODS}/edges/{entities.BIN}" not in read.entities()
    assert "Methods" in read.view_names


def test_the_table_names_colours_and_errors(read):
    table = read.last(entities.METHODS_TABLE, "TextDocument:text").as_py()[0]
    lines = table.splitlines()
    assert lines[2].startswith("| magenta | default |")
    (item,) = (one for one in sv.open_dataset(SAMPLES) if one.name == "clear-2")
    error = sv.a_err(make_method("paper").detect(item.photo()).skyline, item.truth())
    assert lines[3].startswith(f"| orange | paper | {error:.2f} px |")
    assert lines[4].startswith("| sky blue | edges |")
    assert lines[-1].startswith("| turquoise | truth |")


def test_more_methods_than_colours_are_refused(capsys):
    names = ["default", "paper", "edges", "gradient", *(f"{at}.npz" for at in range(6))]
    assert main(["inspect", str(PHOTO), "--headless", "--method", *names]) == 2
    assert "9 methods at most can be told apart" in capsys.readouterr().err


def test_galleries_sort_by_what_the_second_of_two_methods_makes_worse(tmp_path, capsys):
    inputs = collect([SAMPLES])
    ours, paper = make_method("default"), make_method("paper")
    entries, failures = build(tmp_path / "g", inputs, ours, 1, paper)
    assert not failures
    changes = [entry.other_a_err - entry.verdict.a_err for entry in entries]
    assert changes == sorted(changes, reverse=True)
    assert changes == [entry.change for entry in entries]
    assert {entry.compared for entry in entries} == {"paper"}
    worst = entries[0]
    photo = sv.read_photo(worst.photo)
    found = [method.detect(photo) for method in (ours, paper)]
    lines = [one.skyline.rows for one in found]
    assert worst.difference == pytest.approx(abs(lines[0] - lines[1]).mean())
    parted = parting(*found)
    assert (worst.turned_by, worst.parts_at) == (parted.turned_by, place(parted.on_lines))
    kept = Gallery(tmp_path / "g").entries()
    assert kept[worst.name] == worst
    document = json.loads((tmp_path / "g" / "gallery.json").read_text())
    told = document["comparison"]
    assert (told["first"], told["second"]) == ("default", "paper")
    assert told["better"] + told["worse"] + told["level"] == len(entries)
    assert told["change"] == pytest.approx(sum(changes) / len(changes))
    assert f"won {told['better']}, lost {told['worse']}" in capsys.readouterr().out
