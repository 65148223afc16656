"""Filter banks and methods that were damaged, or made to do damage, with the right checksums."""

import io
import json
import struct
import tracemalloc
import zipfile
from dataclasses import replace

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.method import MethodError
from skyline_viz.methods.descriptors import LENGTH
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.methods.registry import Trained, load_method, make_method, save_method
from skyline_viz.methods.score_images import PATCH
from skyline_viz.rendering import render
from skyline_viz.system.headed_npz import MOST_BYTES, NpzError, opened
from testing.harm import Mutations, as_npy, members, npz_of
from testing.methods import write_bank, write_method

MOST_TAKEN = 64 << 20
"""Bytes that reading any of the files here may take at a time."""


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """One file of each kind."""
    folder = tmp_path_factory.mktemp("files")
    bank = sv.FilterBank.default()
    bank.save(folder / "bank.npz")
    sv.find_method("steep=paper:delta=4").save(folder / "detector.npz")
    write_bank(bank, folder / "earlier-bank.npz")
    write_method(folder / "earlier-edges.npz", "edges", EdgesOnly().settings())
    save_method(EdgesOnly(), folder / "edges.npz", Trained("hills", 4))
    models = {
        "sift-hog-edges": {"weights": np.zeros(LENGTH, np.float32), "bias": np.zeros(1)},
        "svm-dcsi": {
            "weights": np.zeros((PATCH, PATCH), np.float32),
            "bias": np.zeros(1),
            "logistic": np.ones(2),
        },
    }
    for name, model in models.items():
        save_method(replace(make_method(name), model=model), folder / f"{name}.npz", Trained())
    return folder


def outcome(path):
    """The sentence with which a file is refused, or the method that it holds."""
    for read, error in ((sv.FilterBank.load, sv.FilterBankError), (load_method, MethodError)):
        try:
            found = read(path)
        except error as problem:
            said = str(problem)
            assert said.startswith(str(path)) or f" {path}" in said, said
            assert said.endswith(".")
            assert "\n" not in said
            assert not any(word in said for word in ("object", "Error", "NoneType", "dtype")), said
        else:
            return found
    return said


@pytest.mark.parametrize(
    "name",
    [
        "bank",
        "detector",
        "edges",
        "sift-hog-edges",
        "svm-dcsi",
        "earlier-bank",
        "earlier-edges",
    ],
)
def test_mutations_are_sentences_or_do_no_harm(name, files, tmp_path):
    photo = render("desert", 50, 60, 48).photo
    mutations = Mutations(files / f"{name}.npz", seed=1)
    path = tmp_path / "mutant.npz"
    tracemalloc.start()
    try:
        for _ in range(60):
            path.write_bytes(mutations.next())
            tracemalloc.reset_peak()
            found = outcome(path)
            assert tracemalloc.get_traced_memory()[1] < MOST_TAKEN
            if isinstance(found, sv.FilterBank):
                sv.Detector(found).detect(photo)
    finally:
        tracemalloc.stop()


def header_of(shape, descr="<f4"):
    said = str({"descr": descr, "fortran_order": False, "shape": shape}).encode() + b"\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(said)) + said


BOMB = header_of((2000, 1000, 1000)) + bytes(1 << 24)

HARMS = {
    "an array larger than memory": {"filters": header_of((10**15,))},
    "a shape that overflows": {"filters": header_of((2**40, 2**40))},
    "a negative shape": {"filters": header_of((-1, 7, 7))},
    "a shape of booleans": {"filters": header_of((True, 7))},
    "a shape of text": {"filters": header_of(("x",))},
    "a bomb": {"filters": BOMB},
    "objects": {"filters": as_npy(np.array([{}], object))},
    "dates": {"filters": as_npy(np.zeros(3, "M8[s]"))},
    "records": {"filters": as_npy(np.zeros(3, [("a", "f4")]))},
    "other bytes first": {"filters": as_npy(np.zeros((288, 7, 7), ">f4"))},
    "no magic": {"filters": b"XNUMPY"},
    "nothing": {"filters": b""},
    "half a description": {"filters": header_of((3,))[:20]},
    "a description without an end": {"filters": b"\x93NUMPY\x01\x00\x08\x00{'descr'"},
    "a long description": {"filters": b"\x93NUMPY\x02\x00" + struct.pack("<I", 1 << 30)},
    "an unknown version": {"filters": b"\x93NUMPY\x09\x00" + bytes(99)},
    "brackets": {"filters": b"\x93NUMPY\x01\x00\xff\x0f" + b"(" * 4095},
    "a header nested too deep": {"header": as_npy(np.frombuffer(b"[" * 100_000, np.uint8))},
    "a header of megabytes": {"header": as_npy(np.zeros(1 << 21, np.uint8))},
    "a header of numbers": {"header": as_npy(np.frombuffer(b"5", np.uint8))},
    "a header of another type": {"header": as_npy(np.zeros(9))},
    "a folder": {"filters/x": b"x"},
    "an archive in the archive": {"inner.zip": npz_of({"a": b"b"})},
}


