"""What commands detect with: the short forms, and how they go together with what is named."""

import json

import pytest

import skyline_viz as sv
from skyline_viz.cli import parse
from skyline_viz.command_line.messages import UsageError
from skyline_viz.command_line.methods import Methods, described, spelt_out
from testing.networks import bright_sky


@pytest.mark.parametrize(
    ("words", "preset"),
    [
        ("detect a.jpg", "default"),
        ("detect --preset paper a.jpg", "paper"),
        ("detect --preset=paper a.jpg", "paper"),
        ("detect --preset paper --preset default", "default"),
        ("detect --preset", "default"),
        ("detect --preset moon", "default"),
        ("detect paper", "default"),
    ],
)
def test_the_preset_is_known_before_parsing(words, preset):
    assert described(words.split()).config == sv.DetectorConfig.presets()[preset]


def chosen(*words, method=(), **changes):
    """Names of the methods of a command line whose settings differ by some changes."""
    asked = described(words)
    bank = next((words[at + 1] for at, word in enumerate(words) if word == "--bank"), None)
    config = asked.config.with_settings(changes)
    return Methods(method, bank=bank, config=config, ours=asked.ours).chosen()


def names(*words, **more):
    return [one.name for one in chosen(*words, **more)]


def test_short_forms_describe_one_method_beside_those_that_are_named():
    assert names() == ["default"]
    assert names(method=("edges",)) == ["edges"]
    assert names("--preset", "paper", method=("edges",)) == ["paper", "edges"]
    assert names("--config.delta", "8", delta=8, method=("default",)) == [
        "default:delta=8",
        "default",
    ]


def test_a_bank_brings_its_settings_unless_others_are_said(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    paper = sv.DetectorConfig.paper()
    sv.Detector(config=paper).save("b.npz")
    for words, more, name, config in (
        (("--bank", "b.npz"), {}, "b.npz", paper),
        (("--bank", "b.npz", "--preset", "paper"), {}, "b.npz", paper),
        (
            ("--bank", "b.npz", "--config.delta", "4"),
            {"delta": 4},
            "b.npz:delta=4",
            paper.with_settings({"delta": 4}),
        ),
        (
            ("--bank", "b.npz", "--preset", "default"),
            {},
            "default:model=b.npz",
            sv.DetectorConfig(),
        ),
        (
            ("--bank", "b.npz", "--preset", "default", "--config.v", "1"),
            {"v": 1.0},
            "default:v=1,model=b.npz",
            sv.DetectorConfig(v=1.0),
        ),
    ):
        (found,) = chosen(*words, **more)
        assert (found.name, found.config) == (name, config)


def test_one_name_stands_for_one_method(tmp_path):
    with pytest.raises(UsageError, match="paper is named twice; give one a label: other=paper"):
        names(method=("paper", "default", "paper"))
    assert names(method=("paper", "other=paper")) == ["paper", "other"]
    with pytest.raises(UsageError, match="2 are named: paper, edges"):
        Methods(("paper", "edges")).one()


def test_what_has_learned_is_not_trained(tmp_path):
    sv.Detector().save(tmp_path / "b.npz")
    for method in (f"{tmp_path}/b.npz", f"paper:model={tmp_path}/b.npz", f"x={tmp_path}/b.npz:v=1"):
        with pytest.raises(UsageError, match="has learned already"):
            Methods((method,)).chosen(to_train=True)
    assert Methods(("svm-dcsi",)).chosen(to_train=True)[0].name == "svm-dcsi"


def test_a_class_of_no_network_is_refused():
    options = Methods(sky_class=3)
    assert options.given  # so that every command looks at it
    with pytest.raises(UsageError, match="--sky-class is a class of --network, which is not named"):
        options.chosen()


@pytest.mark.parametrize(
    ("words", "spelt"),
    [
        ("detect a.jpg --sky large", "detect a.jpg --sky-model large"),
        ("detect a.jpg --sky=x.onnx", "detect a.jpg --sky-model=x.onnx"),
        ("detect --sky huge", "detect --sky-model huge"),
        ("evaluate d --sky 0", "evaluate d --sky 0"),
        ("evaluate d --sky=0 --sky small", "evaluate d --sky=0 --sky-model small"),
        ("evaluate d --sky blue --sky a/b.onnx", "evaluate d --sky blue --sky-model a/b.onnx"),
        ("evaluate d --sky B.ONNX", "evaluate d --sky-model B.ONNX"),
        ("evaluate d --sky=b.npz", "evaluate d --sky-model=b.npz"),
        ("evaluate d --sky 12,13", "evaluate d --sky 12,13"),
        ("evaluate d --sky", "evaluate d --sky"),
        ("detect a.jpg --sky", "detect a.jpg --sky-model"),
        ("", ""),
    ],
)
def test_a_sky_model_and_the_sky_of_masks_are_told_apart(words, spelt):
    assert spelt_out(words.split(), masks={"evaluate"}) == spelt.split()


@pytest.mark.parametrize(
    ("words", "name"),
    [
        ("", "default:sky=s.onnx"),
        ("--bank b.npz", "mine:sky=s.onnx"),
    ],
)
def test_a_sky_model_is_an_option_beside_presets_and_banks(words, name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "s.onnx").write_bytes(bright_sky())
    sv.Detector(label="mine").save("b.npz")
    command = parse(["evaluate", ".", "--sky", "s.onnx", "--sky", "0", *words.split()])
    (found,) = command.methods.chosen()
    assert found.sky == sv.SkyModel("s.onnx", bright_sky())
    assert command.truths.sky == "0"
    assert found.name == name


def test_no_sky_model_is_a_sentence():
    with pytest.raises(sv.MethodError, match="huge is no sky model"):
        parse(["detect", "a.jpg", "--sky", "huge"]).methods.chosen()


@pytest.mark.parametrize("words", ["--preset paper", "--config.sky-weight 0"])
def test_a_sky_model_that_would_not_run_is_refused(words):
    command = parse(["evaluate", ".", "--sky", "small", *words.split()])
    with pytest.raises(UsageError, match="runs no sky model, for its sky_weight is 0"):
        command.methods.chosen()


def test_photos_among_methods_go_before_them(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("hills", "default", "b.npz"):
        (tmp_path / name).mkdir()
    words = "evaluate --method paper default b.npz x:Y hills gone.jpg --workers 1 hills"
    moved = "evaluate hills gone.jpg --method paper default b.npz x:Y --workers 1 hills"
    assert spelt_out(words.split(), masks=()) == moved.split()
    alone = ["detect", "--method", "hills"]
    assert spelt_out(alone, masks=()) == alone


def test_an_earlier_run_says_where_settings_start(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = {"settings": {"x": {"config": {"delta": 9}, "sky": "large"}}}
    (tmp_path / "run.json").write_text(json.dumps(told))
    words = ["detect", "a.jpg", "--config", "run.json"]
    asked = described(words)
    assert (asked.config.delta, asked.sky_model, asked.ours) == (9, "large", True)
    command = parse([*words, "--config.v", "0.25"])
    assert command.methods.one().name == "default:v=0.25,delta=9,sky=large"
    training = parse(["train", "hills", "--out", "b.npz", "--config", "run.json"]).training
    assert training.detector.delta == 9
    with pytest.raises(UsageError, match="both say where settings start"):
        described([*words, "--preset", "paper"])
