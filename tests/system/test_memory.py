"""Memory counted in bytes: which photos stay open, what is said before work, what is refused."""

import gc
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

from annotate.cli import main as label
from annotate.work import open_photos
from annotate.work.open_photos import KEPT, OPEN_AT_MOST, SESSION, OpenPhotos, Room
from skyline_viz.cli import main
from skyline_viz.command_line import sizes
from skyline_viz.detector import Detector
from skyline_viz.photo import PhotoError, read_photo, write_photo
from skyline_viz.system import memory
from testing.examples import examples
from testing.labelling import hills, served, workbench, write_hills

BUDGET = 1000


class Opening(RuleBasedStateMachine):
    """Photos are opened, shown and closed in any order."""

    def __init__(self):
        super().__init__()
        self.photos = OpenPhotos(Room(BUDGET))
        self.sizes = {}
        self.shown = self.newest = None

    @rule(photo=st.integers(1, 9), size=st.integers(1, 2 * BUDGET))
    def take(self, photo, size):
        size = self.sizes.setdefault(photo, size)
        known = self.photos.get(photo)
        future, mine = self.photos.take(photo, size)
        assert mine == (known is None)
        assert future is self.photos.get(photo)
        self.newest = photo

    @rule(photo=st.integers(1, 9))
    def show(self, photo):
        self.photos.show(photo)
        self.shown = self.newest = photo

    @rule(photo=st.integers(1, 9), size=st.integers(1, 2 * BUDGET))
    def keep_beside(self, photo, size):
        own = self.sizes.get(photo, 0) if self.photos.get(photo) else 0
        before = self.photos.open
        kept = self.photos.keep_beside(photo, size)
        assert kept == (own + size <= BUDGET)
        for one in (photo, self.shown):
            assert one not in before or one in self.photos.open
        self.newest = photo if kept else self.newest

    @rule(photo=st.integers(1, 9))
    def close(self, photo):
        self.photos.close(photo)
        assert photo not in self.photos.open

    @rule(photo=st.integers(1, 9))
    def close_others(self, photo):
        self.photos.close_others(photo)
        assert set(self.photos.open) <= {photo, self.shown}

    @rule()
    def drop_beside(self):
        self.photos.drop_beside()

    @invariant()
    def what_does_not_fit_is_closed_but_for_the_shown_and_the_newest(self):
        kept = set(self.photos.open)
        needed = {self.shown, self.newest}
        assert kept <= needed or (self.photos.total <= BUDGET and len(kept) <= OPEN_AT_MOST)


TestOpening = Opening.TestCase
TestOpening.settings = examples(60, stateful_step_count=25)


def test_the_least_recently_used_is_closed_first():
    photos = OpenPhotos(Room(BUDGET))
    for photo in (1, 2, 3):
        photos.take(photo, 300)
    photos.take(1, 300)
    photos.take(4, 300)
    assert photos.open == [3, 1, 4]


def test_the_shown_one_stays_however_large_it_is():
    photos = OpenPhotos(Room(BUDGET))
    photos.take(1, 5000)
    photos.show(1)
    for photo in (2, 3, 4):
        photos.take(photo, 10)
    assert photos.open == [1, 4]
    assert not photos.fits(1)


def test_an_open_photo_takes_what_is_counted(tmp_path):
    bench = workbench(write_hills(tmp_path, count=1, height=200, width=300))
    try:
        session = bench.session(1)
        session.wire.forbid([(20, 20)], 5)
        session.wire.refresh()
        planes = [session.pixels, *vars(session.wire._tables).values()]
        arrays = {id(one): one for one in planes if isinstance(one, np.ndarray) and one.ndim > 1}
        taken = sum(one.nbytes for one in arrays.values())
        assert 0.95 * SESSION <= taken / (200 * 300) <= SESSION
    finally:
        bench.close()


def open_all(bench, count):
    for photo in range(1, count + 1):
        bench.session(photo)
        bench.prepare_after(photo)
        bench._ahead.submit(lambda: None).result()
        yield photo


def test_the_next_photo_is_opened_only_where_it_fits(tmp_path):
    one = 48 * 70 * SESSION
    write_hills(tmp_path, count=4)
    for budget, most in ((int(1.5 * one), 1), (int(2.5 * one), 2), (10 * one, OPEN_AT_MOST)):
        bench = workbench(tmp_path, budget=budget)
        try:
            opened = [len(bench._open.open) for _ in open_all(bench, 4)]
            assert max(opened) == most
            assert bench._open.total <= budget
        finally:
            bench.close()


