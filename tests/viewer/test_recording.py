"""Recordings, read back from their files and compared with the detection."""

import re

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.evaluation.metrics import column_errors
from skyline_viz.tensor import tensor_map
from skyline_viz.viewer import entities
from skyline_viz.viewer.blueprints import TABS
from skyline_viz.viewer.column_views import path_costs
from skyline_viz.viewer.maps.stage_maps import LEAN_PIXELS, shown_pixels
from testing import ROOT
from testing.networks import bright_model
from testing.recordings import Read, drawn_rows, scene, verify, visible_rows

HEIGHT, WIDTH = 90, 120


def record(path, detection, truth=None, **options):
    with sv.new_recording(path, "scene") as recording:
        recording.set_time(entities.IMAGE, sequence=0)
        verdict = sv.log_detection(recording, detection, truth, name="scene", **options)
    verify(path)
    return Read(path), verdict


@pytest.fixture(scope="module")
def found():
    photo, truth = scene()
    return sv.Detector().detect(photo), truth


@pytest.fixture(scope="module")
def full(found, tmp_path_factory):
    return record(tmp_path_factory.mktemp("full") / "full.rrd", *found)[0]


@pytest.fixture(scope="module")
def lean(found, tmp_path_factory):
    return record(tmp_path_factory.mktemp("lean") / "lean.rrd", *found, fidelity="lean")[0]


def values_at_edges(detection):
    rows, columns = detection.edge_rows, detection.edge_columns
    return {
        entities.STRENGTH: detection.strength,
        entities.COHERENCE: detection.coherence,
        entities.ORIENTATION: detection.orientation,
        entities.SCORE: detection.scores,
        entities.COST: detection.cost[rows, columns],
        entities.DETOUR: detection.uncertainty().detour[rows, columns],
    }


def test_photo_and_edges_in_full_are_exact(full, found):
    assert np.array_equal(full.picture(entities.PHOTO), found[0].photo)
    assert np.array_equal(full.picture(entities.EDGES) > 0, found[0].edges)


def test_photo_and_edges_in_lean(lean, found):
    difference = lean.picture(entities.PHOTO).astype(int) - found[0].photo
    assert np.abs(difference).mean() < 8
    assert np.array_equal(lean.picture(entities.EDGES) > 0, found[0].edges)


def test_exact_values_in_full(full, found):
    detection, _ = found
    tensor = tensor_map(detection.photo)
    exact = {
        entities.STRENGTH: tensor.strength,
        entities.COHERENCE: tensor.coherence,
        entities.ORIENTATION: tensor.orientation,
        entities.COST: detection.cost,
        entities.DETOUR: detection.uncertainty().detour,
    }
    for entity, values in exact.items():
        assert np.array_equal(full.array(entity, "exact"), values.ravel()), entity


def test_the_table_of_edge_pixels(full, found):
    detection, _ = found
    table = {
        "edge_row": detection.edge_rows,
        "edge_column": detection.edge_columns,
        "bin": detection.bins,
        "strength": detection.strength,
        "coherence": detection.coherence,
        "orientation": detection.orientation,
        "score": detection.scores,
        "cost": detection.cost[detection.edge_rows, detection.edge_columns],
    }
    for name, values in table.items():
        assert np.array_equal(full.array(entities.EDGE_PIXELS, name), values), name


@pytest.mark.parametrize(
    "entity",
    [
        entities.STRENGTH,
        entities.COHERENCE,
        entities.ORIENTATION,
        entities.SCORE,
        entities.COST,
        entities.DETOUR,
    ],
)
@pytest.mark.parametrize("fidelity", ["full", "lean"])
def test_hovering_an_edge_pixel_tells_its_value(request, found, fidelity, entity):
    detection, truth = found
    read = request.getfixturevalue(fidelity)
    expected = values_at_edges(detection)[entity]
    told = read.map(entity)[detection.edge_rows, detection.edge_columns]
    shown = np.ones(len(told), bool) if fidelity == "full" else shown_pixels(detection, truth)
    assert np.array_equal(~np.isnan(told), shown)
    numbers = [
        float(re.search(r"-?\d+(\.\d+)?", one)[0]) for one in read.labels(entity).values() if one
    ]
    span = max(numbers) - min(numbers)
    levels = len(read.labels(entity)) - 1
    assert levels == (4095 if fidelity == "full" else 255)
    assert told[shown] == pytest.approx(expected[shown], abs=1.1 * span / levels + 1e-4)
    unit = {entities.STRENGTH: " grey levels/px", entities.ORIENTATION: "°"}.get(entity, "")
    assert all(label.endswith(unit) for label in read.labels(entity).values() if label)


