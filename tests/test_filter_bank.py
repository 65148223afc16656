"""Filter banks: what is refused, exact round trips, and files that are none."""

import io
import json
import pickle
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import skyline_viz
from skyline_viz.bins import Bins
from skyline_viz.config import FILTER_SIZES, DetectorConfig
from skyline_viz.detector import Detector
from skyline_viz.filter_bank import STARVED_SAMPLES, FilterBank, FilterBankError, Provenance
from skyline_viz.system.notes import heard_by
from testing.methods import write_bank

SMALL = Bins(2, 2, 1, 0.7, 10, 99)


class Marks:
    """Touches a file when it is unpickled."""

    def __init__(self, path):
        self.path = str(path)

    def __reduce__(self):
        return (open, (self.path, "w"))


def small(**changes):
    rng = np.random.default_rng(0)
    fields = {
        "filters": rng.normal(size=(4, 3, 3)),
        "samples": np.array([0, 49, 50, 10**12]),
        "bins": SMALL,
        "provenance": Provenance("Alpen, Ötztal", 40, 7, "grey", 0.1, "1.2.3"),
    }
    return FilterBank(**fields | changes)


@pytest.fixture
def saved(tmp_path):
    path = tmp_path / "bank.npz"
    small().save(path)
    return path


def as_npy(array):
    file = io.BytesIO()
    np.save(file, array, allow_pickle=True)
    return file.getvalue()


def header(path, **changes):
    with np.load(path) as archive:
        content = json.loads(archive["header"].tobytes())
    return as_npy(np.frombuffer(json.dumps(content | changes).encode(), np.uint8))


def with_entry(path, name, content):
    """Replace one array of a saved bank by other bytes; None leaves it out."""
    with zipfile.ZipFile(path) as archive:
        entries = {entry: archive.read(entry) for entry in archive.namelist()}
    entries[f"{name}.npy"] = content
    with zipfile.ZipFile(path, "w") as archive:
        for entry, data in entries.items():
            if data is not None:
                archive.writestr(entry, data)


def refused(path):
    """The sentence with which a file is refused."""
    with pytest.raises(FilterBankError) as caught:
        FilterBank.load(path)
    sentence = str(caught.value)
    assert str(path) in sentence
    assert sentence.endswith(".")
    return sentence


# Construction


def test_arrays_are_copied_checked_and_frozen():
    filters, samples = np.ones((4, 3, 3)), [1, 2, 3, 4]
    bank = small(filters=filters, samples=samples)
    filters[:] = 9
    assert (bank.filters == 1).all()
    assert (bank.filters.dtype, bank.samples.dtype) == (np.float32, np.int64)
    for array in (bank.filters, bank.samples):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    with pytest.raises(AttributeError):
        bank.filters = filters


def test_starved_bins():
    assert STARVED_SAMPLES == 50
    assert small().starved.tolist() == [True, True, False, False]


@pytest.mark.parametrize("size", FILTER_SIZES)
def test_filter_sizes(size, tmp_path):
    bank = small(filters=np.ones((4, size, size)))
    assert bank.size == size
    bank.save(tmp_path / "a.npz")
    assert FilterBank.load(tmp_path / "a.npz").size == size


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"filters": np.ones((3, 3, 3))}, "4 bins need filters"),
        ({"filters": np.ones((4, 3, 5))}, "4 bins need filters"),
        ({"filters": np.ones((4, 9))}, "4 bins need filters"),
        ({"filters": np.ones((4, 4, 4))}, "pixels a side, not 4"),
        ({"filters": np.ones((4, 17, 17))}, "pixels a side, not 17"),
        ({"filters": np.full((4, 3, 3), np.nan)}, "not finite"),
        ({"samples": [1, 2, 3]}, "4 sample counts"),
        ({"samples": [1, 2, 3, -1]}, "0 or more"),
        ({"bins": Bins()}, "288 bins need filters"),
    ],
)
def test_what_is_refused(changes, message):
    with pytest.raises(FilterBankError, match=message):
        small(**changes)


# Files


def test_round_trip(saved):
    bank, again = small(), FilterBank.load(saved)
    for name in ("filters", "samples"):
        assert getattr(again, name).dtype == getattr(bank, name).dtype
        assert np.array_equal(getattr(again, name), getattr(bank, name))
    assert again.bins == bank.bins
    assert again.provenance == bank.provenance


