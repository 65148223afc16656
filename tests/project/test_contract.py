"""The public interface, line by line, as whoever uses it writes it."""

import dataclasses

import numpy as np
import pytest

import skyline_viz as sv
from annotate import LiveWire


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A plain data set of four rendered photos."""
    place = tmp_path_factory.mktemp("set")
    for seed in range(1, 5):
        scene = sv.render("clear", seed, 200, 120)
        (place / "images").mkdir(exist_ok=True)
        (place / "masks").mkdir(exist_ok=True)
        sv.write_photo(place / "images" / f"{scene.name}.png", scene.photo)
        scene.truth.write_csv(place / "masks" / f"{scene.name}.csv")
    return place


@pytest.fixture(scope="module")
def photo(folder):
    return sv.read_photo(folder / "images" / "clear-1.png")


@pytest.fixture(scope="module")
def detection(photo):
    return sv.Detector().detect(photo)


def test_a_photo_that_is_none_is_one_plain_sentence(tmp_path):
    with pytest.raises(sv.PhotoError, match=r"^.*\.$"):
        sv.read_photo(tmp_path / "none.jpg")


def test_a_detector_is_one_file(photo, tmp_path):
    detector = sv.Detector(sv.FilterBank.default(), sv.DetectorConfig.paper())
    detector.save(tmp_path / "d.npz")
    again = sv.Detector.load(tmp_path / "d.npz")
    assert again.config == detector.config
    assert again.name == "paper"
    assert again.detect(photo).skyline == detector.detect(photo).skyline


def test_a_bank_is_read_out_of_the_file_of_a_detector(tmp_path):
    sv.Detector().save(tmp_path / "d.npz")
    bank = sv.FilterBank.load(tmp_path / "d.npz")
    assert np.array_equal(bank.filters, sv.FilterBank.default().filters)


def test_a_detection_tells_all_that_was_seen(detection, photo):
    height, width = photo.shape[:2]
    count = len(detection.edge_rows)
    assert isinstance(detection, sv.Detection)
    assert detection.skyline.rows.shape == (width,)
    assert detection.skyline.rows.dtype == np.float32
    assert detection.edges.shape == (height, width)
    assert detection.edges.dtype == bool
    for name in ("edge_columns", "strength", "coherence", "orientation", "bins", "scores"):
        assert getattr(detection, name).shape == (count,), name
    assert detection.cost.shape == (height, width)
    assert detection.cost.dtype == np.float32
    with pytest.raises(dataclasses.FrozenInstanceError):
        detection.cost = None


def test_a_sky_model_says_what_is_sky(photo, detection, tmp_path):
    model = sv.SkyModel.small()
    sky = model.sky(photo)
    assert sky.ndim == 2
    assert sky.dtype == np.float32
    assert 0 <= sky.min() <= sky.max() <= 1
    assert np.array_equal(detection.sky, sky)
    (tmp_path / "mine.onnx").write_bytes(model.network)
    detector = sv.Detector(sky=sv.SkyModel.load(tmp_path / "mine.onnx"))
    assert detector.name == "default:sky=mine.onnx"
    detector.save(tmp_path / "d.npz")
    assert sv.Detector.load(tmp_path / "d.npz").sky.network == model.network


def test_its_stages_have_values_a_unit_and_a_colour_map(detection):
    names = ["edges", "strength", "coherence", "orientation", "bin", "score", "cost", "path"]
    assert {"sky", *names} <= set(detection.stages)
    for name, stage in detection.stages.items():
        assert stage.name == name
        assert len(stage.values)
        assert isinstance(stage.unit, str)
        assert isinstance(stage.colour_map, str)
    with pytest.raises(TypeError):
        detection.stages["edges"] = None


def test_training_gives_a_bank_that_can_be_kept(folder, photo, tmp_path):
    pairs = [(item.photo(), item.truth()) for item in sv.open_dataset(folder)]
    bank = sv.train(pairs, seed=0)
    assert bank.samples.sum() > 0
    bank.save(tmp_path / "bank.npz")
    found = sv.Detector(sv.FilterBank.load(tmp_path / "bank.npz")).detect(photo)
    assert found.skyline == sv.Detector(bank).detect(photo).skyline


def test_skylines_masks_and_errors():
    line = sv.Skyline(rows=[2, 3, 4])
    assert line.visible.all()
    mask = line.to_mask(6)
    assert mask.dtype == bool
    assert mask[1].all()
    assert sv.Skyline.from_mask(mask) == line
    assert sv.a_err(line, sv.Skyline(rows=[3, 3, 3], visible=[True, False, True])) == 1


def test_methods_are_found_evaluated_and_cross_validated(folder):
    items = sv.open_dataset(folder)
    steep = sv.find_method("paper:delta=4")
    assert (steep.name, steep.config.delta) == ("paper:delta=4", 4)
    found = sv.evaluate(items, [steep, "default"])
    assert list(found.results) == ["paper:delta=4", "default"]
    assert [one.name for one in found.results["default"]] == [item.name for item in items]
    crossed = sv.cross_validate(items, ["default", "default:delta=8"], folds=2)
    assert crossed.folds == 2
    assert crossed.summaries["default:delta=8"].photos == 4


def test_a_detection_is_logged_and_diagnosed(detection, folder, tmp_path):
    truth = next(iter(sv.open_dataset(folder))).truth()
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        sv.log_detection(recording, detection, truth=truth)
    assert (tmp_path / "a.rrd").stat().st_size > 1000
    away = sv.Skyline(rows=truth.rows + 20)
    for segment in sv.diagnose(detection, away).segments:
        first, last = segment.columns
        assert 0 <= first <= last < truth.width
        assert segment.cause
        assert segment.evidence


def test_a_live_wire_begins_with_the_proposal(photo, detection):
    wire = LiveWire(photo, sv.Detector())
    assert wire.skyline == detection.skyline
    wire.preview(100, 20)
    assert wire.skyline == detection.skyline
    wire.anchor(100, 20)
    assert wire.skyline.rows[100] == 20
    assert wire.margin.shape == (photo.shape[1],)
