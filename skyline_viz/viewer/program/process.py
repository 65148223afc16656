"""The Rerun viewer as a process: open it, or take pictures without a screen.

Whatever is started here listens on this machine alone, and contacts this machine alone; the
viewer's own defaults are every network, and its makers' servers.
"""

from __future__ import annotations

import io
import os
import socket
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from time import monotonic, sleep
from typing import TYPE_CHECKING, Any

import numpy as np
import rerun as rr
from PIL import Image

from skyline_viz.files import replacing
from skyline_viz.system.aftermath import ended, started
from skyline_viz.system.loopback import LOOPBACK
from skyline_viz.viewer.program.rerun_internals import ViewerError, program, viewer_client

if TYPE_CHECKING:
    from rerun.experimental import ViewerClient

WINDOW = (1280, 800)
"""Width and height of pictures, in pixels."""

_ALONE = dict.fromkeys(("HTTPS_PROXY", "HTTP_PROXY", "ALL_PROXY"), f"http://{LOOPBACK}:9") | {
    "NO_PROXY": f"{LOOPBACK},localhost"
}
"""A way out that leads nowhere: the viewer asks for news and reports its use, and has no switch."""

_ATTEMPTS = 3  # under load, the viewer gives up on a card now and then
_WAITING = 0.001  # share of a picture in which signs of waiting move

_START_SECONDS = 120.0  # on a machine that is busy with something else
_STILL_SECONDS = 60.0  # without any change, after which nothing more is expected
_PICTURE_SECONDS = 600.0  # that pictures may take at most, as long as something changes
_BAR = 37  # rows of the window's own bar, which stays when its content is hidden
_STEADY = 4  # pictures in a row that agree, 0.15 s apart: thumbnails come one by one
_ERRORS = (ConnectionError, RuntimeError, OSError, ValueError)  # what a client of a viewer raises


class UnsteadyError(ViewerError):
    """The viewer waits for something that never comes; another one may fare better."""


