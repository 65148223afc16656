"""Methods by name, as files, compared, and in tables."""

import json
import re
import shutil
from dataclasses import replace

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.cli import main
from skyline_viz.detector import Detector
from skyline_viz.evaluation.cross_validation import cross_validate
from skyline_viz.evaluation.paper_tables import published, tables
from skyline_viz.evaluation.paper_tables.writing import latex, markdown
from skyline_viz.evaluation.timing import time_methods
from skyline_viz.method import Learner, MethodError
from skyline_viz.methods.descriptors import LENGTH
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.methods.registry import (
    NAMES,
    Trained,
    find_method,
    load_method,
    make_method,
    method_digest,
    model_bytes,
    save_method,
)
from skyline_viz.methods.score_images import PATCH
from skyline_viz.methods.sky_network import SkyNetwork
from skyline_viz.rendering import render

SIZE = (160, 120)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A plain data set of four small scenes."""
    folder = tmp_path_factory.mktemp("set") / "hills"
    for part in ("images", "masks"):
        (folder / part).mkdir(parents=True)
    for number in range(4):
        scene = render("desert", 50 + number, *SIZE)
        sv.write_photo(folder / "images" / f"hill-{number}.png", scene.photo)
        terrain = ~scene.truth.to_mask(SIZE[1])
        mask = terrain.astype(np.uint8) * np.uint8(255)
        sv.write_photo(folder / "masks" / f"hill-{number}.png", mask)
    return folder


@pytest.fixture(scope="module")
def items(folder):
    return list(sv.open_dataset(folder))


@pytest.mark.parametrize("name", NAMES)
def test_every_name_makes_a_method_of_that_name(name):
    method = make_method(name)
    assert method.name == name
    assert isinstance(method, Learner) == (name not in ("edges", "gradient"))
    assert name in published.TITLES


def test_a_method_that_has_learned_nothing_says_how_to_train_it():
    with pytest.raises(MethodError, match="train it with: skyline-viz train DATASET --method svm-"):
        make_method("svm-dcsi").detect(render("clear", 1, *SIZE).photo)


def test_names_and_files_that_are_no_method_are_refused(tmp_path):
    with pytest.raises(MethodError, match="nobody is neither a method nor the file of a tr"):
        find_method("nobody")
    with pytest.raises(MethodError, match=r"gone\.npz does not exist"):
        find_method(str(tmp_path / "gone.npz"))
    (tmp_path / "text.npz").write_text("no archive")
    with pytest.raises(
        MethodError, match=r"text\.npz is damaged, or not a filter bank or a trained"
    ):
        find_method(str(tmp_path / "text.npz"))
    np.savez(tmp_path / "other.npz", header=np.frombuffer(b'{"format": "x"}', np.uint8))
    with pytest.raises(MethodError, match="neither a trained method nor a filter bank"):
        find_method(str(tmp_path / "other.npz"))


def test_a_filter_bank_is_a_method(tmp_path):
    sv.FilterBank.default().save(tmp_path / "bank.npz")
    method = find_method(str(tmp_path / "bank.npz"))
    assert isinstance(method, Detector)
    assert model_bytes(method) == method.bank.filters.nbytes + len(method.sky.network)
    without = method.with_settings({"sky_weight": 0.0})
    assert model_bytes(without) == method.bank.filters.nbytes


def test_a_method_comes_back_from_its_file(tmp_path):
    method = EdgesOnly(delta=12)
    save_method(method, tmp_path / "m.npz", Trained("hills", 4, 0))
    again = load_method(tmp_path / "m.npz")
    assert again == method
    assert method_digest(again) == method_digest(method)
    assert method_digest(EdgesOnly()) != method_digest(method)


def test_times_are_told_for_every_method(items):
    timings = time_methods({"edges": EdgesOnly()}, items[0].photo())
    assert [one.name for one in timings] == ["edges"]
    assert timings[0].seconds > 0


def test_tables_put_measured_and_published_rows_side_by_side(items):
    measured = {"hills": cross_validate(items, [Detector(), EdgesOnly()], 2)}
    first = tables.table_1(measured, 2)
    assert first.rows[0][:3] == ("Ours, default", "hills", "the other folds of 2")
    assert first.rows[1][:3] == ("Edges only", "hills", "nothing")
    assert ("Edges only", "Web (80), published", "nothing", 9.15, 17.92, 0.38, 93.02) in [
        row[:7] for row in first.rows
    ]
    sixth = tables.table_6(
        time_methods(measured["hills"].methods, items[0].photo()), measured["hills"].methods
    )
    assert sixth.rows[0][3] == "1.0"
    page, paper = markdown([first, sixth]), latex([first, sixth])
    assert "## Table VI: Size of the model" in page
    for table in (first, sixth):
        lines = [line for line in page.splitlines() if line.startswith("| ")]
        assert all(line.count("|") == page.splitlines()[2].count("|") for line in lines[:3])
        assert paper.count(r"\end{tabular}") == 2
        assert len(table.headings) == len(table.rows[0])
    for line in paper.splitlines():
        if line.endswith(r"\\"):
            assert not re.search(r"(?<!\\)[_%#]", line), line


def test_commands_compare_train_and_detect(folder, tmp_path, capsys):
    out = str(tmp_path / "out")
    words = ["evaluate", str(folder), "--folds", "2", "--method", "default", "edges", "--out", out]
    assert main(words) == 0
    said = capsys.readouterr().out
    assert "hills: 4 photos, 2-fold cross-validation" in said
    assert re.search(r"^edges +\d", said, re.MULTILINE)
    document = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert set(document["summary"]) == {"default", "edges"}
    lines = (tmp_path / "out" / "photos.csv").read_text().splitlines()
    assert len(lines) == 9
    photo = str(folder / "images" / "hill-0.png")
    assert main(["detect", photo, "--method", "edges", "--out", str(tmp_path)]) == 0
    found = sv.Skyline.read_csv(tmp_path / "hill-0.csv")
    wanted = EdgesOnly().detect(sv.read_photo(photo)).skyline
    np.testing.assert_array_equal(found.rows, wanted.rows)
    assert main(["diagnose", str(folder), "--method", "edges"]) == 0
    assert main(["detect", photo, "--method", "edges", "gradient"]) == 2
    assert "one method can be used here, and 2 are named" in capsys.readouterr().err
    assert main(["evaluate", str(folder), "--method", "edges", "edges"]) == 2
    capsys.readouterr()
    for command in ("detect", "evaluate", "diagnose", "gallery"):
        assert main([command, str(folder), "--method", "svm-dcsi"]) == 2
        assert capsys.readouterr().err.count("svm-dcsi has learned nothing yet") == 1
    assert main(["train", str(folder), "--method", "edges", "--out", f"{out}/m.npz"]) == 2
    assert "the method edges has nothing to learn" in capsys.readouterr().err


def test_the_command_writes_tables(folder, tmp_path, capsys):
    words = ["tables", str(folder), "--out", str(tmp_path), "--method", "paper", "edges"]
    assert main([*words, "--no-studies"]) == 0
    assert "Table I: A_err of earlier methods" in capsys.readouterr().out
    assert (tmp_path / "tables.md").read_text().count("## Table") == 4
    assert r"\begin{tabular}" in (tmp_path / "tables.tex").read_text()
    assert (tmp_path / "histogram.png").exists()
    assert main(["tables", str(folder), "--folds", "1", "--out", str(tmp_path)]) == 2


def altered(method, path, **changes):
    """A file of a method with other arrays."""
    model = {name: array for name, array in (method.model | changes).items() if array is not None}
    save_method(replace(method, model=model), path, Trained())
    return path


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"weights": np.zeros(3)}, r"its weights has the shape \(3,\)"),
        ({"weights": None}, "its weights is missing"),
        ({"bias": np.array([np.nan])}, "its bias holds what is no finite number"),
        ({"bias": np.array(["x"])}, "its bias holds what is no finite number"),
    ],
)
@pytest.mark.parametrize("name", ["sift-hog-edges", "svm-dcsi"])
def test_compiled_loops_never_see_a_model_of_another_shape(tmp_path, name, changes, says):
    side = {"sift-hog-edges": (LENGTH,), "svm-dcsi": (PATCH, PATCH)}[name]
    model = {"weights": np.zeros(side), "bias": np.zeros(1), "logistic": np.ones(2)}
    method = replace(make_method(name), model=model)
    save_method(method, tmp_path / "good.npz", Trained())
    assert load_method(tmp_path / "good.npz").name == name
    with pytest.raises(MethodError, match=says):
        load_method(altered(method, tmp_path / "bad.npz", **changes))


def test_settings_of_another_kind_are_refused(tmp_path):
    save_method(EdgesOnly(delta="x"), tmp_path / "m.npz", Trained())
    with pytest.raises(
        MethodError, match="damaged: delta is a whole number from 0 to 1,000,000, not 'x'"
    ):
        load_method(tmp_path / "m.npz")


def test_a_network_that_is_damaged_is_one_sentence(tmp_path):
    method = replace(make_method("cnn-dcsi"), model={"onnx": np.zeros(50, np.uint8)})
    with pytest.raises(MethodError, match="the network of cnn-dcsi is damaged"):
        method.detect(render("clear", 1, *SIZE).photo)


def test_tables_outlive_a_photo_that_is_damaged(folder, tmp_path, capsys):
    damaged = tmp_path / "damaged"
    shutil.copytree(folder, damaged)
    (damaged / "images" / "hill-0.png").write_bytes(b"no photo")
    words = ["tables", str(damaged), "--method", "paper", "edges", "--out", str(tmp_path / "out")]
    assert main(words) == 1
    assert "hill-0" in capsys.readouterr().err
    assert (tmp_path / "out" / "tables.md").read_text().count("## Table") == 6
    lines = (tmp_path / "out" / "photos.csv").read_text().splitlines()
    assert len(lines) == 1 + 2 * 3


def test_options_that_would_be_ignored_are_refused(folder, tmp_path, capsys):
    out = str(tmp_path / "m.npz")
    train = ["train", str(folder), "--out", out, "--method"]
    for words, says in (
        ([*train, "default", "--pretrained", "x.pth"], "--pretrained is for FCNs"),
        ([*train, "svm-dcsi", "--preset", "paper"], "are for our filter bank"),
        ([*train, "paper:delta=4", "--preset", "paper"], "settings are given twice"),
        ([*train, "paper:model=b.npz"], "has learned already"),
        (["detect", str(folder), "--method", "edges", "--config.delta", "2"], "2 are named"),
        (["gallery", str(folder), "--method", "edges", "--bank", "x.npz"], "x.npz does not exist"),
    ):
        assert main(words) == 2, words
        assert says in capsys.readouterr().err
    assert not (tmp_path / "m.npz").exists()


def test_a_method_is_not_tested_on_what_it_learned_from_without_a_word(folder, tmp_path, capsys):
    pytest.importorskip("sklearn", reason="not run, the extra 'methods' is not installed")
    file = str(tmp_path / "svm.npz")
    assert main(["train", str(folder), "--method", "svm-dcsi", "--out", file]) == 0
    capsys.readouterr()
    assert main(["evaluate", str(folder), "--method", file]) == 0
    assert "was trained on all 4 photos, so this is no test" in capsys.readouterr().err
    assert main(["evaluate", str(folder), "--method", file, "--folds", "2"]) == 2
    assert "would be trained anew" in capsys.readouterr().err
    assert main(["evaluate", str(folder), "--method", f"svm-mdcsi:model={file}"]) == 0
    assert "was trained on all 4 photos, so this is no test" in capsys.readouterr().err


def test_a_network_is_what_its_file_holds(tmp_path):
    file = tmp_path / "sky.onnx"
    file.write_bytes(b"first")
    network = SkyNetwork(file, sky_class=2)
    digest = method_digest(network)
    assert model_bytes(network) == 5
    save_method(network, tmp_path / "m.npz", Trained())
    assert load_method(tmp_path / "m.npz") == network
    file.write_bytes(b"other")
    assert method_digest(network) != digest
    with pytest.raises(MethodError, match="is another one than it was"):
        load_method(tmp_path / "m.npz")
    file.unlink()
    with pytest.raises(MethodError, match="is gone"):
        load_method(tmp_path / "m.npz")


def test_a_network_that_cannot_be_read_is_told_once(folder, tmp_path, capsys):
    (tmp_path / "junk.onnx").write_text("junk")
    for name in ("junk.onnx", "gone.onnx"):
        assert main(["evaluate", str(folder), "--network", str(tmp_path / name)]) == 2
        assert capsys.readouterr().err.count(name) == 1


def test_where_all_pixels_are_candidates_none_is_shown_as_ruled_out():
    photo = render("clear", 1, *SIZE).photo
    dense = make_method("gradient").detect(photo)
    assert dense.cost.max() > 0
    assert np.isfinite(replace(dense, cost=dense.cost + 1).stages["cost"].map()).all()
    ruled_out = EdgesOnly().detect(photo)
    assert np.isnan(ruled_out.stages["cost"].map()).any()


def test_published_rows_name_their_training_sets():
    rows = {row[0]: row[2] for row in tables.table_1({}, 2).rows}
    assert rows["Proposed"] == "CH1"
    assert rows["G_r"] == "nothing"
    assert rows["SVM-mDCSI"] == "Basalt Hills (9)"
