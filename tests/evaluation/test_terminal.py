"""Tables for people."""

import io

from rich.console import Console

from skyline_viz.evaluation.results import Summary
from skyline_viz.evaluation.terminal import drawn, methods_table, summary_table, worst_table
from testing.detections import result


def test_the_tables_name_figures_and_photos():
    results = [result("Jungfrau", 12.345, gross_miss=True, worst_column=77), result("Eiger", 1)]
    console = Console(width=100, file=io.StringIO())
    console.print(summary_table(Summary.of(results)))
    console.print(worst_table(results))
    text = console.file.getvalue()
    for word in (
        "6.67 px",
        "50.0% (95 % interval: 9% to 91%)",
        "Jungfrau",
        "12.35 px   miss",
        "77",
        "0.500 s",
    ):
        assert word in text


def test_a_photo_is_a_line_in_a_narrow_terminal():
    worst = [result("R_GImag0001", 97.52, gross_miss=True, worst_column=1024), result("b", 1)]
    lines = drawn(worst_table(worst), width=60).splitlines()
    assert len(lines) == 4
    assert lines[2].split()[:4] == ["R_GImag0001", "97.52", "px", "miss"]


def test_a_line_for_each_method_also_where_nothing_was_found():
    table = drawn(methods_table({"[bold]": [result("a", 4.0)], "none": []}), width=110)
    lines = [line.split() for line in table.splitlines()]
    figures = ["4.00", "0.00", "4.00", "4.00", "4.00", "0/1", "0", "100.00%", "500"]
    assert lines[1] == ["[bold]", *figures]
    assert lines[2] == ["none", *"-" * 9]
