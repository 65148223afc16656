"""Whom the viewer answers and contacts, and how much memory large photos take."""

from __future__ import annotations

import http.client
import itertools
import multiprocessing
import shutil
import tempfile
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from urllib.parse import urlsplit

import cv2
import numpy as np

from annotate.server.security import TOKEN_HEADER
from annotate.work.open_photos import BUDGET
from benchmarks.reliability import Trial
from skyline_viz.photo import read_photo, write_photo
from skyline_viz.system.memory import in_words
from skyline_viz.viewer.program.web_viewer import served as served_recordings
from testing.labelling import TOKEN, served, workbench, write_hills
from testing.programs.browser import chromium

SAMPLE = Path(__file__).resolve().parents[2] / "sample_data" / "images" / "clear-2.jpg"
OURS = ("127.0.0.1:{port}", "localhost:{port}", "[::1]:{port}")
OTHERS = ("evil.example", "evil.example:{port}", "127.0.0.2", "127.0.0.2:1", "0.0.0.0:{port}", "")
ORIGINS = (None, "null", "http://evil.example", "http://evil.example:{port}", "https://localhost")
TOKENS = (None, "", TOKEN[:-1], TOKEN.upper(), TOKEN)
RECORDINGS = ("/api/photos/1/recording", "/api/photos/2/recording", "/api/photos/1/stages/cost")
GPU = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
SIZES = ((12, 4000, 3000), (24, 6000, 4000), (48, 8000, 6000))


def measured() -> list[Trial]:
    """Try all of it."""
    folder = Path(tempfile.mkdtemp(prefix="skyline-memory-"))
    try:
        return [
            _page(folder / "page"),
            _serve(folder),
            _browser(folder / "browser"),
            *_large(folder),
        ]
    finally:
        shutil.rmtree(folder)


def _page(folder: Path) -> Trial:
    """The labelling server's recordings, asked for by whoever should not have them."""
    asked = leaked = refused_rightly = 0
    with served(write_hills(folder, count=2)) as client:
        port = client.base_url.port
        for path, host, origin, token in itertools.product(
            RECORDINGS, (*OURS, *OTHERS), ORIGINS, TOKENS
        ):
            if host in OURS and origin is None and token == TOKEN:
                continue  # the page itself
            status, size = _ask(port, path, host, {"Origin": origin, TOKEN_HEADER: token})
            asked += 1
            refused_rightly += status in (400, 401, 403, 421)
            leaked += size if status == 200 else 0
    lost = "nothing" if not leaked else f"{leaked:,} bytes"
    if refused_rightly != asked:
        lost += f"; {asked - refused_rightly} answers of another kind"
    return Trial(
        "another website, a wrong name or no token",
        f"{len(RECORDINGS)} routes with stages, {len(OURS) + len(OTHERS)} host names, "
        f"{len(ORIGINS)} origins, {len(TOKENS)} tokens: all but the page itself",
        asked,
        lost,
    )


def _serve(folder: Path) -> Trial:
    """What ``inspect --serve`` serves."""
    file = folder / "photo.rrd"
    file.write_bytes(b"a recording" * 1000)
    asked = leaked = 0
    with served_recordings([file]) as address:
        where = urlsplit(address)
        right = f"{where.path}0.rrd"
        wrong = ("/0.rrd", "/", right[:-1], right.upper(), f"/x{right}", f"{where.path}../x")
        for path, host, origin in itertools.product((*wrong, right), (*OURS, *OTHERS), ORIGINS):
            if path == right and host in OURS and origin is None:
                continue
            status, size = _ask(where.port, path, host, {"Origin": origin})
            asked += 1
            leaked += size if status == 200 else 0
    return Trial(
        "`inspect --serve` asked under another name, by another website, at another address",
        f"{len(wrong) + 1} addresses, {len(OURS) + len(OTHERS)} host names, {len(ORIGINS)} origins",
        asked,
        f"{leaked:,} bytes" if leaked else "nothing",
    )


def _ask(port: int | None, path: str, host: str, headers: dict[str, str | None]) -> tuple[int, int]:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
    try:
        connection.putrequest("GET", path, skip_host=True)
        for name, value in {"Host": host, **headers}.items():
            if value is not None:
                connection.putheader(name, value.format(port=port))
        connection.endheaders()
        answer = connection.getresponse()
        return answer.status, len(answer.read())
    finally:
        connection.close()


