"""Other methods propose: their lines, and what the store keeps of them."""

import numpy as np
import pytest

from annotate.store.operations import SetAnchor, SetStatus
from annotate.work.learning import LEAST, Learner
from annotate.work.overlays import overlay
from skyline_viz.method import MethodError
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.methods.gradient import GradientCost
from testing import until
from testing.labelling import served, workbench, write_hills


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path, count=2)


def proposing(folder, method):
    return workbench(folder, detector=method)


def test_a_label_goes_on_with_the_method_that_proposed_it(folder):
    bench = proposing(folder, EdgesOnly(delta=9))
    first, second = bench.photos
    session = bench.session(first)
    wanted = EdgesOnly(delta=9).detect(session.pixels).skyline.rows
    np.testing.assert_array_equal(session.wire.skyline.rows, wanted)
    session.apply(SetAnchor(column=10, row=12), -1)
    assert session.wire.skyline.rows[10] == 12
    bench.close()
    bench = proposing(folder, GradientCost())
    assert bench.session(first).detector == EdgesOnly(delta=9)
    assert bench.session(first).wire.skyline.rows[10] == 12
    assert bench.session(second).detector == GradientCost()
    bench.close()
    bench = workbench(folder)
    assert bench.session(first).detector == EdgesOnly(delta=9)
    bench.close()


def test_every_stage_of_another_method_can_be_shown(folder):
    bench = proposing(folder, EdgesOnly())
    for name in ("edges", "score", "cost", "bin", "strength"):
        detection = bench.detection(bench.session(next(iter(bench.photos))))
        assert overlay(detection, name).data[1:4] == b"PNG"
    bench.close()


def test_learning_on_the_way_is_for_our_detector(tmp_path):
    bench = proposing(write_hills(tmp_path, count=LEAST), GradientCost())
    for photo in bench.photos:
        bench.session(photo).apply(SetStatus(status="accepted"), -1)
    learner = Learner(bench)
    learner.start()
    until(lambda: learner.now().state != "running")
    assert learner.now().state == "failed"
    assert "the method gradient proposes here" in learner.now().detail
    bench.close()


def test_a_method_that_fails_on_a_photo_is_a_sentence(tmp_path):
    class Failing(EdgesOnly):
        def detect(self, photo):
            raise MethodError("the network is damaged.")

    with served(write_hills(tmp_path, count=1), detector=Failing()) as client:
        said = client.get("/api/photos/1")
    assert said.status_code == 422
    assert "the network is damaged." in said.text
