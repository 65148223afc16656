"""The loops of gestures are there before the first one."""

from annotate.engine import corridor, tables
from annotate.work import warming
from testing.labelling import workbench, write_hills


def test_a_workbench_warms_up_once(tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr("annotate.work.workbench.warm_up", lambda: asked.append("warm"))
    bench = workbench(write_hills(tmp_path / "alps", count=1))
    bench.close()
    assert asked == ["warm"]


def test_all_loops_of_a_guide_are_there():
    warming.warm_up.__wrapped__()
    assert corridor.follow.signatures
    assert tables.follow.signatures