def test_score_and_bin_are_told_at_edges_only(full, found):
    detection, _ = found
    assert np.array_equal(full.classes(entities.SCORE) > 0, detection.edges)
    bins = full.classes(entities.BIN)
    assert np.array_equal(bins > 0, detection.edges)
    assert np.array_equal(bins[detection.edge_rows, detection.edge_columns], detection.bins + 1)
    labels = full.labels(entities.BIN)
    assert all(labels[1 + one] == detection.bank.bins.label(one) for one in range(288))


def test_the_lines_have_the_rows_of_the_skylines(full, found):
    detection, truth = found
    centres = np.arange(WIDTH) + 0.5
    path = full.last(entities.PATH, "strips").as_py()
    np.testing.assert_array_equal(drawn_rows(path, WIDTH), visible_rows(detection.skyline))
    assert np.isin(np.concatenate(path)[:, 0], centres).all()
    before, after = full.last(entities.TRUTH, "strips").as_py()
    assert (len(before), len(after)) == (60, WIDTH - 61)
    assert np.array_equal(np.array(before)[:, 1], truth.rows[:60])
    assert np.array_equal(np.array(after)[:, 0], centres[61:])


def test_what_runs_along_the_columns(full, found):
    detection, truth = found

    def bars(entity):
        return np.array(full.last(entity, "values").as_py()[0]["buffer"])

    errors = column_errors(detection.skyline, truth)
    node, link = path_costs(detection)
    assert bars(entities.ERRORS) == pytest.approx(np.nan_to_num(errors))
    assert bars(entities.MARGINS) == pytest.approx(detection.margins(), rel=1e-5)
    assert bars(entities.NODE_COSTS) == pytest.approx(node, rel=1e-5)
    assert bars(entities.LINK_COSTS) == pytest.approx(link, rel=1e-5)
    assert node.sum() + link.sum() == pytest.approx(detection.path_cost)
    strip = full.classes(entities.STRIP)
    assert strip[-1, 60] == 0
    assert not strip[:-8].any()
    labels = full.labels(entities.STRIP)
    for column in (0, 30, 90):
        assert labels[strip[-1, column]] == (
            "error up to 1 px" if errors[column] <= 1 else labels[strip[-1, column]]
        )


def test_report_and_metrics(found, tmp_path):
    detection, truth = found
    read, verdict = record(tmp_path / "a.rrd", detection, truth)
    report = read.last(entities.REPORT, "text").as_py()[0]
    assert f"**A_err {sv.a_err(detection.skyline, truth):.2f} px**" in report
    assert f"{len(detection.scores):,} pixels" in report
    assert read.array("metrics/a_err", "scalars") == pytest.approx([verdict.a_err])
    assert read.array("metrics/margin", "scalars") == pytest.approx([verdict.margin])
    for stage, seconds in detection.seconds.items():
        assert read.array(f"timings/{stage}", "scalars") == pytest.approx([1000 * seconds])


def test_without_a_truth_there_is_none(found, tmp_path):
    read, verdict = record(tmp_path / "a.rrd", found[0], fidelity="lean")
    assert verdict.a_err is None
    assert not read.all(entities.TRUTH, "strips")
    assert not read.all(entities.ERRORS, "values")
    assert "margin" in read.labels(entities.STRIP)[1]


def test_everything_of_a_second_detection_lies_under_a_parent(found, tmp_path):
    read, _ = record(tmp_path / "a.rrd", *found, under=entities.OTHER)
    assert {one.split("/")[0] for one in read.entities()} <= {entities.OTHER, "__properties"}


def test_lean_shows_the_cheapest_edge_pixels_of_each_column():
    photo, truth = scene(noise=60)
    detection = sv.Detector().detect(photo)
    assert len(detection.scores) > 2 * LEAN_PIXELS * WIDTH
    shown = shown_pixels(detection, truth)
    costs = detection.cost[detection.edge_rows, detection.edge_columns]
    for column in range(WIDTH):
        here = detection.edge_columns == column
        cheapest = np.sort(costs[here])[:LEAN_PIXELS]
        assert shown[here & (costs <= cheapest[-1])].all()
    near = np.abs(truth.rows[detection.edge_columns] - detection.edge_rows) <= 2
    assert shown[near].all()
    assert shown.sum() < 0.7 * len(shown)