@pytest.mark.parametrize("harm", HARMS)
def test_what_is_made_to_do_damage_is_refused_for_little(harm, files, tmp_path):
    path = tmp_path / "harmful.npz"
    path.write_bytes(npz_of(members(files / "bank.npz") | HARMS[harm]))
    tracemalloc.start()
    try:
        said = outcome(path)
        assert isinstance(said, str)
        assert tracemalloc.get_traced_memory()[1] < MOST_TAKEN
    finally:
        tracemalloc.stop()


def test_directories_that_lie_are_refused(files, tmp_path):
    content = (files / "bank.npz").read_bytes()
    place = content.rindex(b"PK\x01\x02")
    path = tmp_path / "lying.npz"
    for offset, bytes_ in ((8, b"\x01\x00"), (10, b"\x0c\x00"), (24, b"\xff\xff\xff\x7f")):
        at = place + offset  # encrypted, packed with bzip2, two gigabytes
        path.write_bytes(content[:at] + bytes_ + content[at + len(bytes_) :])
        assert isinstance(outcome(path), str)
    path.write_bytes(content[:-2] + b"\x05\x00hello")  # a comment
    assert isinstance(outcome(path), str)
    path.write_bytes(content[:-12] + b"\xff\xff" + content[-10:])  # 65,535 members
    assert "65,535 arrays" in str(outcome(path))


def test_two_arrays_of_one_name_are_refused(files, tmp_path):
    path = tmp_path / "twice.npz"
    with zipfile.ZipFile(path, "w") as archive, pytest.warns(UserWarning, match="Duplicate"):
        for name, content in members(files / "bank.npz").items():
            archive.writestr(f"{name}.npy", content)
        archive.writestr("filters.npy", b"x")
    assert "two arrays called filters" in str(outcome(path))


def test_devices_and_folders_are_no_files(tmp_path):
    for path in (tmp_path, "/dev/zero"):
        with pytest.raises(sv.FilterBankError, match="it is no file"):
            sv.FilterBank.load(path)


@pytest.mark.parametrize(
    "settings",
    [
        {"delta": 10**30},
        {"delta": True},
        {"gap_cost": float("nan")},
        {"gap_cost": float("inf")},
        {"delta": [1]},
        {"unknown": 1},
        {"low_threshold": None},
    ],
)
def test_absurd_settings_are_refused(settings, files, tmp_path):
    parts = members(files / "edges.npz")
    header = json.loads(np.load(io.BytesIO(parts["header"])).tobytes())
    header["settings"] |= settings
    text = json.dumps(header).encode()
    path = tmp_path / "m.npz"
    path.write_bytes(npz_of(parts | {"header": as_npy(np.frombuffer(text, np.uint8))}))
    with pytest.raises(MethodError, match=r"m\.npz is damaged"):
        load_method(path)


def test_what_was_written_in_columns_is_read(tmp_path):
    wide = np.asfortranarray(np.arange(12, dtype=np.float32).reshape(3, 4))
    np.savez(tmp_path / "a.npz", header=np.frombuffer(b"{}", np.uint8), wide=wide, none=wide[:0])
    with opened(tmp_path / "a.npz") as file:
        np.testing.assert_array_equal(file.read("wide"), wide)
        assert file.read("none").shape == (0, 4)
        assert set(file.arrays) == {"wide", "none"}
        with pytest.raises(NpzError, match="its other is missing"):
            file.read("other")
    assert MOST_BYTES == 1 << 30
