"""Where the labelling page is served, for whom, and what is told about it."""

from __future__ import annotations

import socket
import webbrowser
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from annotate.commands.options import PROGRAM
from skyline_viz.command_line.messages import UsageError, counted, say, tell
from skyline_viz.system.endings import told_by_signals

if TYPE_CHECKING:
    from annotate.store.store import Store
    from annotate.work.workbench import Workbench


def serve(
    benches: Sequence[Workbench],
    host: str,
    port: int,
    names: Sequence[str] = (),
    *,
    browser: bool,
) -> None:
    """Serve the page until Ctrl-C, and print everybody's address.

    Args:
        benches: What each person works with.
        host: Address to listen on.
        port: Port to listen on; 0 for that of the last time.
        names: More names by which the server may be called.
        browser: Whether the page is opened, where it is one person's.
    """
    import uvicorn

    from annotate.server.app import make_app
    from annotate.server.hosts import is_loopback, names_for, to_be_told, tunnel
    from skyline_viz.viewer.program.process import has_display

    by_name = {bench.assignment.annotator: bench for bench in benches}
    listener, tokens = found_again(benches[0].store, host, port, list(by_name))
    port = listener.getsockname()[1]
    app = make_app({tokens[name]: bench for name, bench in by_name.items()}, names_for(host, names))
    root = f"http://{to_be_told(host)}:{port}/?token="
    addresses = {name: f"{root}{tokens[name]}" for name in by_name}
    tell(*told(benches, addresses))
    if is_loopback(host):
        tell(f"From another machine: {tunnel(host, port)}, and there the same address.")
    else:
        say(
            f"{host} lets other machines in, without encryption; whoever knows an address can "
            "change the labels of its person.",
            PROGRAM,
        )
    tell("Ctrl-C ends.")
    if browser and len(addresses) == 1 and has_display():
        webbrowser.open(next(iter(addresses.values())))
    config = uvicorn.Config(
        app, log_level="warning", access_log=False, server_header=False, lifespan="on"
    )
    server = uvicorn.Server(config)

    def stop() -> None:
        server.should_exit = True

    with told_by_signals(stop):
        server.run(sockets=[listener])


def told(benches: Sequence[Workbench], addresses: Mapping[str, str]) -> list[str]:
    """How far everybody is, and at which address they label.

    Args:
        benches: What each person works with, on the same photos.
        addresses: Where, by the name of the person.
    """
    photos = f"{counted(len(benches[0].photos), 'photo')} in {benches[0].store.folder}"
    left = {}
    for bench in benches:
        progress = bench.progress(bench.cards())
        left[bench.assignment.annotator] = progress.total - progress.done
    if len(left) == 1:
        return [
            *(f"{photos}, {count} to label." for count in left.values()),
            *(f"Label at {address}" for address in addresses.values()),
        ]
    each = [f"{name}, {left[name]} to label: {address}" for name, address in addresses.items()]
    return [f"{photos}. Everybody has an address:", *each]


def found_again(
    store: Store, host: str, port: int, people: Sequence[str]
) -> tuple[socket.socket, Mapping[str, str]]:
    """A socket and tokens: those that the folder had last, as far as they are still to be had.

    Args:
        store: The labels.
        host: Address to listen on.
        port: Port to listen on; 0 for that of the last time.
        people: Who labels.

    Returns:
        The socket, and each person's token by name.

    Raises:
        UsageError: As `bound` does.
    """
    from annotate.server.address import Address, folder_id, keep_address, kept_address

    folder = folder_id(store)
    address = kept_address(folder) or Address()
    try:
        listener = bound(host, port or address.port)
    except UsageError:
        if port:
            raise
        # pages that are open still tell their tokens to whoever listens there now
        address, listener = Address(), bound(host, 0)
    address = replace(address.serving(people), port=listener.getsockname()[1])
    try:
        keep_address(folder, address)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        say(f"the address cannot be kept for the next time: {reason}.", PROGRAM)
    return listener, {name: address.tokens[name] for name in people}


def bound(host: str, port: int) -> socket.socket:
    """A socket that listens on an address.

    Raises:
        UsageError: The address is taken, or not one of this machine.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    # said to be TCP, or answers would wait 40 ms for the other side's acknowledgement
    listener = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
        listener.listen()  # before the address is told: whoever comes now waits, and is served
    except OSError as error:
        listener.close()
        reason = (error.strerror or str(error)).lower()
        raise UsageError(f"cannot listen on {host}, port {port}: {reason}.") from error
    return listener
