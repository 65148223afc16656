"""Tables as Markdown and LaTeX."""

from skyline_viz.evaluation.paper_tables import tables
from skyline_viz.evaluation.paper_tables.writing import latex, markdown


def test_tables_survive_any_name():
    table = tables.Table("I", "a|b", ("a", "b"), (("x|y", r"a_b^c\d$e{f}~"),))
    assert r"| x\|y |" in markdown([table])
    line = next(one for one in latex([table]).splitlines() if "textbackslash" in one)
    assert r"a\_b\textasciicircum{}c\textbackslash{}d\$e\{f\}\textasciitilde{}" in line