def test_a_detection_is_kept_only_where_it_fits_and_goes_with_its_photo(tmp_path):
    one = 48 * 70 * SESSION
    write_hills(tmp_path, count=2)
    for budget, kept in ((int(1.2 * one), False), (3 * one, True)):
        bench = workbench(tmp_path, budget=budget)
        try:
            session = bench.session(1)
            bench.detection(session)
            assert (bench._detection is not None) == kept
            with_it = bench._open.total
            bench.session(2)
            bench.prepare_after(2)
            assert bench._detection is None
            assert bench._open.total <= with_it + one
        finally:
            bench.close()


def test_open_photos_of_usual_size_keep_their_detection(tmp_path, monkeypatch):
    bench = workbench(write_hills(tmp_path, count=2, height=200, width=300))
    try:
        found = [bench.session(photo).wire.detection for photo in (1, 2)]
        monkeypatch.setattr(Detector, "detect", None)  # nothing is detected again
        assert [bench.detection(bench.session(photo)) for photo in (1, 2)] == found
        assert all(open_photos.detection_bytes(one) <= 60_000 * KEPT for one in found)
        kept = sum(open_photos.detection_bytes(one) for one in found)
        assert bench._open.total == 2 * 60_000 * SESSION + kept
        bench.prepare_after(2)  # the one before needs it no more
        assert [bench.session(photo).wire.detection for photo in (1, 2)] == [None, found[1]]
        assert bench._open.total < 2 * 60_000 * SESSION + kept
    finally:
        bench.close()


def test_a_photo_that_does_not_fit_into_the_memory_is_refused_with_what_it_needs(
    tmp_path, monkeypatch
):
    bench = workbench(write_hills(tmp_path, count=1))
    try:
        monkeypatch.setattr(open_photos, "available", lambda: 100_000)
        with pytest.raises(PhotoError, match=r"needs about 0 MB of memory to open, and 0 MB"):
            bench.session(1)
        monkeypatch.setattr(open_photos, "available", lambda: None)
        assert bench.session(1).pixels.shape == (48, 70, 3)
    finally:
        bench.close()


@given(
    st.integers(1, 8),
    st.integers(1, 10**9),
    st.integers(1, 200),
    st.integers(0, 10**11) | st.none(),
)
def test_workers_fit_into_the_memory_or_there_is_one(workers, largest, each, free):
    fit = memory.fitting_workers(workers, largest, each, free)
    assert 1 <= fit <= workers
    if free is not None and fit > 1:
        assert fit * memory.needed(largest, each) <= free
    if free is None:
        assert fit == workers


def test_what_is_free_is_known_here():
    free = memory.available()
    assert free is None or 10_000_000 < free < 10**15


@pytest.mark.parametrize(
    ("most", "used", "left"), [("max", "5", None), ("100", "30", 70), ("100", "130", 0)]
)
def test_a_container_may_have_less(tmp_path, monkeypatch, most, used, left):
    (tmp_path / "memory.max").write_text(most + "\n")
    (tmp_path / "memory.current").write_text(used + "\n")
    monkeypatch.setattr(memory, "_GROUP", tmp_path)
    monkeypatch.setattr(memory, "_free_in_machine", lambda: 500)
    assert memory.available() == (500 if left is None else left)


@pytest.fixture
def photos(tmp_path):
    folder = tmp_path / "photos"
    folder.mkdir()
    for name, width in (("small", 60), ("large", 200)):
        write_photo(folder / f"{name}.png", hills(1, 50, width))
    return folder


def test_photos_over_the_limit_are_named_before_work_begins(photos, tmp_path, capsys):
    words = ["detect", str(photos), "--out", str(tmp_path / "out"), "--max-megapixels", "0.005"]
    assert main(words) == 1
    said = capsys.readouterr()
    first, second = said.err.splitlines()
    assert first == (
        "skyline-viz: large is over the limit of 0.005 megapixels, and will not be read; "
        "--max-megapixels raises it."
    )
    assert "large.png has 200x50 pixels, over the limit of 0.005 megapixels" in second
    assert said.out.startswith("small ")


def test_the_limit_reaches_workers_and_goes_with_the_command(photos, tmp_path, capsys):
    out = ["--out", str(tmp_path / "out"), "--workers", "2"]
    assert main(["detect", str(photos), *out, "--max-megapixels", "0.005"]) == 1
    assert "over the limit of 0.005 megapixels." in capsys.readouterr().err
    assert main(["detect", str(photos), *out]) == 0
    assert memory.photo_limit() == memory.MAX_MEGAPIXELS


@pytest.mark.parametrize("limit", ["0", "-1", "nan", "inf"])
def test_a_limit_is_a_number_above_0(photos, limit, capsys):
    assert main(["detect", str(photos), "--max-megapixels", limit]) == 2
    assert "--max-megapixels is a number above 0" in capsys.readouterr().err


