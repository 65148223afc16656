"""Tables as Markdown and as LaTeX."""

from __future__ import annotations

from collections.abc import Sequence

from skyline_viz.evaluation.tables import Cell, Table

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


def _shown(cell: Cell) -> str:
    if cell is None:
        return ""
    return f"{cell:.2f}" if isinstance(cell, float) else str(cell)


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