def test_the_same_bank_gives_the_same_bytes(saved, tmp_path):
    small().save(tmp_path / "b.npz")
    FilterBank.load(saved).save(tmp_path / "c.npz")
    assert (tmp_path / "b.npz").read_bytes() == saved.read_bytes()
    assert (tmp_path / "c.npz").read_bytes() == saved.read_bytes()
    small(samples=[1, 2, 3, 4]).save(tmp_path / "b.npz")
    assert (tmp_path / "b.npz").read_bytes() != saved.read_bytes()


def test_paths_may_be_strings_without_a_suffix(tmp_path):
    path = str(tmp_path / "new folder" / "bank")
    small().save(path)
    assert FilterBank.load(path).bins == SMALL
    assert [file.name for file in Path(path).parent.iterdir()] == ["bank"]


def test_a_failed_save_leaves_the_old_file(saved, monkeypatch):
    before = saved.read_bytes()

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(np, "savez_compressed", full)
    with pytest.raises(OSError, match="No space left"):
        small(samples=[1, 2, 3, 4]).save(saved)
    assert saved.read_bytes() == before
    assert list(saved.parent.iterdir()) == [saved]


def test_pickling(saved):
    bank = FilterBank.load(saved)
    again = pickle.loads(pickle.dumps(bank))
    assert np.array_equal(again.filters, bank.filters)
    assert again.provenance == bank.provenance


def test_the_shipped_bank():
    bank = FilterBank.default()
    assert bank.filters.shape == (288, 7, 7)
    assert bank.bins == Bins()
    assert bank.samples.sum() > 10_000
    assert not bank.starved.all()
    assert np.abs(bank.filters).max() < 100
    path = Path(skyline_viz.__file__).with_name("filter_bank.npz")
    assert path.stat().st_size <= 60_000


def test_the_shipped_bank_says_where_it_comes_from():
    provenance = FilterBank.default().provenance
    assert provenance.images >= 10
    assert provenance.edges == "colour"
    assert provenance.smoothness > 0
    assert provenance.package


# Files that are no bank


def test_a_missing_file(tmp_path):
    assert refused(tmp_path / "none.npz").endswith("none.npz does not exist.")


def test_a_folder(tmp_path):
    refused(tmp_path)


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"column,row,visible\n0,3,1\n",
        b"PK\x03\x04",
        b"\x93NUMPY",
        b"\x80\x04K\x01.",
        b"\0" * 999,
    ],
)
def test_other_files(tmp_path, content):
    (tmp_path / "a.npz").write_bytes(content)
    refused(tmp_path / "a.npz")


def test_a_single_array(tmp_path):
    with (tmp_path / "a.npz").open("wb") as file:
        np.save(file, np.zeros(3))
    refused(tmp_path / "a.npz")


@pytest.mark.parametrize("content", [{}, {"filters": np.ones(3)}, {"header": np.arange(9)}])
def test_an_archive_of_something_else(tmp_path, content):
    np.savez(tmp_path / "a.npz", **content)
    assert "not a filter bank" in refused(tmp_path / "a.npz")


def test_truncated_files(saved):
    content = saved.read_bytes()
    for length in range(0, len(content), 7):
        saved.write_bytes(content[:length])
        refused(saved)


def test_any_damaged_byte_is_refused_or_harmless(saved):
    content = saved.read_bytes()
    found = {True: 0, False: 0}
    for place in range(len(content)):
        damaged = bytearray(content)
        damaged[place] ^= 0xFF
        saved.write_bytes(damaged)
        try:
            bank = FilterBank.load(saved)
        except FilterBankError as error:
            assert str(saved) in str(error)
            found[False] += 1
        else:
            assert np.array_equal(bank.filters, small().filters)
            found[True] += 1
    assert found[False] > 2 * found[True]


@pytest.mark.parametrize("name", ["header", "filters", "samples"])
def test_nothing_is_unpickled(saved, name):
    flag = saved.with_name("unpickled")
    payload = as_npy(np.array([Marks(flag)], object))
    np.load(io.BytesIO(payload), allow_pickle=True)[0].close()
    assert flag.exists()
    flag.unlink()
    with_entry(saved, name, payload)
    refused(saved)
    assert not flag.exists()


def test_a_bare_pickle_is_not_unpickled(saved):
    flag = saved.with_name("unpickled")
    saved.write_bytes(pickle.dumps(Marks(flag)))
    refused(saved)
    assert not flag.exists()


@pytest.mark.parametrize("name", ["header", "filters", "samples"])
def test_a_missing_array(saved, name):
    with_entry(saved, name, None)
    refused(saved)


