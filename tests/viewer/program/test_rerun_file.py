"""What Rerun records, written by ourselves: whole, or an error like any other."""

import os

import pytest
import rerun as rr

from skyline_viz.viewer.program import rerun_file
from skyline_viz.viewer.program.rerun_file import saved
from testing.recordings import Read, verify

pytestmark = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="Rerun writes by itself there")


def recorded(path, count=200):
    recording = rr.RecordingStream("test", recording_id="a")
    with saved(recording, path):
        for number in range(count):
            recording.set_time("step", sequence=number)
            recording.log("value", rr.Scalars(number))


def test_what_is_logged_is_in_the_file(tmp_path):
    recorded(tmp_path / "a.rrd")
    verify(tmp_path / "a.rrd")
    values = [one.as_py()[0] for one in Read(tmp_path / "a.rrd").all("value", "scalars")]
    assert sorted(values) == list(range(200))


def test_a_file_that_cannot_be_written_is_an_error_and_the_program_goes_on(tmp_path):
    (tmp_path / "folder").mkdir()
    with pytest.raises(IsADirectoryError):
        recorded(tmp_path / "folder", count=20_000)


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no disk is always full")  # noqa: PTH110
def test_a_full_disk_is_an_error(tmp_path):
    (tmp_path / "a.rrd").symlink_to("/dev/full")
    with pytest.raises(OSError, match="No space left on device"):
        recorded(tmp_path / "a.rrd", count=20_000)


def test_an_error_in_the_block_is_what_is_told_and_the_file_is_whole(tmp_path):
    recording = rr.RecordingStream("test", recording_id="a")
    with pytest.raises(RuntimeError, match="a bug"), saved(recording, tmp_path / "a.rrd"):
        recording.log("value", rr.Scalars(1))
        raise RuntimeError("a bug")
    verify(tmp_path / "a.rrd")


def test_without_pipes_rerun_writes_by_itself(tmp_path, monkeypatch):
    monkeypatch.delattr(rerun_file.os, "mkfifo")
    recorded(tmp_path / "a.rrd", count=3)
    verify(tmp_path / "a.rrd")
