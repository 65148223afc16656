"""Connecting to a cluster: what listens, what is waited for, and what is refused."""

import logging
import socket

import psutil
import pytest

from skyline_viz.running.clusters import connecting as module
from skyline_viz.running.clusters import requirements
from skyline_viz.running.clusters.connecting import cluster_at
from skyline_viz.running.clusters.requirements import ClusterError
from skyline_viz.storage.addresses import StorageError


@pytest.fixture(scope="module")
def two():
    with cluster_at("local:2") as cluster:
        yield cluster


def test_it_is_watched_from_this_machine_alone(two):
    assert two.link.startswith("http://127.0.0.1:")
    process = psutil.Process()
    for one in (process, *process.children(recursive=True)):
        for connection in one.net_connections("inet"):
            if connection.status == psutil.CONN_LISTEN:
                assert connection.laddr.ip in ("127.0.0.1", "::1")


def test_what_is_found_comes_from_the_workers_where_they_are_reached(two):
    assert two.client.direct_to_workers
    (worker, *_) = two.client.scheduler_info()["workers"]
    assert module.reaches([worker])
    with socket.socket() as nobody:
        nobody.bind(("127.0.0.1", 0))
        port = nobody.getsockname()[1]
    for gone in (f"tcp://127.0.0.1:{port}", "inproc://1", "tcp://[::1]:x"):
        assert not module.reaches([worker, gone])


@pytest.mark.parametrize("where", ["", "local", "local:0", "host", "tcp://host", "http://h:1"])
def test_what_is_no_cluster_is_refused(where):
    with pytest.raises(ClusterError, match=r"^a cluster is tcp://HOST:PORT, "), cluster_at(where):
        pass


def test_a_cluster_that_lets_nobody_in_says_why(monkeypatch):
    def refusing(*_, **__):
        raise RuntimeError("another dask\n")

    monkeypatch.setattr(module, "check_scheduler", lambda where: None)
    monkeypatch.setattr("distributed.Client", refusing)
    with (
        pytest.raises(ClusterError, match=r"^the cluster at tcp://h:1 lets .*: another dask\.$"),
        cluster_at("tcp://h:1"),
    ):
        pass


def test_without_dask_the_extra_is_named(monkeypatch):
    def missing(module, what):
        raise StorageError(f"{what} needs distributed; install it with: pip install x")

    monkeypatch.setattr(requirements, "needed", missing)
    with pytest.raises(StorageError, match="a cluster needs distributed"), cluster_at("local:2"):
        pass


def test_a_worker_that_is_long_in_coming_is_waited_for_with_a_sentence(monkeypatch):
    class Client:
        waits = 0

        def wait_for_workers(self, number, timeout):
            self.waits += 1
            if self.waits == 1:
                raise TimeoutError

    told = []
    module.await_worker(client := Client(), "tcp://s:1", told.append)
    assert client.waits == 2
    assert told == ["the cluster at tcp://s:1 has no worker yet; waiting 10 minutes for one."]
    monkeypatch.setattr(Client, "wait_for_workers", _never)
    with pytest.raises(ClusterError, match=r"^the cluster at tcp://s:1 has no worker\.$"):
        module.await_worker(Client(), "tcp://s:1", told.append)


def _never(*_, **__):
    raise TimeoutError


def test_dask_says_nothing_of_its_own(two, caplog):
    logging.getLogger("distributed.client").warning("Couldn't gather 1 keys")
    assert caplog.records == []
