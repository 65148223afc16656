"""What had to be decided about a photo or its truth, on its way to whoever should hear it.

They are read deep inside the work, often in another process. A `DatasetItem` notes what there is
to know; whoever listens, such as a command, hears it. Nobody need listen.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

Listener = Callable[[str], None]
"""Takes one sentence, which names its file."""

_listeners: list[Listener] = []


def note(sentence: str) -> None:
    """Tell the innermost listener of this process."""
    if _listeners:
        _listeners[-1](sentence)


@contextmanager
def heard_by(listener: Listener) -> Iterator[None]:
    """Tell `listener` what is noted in the block, in any thread.

    >>> heard = []
    >>> with heard_by(heard.append):
    ...     note("a.png ends without its end marker.")
    >>> heard
    ['a.png ends without its end marker.']
    """
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def once(listener: Listener) -> Listener:
    """A listener that hears each sentence once, however often its photo is read."""
    heard: set[str] = set()

    def hear(sentence: str) -> None:
        if sentence not in heard:
            heard.add(sentence)
            listener(sentence)

    return hear
