"""``detect`` into one table: in processes, on a cluster, or a shard of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from skyline_viz.command_line.clusters import on_cluster
from skyline_viz.command_line.messages import UsageError, counted, status_after, tell
from skyline_viz.command_line.sizes import foresee
from skyline_viz.command_line.stored import photos_named
from skyline_viz.running.batch import run
from skyline_viz.running.line_table import SUFFIX, arrow
from skyline_viz.running.shards import Shard
from skyline_viz.storage.addresses import is_address
from skyline_viz.storage.uploads import uploaded

if TYPE_CHECKING:
    from skyline_viz.method import Method


def is_table_name(out: str) -> bool:
    """Whether an output is one table, and not a folder of files."""
    return out.lower().endswith(SUFFIX)


def shard_of(text: str | None) -> Shard | None:
    """The shard that was asked for.

    Raises:
        UsageError: There is no such shard.
    """
    try:
        return Shard.parse(text) if text is not None else None
    except ValueError as error:
        raise UsageError(str(error)) from error


@contextmanager
def table_at(out: str, shard: Shard | None) -> Iterator[Path]:
    """The file to write, see `table_of`; that of an address goes there after the block.

    Raises:
        UsageError: See `table_of`.
        StorageError: The address cannot be written.
    """
    arrow()  # where that is missing, nothing is left behind
    if not is_address(out):
        yield table_of(Path(out), shard)
        return
    with uploaded(f"{out}/{shard.file}" if shard else out) as table:
        yield table


def table_of(out: Path, shard: Shard | None) -> Path:
    """The file to write: the output itself, or that of a shard in it.

    Raises:
        UsageError: There is a folder where a file is to be, or the other way round.
    """
    if shard is None:
        if out.is_dir():
            raise UsageError(f"{out} is a folder of shards; name a file, or a --shard.")
        return out
    if out.is_file():
        raise UsageError(f"{out} is a file; shards go into a folder.")
    return out / shard.file


def detect_to_table(
    words: Sequence[str],
    out: str,
    method: Method,
    about: Mapping[str, object],
    *,
    workers: int,
    cluster: str | None,
    shard: Shard | None,
) -> int:
    """Detect photos into a table; return the exit status.

    Args:
        words: Paths and addresses.
        out: File or address to write.
        method: What detects.
        about: What to say of the run in the table.
        workers: Number of processes, where there is no cluster.
        cluster: Address of a cluster, or ``local:N``.
        shard: The part to do.
    """
    from skyline_viz.running.line_run import detect_into, nameable

    arrow()  # before anything is begun
    photos, files = photos_named(words)
    photos = nameable(photos)
    if shard is not None:
        photos = [one for one in photos if shard.holds(one.name)]
        files = [one for one in files if shard.holds(one.where)]
        about = {**about, "shard": str(shard)}
    processes = foresee(files, workers) if files and cluster is None else workers
    with on_cluster(cluster, workers), table_at(out, shard) as table:
        done = detect_into(table, photos, method, partial(run, workers=processes), about)
    if done.known:
        were = "was" if done.known == 1 else "were"
        tell(f"{done.known} of {counted(done.photos, 'photo')} {were} done already.")
    if done.gone:
        rows = "1 row" if done.gone == 1 else f"{done.gone} rows"
        tell(f"{rows} of the earlier table went: of photos that this command does not name.")
    where = out if is_address(out) else table
    tell(f"{counted(done.photos - len(done.failures), 'skyline')} in {where}")
    return status_after([*done.failures, *done.unseen])
