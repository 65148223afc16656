"""Commands as real processes whose files may not grow beyond a limit, as on a full disk."""

import subprocess
import sys
from pathlib import Path
from typing import Any

from testing import uncovered

LIMITED = """
import resource, sys
from {program}.cli import main
resource.setrlimit(resource.RLIMIT_FSIZE, ({most}, {most}))
sys.exit(main(sys.argv[1:]))
"""


def run(
    program: str, most: int, *words: object, stdout: Any = subprocess.PIPE
) -> subprocess.CompletedProcess[str]:
    """Run a command of ours, none of whose files may hold more than so many bytes."""
    code = LIMITED.format(program=program, most=most)
    command = [sys.executable, "-c", code, *map(str, words)]
    # Python would keep the bytecode of a module as far as the limit goes, and trip over it later
    env = {**uncovered(), "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.run(
        command, stdout=stdout, stderr=subprocess.PIPE, text=True, check=False, env=env
    )


COMMANDS = {
    "detect": (100, "detect DATA --out OUT", ".csv"),
    "detect --json": (3000, "detect DATA --out OUT --json", ".json"),
    "detect with workers": (100, "detect DATA --out OUT --workers 2", ".csv"),
    "evaluate": (100, "evaluate DATA --out OUT", ".json"),
    "evaluate, at the end": (2000, "evaluate DATA --out OUT", "histogram.png"),
    "evaluate methods": (100, "evaluate DATA --out OUT --method edges", ".json"),
    "diagnose": (100, "diagnose DATA --out OUT", ".json"),
    "tables": (100, "tables DATA --out OUT --method edges", ".json"),
    "train": (5000, "train DATA --out OUT/bank.npz", "bank.npz"),
    "gallery": (20_000, "gallery DATA --out OUT --serve", ".rrd"),
    "inspect": (20_000, "inspect DATA --save OUT/a.rrd", "a.rrd"),
    "render": (20_000, "render --out OUT", ".jpg"),
}
"""For each command the limit, its words, and how the name of the file ends that meets it first."""


def fault_of(name: str, data: Path, folder: Path) -> str:
    """What a command does wrong on a full disk; nothing if it does what it should.

    Args:
        name: One of `COMMANDS`.
        data: A small data set.
        folder: An empty folder.
    """
    most, line, ending = COMMANDS[name]
    out = folder / "out"
    out.mkdir()
    words = [word.replace("DATA", str(data)).replace("OUT", str(out)) for word in line.split()]
    done = run("skyline_viz", most, *words)
    said = done.stderr.strip()
    if done.returncode != 1:
        return f"status {done.returncode}: {said}"
    if "\n" in said or not said.startswith(f"skyline-viz: {out}"):
        return f"no sentence: {said}"
    if not said.endswith(f"{ending}: file too large."):
        return f"another sentence: {said}"
    files = [path for path in out.rglob("*") if path.is_file()]
    bad = [one for one in files if one.name.startswith(".") or one.stat().st_size in (0, most)]
    return f"left behind: {bad}" if bad else ""
