"""``skyline-annotate open``: proposals that are made ahead, and where the page is served."""

import socket

import pytest

from annotate.commands import open as command
from annotate.commands.open import bound, found_again, propose_all
from annotate.server.address import folder_id, kept_address
from skyline_viz.command_line.messages import UsageError
from testing.labelling import workbench, write_hills


@pytest.fixture
def bench(tmp_path):
    bench = workbench(write_hills(tmp_path / "alps", count=2))
    yield bench
    bench.close()


def test_proposals_are_made_ahead_and_a_photo_that_fails_is_said(bench, capsys):
    (bench.store.folder / "hill-0.png").unlink()
    propose_all(bench)
    told = {card.photo.name: card.confidence for card in bench.cards()}
    assert told["hill-0.png"] is None
    assert told["hill-1.png"] is not None
    assert "hill-0.png" in capsys.readouterr().err


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
    listener, token = found_again(bench.store, "127.0.0.1", 0)
    port = listener.getsockname()[1]
    listener.close()
    listener, again = found_again(bench.store, "127.0.0.1", 0)
    assert (listener.getsockname()[1], again) == (port, token)
    other, another = found_again(bench.store, "127.0.0.1", 0)  # while the first one is taken
    assert other.getsockname()[1] != port
    assert another != token
    kept = kept_address(folder_id(bench.store))
    assert (kept.token, kept.port) == (another, other.getsockname()[1])
    with pytest.raises(UsageError, match="cannot listen"):
        found_again(bench.store, "127.0.0.1", port)  # asked for, and taken
    for one in (listener, other):
        one.close()


def test_an_address_that_cannot_be_kept_is_said(bench, monkeypatch, capsys):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("annotate.server.address.keep_address", full)
    listener, _ = found_again(bench.store, "127.0.0.1", 0)
    listener.close()
    said = capsys.readouterr().err
    assert "the address cannot be kept for the next time: no space left on device." in said
    assert command.PROGRAM in said
