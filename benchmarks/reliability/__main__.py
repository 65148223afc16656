"""Run the parts that are named, or all, and write their tables into ``docs/reliability.md``."""

import sys
from importlib import import_module
from pathlib import Path

from benchmarks.reliability import Trial
from skyline_viz.files import write_text

PAGE = Path(__file__).resolve().parents[2] / "docs" / "reliability.md"
PARTS = sorted(file.stem for file in Path(__file__).parent.glob("[!_]*.py"))


def main() -> None:
    """Measure, and renew the page."""
    chosen = sys.argv[1:] or PARTS
    if unknown := set(chosen) - set(PARTS):
        sys.exit(f"there is no part {', '.join(sorted(unknown))}; there are {', '.join(PARTS)}.")
    for part in chosen:
        table = table_of(import_module(f"benchmarks.reliability.{part}").measured())
        print(f"## {part}\n\n{table}", flush=True)
        write_text(PAGE, renewed(PAGE.read_text(encoding="utf-8"), part, table))


def table_of(trials: list[Trial]) -> str:
    """A Markdown table, a row a trial."""
    rows = [f"| {one.fault} | {one.tried} | {one.times:,} | {one.lost} |" for one in trials]
    head = ["| fault | what was tried | times | lost |", "| --- | --- | ---: | --- |"]
    return "\n".join([*head, *rows])


def renewed(page: str, part: str, table: str) -> str:
    """The page with another table between the marks of a part."""
    begin, end = f"<!-- {part} -->", f"<!-- end of {part} -->"
    before, found, rest = page.partition(begin)
    if not found or end not in rest:
        raise ValueError(f"{PAGE.name} has no place for {part}: {begin} and {end}.")
    return f"{before}{begin}\n\n{table}\n\n{end}{rest.partition(end)[2]}"


if __name__ == "__main__":
    main()
