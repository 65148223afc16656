"""Processor time of several actions, in turn, so that a busy machine is as busy for all of them."""

import time
from collections.abc import Callable, Mapping


def fastest(actions: Mapping[str, Callable[[], object]], repeats: int = 7) -> dict[str, float]:
    """Processor seconds that each action takes in this thread: the fewest of several runs."""
    best = dict.fromkeys(actions, float("inf"))
    for _ in range(repeats):
        for name, action in actions.items():
            start = time.thread_time()
            action()
            best[name] = min(best[name], time.thread_time() - start)
    return best
