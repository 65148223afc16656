"""Asking a scheduler and its workers: whoever does not answer is named."""

import contextlib
import os
import signal
import socket
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import dask
import pytest

from skyline_viz.running.clusters import asking as module
from skyline_viz.running.clusters.asking import check_scheduler, every_worker
from skyline_viz.running.clusters.connecting import cluster_at
from skyline_viz.running.clusters.requirements import ClusterError


@pytest.fixture(scope="module")
def two():
    with cluster_at("local:2") as cluster:
        yield cluster


@contextlib.contextmanager
def web():
    """A server that says what one of the Web does."""

    class Quiet(BaseHTTPRequestHandler):
        def log_message(self, *_):
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Quiet) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield server.server_port
        finally:
            server.shutdown()
            thread.join()


@contextlib.contextmanager
def silent():
    """A server that says nothing."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield server.getsockname()[1]


@contextlib.contextmanager
def nobody():
    with socket.socket() as bound:
        bound.bind(("127.0.0.1", 0))
        yield bound.getsockname()[1]


@pytest.mark.parametrize("server", [web, silent, nobody])
def test_what_is_no_scheduler_is_named(monkeypatch, server):
    monkeypatch.setattr(module, "_REACHED", 0.2)
    monkeypatch.setattr(module, "_GREETING", 1.0)
    with (
        server() as port,
        pytest.raises(ClusterError, match=rf"^no dask scheduler answers at tcp://.*:{port}\.$"),
        cluster_at(f"tcp://127.0.0.1:{port}"),
    ):
        pass


def test_a_scheduler_is_one_and_a_worker_is_none(two):
    check_scheduler(two.client.scheduler.address)
    (worker, *_) = two.client.scheduler_info()["workers"]
    with pytest.raises(ClusterError, match=r"^no dask scheduler answers at "):
        check_scheduler(worker)


@pytest.mark.parametrize(
    ("where", "said"),
    [
        ("tls://127.0.0.1:9", r"^tls://\S+ needs certificates; .* distributed\.comm\.tls\.$"),
        ("wss://127.0.0.1:9", r"^wss://\S+ needs certificates; "),
        ("ucx://127.0.0.1:9", r"^ucx://127\.0\.0\.1:9 needs dask's package for ucx"),
    ],
)
def test_what_dask_lacks_to_connect_is_named(where, said):
    with pytest.raises(ClusterError, match=said), cluster_at(where):
        pass


def test_certificates_that_are_not_there_are_named(tmp_path):
    where = "tls://127.0.0.1:9"
    names = {f"distributed.comm.tls.client.{one}": str(tmp_path / one) for one in ("key", "cert")}
    names["distributed.comm.tls.ca-file"] = str(tmp_path / "ca")
    with (
        dask.config.set(names),
        pytest.raises(ClusterError, match=r"^the certificates of distributed\.comm\.tls fail: "),
    ):
        check_scheduler(where)


def test_each_worker_is_asked(two):
    told = every_worker(two.client, os.path.basename, "a/b")
    assert told == dict.fromkeys(two.client.scheduler_info()["workers"], "b")


def test_a_worker_that_does_not_answer_is_named(two, monkeypatch):
    monkeypatch.setattr(module, "_ANSWER", 0.3)
    process = every_worker(two.client, os.getpid)
    stuck, number = next(iter(process.items()))
    os.kill(number, signal.SIGSTOP)
    try:
        with pytest.raises(ClusterError, match=rf"from the worker {stuck}; start it anew"):
            every_worker(two.client, os.getpid)
    finally:
        os.kill(number, signal.SIGCONT)
