"""Connecting to a cluster, or starting one on this machine."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import re
import socket
from collections.abc import Callable, Iterator, Sequence
from multiprocessing import resource_tracker
from typing import Any

from skyline_viz.running.clusters.asking import check_scheduler, every_worker
from skyline_viz.running.clusters.requirements import ClusterError, check, dask, versions
from skyline_viz.running.clusters.working import Cluster
from skyline_viz.storage.addresses import plain
from skyline_viz.system.aftermath import passing_folder
from skyline_viz.system.endings import held_back

LOCAL = re.compile(r"local:([1-9]\d{0,2})")
"""A cluster of so many processes on this machine, for a try."""

_ADDRESS = re.compile(r"(tcp|tls|ws|wss|ucx)://\S+:\d+")
_SOON, _FIRST_WORKER = 3.0, 600.0  # seconds to wait for a worker, untold and at all
_PATIENCE = "10s"  # of connecting
_ASKED, _REACHING = 3, 2.0  # workers to which a connection is tried; seconds for each
_ENDING = 0.5  # seconds that a worker of this machine has to end by itself

_SETTINGS = {
    "distributed.worker.profile.enabled": False,  # of photos it says nothing, and takes time
    "distributed.admin.low-level-log-length": 1000,  # else it grows with the photos
    "distributed.admin.system-monitor.interval": "5s",
    "distributed.admin.tick.interval": "1s",  # 50 a second take a thirtieth of a processor
    "distributed.comm.timeouts.connect": "10s",
    "distributed.scheduler.work-stealing": False,  # photos cost alike, and wait for no data
}
"""What differs from dask's own on a cluster of ours."""


@contextlib.contextmanager
def cluster_at(where: str, tell: Callable[[str], None] = lambda _: None) -> Iterator[Cluster]:
    """Connect to a cluster, or start one on this machine that lasts as long as the block.

    Args:
        where: Address of a scheduler, ``tcp://host:port``; or ``local:N`` for N processes here.
        tell: Gets a sentence where there is something to wait for.

    Raises:
        ClusterError: No scheduler or worker answers there, or workers have other versions than
            this program.
        StorageError: Dask is not installed.
    """
    local = LOCAL.fullmatch(where)
    if not local and not _ADDRESS.fullmatch(where):
        raise ClusterError(
            f"a cluster is tcp://HOST:PORT, the address of its scheduler, or local:N for N "
            f"processes on this machine, not {where}."
        )
    distributed = dask("distributed")
    with contextlib.ExitStack() as until_done:
        until_done.enter_context(dask("dask").config.set(_SETTINGS))
        until_done.enter_context(_quiet())
        if local:
            where = until_done.enter_context(_started(int(local[1]))).scheduler_address
        else:
            check_scheduler(where)
        try:
            client = until_done.enter_context(
                distributed.Client(where, set_as_default=False, timeout=_PATIENCE)
            )
        except Exception as error:  # it has gone, or has another dask
            raise ClusterError(f"the cluster at {where} lets nobody in: {plain(error)}.") from error
        await_worker(client, where, tell)
        check(every_worker(client, versions))
        client.direct_to_workers = reaches([*client.scheduler_info(-1)["workers"]])
        yield Cluster(client)


def await_worker(client: Any, where: str, tell: Callable[[str], None]) -> None:  # noqa: ANN401
    """Wait for the first worker, as one that a queue of jobs is to start.

    Raises:
        ClusterError: There is none after ten minutes.
    """
    try:
        client.wait_for_workers(1, timeout=_SOON)
    except TimeoutError:
        minutes = _FIRST_WORKER / 60
        tell(f"the cluster at {where} has no worker yet; waiting {minutes:.0f} minutes for one.")
    else:
        return
    try:
        client.wait_for_workers(1, timeout=_FIRST_WORKER)
    except TimeoutError as error:
        raise ClusterError(f"the cluster at {where} has no worker.") from error


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """Keep dask from telling of lost workers, whose photos others do."""
    logger = logging.getLogger("distributed.client")
    before = logger.level
    logger.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        logger.setLevel(before)


def reaches(workers: Sequence[str]) -> bool:
    """Whether this machine reaches workers, so that what they find need not pass the scheduler."""
    for worker in workers[:_ASKED]:
        host, _, port = worker.rpartition("://")[2].rpartition(":")
        try:
            socket.create_connection((host.strip("[]"), int(port)), _REACHING).close()
        except (OSError, ValueError):
            return False
    return True


@contextlib.contextmanager
def _started(number: int) -> Iterator[Any]:
    """A cluster on this machine, which only this machine reaches."""
    resource_tracker.ensure_running()  # which lets SIGINT through again in the thread it starts in
    with (
        passing_folder() as scratch,
        dask("dask").config.set({"temporary-directory": str(scratch)}),  # of the scheduler
    ):
        with held_back("SIGINT", "SIGHUP"):  # both reach all processes of a terminal
            cluster = dask("distributed").LocalCluster(
                n_workers=number,
                threads_per_worker=1,
                host="127.0.0.1",
                dashboard_address="127.0.0.1:0",
                local_directory=str(scratch),
                memory_limit=0,
                silence_logs=50,
            )
        with cluster:
            try:
                yield cluster
            finally:
                cluster.sync(_end, cluster)


async def _end(cluster: Any) -> None:  # noqa: ANN401
    """End workers at once, where dask lets them finish what nobody waits for any more."""
    ends = (worker.close(timeout=_ENDING) for worker in cluster.workers.values())
    await asyncio.gather(*ends, return_exceptions=True)
