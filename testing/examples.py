"""How many examples a property gets."""

from hypothesis import settings

MORE = 20
"""Times as many examples where they are drawn at random, as `make fuzz` does."""


def examples(count: int, **others: object) -> settings:
    """Settings of a property test: `count` examples that are always the same, or many new ones.

    Args:
        count: Examples that are enough for each run of the tests.
        others: Further settings of hypothesis, say `suppress_health_check`.
    """
    times = 1 if settings().derandomize else MORE
    return settings(max_examples=count * times, **others)
