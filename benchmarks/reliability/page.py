"""The labelling page and its server: what was done is in the log, once, whatever happens between.

A real page in Chromium works on a folder while its server is killed and started again, and while
the network is away. What it did is compared with the log of the store.
"""

import json
import os
import random
import re
import signal
import tempfile
import threading
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from benchmarks.reliability import Trial
from testing.labelling import write_hills
from testing.programs.browser import Page, chromium
from testing.programs.node import node_tests
from testing.programs.restarts import Restarted, kept

SIZE = {"height": 240, "width": 400}
SCHEDULES = 2000


@dataclass
class Work:
    """What a page did, and what became of it."""

    clicked: int = 0
    kills: int = 0
    offline: int = 0
    reloads: int = 0
    lost: list = field(default_factory=list)
    doubled: list = field(default_factory=list)
    named: list = field(default_factory=list)
    in_order: bool = False


def measured() -> list[Trial]:
    """A thousand operations of a real page, and random schedules of its queue."""
    with tempfile.TemporaryDirectory() as place, chromium() as browser:
        os.environ["XDG_STATE_HOME"] = place  # nothing is kept in the home of whoever runs this
        folder = write_hills(Path(place) / "alps", **SIZE)
        work = worked(browser, folder, operations=1000, kills=25, offline=25, seed=1)
    return [
        Trial(
            "server killed, network away, page loaded again",
            "a page in Chromium hides columns and takes it back, without a pause; meanwhile the "
            f"server is killed and started again {work.kills} times, the network is away "
            f"{work.offline} times, the page is loaded again {work.reloads} times; the log is "
            "compared with what was done",
            work.clicked,
            _lost(work),
        ),
        schedules(),
    ]


def worked(browser, folder, *, operations, kills, offline, seed) -> Work:
    """Let a page do operations while its server is killed and its network goes away."""
    chance = random.Random(seed)
    work, clicks = Work(clicked=operations), []
    moments = chance.sample(range(operations // 5), kills + offline)
    faults = {5 * moment: at < kills for at, moment in enumerate(moments)}  # True kills
    with Restarted(folder) as server:
        page = Page(browser, server)
        page.page.on("dialog", lambda dialog: dialog.accept())
        page.keys("h")
        end = None
        for number in range(operations):
            if number in faults:
                end = (
                    number + chance.randint(1, 4),
                    leave(page, server, work, faults[number], chance),
                )
            clicks.append(act(page, chance, number))
            if end and end[0] == number:
                end[1]()
                end = None
                if chance.random() < 0.3:
                    load_again(page, work)
        if end:
            end[1]()
        page.page.wait_for_function(
            "() => !Object.keys(localStorage).some(key => key.startsWith('skyline-queue'))"
            " || document.querySelector('#lost-list li')",
            timeout=60_000,
        )
        page.page.locator("#saving[data-state=saved]").wait_for(timeout=60_000)
        work.named = page.page.locator("#lost-list li").all_text_contents()
        page.errors.clear()  # of faults that were made on purpose
        page.close()
    log = [told(kind, body) for kind, body in kept(folder).get(1, [])]
    work.lost = list((Counter(clicks) - Counter(log)).elements())
    work.doubled = list((Counter(log) - Counter(clicks)).elements())
    work.in_order = log == clicks
    return work


def leave(page, server, work, kill, chance) -> Callable[[], None]:
    """Take the server or the network away, at some moment; return what brings it back."""
    if not kill:
        work.offline += 1
        page.context.set_offline(True)
        return lambda: page.context.set_offline(False)
    work.kills += 1
    killer = threading.Timer(chance.uniform(0, 0.1), os.kill, (server.process.pid, signal.SIGKILL))
    killer.start()

    def again() -> None:
        killer.join()
        server.kill()
        server.start()

    return again


def load_again(page, work) -> None:
    """Load the page again, whatever still waits."""
    work.reloads += 1
    page.page.reload()
    page.page.locator("#accept:enabled").wait_for(timeout=60_000)
    page.page.keyboard.press("h")


def act(page, chance, number) -> tuple[str | int, ...]:
    """Do one thing as a person does; return what the log must hold of it."""
    if number and chance.random() < 0.15:
        page.page.keyboard.press("u")
        return ("undo",)
    first, last = number * 7 % 190, 200 + number // 190 * 7 + chance.randrange(7)
    ends = [page.place(column, 100, SIZE) for column in (first, last)]
    page.page.mouse.move(*ends[0])
    page.page.mouse.down()
    page.page.mouse.move(*ends[1])
    page.page.mouse.up()
    return ("hidden", first, last)


def told(kind, body) -> tuple[str | int, ...]:
    """An operation of the log as `act` tells it."""
    return (kind, body["first"], body["last"]) if kind == "hidden" else (kind,)


def schedules() -> Trial:
    """The page's queue in Node, before a network and a server that do what they like."""
    done = node_tests("schedules", "--test-reporter=tap", SCHEDULES=str(SCHEDULES))
    found = re.search(r"# (\d+) clicks, (\{.*\})", done.stdout)
    counts = json.loads(found[2])
    return Trial(
        "answers lost, broken off, never given or not ours; full disks; other tabs; crashed pages",
        f"{SCHEDULES:,} random schedules of two tabs in Node: {counts['faults']:,} requests went "
        f"wrong, and {counts['crashes']:,} pages crashed; {counts['lost']:,} clicks that another "
        "tab's change had made senseless, or that the server refused, were named as not kept",
        int(found[1]),
        "nothing" if done.returncode == 0 else "something: the tests of the page fail",
    )


def _lost(work: Work) -> str:
    if not (work.lost or work.doubled or work.named or not work.in_order):
        return "nothing"
    return (
        f"{len(work.lost)} of them ({len(work.named)} named on the page), {len(work.doubled)} "
        f"doubled{'' if work.in_order or work.lost else ', out of order'}"
    )
