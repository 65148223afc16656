"""What is tried to make the program lose or misread something, and what was lost: nothing, or else.

A module a part, each with ``measured() -> list[Trial]``. Run all of them, or some, with

    python -m benchmarks.reliability [PART ...]

which writes their tables into ``docs/reliability.md`` and leaves the other parts as they are. The
test suite tries the same faults less often.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Trial:
    """A fault, and what it did."""

    fault: str
    """What goes wrong, in a few words."""

    tried: str
    """What was done, so that a reader could do it by hand."""

    times: int
    """How often."""

    lost: str
    """What was lost, misread or left behind: ``nothing``, or what and how often."""