def test_a_reader_may_have_a_limit_of_its_own(photos):
    memory.limit_photos(0.005)
    try:
        with pytest.raises(PhotoError, match=r"over the limit of 0\.005 megapixels"):
            read_photo(photos / "large.png")
        assert read_photo(photos / "large.png", max_megapixels=1).shape == (50, 200, 3)
    finally:
        memory.limit_photos(memory.MAX_MEGAPIXELS)


@pytest.mark.parametrize(
    ("workers", "free", "chosen", "said"),
    [
        ("0", None, 0, ""),
        ("0", 10**10, 0, ""),
        ("1", 10**8, 1, "2 photos of up to 0 megapixels need about 200 MB of memory, and 100 MB"),
        ("2", 3 * 10**8, 2, "need about 401 MB with 2 workers, and 300 MB are free; --workers 1"),
    ],
)
def test_what_does_not_fit_is_said_before_work_begins(
    photos, tmp_path, monkeypatch, capsys, workers, free, chosen, said
):
    asked = []
    monkeypatch.setattr(sizes, "available", lambda: free)
    monkeypatch.setattr(
        "skyline_viz.running.resume.Kept.run",
        lambda *_, workers: asked.append(workers) or [],
    )
    main(["detect", str(photos), "--out", str(tmp_path / "out"), "--workers", workers])
    assert asked == [chosen]
    assert said in capsys.readouterr().err


def test_chosen_workers_are_as_many_as_fit(photos, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(sizes, "available", lambda: 3 * 10**8)
    monkeypatch.setattr("skyline_viz.running.batch._HANDFUL", 1)
    monkeypatch.setattr("os.cpu_count", lambda: 4)
    assert main(["detect", str(photos), "--out", str(tmp_path / "out")]) == 0
    assert "so there are 1 workers and not 2." in capsys.readouterr().err


def test_what_a_detection_takes_is_counted(tmp_path):
    found = Detector().detect(hills(2, 200, 300))
    counted = open_photos.detection_bytes(found) / (200 * 300)
    cost_and_edges = 4 + 1
    assert cost_and_edges < counted <= memory.DETECTING


@pytest.mark.parametrize(("option", "full"), [([], True), (["--full-megapixels", "0.002"], False)])
def test_recordings_are_full_up_to_a_number_of_pixels(photos, tmp_path, capsys, option, full):
    file = tmp_path / "photo.rrd"
    assert main(["inspect", str(photos / "small.png"), "--save", str(file), *option]) == 0
    said = capsys.readouterr().err
    assert ("maps are kept lean" not in said) == full
    assert (b"exact" in file.read_bytes()) == full


def test_several_photos_share_the_pixels(photos, tmp_path, capsys):
    together = ["inspect", str(photos), "--headless", "--full-megapixels", "0.012"]
    assert main(together) == 0
    assert "maps are kept lean" in capsys.readouterr().err
    assert main([*together, "--split"]) == 0
    assert "maps are kept lean" not in capsys.readouterr().err


def test_the_list_and_the_start_of_labelling_say_what_is_too_large(photos, monkeypatch, capsys):
    monkeypatch.setattr(
        "annotate.commands.open.serve", lambda benches, *_, **__: benches[0].close()
    )
    words = ["open", str(photos), "--annotator", "ann", "--max-megapixels", "0.005"]
    try:
        assert label(words) == 0
        said = capsys.readouterr().err
        assert "large.png is over the limit of 0.005 megapixels, and will not be read" in said
        with served(photos) as client:
            listed = client.get("/api/photos").json()["photos"]
            found = {one["name"]: one["too_large"] for one in listed}
            answers = [client.get(f"/api/photos/{one['id']}").status_code for one in listed]
    finally:
        memory.limit_photos(memory.MAX_MEGAPIXELS)
    assert found == {"large.png": True, "small.png": False}
    assert answers == [410 if one["too_large"] else 200 for one in listed]


def test_freed_memory_is_kept_where_there_is_an_allocator_that_gives_it_back(monkeypatch):
    told = {}
    library = SimpleNamespace(mallopt=told.__setitem__)
    monkeypatch.setattr(memory.ctypes, "CDLL", lambda _: library)
    memory.keep_freed()
    assert told == memory._KEPT
    del library.mallopt
    memory.keep_freed()


@pytest.mark.parametrize("looked", [True, False])
def test_garbage_is_looked_for_after_loading_as_before(looked):
    before = gc.isenabled()
    (gc.enable if looked else gc.disable)()
    try:
        with pytest.raises(ValueError, match=r"^lost$"), memory.loading():
            assert not gc.isenabled()
            raise ValueError("lost")
        assert gc.isenabled() == looked
    finally:
        (gc.enable if before else gc.disable)()


def test_what_is_to_be_done_at_the_end_is_done():
    program = """
import atexit
from skyline_viz.system.memory import end_quickly
atexit.register(print, "done")
end_quickly()
end_quickly()
"""
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, check=True)
    assert ended.stdout.split() == [b"done"]