def has_display() -> bool:
    """Whether a window can be opened here: there is a screen, and it is this machine's."""
    if os.environ.get("CI"):
        return False
    if sys.platform in ("darwin", "win32"):
        return "SSH_CONNECTION" not in os.environ
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def open_viewer(sources: Sequence[str | Path], port: int | None = None) -> subprocess.Popen[bytes]:
    """Open the viewer's window on recordings, and return at once.

    Args:
        sources: Recording files, or addresses of a server's recordings.
        port: Where it listens; any unless given.
    """
    arguments = ["--port", str(port or "auto"), *map(str, sources)]
    return _start(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


@contextmanager
def web_server() -> Iterator[str]:
    """Run the viewer's own web server for a moment, without recordings, and hand out its address.

    It answers whoever reaches its port, so nothing but the viewer's program is ever on it; what
    shows recordings in a browser is `skyline_viz.web_viewer`.

    Raises:
        ViewerError: It does not start.
    """
    page, data = free_port(), free_port()
    arguments = ["--serve-web", "--web-viewer-port", str(page), "--port", str(data)]
    process = _start(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    deadline = monotonic() + _START_SECONDS
    try:
        while not _listens(page):
            if process.poll() is not None or monotonic() > deadline:
                raise ViewerError("the viewer's web server did not start.")
            sleep(0.05)
        yield f"http://{LOOPBACK}:{page}"
    finally:
        ended(process)


@contextmanager
def headless_viewer(
    sources: Sequence[str | Path] = (), window: tuple[int, int] = WINDOW
) -> Iterator[ViewerClient]:
    """Run a viewer without a screen, and hand out what drives it.

    Args:
        sources: Recording files or addresses to open.
        window: Width and height of its picture, in pixels.

    Raises:
        ViewerError: It does not start; mostly because there is no Vulkan driver.
    """
    port = free_port()
    arguments = ["--headless", "--window-size", f"{window[0]}x{window[1]}", "--port", str(port)]
    with tempfile.TemporaryFile() as log:
        process = _start([*arguments, *map(str, sources)], stdout=log, stderr=log)
        try:
            yield _connected(process, port, log)
        finally:
            ended(process)


def save_picture(source: str | Path, path: Path, window: tuple[int, int] = WINDOW) -> None:
    """Render what a source shows first into a PNG or JPEG file.

    Args:
        source: Recording file, or an address.
        path: Where to.
        window: Width and height of the picture, in pixels.

    Raises:
        ViewerError: No viewer, or the picture stays blank.
    """
    for attempt in range(_ATTEMPTS):
        with headless_viewer([source], window) as client:
            try:
                picture = settled_picture(client)
                break
            except UnsteadyError:  # another viewer asks for everything again
                if attempt == _ATTEMPTS - 1:
                    raise
    _save(picture, path)


def save_pictures(
    source: Path, path: Path, more: str = "", window: tuple[int, int] = WINDOW
) -> Iterator[Path]:
    """Render every tab of a recording into a file of its own, ``NAME-TAB.png`` or ``.jpg``.

    Args:
        source: Recording file.
        path: Where to, without the tab.
        more: What comes before the tab in the names.
        window: Width and height of the viewer's window, in pixels; pictures lack its own bar.

    Yields:
        The files as they are written.

    Raises:
        ViewerError: No viewer, or a picture stays blank.
    """
    with headless_viewer([source], window) as client:
        _hide_menu(client)
        for tab in tab_names(client):
            show_tab(client, tab)
            name = f"{path.stem}{more}-{tab.lower().replace(' ', '-')}{path.suffix}"
            picture = settled_picture(client)
            _save(picture.crop((0, _BAR, *picture.size)), path.with_name(name))
            yield path.with_name(name)


def send(sources: Sequence[Path], address: str) -> None:
    """Send recordings to a viewer that runs.

    Raises:
        ViewerError: None runs there.
    """
    client = viewer_client()
    try:
        client.connect(address).get_state()
    except _ERRORS as error:
        raise ViewerError(f"no viewer answers at {address}.") from error
    for source in sources:
        stream = rr.RecordingStream("skyline-viz")
        stream.connect_grpc(address)
        stream.log_file_from_path(source)
        stream.flush()
        stream.disconnect()


def wait_for(process: subprocess.Popen[bytes]) -> None:
    """Wait until a viewer is closed; Ctrl-C closes it."""
    try:
        with suppress(KeyboardInterrupt):
            process.wait()
    finally:
        ended(process)


def tab_names(client: ViewerClient) -> list[str]:
    """Names of the tabs of what a viewer shows, from left to right."""
    _wait_for_views(client)
    return [name for name, _, _ in _tabs(client)]


def show_tab(client: ViewerClient, tab: str) -> None:
    """Bring a tab to the front.

    Raises:
        ViewerError: There is no such tab.
    """
    _wait_for_views(client)
    for name, path, child in _tabs(client):
        if name == tab:
            blueprint = dict(client.get_blueprint().blueprint)
            changed = {**blueprint[path]["ContainerBlueprint"], "active_tab": child}
            client.set_blueprint(
                {**blueprint, path: {"ContainerBlueprint": changed}}, of="recording"
            )
            return
    raise ViewerError(f"the recording has no tab called {tab}.")


def _save(picture: Image.Image, path: Path) -> None:
    """Write a picture, as PNG or JPEG."""
    with replacing(path) as temporary:
        picture.save(temporary, quality=88)


def _hide_menu(client: ViewerClient) -> None:
    """Leave the window's own bar out of pictures."""
    _wait_for_views(client)
    bar = {"/top_panel": {"PanelBlueprint": {"state": "Hidden"}}}
    client.set_blueprint({**client.get_blueprint().blueprint, **bar}, of="recording")


def _tabs(client: ViewerClient) -> list[tuple[str, str, str]]:
    """Name of each tab, entity path of the container that it is in, and its own."""
    containers: dict[str, Any] = {
        path: parts["ContainerBlueprint"]
        for path, parts in client.get_blueprint().blueprint.items()
        if "ContainerBlueprint" in parts
    }
    return [
        (containers[f"/{child}"]["display_name"], path, child)
        for path, container in containers.items()
        if container.get("container_kind") == "Tabs"
        for child in container["contents"]
        if "display_name" in containers.get(f"/{child}", {})
    ]


def settled_picture(client: ViewerClient) -> Image.Image:
    """Picture of a viewer when nothing moves any more.

    A busy machine is waited for: as long as pictures change, or something is being loaded, for up
    to ten minutes; a picture that stays blank for a minute is the end, and so is one in which
    nothing but a sign of waiting has moved for so long.

    Raises:
        UnsteadyError: A part of it never comes.
        ViewerError: It stays blank, or never settles.
    """
    before: np.ndarray | None = None
    same = 0
    deadline, changed = monotonic() + _PICTURE_SECONDS, monotonic()
    while monotonic() < deadline:
        try:
            taken = client.take_screenshot()
        except TimeoutError:  # of the call: what is large takes its time
            continue
        picture = Image.open(io.BytesIO(taken)).convert("RGB")
        now = np.asarray(picture)
        still = before is not None and np.array_equal(now, before)
        loading = client.get_state().loading
        same = same + 1 if still else 0
        if same >= _STEADY and not loading and now.std() > 1:
            return picture
        moved = before is None or (now != before).any(axis=2).mean() > _WAITING
        if loading or moved:
            changed = monotonic()
        elif monotonic() > changed + _STILL_SECONDS and same == 0:
            raise UnsteadyError("a part of what the viewer shows never came.")
        elif same >= _STEADY and monotonic() > changed + _STILL_SECONDS:
            raise ViewerError(f"the viewer's picture stayed blank for {_STILL_SECONDS:.0f} s.")
        before = now
        sleep(0.15)  # maps are decoded in the background, between two pictures that agree
    raise ViewerError(f"the viewer showed no steady picture within {_PICTURE_SECONDS:.0f} s.")


def free_port() -> int:
    """A port on which nothing listens now."""
    with socket.socket() as one:
        one.bind((LOOPBACK, 0))
        return int(one.getsockname()[1])


def _start(arguments: Sequence[str], **streams: Any) -> subprocess.Popen[bytes]:  # noqa: ANN401
    common = ["--bind", LOOPBACK, "--hide-welcome-screen"]
    alone = _ALONE | {name.lower(): value for name, value in _ALONE.items()}
    environment = {"RUST_LOG": "warn", **os.environ, **alone}
    viewer = program()
    try:
        return started([viewer, *common, *arguments], env=environment, **streams)
    except OSError as error:
        raise ViewerError(f"the viewer {viewer} cannot be started: {error.strerror}.") from error


def _connected(process: subprocess.Popen[bytes], port: int, log: Any) -> ViewerClient:  # noqa: ANN401
    kind = viewer_client()
    deadline = monotonic() + _START_SECONDS
    while monotonic() < deadline:
        if process.poll() is not None:
            break
        try:
            client = kind.connect(f"rerun+http://{LOOPBACK}:{port}/proxy")
            client.get_state()
        except _ERRORS:
            sleep(0.1)
        else:
            return client
    log.seek(0)
    said = log.read().decode(errors="replace")
    if "adapter" in said.lower() or "vulkan" in said.lower():
        raise ViewerError(
            "pictures without a screen need a Vulkan driver; "
            "on Debian and Ubuntu: apt-get install mesa-vulkan-drivers libvulkan1."
        )
    last = said.strip().splitlines()[-1:] or ["it said nothing"]
    raise ViewerError(f"the viewer did not start: {last[0]}.")


def _wait_for_views(client: ViewerClient) -> None:
    deadline = monotonic() + _PICTURE_SECONDS
    while monotonic() < deadline:
        state = client.get_state()
        if state.views and not state.loading:
            return
        sleep(0.05)
    raise ViewerError("the viewer found nothing to show in the recording.")


def _listens(port: int) -> bool:
    with socket.socket() as one:
        one.settimeout(0.5)
        return one.connect_ex((LOOPBACK, port)) == 0
