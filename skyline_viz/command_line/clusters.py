"""The option ``--cluster``: what a command does in a block is done there."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from skyline_viz.command_line.messages import UsageError, say
from skyline_viz.running.batch import working_on
from skyline_viz.storage.copies import CACHE, caches
from skyline_viz.storage.copy_names import has_copies


@contextmanager
def on_cluster(where: str | None, workers: int = 0, out: Path | None = None) -> Iterator[None]:
    """Work on a cluster in the block; without one, as usual.

    Args:
        where: Address of a cluster, or ``local:N``.
        workers: Number of processes that was asked for.
        out: Folder that workers write into, where they do.

    Raises:
        UsageError: Both are asked for.
        ClusterError: There is no such cluster, or a worker does not see the folder, or that of the
            copies that have been made of data sets.
        StorageError: Dask is not installed.
    """
    if where is None:
        yield
        return
    if workers:
        raise UsageError("--workers are processes of this machine, and --cluster has its own.")
    from skyline_viz.running.clusters.connecting import cluster_at

    with cluster_at(where, say) as there, working_on(there):
        say(f"the cluster shows what it does at {there.link}")
        if out is not None:
            there.check_shared(out)
        if has_copies():
            there.check_shared(caches(), f"let {CACHE} name")
        yield