def _browser(folder: Path) -> Trial:
    """Every request of a browser that shows stages, twice and once more after a reload."""
    own = ("data:", "blob:", "about:")
    asked: list[str] = []
    with served(write_hills(folder, count=2)) as client, chromium(GPU) as browser:
        here = f"127.0.0.1:{client.base_url.port}"
        context = browser.new_context(viewport={"width": 1000, "height": 700})
        context.on("request", lambda request: asked.append(request.url))
        page = context.new_page()
        for photo in (1, 2, None):
            if photo is None:
                page.reload()
            else:
                where = f"recording=../../api/photos/{photo}/recording&token={TOKEN}"
                page.goto("about:blank")
                page.goto(f"http://{here}/static/stages/#{where}")
            page.locator("#said").wait_for(state="hidden", timeout=120_000)
            page.wait_for_timeout(10_000)  # reports of use are sent some seconds after the start
        context.close()
    sent = [url for url in asked if not url.startswith(own)]
    elsewhere = [url for url in sent if urlsplit(url).netloc != here]
    return Trial(
        "the viewer asks for news and reports its use",
        "every request of Chromium while stages are shown, two photos and a reload",
        len(sent),
        f"{len(elsewhere)} requests to others" if elsewhere else "nothing: all went to the server",
    )


def _large(folder: Path) -> list[Trial]:
    found = []
    for megapixels, width, height in SIZES:
        photos = folder / f"{megapixels}"
        photos.mkdir()
        for number in range(3):
            _write(photos / f"{number}.jpg", width, height, number)
        held, peak, most = _apart(_open_one_after_another, photos)
        found.append(
            Trial(
                f"photos of {megapixels} megapixels, one after another in the page",
                "each opened, its margins and the cost overlay asked for, the next one prepared",
                3,
                f"nothing; {most} open at most, counted {in_words(held)} of {in_words(BUDGET)}, "
                f"peak of the process {in_words(peak)}",
            )
        )
    panorama = folder / "panorama.jpg"
    _write(panorama, 20000, 2000, 7)
    for words in (["detect", "--out"], ["inspect", "--save"]):
        target = folder / ("out" if words[0] == "detect" else "panorama.rrd")
        status, peak, _ = _apart(_command, [words[0], str(panorama), words[1], str(target)])
        size = sum(
            one.stat().st_size for one in ([target] if target.is_file() else target.iterdir())
        )
        found.append(
            Trial(
                "a panorama of 20000x2000 pixels",
                f"`skyline-viz {words[0]}`",
                1,
                "the photo"
                if status
                else f"nothing; peak {in_words(peak)}, {in_words(size)} written",
            )
        )
    return found


def _write(path: Path, width: int, height: int, seed: int) -> None:
    """A large photo: a sample, stretched, with noise that makes edges of its own."""
    photo = cv2.resize(read_photo(SAMPLE), (width, height), interpolation=cv2.INTER_CUBIC)
    noise = np.random.default_rng(seed).normal(0, 9, (height, width)).astype(np.float32)
    write_photo(path, np.clip(photo + noise[..., None], 0, 255).astype(np.uint8))


def _apart(what: Callable[..., tuple[int, int]], argument: object) -> tuple[int, int, int]:
    """Do something in a process of its own; return what it found and the peak of its memory."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        first, second = pool.submit(what, argument).result()
        return first, pool.submit(_peak).result(), second


def _peak() -> int:
    """Peak of this process, in bytes; what `resource` tells begins with that of its parent."""
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    return next(int(line.split()[1]) * 1024 for line in lines if line.startswith("VmHWM:"))


def _open_one_after_another(folder: Path) -> tuple[int, int]:
    bench = workbench(folder)
    held = most = 0
    try:
        for photo in bench.photos:
            session = bench.session(photo)
            bench.prepare_after(photo)
            with session.lock:
                session.wire.refresh()
            bench.detection(bench.session(photo))
            bench._ahead.submit(lambda: None).result()  # until the next one is prepared
            held, most = max(held, bench._open.total), max(most, len(bench._open.open))
    finally:
        bench.close()
    return held, most


def _command(words: list[str]) -> tuple[int, int]:
    from skyline_viz.cli import main  # noqa: PLC0415

    return main(words), 0
