"""Where the labelling page is served, and what is told about it."""

import re
import socket

import pytest

from annotate.commands import serving
from annotate.commands.serving import bound, found_again, told
from annotate.server.address import folder_id, kept_address
from annotate.store.operations import SetStatus
from skyline_viz.command_line.messages import UsageError
from testing.labelling import beside, workbench, write_hills


@pytest.fixture
def bench(tmp_path):
    bench = workbench(write_hills(tmp_path / "alps", count=2))
    yield bench
    bench.close()


def test_a_socket_listens_on_this_machine_alone():
    with bound("127.0.0.1", 0) as listener:
        host, port = listener.getsockname()
        assert host == "127.0.0.1"
        assert listener.proto == socket.IPPROTO_TCP
        with socket.create_connection(("127.0.0.1", port), timeout=20):
            pass
        with pytest.raises(UsageError, match=f"cannot listen on 127.0.0.1, port {port}: "):
            bound("127.0.0.1", port)


def test_a_folder_has_its_address_again(bench):
    listener, token = found_again(bench.store, "127.0.0.1", 0, ["ann"])
    port = listener.getsockname()[1]
    listener.close()
    listener, again = found_again(bench.store, "127.0.0.1", 0, ["ann"])
    assert (listener.getsockname()[1], again) == (port, token)
    other, another = found_again(
        bench.store, "127.0.0.1", 0, ["ann"]
    )  # while the first one is taken
    assert other.getsockname()[1] != port
    assert another != token
    kept = kept_address(folder_id(bench.store))
    assert (kept.tokens, kept.port) == (another, other.getsockname()[1])
    with pytest.raises(UsageError, match="cannot listen"):
        found_again(bench.store, "127.0.0.1", port, ["ann"])  # asked for, and taken
    for one in (listener, other):
        one.close()


def test_an_address_that_cannot_be_kept_is_said(bench, monkeypatch, capsys):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("annotate.server.address.keep_address", full)
    listener, _ = found_again(bench.store, "127.0.0.1", 0, ["ann"])
    listener.close()
    said = capsys.readouterr().err
    assert "the address cannot be kept for the next time: no space left on device." in said
    assert serving.PROGRAM in said


def test_everybody_is_told_their_own_address(bench):
    bob = beside(bench, "bob")
    addresses = {"ann": "http://here/?token=1", "bob": "http://here/?token=2"}
    bench.session(1).apply(SetStatus(status="rejected"), -1)
    first, *each = told([bench, bob], addresses)
    assert first == f"2 photos in {bench.store.folder}. Everybody has an address:"
    assert each == [
        "ann, 1 to label: http://here/?token=1",
        "bob, 2 to label: http://here/?token=2",
    ]
    assert told([bench], {"ann": "http://here/?token=1"}) == [
        f"2 photos in {bench.store.folder}, 1 to label.",
        "Label at http://here/?token=1",
    ]
    bob.finish()


@pytest.mark.parametrize(
    ("host", "out", "err"),
    [
        ("127.0.0.1", r"ssh -N -L (\d+):127.0.0.1:\1 \S+, and there the same address", ""),
        ("127.0.0.2", r"http://127.0.0.2:\d+/\?token=", ""),
    ],
)
def test_what_is_told_at_the_start(bench, host, out, err, monkeypatch, capsys):
    ran = []
    monkeypatch.setattr("uvicorn.Server.run", lambda self, sockets: ran.append(sockets))
    serving.serve([bench], host, 0, browser=False)
    ((listener,),) = ran
    assert listener.getsockname()[0] == host
    listener.close()
    said = capsys.readouterr()
    assert re.search(out, said.out)
    assert said.err == err


def test_what_lets_other_machines_in_is_said(bench, monkeypatch, capsys):
    made = socket.socket()
    made.bind(("127.0.0.1", 0))
    monkeypatch.setattr(serving, "bound", lambda *_: made)
    monkeypatch.setattr("uvicorn.Server.run", lambda self, sockets: None)
    serving.serve([bench], "192.0.2.7", 0, browser=False)
    made.close()
    said = capsys.readouterr()
    assert "http://192.0.2.7:" in said.out
    assert "ssh" not in said.out
    assert "192.0.2.7 lets other machines in, without encryption" in said.err
