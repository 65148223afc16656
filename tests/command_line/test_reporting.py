"""``--report``: what is refused before any work, and what is said."""

import pytest

from skyline_viz.command_line.messages import UsageError
from skyline_viz.command_line.reporting import check_report, report_data_set
from skyline_viz.datasets.layouts import open_dataset
from skyline_viz.detector import Detector
from skyline_viz.evaluation.tasks import photo_tasks
from skyline_viz.running.batch import Failure
from testing.detections import write_slanting


def test_a_report_is_an_html_file(tmp_path):
    check_report(None)
    check_report(tmp_path / "a.HTML")
    with pytest.raises(UsageError, match=r"so .*a\.pdf should end in \.html"):
        check_report(tmp_path / "a.pdf")
    (tmp_path / "b.html").mkdir()
    with pytest.raises(UsageError, match="is a folder"):
        check_report(tmp_path / "b.html")


def test_failures_are_in_the_report_and_not_tried_again(tmp_path, capsys):
    items = write_slanting(tmp_path / "hills", count=3)
    tasks = photo_tasks([(item, Detector()) for item in items])
    items[2].photo_path.write_bytes(b"damaged")
    known = [Failure("p1", "it was damaged")]
    late = report_data_set(
        tmp_path / "r.html", open_dataset(tmp_path / "hills"), "default", tasks, known
    )
    assert [one.name for one in late] == ["p2"]
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "p1: it was damaged." in text
    assert text.count("<article") == 1
    assert f"{tmp_path / 'r.html'}: 1 photo, " in capsys.readouterr().out
