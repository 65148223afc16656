"""Addresses of folders: the same after a restart, and nobody else's."""

import json
import os
import shutil
import stat
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from annotate.commands.serving import bound, found_again
from annotate.server.address import (
    Address,
    folder_id,
    keep_address,
    kept_address,
    pass_id,
)
from annotate.store.store import Store
from skyline_viz.command_line.messages import UsageError
from testing.examples import examples
from testing.labelling import write_hills

ADDRESS = Address({"ann": "t" * 32, "bob": "u" * 32}, ("bob",), 8000)


@pytest.fixture
def state(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return tmp_path / "state" / "skyline-annotate"


@pytest.fixture
def store(tmp_path):
    store = Store(write_hills(tmp_path / "alps", count=1))
    yield store
    store.close()


def test_a_restarted_server_has_the_address_it_had(state, store):
    listener, token = found_again(store, "127.0.0.1", 0, ["ann"])
    port = listener.getsockname()[1]
    listener.close()
    again, same = found_again(store, "127.0.0.1", 0, ["ann"])
    assert (again.getsockname()[1], same) == (port, token)
    again.close()


def test_a_port_that_is_taken_gives_way_and_its_token_with_it(state, store):
    taken, token = found_again(store, "127.0.0.1", 0, ["ann"])
    other, new = found_again(store, "127.0.0.1", 0, ["ann"])
    assert other.getsockname()[1] != taken.getsockname()[1]
    assert new != token
    with pytest.raises(UsageError, match="cannot listen"):
        found_again(store, "127.0.0.1", other.getsockname()[1], ["ann"])
    for one in (taken, other):
        one.close()


def test_a_port_that_is_asked_for_is_taken_with_the_same_token(state, store):
    listener, token = found_again(store, "127.0.0.1", 0, ["ann"])
    free = bound("127.0.0.1", 0)
    port = free.getsockname()[1]
    for one in (listener, free):
        one.close()
    listener, same = found_again(store, "127.0.0.1", port, ["ann"])
    assert (listener.getsockname()[1], same) == (port, token)
    listener.close()


def test_only_its_owner_can_read_an_address(state):
    keep_address("folder", ADDRESS)
    (file,) = state.iterdir()
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    assert stat.S_IMODE(state.stat().st_mode) == 0o700
    assert kept_address("folder") == ADDRESS


@pytest.mark.parametrize("mode", [0o640, 0o604, 0o620, 0o602, 0o666])
def test_an_address_that_others_may_know_or_have_written_is_not_believed(state, mode):
    keep_address("folder", ADDRESS)
    (state / "folder.json").chmod(mode)
    assert kept_address("folder") is None


def test_an_address_of_somebody_else_is_not_believed(state, monkeypatch):
    keep_address("folder", ADDRESS)
    here = os.getuid()
    monkeypatch.setattr(os, "getuid", lambda: here + 1)
    assert kept_address("folder") is None


def test_an_address_behind_a_link_is_not_believed(state):
    keep_address("other", ADDRESS)
    (state / "folder.json").symlink_to(state / "other.json")
    assert kept_address("folder") is None


@examples(60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.binary(max_size=60)
    | st.from_regex(rb'\{"port": 8, "people": .*, "tokens": .*\}', fullmatch=True)
)
def test_a_damaged_address_is_none(state, content):
    keep_address("folder", ADDRESS)
    (state / "folder.json").write_bytes(content)
    assert kept_address("folder") is None


@pytest.mark.parametrize(
    "wrong",
    [
        {"tokens": {"ann": "short"}},
        {"tokens": ["t" * 32]},
        {"tokens": {"a/b": "t" * 32}},
        {"people": ["eve"]},
        {"people": 1},
        {"port": 2**16},
        {"port": True},
    ],
)
def test_an_address_that_makes_no_sense_is_none(state, wrong):
    sound = {"port": 8000, "people": ["ann"], "tokens": {"ann": "t" * 32}}
    keep_address("folder", ADDRESS)
    (state / "folder.json").write_text(json.dumps(sound))
    assert kept_address("folder") == Address({"ann": "t" * 32}, ("ann",), 8000)
    (state / "folder.json").write_text(json.dumps(sound | wrong))
    assert kept_address("folder") is None


def test_everybody_keeps_their_address_whoever_else_labels(state, store):
    found = []
    for people in (["ann", "bob"], ["eve"], ["bob", "ann"]):
        listener, tokens = found_again(store, "127.0.0.1", 0, people)
        listener.close()
        assert list(tokens) == people
        assert kept_address(folder_id(store)).people == tuple(people)
        found.append(tokens)
    assert found[0] == found[2]
    assert len({*found[0].values(), *found[1].values()}) == 3


def test_where_it_cannot_be_kept_the_server_starts_nevertheless(
    tmp_path, store, monkeypatch, capsys
):
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "file"))
    listener, token = found_again(store, "127.0.0.1", 0, ["ann"])
    listener.close()
    assert len(token["ann"]) == 32
    assert "cannot be kept for the next time" in capsys.readouterr().err


def test_a_user_without_a_home_has_no_kept_address(monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", "relative")

    def homeless():
        raise RuntimeError("no home")

    monkeypatch.setattr(Path, "home", homeless)
    assert kept_address("folder") is None
    with pytest.raises(OSError, match="no home"):
        keep_address("folder", ADDRESS)


def test_every_folder_and_every_pass_has_an_id_of_its_own(tmp_path, store):
    ids = {folder_id(store)}
    ids |= {pass_id(store, who, number) for who in ("ann", "bob") for number in (1, 2)}
    shutil.copytree(store.folder, tmp_path / "copy")
    copy, other = Store(tmp_path / "copy"), Store(write_hills(tmp_path / "andes", count=1))
    ids |= {folder_id(copy), folder_id(other)}
    assert len(ids) == 7
    for one in (copy, other):
        one.close()
    again = Store(store.folder)
    assert folder_id(again) == folder_id(store)
    again.close()