@pytest.mark.parametrize("version", [3, 0, None, "2", [2]])
def test_other_versions_are_told(saved, version):
    with_entry(saved, "header", header(saved, version=version))
    sentence = refused(saved)
    assert f"of version {version}; this program reads version 2" in sentence


def test_a_bank_of_an_earlier_version_is_read(tmp_path):
    path = write_bank(small(), tmp_path / "bank.npz")
    again = FilterBank.load(path)
    assert np.array_equal(again.filters, small().filters)
    assert (again.bins, again.provenance) == (small().bins, small().provenance)
    assert again.provenance.detector is None
    assert again.provenance.settings == DetectorConfig(edge_source="grey")
    with_entry(path, "header", header(path, version=2))
    assert "of version 2; this program reads version 1" in refused(path)


@pytest.mark.parametrize("terrain", [np.ones(12, np.float32), np.zeros(3)])
def test_the_terrain_model_of_an_earlier_version_is_passed_over(saved, terrain):
    told = small().header()["bank"]
    told["provenance"]["detector"] = {"delta": 2, "terrain_weight": 4.0}
    with_entry(saved, "header", header(saved, bank=told))
    with_entry(saved, "terrain", as_npy(terrain))
    heard = []
    with heard_by(heard.append):
        again = FilterBank.load(saved)
        assert Detector.load(saved).config == again.provenance.settings
    assert np.array_equal(again.filters, small().filters)
    assert again.provenance.detector == DetectorConfig(delta=2)
    assert set(again.arrays()) == {"filters", "samples"}
    (sentence,) = heard
    assert sentence.startswith(f"{saved} was made with terrain_weight 4, which is gone: ")


def test_a_bank_knows_the_settings_it_was_trained_for(tmp_path):
    made = Provenance("hills", detector=DetectorConfig.paper())
    small(provenance=made).save(tmp_path / "bank.npz")
    again = FilterBank.load(tmp_path / "bank.npz")
    assert again.provenance == made
    assert again.provenance.settings == DetectorConfig.paper()


@pytest.mark.parametrize(
    "changes",
    [
        {"format": "another"},
        {"format": None},
        {"bins": None},
        {"bins": {}},
        {"bins": {"depths": 3}},
        {"bins": {"coherences": 2, "strengths": 2, "orientations": 0}},
        {"bins": {"coherences": 2.5, "strengths": 2, "orientations": 1}},
        {"bins": {"coherences": "2", "strengths": 2, "orientations": 1}},
        {"bins": {"coherences": 1000, "strengths": 1000, "orientations": 1000}},
        {"provenance": None},
        {"provenance": {"author": "me"}},
        {"provenance": {"detector": 3}},
        {"provenance": {"detector": {"delta": -1}}},
        {"provenance": {"detector": {"slope": 1}}},
    ],
    ids=repr,
)
def test_other_headers(saved, changes):
    told = small().header()["bank"]
    if "format" not in changes:
        changes = {"bank": {**told, **changes}}
    with_entry(saved, "header", header(saved, **changes))
    refused(saved)


@pytest.mark.parametrize("bank", [None, 3, "x", [], {}, [["bins", 1]]], ids=repr)
def test_headers_that_tell_of_no_bank(saved, bank):
    with_entry(saved, "header", header(saved, bank=bank))
    refused(saved)


@pytest.mark.parametrize("text", [b"", b"[1]", b"{", b"\xff", b"null", b"[" * 100_000])
def test_headers_that_are_no_json_object(saved, text):
    with_entry(saved, "header", as_npy(np.frombuffer(text, np.uint8)))
    refused(saved)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("filters", np.ones((5, 3, 3))),
        ("filters", np.full((4, 3, 3), np.nan)),
        ("filters", np.array("text")),
        ("samples", np.array(["a", "b", "c", "d"])),
        ("samples", np.array([1, 2, 3, -4])),
    ],
)
def test_other_arrays(saved, name, content):
    with_entry(saved, name, as_npy(content))
    refused(saved)


def test_an_array_larger_than_memory(saved):
    claim = as_npy(np.zeros(4, np.float32)).replace(b"(4,), }", b"(99999999999999,), }")
    with_entry(saved, "filters", claim)
    refused(saved)


def test_a_bank_is_changed_by_making_another():
    bank = small()
    assert replace(bank, provenance=Provenance("x")).provenance.dataset == "x"
    with pytest.raises(FilterBankError):
        replace(bank, bins=Bins())