def test_a_lean_recording_of_rough_terrain_is_small(tmp_path):
    photo, truth = scene(519, 1388, noise=60)
    calm, _ = scene(519, 1388, noise=1)
    sky = truth.to_mask(519)
    photo[sky] = calm[sky]
    detection = sv.Detector(sky=bright_model()).detect(photo)
    assert len(detection.scores) > 100_000
    read, _ = record(tmp_path / "a.rrd", detection, truth, fidelity="lean")
    photo_bytes = len(read.last(entities.PHOTO, "blob").as_py()[0])
    maps = (tmp_path / "a.rrd").stat().st_size - photo_bytes
    assert maps < 750_000  # white noise, with what is broadened; photographs take less


def test_the_tabs_are_those_of_the_docs(full):
    assert {*TABS} - {"Pixel"} <= full.view_names  # its own is a single photo's
    told = re.findall(r"\([a-z]\) [a-z ]+", (ROOT / "docs" / "inspect.md").read_text())
    shown = sorted(name for name in full.view_names if re.match(r"\([a-z]\) ", name))
    assert len(told) == len(shown) > 1
    for title, words in zip(shown, told, strict=True):
        assert title.lower().startswith(words.strip())


@pytest.mark.parametrize("fidelity", ["lean", "full"])
@pytest.mark.parametrize(
    "photo", [np.full((40, 50, 3), 128, np.uint8), np.zeros((2, 2, 3), np.uint8)]
)
def test_photos_without_an_edge(tmp_path, photo, fidelity):
    detection = sv.Detector().detect(photo)
    read, verdict = record(tmp_path / "a.rrd", detection, fidelity=fidelity)
    assert not read.classes(entities.SCORE).any()
    assert verdict.margin >= 0


def test_a_truth_of_another_width_leaves_no_file(found, tmp_path):
    with pytest.raises(sv.SkylineError, match="columns"):
        record(tmp_path / "a.rrd", found[0], sv.Skyline(np.zeros(3)))
    assert list(tmp_path.iterdir()) == []


def test_an_interrupt_leaves_what_was_logged(found, tmp_path):
    path = tmp_path / "a.rrd"

    def interrupted():
        with sv.new_recording(path, "a") as recording:
            sv.log_detection(recording, found[0], fidelity="lean")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    verify(path)
    assert entities.SCORE in Read(path).entities()


def test_the_stages_of_another_detector(tmp_path):
    photo, truth = scene()
    brightness = photo.mean(axis=2)
    brightness[3:6, 7] = np.nan
    edges = brightness > 150
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        stages = {"brightness": brightness, "edges": edges}
        sv.log_stages(recording, photo, stages, truth, truth)
    verify(tmp_path / "a.rrd")
    read = Read(tmp_path / "a.rrd")
    exact = read.array("brightness", "exact").reshape(photo.shape[:2])
    np.testing.assert_array_equal(exact, brightness.astype(np.float32))
    np.testing.assert_allclose(read.map("brightness"), brightness, atol=0.1)
    assert np.array_equal(read.picture("edges") > 0, edges)
    assert {"Brightness", "Edges", "Skyline"} <= read.view_names


def test_maps_of_another_size_are_refused(tmp_path):
    photo, truth = scene()
    with (
        pytest.raises(ValueError, match="score has the shape"),
        sv.new_recording(tmp_path / "a.rrd", "a") as recording,
    ):
        sv.log_stages(recording, photo, {"score": np.zeros((3, 3))}, truth)
    assert list(tmp_path.iterdir()) == []


def test_times_of_an_earlier_recording_of_that_name_are_forgotten(tmp_path):
    photo, truth = scene()
    found = sv.Detector().detect(photo)
    with sv.new_recording(tmp_path / "a.rrd", "one name") as recording:
        recording.set_time("image", sequence=3)
        sv.log_detection(recording, found, truth)
    with sv.new_recording(tmp_path / "b.rrd", "one name") as recording:
        sv.log_detection(recording, found, truth)
    timelines = [
        {name for _, batch in Read(tmp_path / file).chunks for name in batch.schema.names}
        for file in ("a.rrd", "b.rrd")
    ]
    assert ["image" in names for names in timelines] == [True, False]
