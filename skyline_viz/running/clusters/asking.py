"""Asking a scheduler and its workers something, which have a while to answer."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

from skyline_viz.running.clusters.requirements import ClusterError, dask

_REACHED, _GREETING = 10.0, 15.0  # seconds until a server is, and until it has said what it is
_ANSWER = 60.0  # seconds that a worker has, which may be busy with photos
_NAMED = 3  # workers in a sentence
_SILENT = object()


def check_scheduler(where: str) -> None:
    """Make sure that a scheduler of dask answers: dask waits for other servers without an end.

    Raises:
        ClusterError: There is none, or dask lacks what it takes to connect.
    """
    distributed = dask("distributed")
    kind = where.partition("://")[0]
    try:
        certificates = distributed.security.Security().get_connection_args("client")
    except Exception as error:  # each library has classes of its own
        raise ClusterError(f"the certificates of distributed.comm.tls fail: {error}.") from error
    if kind in ("tls", "wss") and certificates["ssl_context"] is None:
        raise ClusterError(
            f"{where} needs certificates; name them in dask's settings, distributed.comm.tls."
        )
    try:
        distributed.comm.registry.get_backend(kind).get_connector()
    except Exception as error:  # an abstract class, or a name that nobody knows
        raise ClusterError(f"{where} needs dask's package for {kind}, as ucxx for ucx.") from error
    try:
        told = asyncio.run(_greeting(where, certificates))
    except Exception as error:  # what a server that is none says is taken for all kinds of things
        raise ClusterError(f"no dask scheduler answers at {where}.") from error
    if not isinstance(told, dict) or told.get("type") != "Scheduler":
        raise ClusterError(f"no dask scheduler answers at {where}.")


async def _greeting(where: str, certificates: dict[str, Any]) -> Any:  # noqa: ANN401
    """What answers there says of itself."""
    async with asyncio.timeout(_GREETING):
        comm = await dask("distributed").comm.connect(where, timeout=_REACHED, **certificates)
        try:
            await comm.write({"op": "identity", "n_workers": 0, "reply": True})
            return await comm.read()
        finally:
            comm.abort()


def every_worker(
    client: Any,  # noqa: ANN401
    function: Callable[..., object],
    *arguments: object,
) -> dict[str, Any]:
    """What a function gives on each worker, or the exception that it ended in there.

    Args:
        client: Dask's connection to them.
        function: What to ask; a worker answers between what else it does.
        arguments: Those of the function.

    Raises:
        ClusterError: Some of them do not answer.
    """

    async def one(worker: str) -> Any:  # noqa: ANN401
        try:
            async with asyncio.timeout(_ANSWER):
                told = await client.run(function, *arguments, workers=[worker], on_error="return")
        except TimeoutError:
            return _SILENT
        return told[worker]

    async def each(workers: list[str]) -> list[Any]:
        return await asyncio.gather(*map(one, workers))

    workers = [*client.scheduler_info(-1)["workers"]]
    told = dict(zip(workers, client.sync(each, workers), strict=True))
    if silent := [worker for worker, said in told.items() if said is _SILENT]:
        more = f" and {len(silent) - _NAMED} more" if len(silent) > _NAMED else ""
        raise ClusterError(
            f"no answer in {_ANSWER:.0f} seconds from the worker {', '.join(silent[:_NAMED])}"
            f"{more}; start it anew, or take it from the cluster."
        )
    return told
