"""Tables as Markdown and as LaTeX, and for a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import rich.table

from skyline_viz.evaluation.paper_tables.tables import Cell, Table
from skyline_viz.system.names import cell

_ESCAPED = {one: f"\\{one}" for one in "_%&#${}"} | {one: f"${one}$" for one in "<>+|"}
_ESCAPED |= {"\\": r"\textbackslash{}", "^": r"\textasciicircum{}", "~": r"\textasciitilde{}"}


def markdown(tables: Sequence[Table]) -> str:
    """All tables as one Markdown page."""
    parts = []
    for table in tables:
        lines = [
            f"## Table {table.number}: {table.title}",
            "",
            _line(table.headings),
            _line(["---" if column == 0 else _rule(table, column) for column in _columns(table)]),
            *(_line([_shown(cell) for cell in row]) for row in table.rows),
        ]
        parts.append("\n".join([*lines, *(f"\n{note}" for note in table.notes)]))
    return "\n\n".join(parts) + "\n"


def measured_only(tables: Sequence[Table]) -> Iterator[rich.table.Table]:
    """What was measured, for a terminal; published rows are left to the page."""
    for table in tables:
        rows = [row for row in table.rows if not any(map(_is_published, row))]
        if not rows:
            continue
        drawn = rich.table.Table(
            title=f"\nTable {table.number}: {table.title}", title_justify="left",
            box=None, pad_edge=False, header_style="bold",
        )  # fmt: skip
        for column, heading in enumerate(table.headings):
            drawn.add_column(heading, justify="right" if _is_number(table, column) else "left")
        for row in rows:
            drawn.add_row(*(cell(_shown(one)) for one in row))
        yield drawn


def latex(tables: Sequence[Table]) -> str:
    """All tables as LaTeX, to be included in a paper; needs no package."""
    parts = []
    for table in tables:
        kinds = "".join("r" if _is_number(table, column) else "l" for column in _columns(table))
        lines = [
            r"\begin{table*}",
            r"\centering",
            rf"\caption{{{_escaped(table.title)}}}",
            rf"\label{{tab:skyline-{table.number.lower()}}}",
            rf"\begin{{tabular}}{{{kinds}}}",
            r"\hline",
            _latex_line(table.headings),
            r"\hline",
            *(_latex_line([_shown(cell) for cell in row]) for row in table.rows),
            r"\hline",
            r"\end{tabular}",
            *(rf"\par\smallskip {_escaped(note)}" for note in table.notes),
            r"\end{table*}",
        ]
        parts.append("\n".join(lines))
    return "\n\n".join(parts) + "\n"


def _shown(one: Cell) -> str:
    if one is None:
        return ""
    return f"{one:.2f}" if isinstance(one, float) else str(one)


def _is_published(one: Cell) -> bool:
    return isinstance(one, str) and one.endswith(", published")


def _columns(table: Table) -> range:
    return range(len(table.headings))


def _is_number(table: Table, column: int) -> bool:
    cells = [_shown(row[column]) for row in table.rows]
    return all(not cell or cell[0].isdigit() for cell in cells) and column > 0


def _rule(table: Table, column: int) -> str:
    return "---:" if _is_number(table, column) else "---"


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"


def _latex_line(cells: Sequence[str]) -> str:
    return " & ".join(_escaped(cell) for cell in cells) + r" \\"


def _escaped(text: str) -> str:
    return "".join(_ESCAPED.get(one, one) for one in text)
